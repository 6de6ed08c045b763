// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/edge_profile.h"

#include <algorithm>
#include <cmath>

namespace bladecurve {
namespace {

// Hermite interpolation at this spacing is exact to 3e-6 for blurs from 0.5 px.
constexpr int kNodesPerPx = 8;
// Beyond so many sigma, and half a pixel's diagonal, the profile is flat to 1e-6.
constexpr double kFlatSigmas = 4.8, kHalfPixelPx = 0.75;
constexpr double kInvSqrt2Pi = 0.3989422804014327;
constexpr double kInvSqrt2 = 0.7071067811865476;

// The normal density of standard deviation s and its repeated integrals.
struct NormalIntegrals {
  double density, once, twice, thrice;
};

NormalIntegrals Integrate(double u, double s) {
  const double z = u / s;
  const double density = kInvSqrt2Pi / s * std::exp(-0.5 * z * z);
  const double once = 0.5 * std::erfc(-z * kInvSqrt2);
  const double twice = u * once + s * s * density;
  const double thrice = 0.5 * ((u * u + s * s) * once + u * s * s * density);
  return {density, once, twice, thrice};
}

// Along an axis the trapezoid is a box of width w.
EdgeProfile::Value AxisProfile(double d, double w, double s) {
  const NormalIntegrals a = Integrate(d + 0.5 * w, s), b = Integrate(d - 0.5 * w, s);
  return {(a.twice - b.twice) / w, (a.once - b.once) / w, (a.density - b.density) / w};
}

EdgeProfile::Value ObliqueProfile(double d, double a, double b, double s) {
  const NormalIntegrals n1 = Integrate(d + 0.5 * (a + b), s), n2 = Integrate(d + 0.5 * (a - b), s);
  const NormalIntegrals n3 = Integrate(d - 0.5 * (a - b), s), n4 = Integrate(d - 0.5 * (a + b), s);
  const double area = a * b;
  return {(n1.thrice - n2.thrice - n3.thrice + n4.thrice) / area,
          (n1.twice - n2.twice - n3.twice + n4.twice) / area,
          (n1.once - n2.once - n3.once + n4.once) / area};
}

}  // namespace

EdgeProfile::EdgeProfile(double normal_angle_rad, double blur_px)
    : reach_px_(kFlatSigmas * blur_px + kHalfPixelPx) {
  constexpr double kAxisAligned = 1e-3;  // below, the trapezoid's flanks are too steep to divide by
  const double a = std::abs(std::cos(normal_angle_rad)), b = std::abs(std::sin(normal_angle_rad));
  const int count = static_cast<int>(std::ceil(2 * reach_px_ * kNodesPerPx)) + 2;
  nodes_.reserve(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double d = static_cast<double>(i) / kNodesPerPx - reach_px_;
    nodes_.push_back(std::min(a, b) < kAxisAligned ? AxisProfile(d, std::max(a, b), blur_px)
                                                   : ObliqueProfile(d, a, b, blur_px));
  }
}

EdgeProfile::Value EdgeProfile::At(double distance_px) const {
  const double last = static_cast<double>(nodes_.size() - 1);
  const double x = std::clamp((distance_px + reach_px_) * kNodesPerPx, 0.0, last - 1e-9);
  const size_t i = static_cast<size_t>(x);
  const Value &p = nodes_[i], &q = nodes_[i + 1];
  const double u = x - static_cast<double>(i), v = 1 - u;
  constexpr double kStep = 1.0 / kNodesPerPx;
  const double rise0 = v * v * (1 + 2 * u), rise1 = u * u * (3 - 2 * u);
  const double turn0 = u * v * v * kStep, turn1 = -u * u * v * kStep;
  return {rise0 * p.level + rise1 * q.level + turn0 * p.slope_per_px + turn1 * q.slope_per_px,
          rise0 * p.slope_per_px + rise1 * q.slope_per_px + turn0 * p.curvature_per_px2 +
              turn1 * q.curvature_per_px2,
          v * p.curvature_per_px2 + u * q.curvature_per_px2};
}

}  // namespace bladecurve
