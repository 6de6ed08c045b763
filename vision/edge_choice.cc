// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_choice.h"

#include <algorithm>
#include <cmath>

#include "vision/edge_survey.h"
#include "vision/robust_statistics.h"

namespace bladecurve {
namespace {

constexpr float kStiffBend =
    0.5F;  // once straightened, it takes two clear stations to leave a line

size_t Index(int i) { return static_cast<size_t>(i); }

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

double LengthOf(const EdgePath& path) {
  double length = 0;
  for (size_t i = 1; i < path.points.size(); ++i)
    length += (path.points[i] - path.points[i - 1]).norm();
  return length;
}

// Median height along the line, clear or not.
double HeightUnder(const StepMap& map, const StepLine& line) {
  std::vector<double> heights;
  for (int station = 0; station < map.stations; ++station)
    heights.push_back(map.height[map.At(station, line.rows[Index(station)])]);
  return Median(std::move(heights));
}

// How wide a bevel may be, px: sharper photographs show more of it.
double WidestBevel(const Survey& survey) {
  constexpr double kLeast = 7, kPerLength = 0.05;
  return kLeast + kPerLength * LengthOf(survey.path);
}

// A fall of light, going outwards, far greater than that of a line: no shadow does that, however
// soft it is.
bool FallsDeeper(const StepMap& map, int station, int row, double line_height) {
  constexpr double kFar = 1.25;  // times the line's height, which a soft step shows little of
  const float* height = &map.height[map.At(station, row)];
  return *height < -kFar * std::abs(line_height) && *height <= height[-1] && *height <= height[1];
}

// Share of its stations in which the line is clear or a deep fall of light, however soft.
double SeenShare(const Survey& survey, const StepLine& line) {
  constexpr float kClear = 0.5F;
  constexpr double kDeep = 10;  // times what texture does
  const StepMap& map = survey.map;
  int seen = 0;
  for (int station = 0; station < map.stations; ++station) {
    const int row = line.rows[Index(station)];
    seen += map.clear[map.At(station, row)] > kClear ||
            FallsDeeper(map, station, row, kDeep * map.background_response);
  }
  return static_cast<double>(seen) / map.stations;
}

// The next line further out, where it is about as clear and as high: what lies outside a silhouette
// is not.
StepLine OuterMatch(const Survey& survey, const StepLine& line, double search_px) {
  constexpr int kApart = 2;                          // px; nearer lines are the same
  constexpr double kAsClear = 0.75, kAsHigh = 0.75;  // of the line
  const double height = TypicalHeight(survey.map, line), widest = WidestBevel(survey);
  const StepLine outer =
      FindBestLine(survey.map,
                   Scores(survey,
                          [&](int station, int row) {
                            const int outwards = row - line.rows[Index(station)];
                            if (outwards <= kApart || outwards > widest) return kForbidden;
                            if (std::abs(survey.FromGuess(station, row)) > search_px)
                              return kForbidden;
                            if (FallsDeeper(survey.map, station, row, height)) return 1.0F;
                            return survey.map.clear[survey.map.At(station, row)];
                          }),
                   kStiffBend);
  const bool clear = outer.score > kAsClear * line.score;
  const bool high = std::abs(HeightUnder(survey.map, outer)) > kAsHigh * std::abs(height);
  return clear && high ? outer : line;
}

// A dark band between bright metal and a bright background is the bevel where it is narrow; where
// it is wide, and a sharp step bounds it on the blade's side as well, it is a hard shadow and the
// border is that inner step.
StepLine WithoutHardShadow(const Survey& survey, const StepLine& line, double search_px) {
  constexpr double kSeen = 0.6, kHigh = 0.5;  // of the outer border's share and height
  const double height = TypicalHeight(survey.map, line);
  if (height <= 0) return line;
  const int apart = static_cast<int>(std::lround(WidestBevel(survey)));
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
  constexpr double kAsHigh = 0.5;          // of the line's height; lower ones within are texture
  constexpr double kAsHighBeyond = 0.2;    // beyond, a low step may still be a dark bevel's border
  constexpr double kRivalStiffness = 400;  // a guess, not an edge
  const StepLine rival = RivalOf(survey, line, search_px);
  for (int station = 0; station < survey.map.stations; ++station) {
    chosen.rival_px += (rival.rows[Index(station)] - line.rows[Index(station)]) /
                       static_cast<double>(survey.map.stations);
  }
  chosen.rival = PointsOn(survey, rival, kRivalStiffness);
  const double as_high = std::abs(TypicalHeight(survey.map, rival)) /
                         std::max((chosen.rival_px > 0 ? kAsHighBeyond : kAsHigh) *
                                      std::abs(TypicalHeight(survey.map, line)),
                                  1e-6);
  chosen.ambiguity =
      std::clamp(rival.score / std::max(line.score, 1e-6), 0.0, 1.0) * std::min(as_high, 1.0);
}

struct Surveyed {
  Survey survey;
  StepLine line;
};

// Where noise hides the steps, averaging over more of the guess, however it wanders, may show them.
Surveyed ClearerSurvey(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  constexpr double kWellSeen = 0.6;
  constexpr double kMuchMore = 1.3;  // times as much seen; a longer mean shows a little more of any
  Surveyed usual{SurveyStraightened(grey, guess, search_px), {}};
  usual.line = OutermostLine(usual.survey, search_px);
  const double seen = ClearShare(usual.survey.map, usual.line);
  if (seen > kWellSeen) return usual;
  Surveyed averaged{SurveyGuess(grey, guess, search_px), {}};
  averaged.line = OutermostLine(averaged.survey, search_px);
  return ClearShare(averaged.survey.map, averaged.line) > kMuchMore * seen ? averaged : usual;
}

Surveyed SurveyAndLine(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  Surveyed surveyed = ClearerSurvey(grey, guess, search_px);
  surveyed.line = OuterMatch(surveyed.survey, surveyed.line, search_px);
  surveyed.line = WithoutHardShadow(surveyed.survey, surveyed.line, search_px);
  return surveyed;
}

}  // namespace

ChosenTransition ChooseTransition(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  const auto [survey, line] = SurveyAndLine(grey, guess, search_px);
  ChosenTransition chosen;
  // Sharper steps than a fall of light at the border are drawn or engraved, not photographed; where
  // it gets brighter outwards the border may lie in a shadow, which would soften it.
  chosen.blur_px = survey.map.blur_px;
  if (HeightUnder(survey.map, line) < 0)
    chosen.blur_px = std::max(chosen.blur_px, BlurUnder(survey.map, line.rows));
  chosen.support = SeenShare(survey, line);
  CompareWithRival(survey, line, search_px, chosen);
  const int spacing = survey.map.layout.spacing, samples = survey.path.size();
  chosen.inner_px = Spread(FreeDistances(survey.map, line, -1), spacing, samples);
  chosen.outer_px = Spread(FreeDistances(survey.map, line, 1), spacing, samples);
  constexpr double kStiffness = 4;  // bends within three stations are noise
  chosen.points = PointsOn(survey, line, kStiffness);
  return chosen;
}

}  // namespace bladecurve
