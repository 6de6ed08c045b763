// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_choice.h"

#include <algorithm>
#include <cmath>

#include "vision/edge/edge_border.h"
#include "vision/edge/edge_survey.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

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

// The line itself, and how far from it others lie.
void TakeLine(const Survey& survey, const StepLine& line, ChosenTransition& chosen) {
  const int spacing = survey.map.layout.spacing, samples = survey.path.size();
  chosen.inner_px = Spread(FreeDistances(survey.map, line, -1), spacing, samples);
  chosen.outer_px = Spread(FreeDistances(survey.map, line, 1), spacing, samples);
  constexpr double kStiffness = 4;  // bends within three stations are noise
  chosen.points = PointsOn(survey, line, kStiffness);
}

}  // namespace

ChosenTransition ChooseTransition(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  const auto [survey, line] = FindBorder(grey, guess, search_px);
  ChosenTransition chosen;
  // Sharper steps than a fall of light at the border are drawn or engraved, not photographed; where
  // it gets brighter outwards the border may lie in a shadow, which would soften it.
  chosen.blur_px = survey.map.blur_px;
  if (HeightUnder(survey.map, line) < 0)
    chosen.blur_px = std::max(chosen.blur_px, BlurUnder(survey.map, line.rows));
  chosen.support = SeenShare(survey, line);
  CompareWithRival(survey, line, search_px, chosen);
  TakeLine(survey, line, chosen);
  return chosen;
}

ChosenTransition ChooseShadow(const cv::Mat& grey,
                              const EdgePath& guess,
                              double search_px,
                              Shadow shadow) {
  const auto [survey, line] = FindShadow(grey, guess, search_px, shadow);
  ChosenTransition chosen;
  chosen.blur_px = survey.map.blur_px;
  chosen.support = std::clamp(line.score, 0.0, 1.0);
  TakeLine(survey, line, chosen);
  return chosen;
}

}  // namespace bladecurve
