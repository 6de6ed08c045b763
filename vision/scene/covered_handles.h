// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/scene/blades.h"
#include "vision/scene/silhouette.h"

namespace bladecurve {

// A silhouette with the handles cut off, two stubs left of the shanks; what lies beyond the cut is
// `hidden` (CV_8UC1).
struct WithoutHandles {
  Silhouette silhouette;
  cv::Mat hidden;
  Crotches crotches;
};

// Handles that lie on a card or a ruler, or in a hand, are one thing with it, and show no gap
// between the shanks; nor do those that the frame cuts off right behind the joint. What the
// silhouette is without them, once for each gap that may be the blades': cut where behind the gap
// it widens or runs out of sight; right behind the pivot, px, where that is known. `hidden` as for
// FindBladePairAt.
[[nodiscard]] std::vector<WithoutHandles> CutOffHandles(
    const Silhouette& silhouette,
    const cv::Mat& hidden,
    const std::optional<Eigen::Vector2d>& pivot = std::nullopt);

}  // namespace bladecurve
