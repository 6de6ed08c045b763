// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_choice.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "vision/edge_band.h"
#include "vision/edge_line.h"
#include "vision/edge_steps.h"
#include "vision/robust_statistics.h"
#include "vision/tone_curve.h"

namespace bladecurve {
namespace {

constexpr double kBackgroundPx = 10;  // seen beyond the search range, to know the background
constexpr double kBladePx = 8;        // the same inwards
constexpr int kThinning = 2;          // samples of the guess to one that the first look takes
constexpr float kForbidden = -1;      // score of a place where the edge cannot be
constexpr float kLooseBend = 0.25F;  // the guess wanders about the edge by a row every few stations
constexpr float kStiffBend =
    0.5F;  // once straightened, it takes two clear stations to leave a line

size_t Index(int i) { return static_cast<size_t>(i); }

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

// Values at stations spread over `count` evenly spaced samples.
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

// A band straightened along a path, its steps, and how far its middle lies from the guess.
struct Survey {
  EdgePath path;
  std::vector<double> moved_px;  // one per sample of the path
  StraightBand band;
  StepMap map;

  [[nodiscard]] double Across(double row) const { return band.Across(row + 0.5); }
  [[nodiscard]] double FromGuess(int station, double row) const {
    return moved_px[std::min(Index(station * map.layout.spacing), moved_px.size() - 1)] +
           Across(row);
  }
};

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
      grey, EncodedValues(), survey.path, search_px + kBladePx, search_px + kBackgroundPx);
  const int background_row = static_cast<int>(std::lround(search_px - survey.band.first_across_px));
  survey.map = FindSteps(survey.band, layout, background_row);
  return survey;
}

std::vector<float> Scores(const Survey& survey,
                          const std::function<float(int station, int row)>& score) {
  std::vector<float> scores(survey.map.clear.size());
  for (int station = 0; station < survey.map.stations; ++station) {
    for (int row = 0; row < survey.map.rows; ++row)
      scores[survey.map.At(station, row)] = score(station, row);
  }
  return scores;
}

// Every second sample: enough for a first look.
EdgePath Thinned(const EdgePath& path) {
  EdgePath thin;
  thin.blade_on_left = path.blade_on_left;
  for (size_t i = 0; i < path.points.size(); i += kThinning) {
    thin.points.push_back(path.points[i]);
    thin.tangents.push_back(path.tangents[i]);
    thin.normals.push_back(path.normals[i]);
    thin.curvatures.push_back(path.curvatures[i]);
  }
  return thin;
}

// The guess wanders about the edge; along any line that runs with the blade the picture can be
// averaged over more columns. The clearest line serves, whichever it is.
Survey Straightened(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  constexpr double kStiffness =
      400;                          // bends within 25 stations are the line's own, not the guess's
  constexpr double kSmoothing = 3;  // px
  const Survey rough = Take(grey, Thinned(guess), {}, search_px, {2, 2});
  const std::vector<float> scores = Scores(rough, [&](int station, int row) {
    return std::abs(rough.Across(row)) <= search_px ? rough.map.clear[rough.map.At(station, row)]
                                                    : kForbidden;
  });
  std::vector<double> rows =
      SmoothRows(rough.map, FindBestLine(rough.map, scores, kLooseBend), kStiffness);
  for (double& row : rows) row = rough.Across(row);
  const std::vector<double> offsets =
      Spread(rows, kThinning * rough.map.layout.spacing, guess.size());
  EdgePath path = SmoothPath(Shifted(guess, offsets), guess.blade_on_left, kSmoothing);
  return Take(grey, std::move(path), offsets, search_px, {4, 9});
}

// Highest clear step of each station.
std::vector<double> HighestSteps(const StepMap& map) {
  std::vector<double> highest(Index(map.stations), 1e-9);
  for (int station = 0; station < map.stations; ++station) {
    for (int row = 0; row < map.rows; ++row) {
      const size_t at = map.At(station, row);
      highest[Index(station)] = std::max(
          highest[Index(station)], static_cast<double>(std::abs(map.height[at]) * map.clear[at]));
    }
  }
  return highest;
}

// The line most clearly seen, wherever it lies.
StepLine ClearestLine(const Survey& survey, double search_px) {
  return FindBestLine(survey.map,
                      Scores(survey,
                             [&](int station, int row) {
                               return std::abs(survey.FromGuess(station, row)) <= search_px
                                          ? survey.map.clear[survey.map.At(station, row)]
                                          : kForbidden;
                             }),
                      kStiffBend);
}

// Of the clear lines about as far apart as bevel and shadow are wide, the outer one.
StepLine OutermostLine(const Survey& survey, double search_px) {
  constexpr double kOutwards = 0.055;  // a px: of two clear lines the outer one is the border
  constexpr double kMostApart = 8;     // px; lines further out are the background's own
  constexpr double kForHeight = 0.12;  // unless it is much the lower one and near
  const std::vector<double> highest = HighestSteps(survey.map);
  const StepLine clearest = ClearestLine(survey, search_px);
  return FindBestLine(
      survey.map,
      Scores(
          survey,
          [&](int station, int row) {
            if (std::abs(survey.FromGuess(station, row)) > search_px) return kForbidden;
            const double outwards = std::clamp(
                static_cast<double>(row - clearest.rows[Index(station)]), -kMostApart, kMostApart);
            const size_t at = survey.map.At(station, row);
            const double height =
                std::min(std::abs(survey.map.height[at]) / highest[Index(station)], 1.0);
            return survey.map.clear[at] *
                   static_cast<float>(1 + kOutwards * outwards - kForHeight * (1 - height));
          }),
      kStiffBend);
}

// The best line at least `apart` rows further in than `line`, over steps of the given sign.
StepLine LineWithin(
    const Survey& survey, const StepLine& line, int apart, double search_px, double sign) {
  return FindBestLine(survey.map,
                      Scores(survey,
                             [&](int station, int row) {
                               if (row + apart > line.rows[Index(station)] ||
                                   survey.FromGuess(station, row) < -search_px)
                                 return kForbidden;
                               const size_t at = survey.map.At(station, row);
                               return sign * survey.map.height[at] > 0 ? survey.map.clear[at]
                                                                       : 0.0F;
                             }),
                      kStiffBend);
}

// A dark band between bright metal and a bright background is the bevel where it is narrow; where
// it is wide, and a sharp step bounds it on the blade's side as well, it is a hard shadow and the
// border is that inner step.
StepLine WithoutHardShadow(const Survey& survey, const StepLine& line, double search_px) {
  constexpr double kWidestBevel = 7,
                   kBevelPerLength =
                       0.004;  // px, and px a px of edge: sharper photographs show more
  constexpr double kSeen = 0.6, kHigh = 0.5;  // of the outer border's share and height
  const double height = TypicalHeight(survey.map, line);
  if (height <= 0) return line;
  const int apart =
      static_cast<int>(std::lround(kWidestBevel + kBevelPerLength * survey.path.size()));
  const StepLine inner = LineWithin(survey, line, apart, search_px, -1);
  const bool seen = ClearShare(survey.map, inner) > kSeen * ClearShare(survey.map, line);
  return seen && -TypicalHeight(survey.map, inner) > kHigh * height ? inner : line;
}

// Distance from the line to the next clear step, going by `toward`.
double FreeDistance(const StepMap& map, int station, int row, int toward) {
  constexpr double kShare = 0.2;  // lower steps do no harm
  constexpr int kOwn = 2;         // rows that still belong to the step itself
  const double height = std::abs(map.height[map.At(station, row)]);
  for (int r = row + kOwn * toward; r >= kStepMargin && r + kStepMargin < map.rows; r += toward) {
    const float* other = &map.height[map.At(station, r)];
    const bool peak =
        std::abs(other[0]) >= std::abs(other[-1]) && std::abs(other[0]) >= std::abs(other[1]);
    if (peak && std::abs(other[0]) > std::max(kShare * height, 3 * map.background_response))
      return std::abs(PeakRow(map, station, r) - PeakRow(map, station, row));
  }
  return kNoTransition;
}

// Typical distance of a station's neighbours, so that one glint does not shorten the fit.
std::vector<double> FreeDistances(const StepMap& map, const StepLine& line, int toward) {
  constexpr int kReach = 3;
  std::vector<double> single, typical;
  for (int station = 0; station < map.stations; ++station) {
    single.push_back(FreeDistance(map, station, line.rows[Index(station)], toward));
  }
  for (int station = 0; station < map.stations; ++station) {
    std::vector<double> near(single.begin() + std::max(station - kReach, 0),
                             single.begin() + std::min(station + kReach + 1, map.stations));
    std::nth_element(
        near.begin(), near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2), near.end());
    typical.push_back(near[near.size() / 2]);
  }
  return typical;
}

// The line in the picture, smoothed.
std::vector<Eigen::Vector2d> PointsOn(const Survey& survey,
                                      const StepLine& line,
                                      double stiffness) {
  std::vector<double> rows = SmoothRows(survey.map, line, stiffness);
  for (double& row : rows) row = survey.Across(row);
  return Shifted(survey.path, Spread(rows, survey.map.layout.spacing, survey.path.size()));
}

// The best other line that might be the border: one further out, or one within where the band
// between them may be a shadow, that is darker than both its sides.
StepLine RivalOf(const Survey& survey, const StepLine& line, double search_px) {
  constexpr int kApart = 2;  // rows; nearer lines are the same
  const bool dark_inside = TypicalHeight(survey.map, line) > 0;
  return FindBestLine(survey.map,
                      Scores(survey,
                             [&](int station, int row) {
                               const int outwards = row - line.rows[Index(station)];
                               const size_t at = survey.map.At(station, row);
                               if (std::abs(survey.FromGuess(station, row)) > search_px)
                                 return kForbidden;
                               if (std::abs(outwards) <= kApart) return 0.25F * kForbidden;
                               const bool shadow = dark_inside && survey.map.height[at] < 0;
                               return outwards > 0 || shadow ? survey.map.clear[at] : 0.0F;
                             }),
                      kStiffBend);
}

void CompareWithRival(const Survey& survey,
                      const StepLine& line,
                      double search_px,
                      ChosenTransition& chosen) {
  constexpr double kAsHigh = 0.5;          // of the line's height; lower ones are texture
  constexpr double kRivalStiffness = 400;  // a guess, not an edge
  const StepLine rival = RivalOf(survey, line, search_px);
  for (int station = 0; station < survey.map.stations; ++station) {
    chosen.rival_px += (rival.rows[Index(station)] - line.rows[Index(station)]) /
                       static_cast<double>(survey.map.stations);
  }
  chosen.rival = PointsOn(survey, rival, kRivalStiffness);
  const double as_high = std::abs(TypicalHeight(survey.map, rival)) /
                         std::max(kAsHigh * std::abs(TypicalHeight(survey.map, line)), 1e-6);
  chosen.ambiguity =
      std::clamp(rival.score / std::max(line.score, 1e-6), 0.0, 1.0) * std::min(as_high, 1.0);
}

struct Surveyed {
  Survey survey;
  StepLine line;
};

// Where noise hides the steps, averaging over more of the guess, however it wanders, may show them.
Surveyed SurveyAndLine(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  constexpr double kWellSeen = 0.6;
  constexpr StationLayout kLong = {4, 25};
  Surveyed usual{Straightened(grey, guess, search_px), {}};
  usual.line = WithoutHardShadow(usual.survey, OutermostLine(usual.survey, search_px), search_px);
  const double seen = ClearShare(usual.survey.map, usual.line);
  if (seen > kWellSeen) return usual;
  Surveyed averaged{Take(grey, guess, {}, search_px, kLong), {}};
  averaged.line = OutermostLine(averaged.survey, search_px);
  return ClearShare(averaged.survey.map, averaged.line) > seen ? averaged : usual;
}

}  // namespace

ChosenTransition ChooseTransition(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  const auto [survey, line] = SurveyAndLine(grey, guess, search_px);
  ChosenTransition chosen;
  chosen.blur_px = survey.map.blur_px;
  chosen.support = ClearShare(survey.map, line);
  CompareWithRival(survey, line, search_px, chosen);
  const int spacing = survey.map.layout.spacing, samples = survey.path.size();
  chosen.inner_px = Spread(FreeDistances(survey.map, line, -1), spacing, samples);
  chosen.outer_px = Spread(FreeDistances(survey.map, line, 1), spacing, samples);
  constexpr double kStiffness = 4;  // bends within three stations are noise
  chosen.points = PointsOn(survey, line, kStiffness);
  return chosen;
}

}  // namespace bladecurve
