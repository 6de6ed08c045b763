// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/edge_band.h"

namespace bladecurve {

// Which of the transitions in a straightened band is the blade's border, to about a pixel.
struct ChosenTransition {
  std::vector<double> offset_px;  // from the path, one per column, positive out of the blade
  std::vector<double>
      inner_px;  // how far the blade goes without another transition, one per column
  std::vector<double> outer_px;  // the same for the background
  double support = 0;            // share of columns in which the transition is seen, 0 to 1
  double ambiguity = 0;  // 0: nothing else comes near; 1: another line through the band is as good
  double rival_px = 0;   // how far off that other line is
};

// The border is the outermost sharp step that can be followed along the band. Shadows' borders are
// soft, and a local fit with sloping levels does not take them for steps; bevel lines, glints and
// engraved lines lie further in.
[[nodiscard]] ChosenTransition ChooseTransition(const StraightBand& band, double search_px);

}  // namespace bladecurve
