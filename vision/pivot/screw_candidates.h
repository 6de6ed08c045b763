// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/pivot/screw_ellipse.h"
#include "vision/pivot/screw_field.h"

namespace bladecurve {

// Sizes are sought an octave at a time, each in a window scaled so that the rim's mean radius is 10
// to 20 px there: small enough to be quick, large enough to tell a rim from a blob.
inline constexpr double kOctaveRadius = 10;

// Where an octave's rims are sought; all in pixels of its window.
struct OctaveSearch {
  Eigen::Vector2d guess = Eigen::Vector2d::Zero();
  double range = 0;  // how far from the guess the centre may lie
  double least_radius = kOctaveRadius;
};

struct RimCandidate {
  RimEllipse rim;    // in window pixels
  double score = 0;  // RimField::Score
};

// The places and sizes where the field shows most of a rim of either polarity (a disc, a groove, a
// bright ring), best first, no two alike. The window must reach range + 2.5 least_radius around
// the guess.
[[nodiscard]] std::vector<RimCandidate> FindRimCandidates(const RimField& field,
                                                          const OctaveSearch& search);

}  // namespace bladecurve
