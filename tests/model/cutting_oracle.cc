// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "tests/model/cutting_oracle.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bladecurve {
namespace {

using Real = long double;

// B-spline and its first derivative at u, by the recursion of de Boor and Cox on the basis
// functions.
Real Basis(const std::vector<double>& knots, std::size_t i, int degree, Real u) {
  if (degree == 0) return knots[i] <= u && u < knots[i + 1] ? 1 : 0;
  Real sum = 0;
  const Real left = static_cast<Real>(knots[i + degree]) - knots[i];
  const Real right = static_cast<Real>(knots[i + degree + 1]) - knots[i + 1];
  if (left > 0) sum += (u - knots[i]) / left * Basis(knots, i, degree - 1, u);
  if (right > 0) sum += (knots[i + degree + 1] - u) / right * Basis(knots, i + 1, degree - 1, u);
  return sum;
}

Real Spline(const RigidSpline& shape, Real u) {
  Real sum = 0;
  for (std::size_t i = 0; i < shape.coefficients_mm.size(); ++i) {
    sum += shape.coefficients_mm[i] * Basis(shape.knots_mm, i, shape.degree, u);
  }
  return sum;
}

Real SplineSlope(const RigidSpline& shape, Real u) {
  Real sum = 0;
  for (std::size_t i = 1; i < shape.coefficients_mm.size(); ++i) {
    const Real width = static_cast<Real>(shape.knots_mm[i + shape.degree]) - shape.knots_mm[i];
    const Real slope =
        shape.degree *
        (static_cast<Real>(shape.coefficients_mm[i]) - shape.coefficients_mm[i - 1]) / width;
    sum += slope * Basis(shape.knots_mm, i, shape.degree - 1, u);
  }
  return sum;
}

template <class Function>
Real Bisect(const Function& rises, Real low, Real high) {
  for (int i = 0; i < 70; ++i) {
    const Real middle = (low + high) / 2;
    (rises(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

CuttingOracle::CuttingOracle(const BladeCurve& blade,
                             const Material& material,
                             PlateSpan span,
                             DeltaPolicy policy,
                             int substeps)
    : blade_(blade),
      material_(material),
      end_(span.end_mm),
      policy_(policy),
      substeps_(substeps),
      crack_(span.edge_mm) {}

CuttingOracle::Edge CuttingOracle::EdgeAt(Real x, Real theta) const {
  const Real half = theta / 2;
  if (const auto* shape = std::get_if<TaperedRectangle>(&blade_.shape())) {
    const Real slope = shape->b + shape->gain * std::tan(half);
    const Real secant = 1 / std::cos(half);
    return {shape->a_mm + x * slope, slope, x * shape->gain / 2 * secant * secant};
  }
  const RigidSpline& shape = std::get<RigidSpline>(blade_.shape());
  const Real sine = std::sin(half), cosine = std::cos(half);
  Real u = x;
  for (int i = 0; i < 8;
       ++i) {  // Newton: the edge is flat beside the turn, a few steps reach the last bit
    u -= (u * cosine - Spline(shape, u) * sine - x) / (cosine - SplineSlope(shape, u) * sine);
  }
  const Real s = Spline(shape, u), slope = SplineSlope(shape, u);
  Edge edge;
  edge.phi = u * sine + s * cosine;
  edge.phi_x = (sine + slope * cosine) / (cosine - slope * sine);
  edge.phi_theta = (x + edge.phi * edge.phi_x) / 2;
  return edge;
}

Real CuttingOracle::Delta(Real x, Real theta) const {
  return material_.thickness_mm / 2 - EdgeAt(x, theta).phi;
}

Real CuttingOracle::Elastic(Real x, Real theta) const {
  const Edge edge = EdgeAt(x, theta);
  const Real delta = material_.thickness_mm / 2 - edge.phi;
  const Real force = material_.force_deflection.initial_stiffness_n_per_mm() * delta;
  return x * force * std::cos(theta / 2 - std::atan(edge.phi_x));
}

Real CuttingOracle::Sharp(Real x, Real theta) const {
  const Edge edge = EdgeAt(x, theta);
  return material_.toughness_n_per_mm * material_.thickness_mm * edge.phi_theta / edge.phi_x;
}

Real CuttingOracle::Excess(Real x, Real theta) const { return Elastic(x, theta) - Sharp(x, theta); }

Real CuttingOracle::Growth(Real x, Real theta) const {
  return policy_ == DeltaPolicy::kCriterion ? Excess(x, theta) : Delta(x, theta) - delta_c_;
}

// x* nearest outwards of x, or the same inwards: the level falls along x.
Real CuttingOracle::Grown(Real x, Real theta) const {
  Real low = x, high = x;
  for (Real reach = 1e-6L; Growth(high, theta) > 0 && reach < 50; reach *= 2) high = x + reach;
  for (Real reach = 1e-6L; Growth(low, theta) <= 0 && reach < 50; reach *= 2) low = x - reach;
  return Bisect([&](Real at) { return Growth(at, theta) <= 0; }, low, high);
}

void CuttingOracle::SubstepElastic(Real theta, Real pivot) {
  const auto excess = [&](Real s) {
    return Excess(crack_ - (pivot_ + s * (pivot - pivot_)), theta_ + s * (theta - theta_));
  };
  if (excess(1) < 0) return;
  const Real s = started_ ? Bisect([&](Real at) { return excess(at) >= 0; }, 0, 1) : 1;
  delta_c_ = Delta(crack_ - (pivot_ + s * (pivot - pivot_)), theta_ + s * (theta - theta_));
  mode_ = Mode::kCutting;
  SubstepCutting(theta, pivot);
}

void CuttingOracle::SubstepCutting(Real theta, Real pivot) {
  const Real x = crack_ - pivot;
  const bool grows = Growth(x, theta) >= 0;
  const bool overloaded = Excess(x, theta) > 0;
  if (grows) {
    mode_ = Mode::kCutting;
    crack_ = std::max(crack_, pivot + Grown(x, theta));
    if (crack_ >= end_) {
      crack_ = end_;
      mode_ = Mode::kThrough;
    }
  } else if (policy_ == DeltaPolicy::kConstant && overloaded) {
    mode_ = Mode::kResting;
  } else {
    mode_ = Mode::kElastic;
  }
}

void CuttingOracle::Substep(Real theta, Real pivot) {
  if (mode_ == Mode::kElastic) {
    SubstepElastic(theta, pivot);
  } else if (mode_ != Mode::kThrough) {
    SubstepCutting(theta, pivot);
  }
  theta_ = theta;
  pivot_ = pivot;
}

CuttingOracle::Sample CuttingOracle::Step(Real theta, Real pivot) {
  const Phase phase_before = phase_;
  const Mode mode_before = mode_;
  const Real crack_before = crack_;
  if (!started_) {
    theta_ = theta;
    pivot_ = pivot;
    delta_before_ = Delta(crack_ - pivot, theta);
  }
  const Real theta_start = theta_, pivot_start = pivot_;
  const int substeps = started_ ? substeps_ : 1;
  for (int i = 1; i <= substeps; ++i) {
    const Real s = static_cast<Real>(i) / substeps;
    Substep(theta_start + s * (theta - theta_start), pivot_start + s * (pivot - pivot_start));
  }
  started_ = true;

  Sample sample;
  sample.x_c_mm = crack_ - pivot;
  const Real delta = Delta(sample.x_c_mm, theta);
  if (mode_ == Mode::kThrough) {
    phase_ = Phase::kThrough;
  } else if (mode_ == Mode::kElastic) {
    if (crack_ != crack_before || delta < delta_before_) {
      phase_ = Phase::kRelaxation;
    } else if (delta > delta_before_ || phase_ == Phase::kNone) {
      phase_ = Phase::kDeformation;
    }
    if (delta <= 0) phase_ = Phase::kNone;
    sample.torque_nmm = delta > 0 ? Elastic(sample.x_c_mm, theta) : 0;
  } else {
    phase_ = Phase::kCutting;
    sample.torque_nmm = Sharp(sample.x_c_mm, theta);
  }
  const Edge edge = EdgeAt(sample.x_c_mm, theta);
  const Real slope = std::atan(edge.phi_x);
  sample.force_x_n =
      -sample.torque_nmm / (sample.x_c_mm * std::cos(theta / 2 - slope)) * std::sin(slope);
  sample.phase = phase_;
  sample.near_event = phase_ != phase_before || mode_ != mode_before;
  delta_before_ = delta;
  return sample;
}

}  // namespace bladecurve
