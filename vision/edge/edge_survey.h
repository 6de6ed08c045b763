// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/edge/edge_band.h"
#include "vision/edge/edge_line.h"
#include "vision/edge/edge_path.h"
#include "vision/edge/edge_steps.h"

namespace bladecurve {

// A band straightened along a path, its steps, and how far its middle lies from the guess.
struct Survey {
  EdgePath path;
  std::vector<double> moved_px;  // one per sample of the path
  StraightBand band;
  StepMap map;

  [[nodiscard]] double Across(double row) const { return band.Across(row + 0.5); }
  [[nodiscard]] double FromGuess(int station, double row) const {
    const auto sample = static_cast<size_t>(station) * static_cast<size_t>(map.layout.spacing);
    return moved_px[std::min(sample, moved_px.size() - 1)] + Across(row);
  }
};

// How far a survey sees beyond the search range at most, px: enough to know the background.
inline constexpr double kBeyondSearchPx = 10;

// How far from the guess a survey looks: the line along which it straightens the picture may lie at
// the end of the search.
inline double SurveyReachPx(double search_px) { return 2 * search_px + kBeyondSearchPx; }

// The part of an area that a survey of the guess sees, and margin_px about it; may be empty.
[[nodiscard]] cv::Rect SurveyedPart(const cv::Rect& area_px,
                                    const std::vector<Eigen::Vector2d>& guess_px,
                                    double search_px,
                                    double margin_px = 0);

inline constexpr float kForbidden = -1;  // score of a place where the edge cannot be

// The score of every place of the survey's map, as FindBestLine takes it.
// score(int station, int row) -> float.
template <typename Score>
[[nodiscard]] std::vector<float> Scores(const Survey& survey, const Score& score) {
  std::vector<float> scores(survey.map.clear.size());
  for (int station = 0; station < survey.map.stations; ++station) {
    for (int row = 0; row < survey.map.rows; ++row)
      scores[survey.map.At(station, row)] = score(station, row);
  }
  return scores;
}

// Surveys the guess as it is, averaging along all its wanderings.
[[nodiscard]] Survey SurveyGuess(const cv::Mat& grey, const EdgePath& guess, double search_px);

// The guess wanders about the edge; along any line that runs with the blade the picture can be
// averaged over more columns. The clearest line serves, whichever it is.
[[nodiscard]] Survey SurveyStraightened(const cv::Mat& grey,
                                        const EdgePath& guess,
                                        double search_px);

// Values at stations spread over `count` samples, `spacing` of them from one station to the next.
[[nodiscard]] std::vector<double> Spread(const std::vector<double>& stations,
                                         int spacing,
                                         int count);

// The line in the picture, smoothed; one point for each sample of the survey's path.
[[nodiscard]] std::vector<Eigen::Vector2d> PointsOn(const Survey& survey,
                                                    const StepLine& line,
                                                    double stiffness);

}  // namespace bladecurve
