// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/scissors/tip_cap.h"

namespace bladecurve {

// The step across an edge, followed along it.
struct FollowedStep {
  // Grey values outside the edge less those inside along its last part, typically; along an earlier
  // one where the step turns over: what follows is the border of a shadow. 0 where it does not
  // stand out.
  double step = 0;
  // The last point of the edge, continued, at which there is a step like that. std::nullopt where
  // it goes on to the picture's border, or stood out nowhere.
  std::optional<Eigen::Vector2d> end_px;
  // Whether the blade ends there before the presumed tip, which is its shadow's. A bright one:
  // beyond, up to that, next to nothing inside the edge continued is as bright as the blade, or
  // brighter than the ground. A dark one: what is dark beyond keeps off the edge continued.
  bool blade_ends = false;
};

// grey: CV_8UC1. `search` gives the blade's side and the edge's blur. Of fewer than 12 points
// nothing is said.
[[nodiscard]] FollowedStep FollowStep(const cv::Mat& grey,
                                      const std::vector<Eigen::Vector2d>& edge,
                                      const TipSearch& search);

}  // namespace bladecurve
