// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/screw_ellipse.h"

namespace bladecurve {

using Vector5d = Eigen::Matrix<double, 5, 1>;

// Grey values across the rim of a screw's head, all round.
struct RimProfiles {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
      values;                      // one profile a row
  Eigen::VectorXd t;               // px along the normal, outwards
  Eigen::VectorXd window;          // weights of the taps
  std::vector<Eigen::Vector2d> u;  // of each profile: rim.PointAt(u)
  std::vector<Vector5d>
      jacobian;  // d(displacement along the normal)/d(center x, y, shape xx, xy, yy)
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
};

// std::nullopt where the profiles have nothing in common.
[[nodiscard]] std::optional<std::vector<RimMatch>> MatchProfiles(const RimProfiles& profiles);

}  // namespace bladecurve
