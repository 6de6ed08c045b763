// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>

#include "curvefit/bspline.h"
#include "curvefit/fit_data.h"

namespace ceres {
class CostFunction;
}

namespace bladecurve {

enum class Loss { kNone, kHuber, kCauchy, kTukey };

// Throws std::invalid_argument for a name that is not "none", "huber", "cauchy" or "tukey".
[[nodiscard]] Loss LossNamed(const std::string& name);

// Width in sigma. Gross outliers are gone before; at this width Gaussian noise loses less than 1 %
// of its information.
inline constexpr double kHuber = 2.5;

// A robust loss inside the residual: its square is rho(r^2). Works as long as rho grows like r^2
// near 0.
struct SoftResidual {
  double value = 0, slope = 1;
};
[[nodiscard]] SoftResidual SoftenLarge(Loss loss, double residual);  // any but a small one of Huber
[[nodiscard]] inline SoftResidual Soften(Loss loss, double residual) {
  const bool plain = loss == Loss::kNone || (loss == Loss::kHuber && std::abs(residual) <= kHuber);
  return plain ? SoftResidual{residual, 1} : SoftenLarge(loss, residual);
}

// Residuals of the edges of one photograph against the shared spline; parameter blocks: free
// coefficients, reach, zero, pose of the first photograph, and its own pose if it is another one.
// Thousands of points are condensed to as many residuals as there
// are parameters, and one more for what no parameter can change: same cost, same gradient, same
// Gauss-Newton matrix. The lower edge is used if `mirror`.
// A residual is the signed orthogonal distance of a point from the edge v = s(u), to first order in
// the distance: (v - s) cos, cos = 1/sqrt(1 + s'^2); the next term is d^2 s''/2, 1e-5 mm for d =
// 0.05 mm and a radius of 100 mm. The edge's direction in the photograph at each point is held as
// it is at `start`: were it free, a curve that misses its points could come nearer to them, in this
// measure, by standing upright. Held in the photograph, not in the blade's frame: else turning the
// frame would change distances. Distances are counted in the photograph's own lengths, else they
// would shrink with its scale.
struct SplineEdgesStart {
  Eigen::VectorXd coefficients;
  Pose first_pose;               // held: where the spline lies, see spline_frame.h
  std::optional<Pose> own_pose;  // not set: this is the first photograph
};
[[nodiscard]] ceres::CostFunction* NewSplineEdges(const PhotoData& photo,
                                                  const SplineSpace& space,
                                                  Loss loss,
                                                  bool mirror,
                                                  const SplineEdgesStart& start);

// The same against a straight edge of slope b + gain tan(theta/2); blocks: (a, b), gain, pose.
[[nodiscard]] ceres::CostFunction* NewTaperedEdges(const PhotoData& photo, bool mirror);

// Pivot, distal ends, theta, scale and offset as observed; blocks: reach, zero, pose.
[[nodiscard]] ceres::CostFunction* NewPoseObservations(const PhotoData& photo);

}  // namespace bladecurve
