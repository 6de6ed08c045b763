// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/edge/edge.h"
#include "vision/edge/edge_path.h"

namespace bladecurve {

// Which of the transitions beside a guessed path is the blade's border, to about a pixel.
struct ChosenTransition {
  std::vector<Eigen::Vector2d> points;  // along it, one to a few px apart
  std::vector<double> inner_px;         // from each point to the next transition within the blade
  std::vector<double> outer_px;  // the same in the background; kNoTransition where there is none
  double blur_px = 0;    // of the sharper transitions, good to a third; up to 2 px more where
                         // noise hides them: the fit mends a blur too wide, not one too narrow
  double support = 0;    // share of the path along which the transition is seen, 0 to 1
  double ambiguity = 0;  // 0: no other line comes near; 1: another one is as good
  double rival_px = 0;   // where that other line lies, positive out of the blade
  std::vector<Eigen::Vector2d> rival;  // the other line
};

inline constexpr double kNoTransition = 1e3;

// The border is the outermost sharp step that can be followed along the path. A shadow's border is
// soft, or the dark band between it and the blade is wide; bevel lines, glints and ridges lie
// further in. Where the picture is so soft that hardly any step in it looks sharp, it is looked at
// in half its resolution as well.
[[nodiscard]] ChosenTransition ChooseTransition(const cv::Mat& grey,
                                                const EdgePath& guess,
                                                double search_px);

// Where a shadow begins at the blade's border: the transition at which light changes most clearly.
// It has no rival.
[[nodiscard]] ChosenTransition ChooseShadow(const cv::Mat& grey,
                                            const EdgePath& guess,
                                            double search_px,
                                            Shadow shadow);

}  // namespace bladecurve
