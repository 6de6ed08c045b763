// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "vision/pivot/pivot_geometry.h"
#include "vision/pivot/screw.h"
#include "vision/scale/scale.h"
#include "vision/scale/sheet_pose.h"
#include "vision/scene/scene.h"

namespace bladecurve {

// The head where joints mostly have theirs: from a third to two thirds of the way from the shanks'
// crotch to the blades'. Needs no edges.
[[nodiscard]] std::optional<Screw> LookAtJoint(const cv::Mat& grey,
                                               const ScaleResult& scale,
                                               const Scene& scene);

// What is known before the head is looked for; stored pixels.
struct HeadSearch {
  const cv::Mat& grey;
  const ScaleResult& scale;
  const Scene& scene;
  const EdgePair& edges;
  PlacePx by_geometry;            // where the blades alone put the pivot
  std::optional<Screw> at_joint;  // what LookAtJoint found
};

// The head of the screw or rivet. How obliquely it is seen the markers say, where there are any.
// A faint head in an unknown view counts near where the blades put the pivot, and is left for a
// clearer one elsewhere; where it leaves the edges far unlike, for any about which they mirror each
// other. Where none is seen, also a half-lit one about which they do, or the faint one itself, if
// they do so as near to it as it is known; then a small one, magnified; at last, what elsewhere
// would be no head, right where the blades turn, to a quarter of its radius.
[[nodiscard]] std::optional<Screw> FindHead(const HeadSearch& search);

}  // namespace bladecurve
