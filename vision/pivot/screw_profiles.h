// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/pivot/screw_ellipse.h"

namespace bladecurve {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using RimJacobian = Eigen::Matrix<double, Eigen::Dynamic, 5>;
using RimRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Grey values across the rim of a screw's head, all round.
struct RimProfiles {
  RimRows values;          // one profile a row
  Eigen::VectorXd t;       // px along the normal, outwards
  Eigen::VectorXd window;  // weights of the taps
  RimJacobian jacobian;    // d(displacement along the normal)/d(center x, y, shape xx, xy, yy)
};

struct RimSampling {
  double half_px = 3;        // of the profiles
  int most_profiles = 96;    // about one per px of rim up to this many
  bool flat_window = false;  // whole profiles count; else mostly their middle
};

[[nodiscard]] RimProfiles SampleProfiles(const cv::Mat& picture,
                                         const RimEllipse& rim,
                                         const RimSampling& sampling);

// What one profile says, compared with the shape that all have in common.
struct RimMatch {
  double shift_px = 0;     // of the rim from the ellipse, along the normal
  double amplitude = 0;    // of the common shape; negative where light and dark are exchanged
  double correlation = 0;  // with the common shape, after smoothing along the rim
  double strength = 0;     // amplitude after that smoothing
  // Relative to the others: how far shifts hereabouts scatter, and the inverse of that variance for
  // means of many, which what neighbours share does not leave.
  double spread_px = 1, precision = 1;
};

// What the profiles have in common.
struct RimShape {
  Eigen::VectorXd value, derivative;  // over the taps; weighted norm of `value` is 1
  double center_px = 0;               // where along the profile its structure lies
};

struct RimMatches {
  RimShape shape;
  std::vector<RimMatch> each;  // one a profile
};

// Of half a profile: a larger shift is an extrapolation.
inline constexpr double kMostRelativeShift = 0.6;

// Averages over the neighbours along the rim by a Gaussian, times the sum of its weights.
struct SmoothedRows {
  RimRows values;
  double weights = 1, squared_weights = 1;  // sums over the neighbours
};
[[nodiscard]] SmoothedRows SmoothAlongRim(const RimRows& rows, double sigma_rows);

inline constexpr int kMostShading = 2;

// `shading`: degree, up to kMostShading, to which light may rise or fall towards the rim within the
// head, at each place by another amount, as on a rounded rim or a lit chamfer; 0: not at all.
// std::nullopt where the profiles have nothing in common.
[[nodiscard]] std::optional<RimMatches> MatchProfiles(const RimProfiles& profiles, int shading = 0);

}  // namespace bladecurve
