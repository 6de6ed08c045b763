// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_survey.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "vision/image/tone_curve.h"

namespace bladecurve {
namespace {

constexpr double kBladePx = 8;        // seen beyond the search range inwards
constexpr int kThinning = 2;          // samples of the guess to one that the first look takes
constexpr int kEnoughToSurvey = 500;  // samples that tell as much as more of them would
constexpr float kLooseBend = 0.25F;  // the guess wanders about the edge by a row every few stations

// Grey values as they are stored: noise and texture are then about alike in light and shadow, which
// linear light is not.
const ToneCurve& EncodedValues() {
  static const ToneCurve encoded = [] {
    ToneCurve curve;
    for (size_t v = 0; v < curve.linear.size(); ++v) curve.linear[v] = static_cast<float>(v) / 255;
    return curve;
  }();
  return encoded;
}

Survey Take(const cv::Mat& grey,
            EdgePath path,
            std::vector<double> moved_px,
            double search_px,
            const StationLayout& layout) {
  Survey survey;
  survey.path = std::move(path);
  survey.moved_px = std::move(moved_px);
  survey.moved_px.resize(survey.path.points.size(),
                         survey.moved_px.empty() ? 0.0 : survey.moved_px.back());
  survey.band = StraightenBand(
      grey, EncodedValues(), survey.path, search_px + kBladePx, search_px + kBeyondSearchPx);
  const int background_row = static_cast<int>(std::lround(search_px - survey.band.first_across_px));
  survey.map = FindSteps(survey.band, layout, background_row);
  return survey;
}

// One sample in `stride`.
EdgePath Thinned(const EdgePath& path, int stride) {
  EdgePath thin;
  thin.blade_on_left = path.blade_on_left;
  for (size_t i = 0; i < path.points.size(); i += Index(stride)) {
    thin.points.push_back(path.points[i]);
    thin.tangents.push_back(path.tangents[i]);
    thin.normals.push_back(path.normals[i]);
    thin.curvatures.push_back(path.curvatures[i]);
  }
  return thin;
}

int StrideFor(const EdgePath& guess) { return 1 + guess.size() / kEnoughToSurvey; }

}  // namespace

cv::Rect SurveyedPart(const cv::Rect& area_px,
                      const std::vector<Eigen::Vector2d>& guess_px,
                      double search_px,
                      double margin_px) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : guess_px) box.extend(p);
  const double reach = SurveyReachPx(search_px) + margin_px;
  const Eigen::Array2d low = box.min().array() - reach, high = box.max().array() + reach;
  const cv::Point corner(static_cast<int>(low.x()), static_cast<int>(low.y()));
  const cv::Point end(static_cast<int>(high.x()) + 1, static_cast<int>(high.y()) + 1);
  return cv::Rect(corner, end) & area_px;
}

std::vector<double> Spread(const std::vector<double>& stations, int spacing, int count) {
  std::vector<double> values;
  const int last = static_cast<int>(stations.size()) - 1;
  for (int i = 0; i < count; ++i) {
    const double position = std::min(static_cast<double>(i) / spacing, static_cast<double>(last));
    const int a = static_cast<int>(position), b = std::min(a + 1, last);
    values.push_back(stations[Index(a)] +
                     (position - a) * (stations[Index(b)] - stations[Index(a)]));
  }
  return values;
}

Survey SurveyGuess(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  constexpr StationLayout kLong = {4, 25};
  return Take(grey, Thinned(guess, StrideFor(guess)), {}, search_px, kLong);
}

Survey SurveyStraightened(const cv::Mat& grey, const EdgePath& whole_guess, double search_px) {
  const int stride = StrideFor(whole_guess);
  const EdgePath guess = Thinned(whole_guess, stride);
  constexpr double kStiffness =
      400;                          // bends within 25 stations are the line's own, not the guess's
  constexpr double kSmoothing = 3;  // px
  const Survey rough = Take(grey, Thinned(guess, kThinning), {}, search_px, {2, 2});
  const std::vector<float> scores = Scores(rough, [&](int station, int row) {
    return std::abs(rough.Across(row)) <= search_px ? rough.map.clear[rough.map.At(station, row)]
                                                    : kForbidden;
  });
  std::vector<double> rows =
      SmoothRows(rough.map, FindBestLine(rough.map, scores, kLooseBend), kStiffness);
  for (double& row : rows) row = rough.Across(row);
  const std::vector<double> offsets =
      Spread(rows, kThinning * rough.map.layout.spacing, guess.size());
  const EdgePath path = SmoothPath(Shifted(guess, offsets), guess.blade_on_left, kSmoothing);
  constexpr int kReachPx = 9;
  return Take(grey, Thinned(path, stride), offsets, search_px, {4, kReachPx / stride});
}

std::vector<Eigen::Vector2d> PointsOn(const Survey& survey,
                                      const StepLine& line,
                                      double stiffness) {
  std::vector<double> rows = SmoothRows(survey.map, line, stiffness);
  for (double& row : rows) row = survey.Across(row);
  return Shifted(survey.path, Spread(rows, survey.map.layout.spacing, survey.path.size()));
}

}  // namespace bladecurve
