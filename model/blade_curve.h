// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace bladecurve {

// phi = a + x (b + gain tan(theta/2)); the paper's eq. (19) has gain 1/2.
struct TaperedRectangle {
  double a_mm = 0;
  double b = 0;
  double gain = 0.5;
};

// The edge in the blade's own frame, a B-spline v = s(u); the blade turns rigidly by theta/2 about
// the pivot: x = u cos(theta/2) - s sin(theta/2), y = u sin(theta/2) + s cos(theta/2).
struct RigidSpline {
  int degree = 3;                // 1 to 5
  std::vector<double> knots_mm;  // clamped, non-decreasing, coefficients + degree + 1 of them
  std::vector<double> coefficients_mm;  // at least degree + 1
};

using BladeShape = std::variant<TaperedRectangle, RigidSpline>;

// Where the curve was measured; beyond it phi goes on linearly (C1) and is flagged.
struct CurveDomain {
  double x_min_mm = 0, x_max_mm = 0;
  double theta_min_rad = 0, theta_max_rad = 0;
};

enum CurveFlag : std::uint32_t {
  kCurveOk = 0,
  kCurveXOutside = 1u << 0,      // x outside the domain: linear continuation in x
  kCurveThetaOutside = 1u << 1,  // theta outside the domain: linear continuation in theta
  kCurveNotFinite = 1u << 2,     // NaN or Inf came in: the values are 0
  kCurveNotGraph =
      1u << 3,  // the turned edge is no graph over x there; the nearest valid value is given
};

// phi and its derivatives at one (x, theta).
struct CurveSample {
  double phi_mm = 0;
  double phi_x = 0;
  double phi_theta_mm_per_rad = 0;
  double phi_xx_per_mm = 0;
  double phi_xtheta_per_rad = 0;
  double phi_thetatheta_mm_per_rad2 = 0;
  std::uint32_t flags = kCurveOk;
};

struct PreparedBlade;  // the shape as Eval needs it (prepared_blade.h)

// The edge of the upper blade, y = phi(x, theta); origin at the pivot, +x along the
// symmetry line towards the tips, mm and rad.
// Invariant: the shape is valid (checked once, when built); it never changes afterwards. Copies
// share what Eval needs; a move copies, so that no curve is ever empty.
class BladeCurve {
 public:
  // Throws std::invalid_argument for a shape or domain that cannot be one.
  BladeCurve(BladeShape shape, CurveDomain domain);
  BladeCurve(const BladeCurve&) = default;
  BladeCurve& operator=(const BladeCurve&) = default;
  ~BladeCurve() = default;

  // Real-time safe: noexcept, no allocation, bounded time. Never NaN or Inf.
  [[nodiscard]] CurveSample Eval(double x_mm, double theta_rad) const noexcept;
  // phi alone, mm: the same bits, sooner for a tapered rectangle. What lies outside the domain is
  // not told; Eval's flags do.
  [[nodiscard]] double Phi(double x_mm, double theta_rad) const noexcept;

  // All x of the domain with phi(x, theta) = y, ascending, each once also where the curve only
  // touches y. Writes as many as x_mm holds and returns how many there are. Real-time safe.
  // The ends of a stretch that lies along y stand for it; a tapered rectangle along y has none.
  int Contacts(double y_mm, double theta_rad, std::span<double> x_mm) const noexcept;

  [[nodiscard]] const BladeShape& shape() const noexcept { return shape_; }
  [[nodiscard]] const CurveDomain& domain() const noexcept { return domain_; }

 private:
  BladeShape shape_;
  CurveDomain domain_;
  std::shared_ptr<const PreparedBlade> prepared_;
};

}  // namespace bladecurve
