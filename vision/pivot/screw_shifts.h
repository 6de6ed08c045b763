// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/pivot/screw_ellipse.h"
#include "vision/pivot/screw_profiles.h"

namespace bladecurve {

// A robust fit of a small change of the ellipse to the shifts of its profiles.
struct RimUpdate {
  Vector5d change = Vector5d::Zero();  // of center x, y, shape xx, xy, yy
  Eigen::VectorXd residual_px;         // one a profile
  // px^2; from the scatter along the rim, in blocks that may be correlated
  Eigen::Matrix2d center_covariance = Eigen::Matrix2d::Identity();
};

struct ShiftFitOptions {
  double outlier_sigmas = 4;  // of the shifts; beyond: something else than the rim
  // How far half the semi-axes' difference may be expected from zero; 0: nothing is expected.
  double flattening_px = 0;
};

// The change of `rim` that the shifts ask for: least squares with Tukey's biweight, each shift
// weighted by its precision and by how much its profile looks like the rim.
[[nodiscard]] RimUpdate FitShifts(const RimProfiles& profiles,
                                  const std::vector<RimMatch>& matches,
                                  const RimEllipse& rim,
                                  const ShiftFitOptions& options);

}  // namespace bladecurve
