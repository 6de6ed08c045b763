// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_choice.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vision/edge/edge_border.h"
#include "vision/edge/edge_survey.h"
#include "vision/image/reduced.h"
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

// What a look at the picture, as fine or coarse as it is, takes for the border.
struct Look {
  ChosenTransition chosen;
  double stands_out = 0;     // the line's height, times what texture does; positive where the
                             // outside is brighter
  double from_guess_px = 0;  // where the line lies on average, positive out of the blade
  double blur_px = 0;        // of the line's own steps
};

Look LookAt(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  const auto [survey, line] = FindBorder(grey, guess, search_px);
  const double height = HeightUnder(survey.map, line);
  Look look;
  look.stands_out = height / survey.map.background_response;
  look.blur_px = BlurUnder(survey.map, line.rows);
  for (int station = 0; station < survey.map.stations; ++station)
    look.from_guess_px +=
        survey.FromGuess(station, line.rows[Index(station)]) / survey.map.stations;
  ChosenTransition& chosen = look.chosen;
  // Sharper steps than a fall of light at the border are drawn or engraved, not photographed; where
  // it gets brighter outwards the border may lie in a shadow, which would soften it.
  chosen.blur_px = height < 0 ? std::max(survey.map.blur_px, look.blur_px) : survey.map.blur_px;
  chosen.support = SeenShare(survey, line);
  CompareWithRival(survey, line, search_px, chosen);
  TakeLine(survey, line, chosen);
  return look;
}

// The same in means over squares of two pixels; px of the picture itself. None where the guess is
// too short, the search too narrow or the picture too small for that.
std::optional<Look> LookAtHalf(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  constexpr int kLeastLength = 60, kLeastSide = 16;                // px
  constexpr double kLeastSearch = 6, kMargin = 2, kSmoothing = 3;  // px
  cv::Rect part = SurveyedPart({{}, grey.size()}, guess.points, search_px, kMargin);
  part.width -= part.width % 2;
  part.height -= part.height % 2;
  if (guess.size() < kLeastLength || search_px < kLeastSearch ||
      std::min(part.width, part.height) < kLeastSide)
    return std::nullopt;
  const Reduction reduction{{part.x, part.y}, 2};
  std::vector<Eigen::Vector2d> path;
  for (const Eigen::Vector2d& point : guess.points) path.push_back(reduction.There(point));
  Look look = LookAt(Reduced(grey(part), part.size() / 2),
                     SmoothPath(path, guess.blade_on_left, kSmoothing),
                     search_px / 2);
  for (auto* line : {&look.chosen.points, &look.chosen.rival}) {
    for (Eigen::Vector2d& point : *line) point = reduction.Back(point);
  }
  for (auto* distances : {&look.chosen.inner_px, &look.chosen.outer_px}) {
    for (double& px : *distances) px = std::min(2 * px, kNoTransition);
  }
  for (double* px :
       {&look.chosen.blur_px, &look.chosen.rival_px, &look.from_guess_px, &look.blur_px})
    *px *= 2;
  return look;
}

// Steps that stand out by far and yet look soft along much of the line: no shadow's border need be
// near, the whole picture may be soft.
bool IsSoft(const Look& look) {
  constexpr double kSeen = 0.75, kFar = 5;
  return look.chosen.support < kSeen && std::abs(look.stands_out) > kFar;
}

// Light that falls along the finer look's line, going outwards, and rises again along the coarser
// one's, about as sharply: the line was the ridge of round metal, whose dark flank ends there. A
// shadow's border would be softer, or the blade's in it seen all along.
bool FindsTheFlanksEnd(const Look& coarse, const Look& fine) {
  constexpr double kAsSoft = 1.7;
  return fine.stands_out < 0 && coarse.stands_out > 0 &&
         coarse.from_guess_px > fine.from_guess_px && coarse.blur_px < kAsSoft * fine.blur_px;
}

}  // namespace

ChosenTransition ChooseTransition(const cv::Mat& grey, const EdgePath& guess, double search_px) {
  constexpr double kMuchMore = 1.15;  // times as much seen; a coarser look shows a little more
  constexpr double kSamePx = 2;
  Look look = LookAt(grey, guess, search_px);
  if (!IsSoft(look)) return look.chosen;
  const std::optional<Look> coarse = LookAtHalf(grey, guess, search_px);
  if (!coarse || coarse->chosen.support < kMuchMore * look.chosen.support) return look.chosen;
  if (std::abs(coarse->from_guess_px - look.from_guess_px) < kSamePx)
    look.chosen.support = coarse->chosen.support;
  else if (FindsTheFlanksEnd(*coarse, look))
    return coarse->chosen;
  return look.chosen;
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
