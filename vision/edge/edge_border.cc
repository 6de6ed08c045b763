// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_border.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "vision/edge/edge_curve.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

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

constexpr float kStiffestBend = 2;  // it takes eight clear stations to leave a line for good

// How far across the guess a line may lie, and what each change by a row costs it.
struct LineSearch {
  double reach_px;
  float bend = kStiffBend;
};

// The line most clearly seen, wherever it lies.
StepLine ClearestLine(const Survey& survey, const LineSearch& search) {
  return FindBestLine(survey.map,
                      Scores(survey,
                             [&](int station, int row) {
                               return std::abs(survey.FromGuess(station, row)) <= search.reach_px
                                          ? survey.map.clear[survey.map.At(station, row)]
                                          : kForbidden;
                             }),
                      search.bend);
}

// Of the clear lines about as far apart as bevel and shadow are wide, the outer one.
StepLine OutermostLine(const Survey& survey, const LineSearch& search) {
  constexpr double kOutwards = 0.055;  // a px: of two clear lines the outer one is the border
  constexpr double kMostApart = 8;     // px; lines further out are the background's own
  constexpr double kForHeight = 0.12;  // unless it is much the lower one and near
  const std::vector<double> highest = HighestSteps(survey.map);
  const StepLine clearest = ClearestLine(survey, search);
  return FindBestLine(
      survey.map,
      Scores(
          survey,
          [&](int station, int row) {
            if (std::abs(survey.FromGuess(station, row)) > search.reach_px) return kForbidden;
            const double outwards = std::clamp(
                static_cast<double>(row - clearest.rows[Index(station)]), -kMostApart, kMostApart);
            const size_t at = survey.map.At(station, row);
            const double height =
                std::min(std::abs(survey.map.height[at]) / highest[Index(station)], 1.0);
            return survey.map.clear[at] *
                   static_cast<float>(1 + kOutwards * outwards - kForHeight * (1 - height));
          }),
      search.bend);
}

// The best line at least `apart` rows further in than `line`, over steps of the given sign.
StepLine LineWithin(
    const Survey& survey, const StepLine& line, int apart, const LineSearch& search, double sign) {
  return FindBestLine(survey.map,
                      Scores(survey,
                             [&](int station, int row) {
                               if (row + apart > line.rows[Index(station)] ||
                                   survey.FromGuess(station, row) < -search.reach_px)
                                 return kForbidden;
                               const size_t at = survey.map.At(station, row);
                               return sign * survey.map.height[at] > 0 ? survey.map.clear[at]
                                                                       : 0.0F;
                             }),
                      search.bend);
}

double LengthOf(const EdgePath& path) {
  double length = 0;
  for (size_t i = 1; i < path.points.size(); ++i)
    length += (path.points[i] - path.points[i - 1]).norm();
  return length;
}

// How wide a bevel may be, px: sharper photographs show more of it.
double WidestBevel(const Survey& survey) {
  constexpr double kLeast = 7, kPerLength = 0.05;
  return kLeast + kPerLength * LengthOf(survey.path);
}

// How clear a line is by itself, on average, wherever it lies.
double MeanClearness(const StepMap& map, const StepLine& line) {
  double sum = 0;
  for (int station = 0; station < map.stations; ++station)
    sum += map.clear[map.At(station, line.rows[Index(station)])];
  return sum / map.stations;
}

// The next line further out, where it is about as clear and as high: what lies outside a silhouette
// is not. Where light falls at both, the outer one is no shadow's border, at which it rises: a
// twentieth as high is enough, as a bevel may be hardly brighter than the shadow beside it, and the
// guess may have lain on a bevel's inner line, farther off than it may lie from the border.
StepLine OuterMatch(const Survey& survey, const StepLine& line, const LineSearch& search) {
  constexpr int kApart = 2;  // px; nearer lines are the same
  constexpr double kAsClear = 0.75, kAsHigh = 0.75, kAsHighFalling = 0.05;  // of the line
  constexpr double kStandsOut = 10;  // times what texture does, in which light falls everywhere
  const double height = TypicalHeight(survey.map, line), widest = WidestBevel(survey);
  const auto falls_too = [&](double step) {
    return height < 0 && step < -kStandsOut * survey.map.background_response;
  };
  const StepLine outer =
      FindBestLine(survey.map,
                   Scores(survey,
                          [&](int station, int row) {
                            const int outwards = row - line.rows[Index(station)];
                            if (outwards <= kApart || outwards > widest) return kForbidden;
                            if (std::abs(survey.FromGuess(station, row)) > search.reach_px &&
                                !falls_too(survey.map.height[survey.map.At(station, row)]))
                              return kForbidden;
                            if (FallsDeeper(survey.map, station, row, height)) return 1.0F;
                            return survey.map.clear[survey.map.At(station, row)];
                          }),
                   search.bend);
  // What spoke for the line as the outermost one does not count here.
  const double line_score = std::min(line.score, MeanClearness(survey.map, line));
  const bool clear = outer.score > kAsClear * line_score;
  const double outer_height = HeightUnder(survey.map, outer);
  const double as_high = falls_too(outer_height) ? kAsHighFalling : kAsHigh;
  return clear && std::abs(outer_height) > as_high * std::abs(height) ? outer : line;
}

// A dark band between bright metal and a bright background is the bevel where it is narrow; where
// it is wide, and a sharp step bounds it on the blade's side as well, it is a hard shadow and the
// border is that inner step.
StepLine WithoutHardShadow(const Survey& survey, const StepLine& line, const LineSearch& search) {
  constexpr double kSeen = 0.6, kHigh = 0.5;  // of the outer border's share and height
  const double height = TypicalHeight(survey.map, line);
  if (height <= 0) return line;
  const int apart = static_cast<int>(std::lround(WidestBevel(survey)));
  const StepLine inner = LineWithin(survey, line, apart, search, -1);
  const bool seen = ClearShare(survey.map, inner) > kSeen * ClearShare(survey.map, line);
  return seen && -TypicalHeight(survey.map, inner) > kHigh * height ? inner : line;
}

// The survey and the outermost line in it.
SurveyedBorder WithOutermostLine(Survey survey, double search_px) {
  SurveyedBorder border{std::move(survey), {}};
  border.line = OutermostLine(border.survey, {search_px});
  return border;
}

// How far the line's steps stand out of what texture and noise do.
double StandsOut(const SurveyedBorder& border) {
  const StepMap& map = border.survey.map;
  return std::abs(HeightUnder(map, border.line)) / map.background_response;
}

double SeenShareOf(const SurveyedBorder& border) {
  return ClearShare(border.survey.map, border.line);
}

EdgePath MovedBy(const Eigen::Vector2d& by, EdgePath path) {
  for (Eigen::Vector2d& point : path.points) point += by;
  return path;
}

// Surveys the picture smoothed, as far about the guess as a survey sees.
Survey SurveySmoothed(const cv::Mat& grey,
                      const EdgePath& guess,
                      double search_px,
                      double sigma_px) {
  const cv::Rect box = SurveyedPart({{}, grey.size()}, guess.points, search_px, 4 * sigma_px);
  if (box.empty()) return SurveyStraightened(grey, guess, search_px);
  cv::Mat smooth;
  cv::GaussianBlur(grey(box), smooth, cv::Size(0, 0), sigma_px);
  const Eigen::Vector2d corner(box.x, box.y);
  Survey survey = SurveyStraightened(smooth, MovedBy(-corner, guess), search_px);
  survey.path = MovedBy(corner, std::move(survey.path));
  return survey;
}

// In noise a line can be followed from peak to peak of it, and the picture straightened along that
// line shows it. Smoothed as far as soft edges allow, the border stands out far more, if it is
// noise that hides it and not texture.
std::optional<SurveyedBorder> BorderInNoise(const cv::Mat& grey,
                                            const EdgePath& guess,
                                            double search_px,
                                            const SurveyedBorder& usual) {
  constexpr double kClear =
      10;  // times what noise does; such steps are followed rightly as they are
  constexpr double kNearlyAll = 0.9;  // seen of a line that needs no help
  constexpr double kSigmaPx = 2;      // a blur of 2 px loses a third of its slope
  constexpr double kStandsOut = 2;    // times as far as before; texture gains less
  constexpr double kLeastSeen = 0.5;  // of the smoothed line; less is another one
  const double seen = SeenShareOf(usual);
  if (StandsOut(usual) > kClear || seen > kNearlyAll) return std::nullopt;
  SurveyedBorder smoothed =
      WithOutermostLine(SurveySmoothed(grey, guess, search_px, kSigmaPx), search_px);
  const bool helps = StandsOut(smoothed) > kStandsOut * StandsOut(usual) &&
                     SeenShareOf(smoothed) > std::max(kLeastSeen, seen);
  return helps ? std::optional(std::move(smoothed)) : std::nullopt;
}

// Where noise hides the steps, smoothing or averaging over more of the guess, however it wanders,
// may show them.
SurveyedBorder ClearestSurvey(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  constexpr double kWellSeen = 0.6;
  constexpr double kMuchMore = 1.3;  // times as much seen; a longer mean shows a little more of any
  SurveyedBorder usual = WithOutermostLine(SurveyStraightened(grey, guess, search_px), search_px);
  if (auto smoothed = BorderInNoise(grey, guess, search_px, usual)) return *std::move(smoothed);
  const double seen = SeenShareOf(usual);
  if (seen > kWellSeen) return usual;
  SurveyedBorder averaged = WithOutermostLine(SurveyGuess(grey, guess, search_px), search_px);
  return SeenShareOf(averaged) > kMuchMore * seen ? averaged : usual;
}

// What the blade's texture does within the search range: beyond it a soft shadow is no texture.
double BladeResponse(const Survey& survey, double search_px) {
  constexpr double kLeastResponse = 1e-3;                     // a quarter of a grey level
  constexpr double kShare = 0.25, kSigmaPerQuantile = 3.138;  // keeps clear of a fall next to it
  std::vector<double> heights;
  for (int station = 0; station < survey.map.stations; ++station) {
    for (int row = kStepMargin; survey.FromGuess(station, row) < -search_px; ++row) {
      const size_t at = survey.map.At(station, row);
      if (!survey.map.unseen[at]) heights.push_back(std::abs(survey.map.height[at]));
    }
  }
  if (heights.empty()) return kLeastResponse;
  return std::max(kSigmaPerQuantile * SampleQuantile(std::move(heights), kShare), kLeastResponse);
}

// The border, from the outermost line.
StepLine BorderFrom(const Survey& survey, const StepLine& outermost, const LineSearch& search) {
  return WithoutHardShadow(survey, OuterMatch(survey, outermost, search), search);
}

// How far a line is off the smooth curve that most of it follows. px
double KinkOf(const Survey& survey, const StepLine& line) {
  constexpr double kMost = 0.9, kStiffness = 4;
  const std::vector<Eigen::Vector2d> path = PointsOn(survey, line, kStiffness);
  std::vector<LocatedEdgePoint> points;
  for (std::size_t i = 0; i < path.size(); i += Index(survey.map.layout.spacing)) {
    LocatedEdgePoint point;
    point.point_px = point.trend_px = path[i];
    point.normal = survey.path.normals[i];
    points.push_back(point);
  }
  return OffPlainCurve(points, kMost);
}

// Of their stations, the share in which two lines are the same.
double ShareInCommon(const StepLine& a, const StepLine& b) {
  int common = 0;
  for (std::size_t i = 0; i < a.rows.size(); ++i) common += std::abs(a.rows[i] - b.rows[i]) <= 1;
  return common / static_cast<double>(a.rows.size());
}

// A border that changes to another line part of the way, a bevel's or a shadow's, has a kink. The
// one that changes less readily, if it goes along with the other for a while and has none.
std::optional<StepLine> StifferLine(const SurveyedBorder& border, double search_px) {
  constexpr double kKinkPx = 0.7, kLess = 0.5, kInCommon = 0.2;
  const double kink_px = KinkOf(border.survey, border.line);
  if (kink_px < kKinkPx) return std::nullopt;
  const LineSearch search{search_px, kStiffestBend};
  StepLine stiffer = BorderFrom(border.survey, OutermostLine(border.survey, search), search);
  const bool goes_along = ShareInCommon(stiffer, border.line) > kInCommon;
  if (!goes_along || KinkOf(border.survey, stiffer) > kLess * kink_px) return std::nullopt;
  return stiffer;
}

}  // namespace

double HeightUnder(const StepMap& map, const StepLine& line) {
  std::vector<double> heights;
  for (int station = 0; station < map.stations; ++station)
    heights.push_back(map.height[map.At(station, line.rows[Index(station)])]);
  return Median(std::move(heights));
}

bool FallsDeeper(const StepMap& map, int station, int row, double line_height) {
  constexpr double kFar = 1.25;  // times the line's height, which a soft step shows little of
  const float* height = &map.height[map.At(station, row)];
  return *height < -kFar * std::abs(line_height) && *height <= height[-1] && *height <= height[1];
}

SurveyedBorder FindShadow(const cv::Mat& grey,
                          const EdgePath& guess,
                          double search_px,
                          Shadow shadow) {
  constexpr double kSigmas =
      3;  // texture of normal distribution steps by as much once in 800 places
  SurveyedBorder border{SurveyGuess(grey, guess, search_px), {}};
  const StepMap& map = border.survey.map;
  const double clear = kSigmas * BladeResponse(border.survey, search_px);
  const float sign = shadow == Shadow::kDarker ? -1.0F : 1.0F;
  const auto score = [&](int station, int row) {
    if (std::abs(border.survey.FromGuess(station, row)) > search_px) return kForbidden;
    const float* height = &map.height[map.At(station, row)];
    const auto step = [&](int next) { return sign * height[next]; };
    const bool highest = step(0) > 0 && step(0) >= step(-1) && step(0) >= step(1);
    return highest ? static_cast<float>(1 - std::exp2(-std::pow(*height / clear, 2))) : 0.0F;
  };
  border.line = FindBestLine(map, Scores(border.survey, score), kStiffBend);
  return border;
}

SurveyedBorder FindBorder(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  SurveyedBorder border = ClearestSurvey(grey, guess, search_px);
  border.line = BorderFrom(border.survey, border.line, {search_px});
  if (auto stiffer = StifferLine(border, search_px)) border.line = *std::move(stiffer);
  return border;
}

}  // namespace bladecurve
