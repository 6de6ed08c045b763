// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "curvefit/bspline.h"
#include "curvefit/fit_data.h"

namespace ceres {
class CostFunction;
}

namespace bladecurve {

enum class Loss { kNone, kHuber, kCauchy, kTukey };

// Throws std::invalid_argument for a name that is not "none", "huber", "cauchy" or "tukey".
[[nodiscard]] Loss LossNamed(const std::string& name);

// A robust loss inside the residual: its square is rho(r^2). Works as long as rho grows like r^2
// near 0.
struct SoftResidual {
  double value = 0, slope = 1;
};
[[nodiscard]] SoftResidual Soften(Loss loss, double residual);

// Signed orthogonal distance of a point from the edge v = s(u), and its derivatives. To first order
// in the distance, d = (v - s) cos, cos = 1/sqrt(1 + s'^2); the next term is d^2 s''/2, 1e-5 mm for
// d = 0.05 mm and a radius of 100 mm.
struct SplineDistance {
  double d = 0;
  double d_u = 0, d_v = 0;
  std::array<double, kMaxSplineDegree + 1> d_c{};  // by coefficients first, first + 1, ...
  int first = 0;
};
// Of the point (u, v); `row` holds the basis functions at u.
[[nodiscard]] SplineDistance DistanceFrom(
    const BasisRow& row, int degree, const double* coefficients, double v, double cosine);

// s' at the place of the row.
[[nodiscard]] double SlopeAt(const BasisRow& row, int degree, const double* coefficients);

// The spline's coefficients from the parameters of the fit, which keep s(u_end) = -u_end
// tan(zero/2): all but the last coefficient of a spline T, the reach u_end, and the opening that
// the user's theta has where ours is 0.
//   s(u) = T(u) - u (T(u_end)/u_end + tan(zero/2)),  T's last coefficient 0
struct SplineParameters {
  std::vector<double> free;
  double reach = 1, zero = 0;
};
struct SplineCoefficients {
  Eigen::VectorXd value;
  Eigen::MatrixXd jacobian;  // by free, reach, zero
};
[[nodiscard]] SplineCoefficients CoefficientsOf(const SplineSpace& space,
                                                const double* free,
                                                double reach,
                                                double zero);
[[nodiscard]] SplineParameters ParametersOf(const SplineSpace& space,
                                            const Eigen::VectorXd& coefficients,
                                            double reach,
                                            double zero);

// Residuals of the edges of one photograph against the shared spline; parameter blocks: free
// coefficients, reach, zero, pose. Thousands of points are condensed to as many residuals as there
// are parameters, and one more for what no parameter can change: same cost, same gradient, same
// Gauss-Newton matrix. The lower edge is used if `mirror`.
// The edge's direction in the photograph at each point is held as it is at `start`: were it free, a
// curve that misses its points could come nearer to them, in this measure, by standing upright.
// Held in the photograph, not in the blade's frame: else turning the frame would change distances.
// Distances are counted in the photograph's own lengths, else they would shrink with its scale.
struct SplineEdgesStart {
  Eigen::VectorXd coefficients;
  Pose pose;
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
