// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/edge/edge_band.h"

namespace bladecurve {

// How a straightened band is cut into stations, whose columns are averaged.
struct StationLayout {
  int spacing = 4;  // columns from one station to the next
  int reach = 5;  // columns averaged to either side: evens out texture, smears what is not parallel
};

// Steps of light found everywhere in a straightened band.
struct StepMap {
  StationLayout layout;
  int stations = 0, rows = 0;
  std::vector<float> height;  // [station * rows + row]: light outside minus light inside, smoothed
  std::vector<bool> unseen;   // where it is 0 as the picture ends there
  std::vector<float>
      clear;  // 0 to 1: a sharp step that stands out of texture and noise, at its peak
  double background_response = 0;  // typical height that texture and noise reach
  double blur_px = 0;  // Gaussian sigma of the sharper steps, pixel box apart; good to a third

  [[nodiscard]] size_t At(int station, int row) const {
    return static_cast<size_t>(station) * static_cast<size_t>(rows) + static_cast<size_t>(row);
  }
};

// Rows next to the band's borders in which no step can be told.
inline constexpr int kStepMargin = 5;

// A step at row r lies half a row further out than band.Across(r). Rows from `background_row` on
// show the background alone, as far as is known.
[[nodiscard]] StepMap FindSteps(const StraightBand& band,
                                const StationLayout& layout,
                                int background_row);

// Gaussian sigma of the steps under a line, one row a station; px, pixel box apart.
[[nodiscard]] double BlurUnder(const StepMap& map, const std::vector<int>& rows);

}  // namespace bladecurve
