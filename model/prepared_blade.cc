// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/prepared_blade.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "model/kernel_polynomial.h"

namespace bladecurve {
namespace {

constexpr double kLargestLengthMm =
    1e6;  // rejects lengths that are none of a blade, far below overflow
constexpr double kLargestSlope = 1e6;      // the same for b and gain
constexpr double kLargestThetaRad = 3.14;  // tan(theta/2) has its pole at pi
constexpr double kShortestSpan = 1e-9;  // of the whole: rejects knots that were meant to be equal
constexpr double kEndSlack =
    1e-12;  // a point this near the spline's end (relative) is not beyond it
constexpr double kNearSpan = 1e-7;  // Taylor's remainder, of its square, is below rounding
constexpr double kExact = 4e-16;    // of the farthest knot: rounding of x = u cos - s sin

constexpr double kBeyondAll = 1e12;  // no step towards an x within kFarthest gets there

std::string Text(double value) {
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

void RequireWithin(const std::string& name, double value, double largest) {
  if (!(std::abs(value) <= largest)) {
    throw std::invalid_argument(name + " is " + Text(value) + "; it must lie within +-" +
                                Text(largest));
  }
}

void Check(const CurveDomain& domain) {
  RequireWithin("domain x_mm", domain.x_min_mm, kLargestLengthMm);
  RequireWithin("domain x_mm", domain.x_max_mm, kLargestLengthMm);
  RequireWithin("domain theta_rad", domain.theta_min_rad, kLargestThetaRad);
  RequireWithin("domain theta_rad", domain.theta_max_rad, kLargestThetaRad);
  if (!(domain.x_min_mm < domain.x_max_mm)) {
    throw std::invalid_argument("domain x_mm runs from " + Text(domain.x_min_mm) + " to " +
                                Text(domain.x_max_mm) + "; it must ascend");
  }
  if (!(domain.theta_min_rad <= domain.theta_max_rad)) {
    throw std::invalid_argument("domain theta_rad runs from " + Text(domain.theta_min_rad) +
                                " to " + Text(domain.theta_max_rad) + "; it must ascend");
  }
}

void Check(const TaperedRectangle& shape) {
  RequireWithin("a_mm", shape.a_mm, kLargestLengthMm);
  RequireWithin("b", shape.b, kLargestSlope);
  RequireWithin("gain", shape.gain, kLargestSlope);
}

void CheckSizes(const RigidSpline& spline) {
  if (spline.degree < 1 || spline.degree > kMaxDegree) {
    throw std::invalid_argument("degree is " + std::to_string(spline.degree) +
                                "; it must be 1 to 5");
  }
  const std::size_t order = static_cast<std::size_t>(spline.degree) + 1;
  const std::size_t coefficients = spline.coefficients_mm.size();
  if (coefficients < order) {
    throw std::invalid_argument("coefficients_mm has " + std::to_string(coefficients) +
                                " values; degree " + std::to_string(spline.degree) +
                                " needs at least " + std::to_string(order));
  }
  if (spline.knots_mm.size() != coefficients + order) {
    throw std::invalid_argument("knots_mm has " + std::to_string(spline.knots_mm.size()) +
                                " values; with " + std::to_string(coefficients) +
                                " coefficients of degree " + std::to_string(spline.degree) +
                                " it must have " + std::to_string(coefficients + order));
  }
}

void CheckKnots(const RigidSpline& spline) {
  const std::vector<double>& knots = spline.knots_mm;
  const auto degree = static_cast<std::size_t>(spline.degree);
  const double shortest = kShortestSpan * (knots.back() - knots.front());
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double span = knots[i] - knots[i - 1];
    if (span != 0 && !(span >= shortest)) {
      throw std::invalid_argument(
          "knots_mm: " + Text(knots[i]) + " follows " + Text(knots[i - 1]) +
          "; knots must not decrease, nor ascend by less than 1e-9 of the whole");
    }
  }
  if (knots[degree] != knots.front() || knots[knots.size() - 1 - degree] != knots.back()) {
    throw std::invalid_argument(
        "knots_mm is not clamped: the first and the last knot must each stand there " +
        std::to_string(degree + 1) + " times");
  }
  for (std::size_t i = 1; i + degree + 1 < knots.size(); ++i) {
    if (knots[i] == knots[i + degree]) {
      throw std::invalid_argument("knots_mm: " + Text(knots[i]) +
                                  " is repeated too often; the edge would be torn there");
    }
  }
}

void Check(const RigidSpline& spline) {
  CheckSizes(spline);
  for (const double knot : spline.knots_mm) RequireWithin("knots_mm", knot, kLargestLengthMm);
  for (const double c : spline.coefficients_mm)
    RequireWithin("coefficients_mm", c, kLargestLengthMm);
  CheckKnots(spline);
}

// de Boor's algorithm for the spline of `degree` with coefficients d[0 .. degree] on the span that
// begins at knots[span]; extended precision, so that rounding the result is the only error.
long double DeBoor(std::array<long double, kMaxDegree + 1> d,
                   int degree,
                   const double* span,
                   long double u) {
  for (int l = 1; l <= degree; ++l) {
    for (int j = 0; j >= l - degree; --j) {
      const long double low = span[j];
      const long double high = span[j + degree - l + 1];
      const long double weight = (u - low) / (high - low);
      long double& value = d[static_cast<std::size_t>(degree + j)];
      value = (1 - weight) * d[static_cast<std::size_t>(degree + j - 1)] + weight * value;
    }
  }
  return d[static_cast<std::size_t>(degree)];
}

// Taylor coefficients of the spline on the span [knots[i], knots[i + 1]] about u.
std::array<double, kMaxDegree + 1> TaylorOnSpan(const RigidSpline& spline,
                                                std::size_t i,
                                                double u) {
  const int p = spline.degree;
  const double* span = spline.knots_mm.data() + i;
  std::array<long double, kMaxDegree + 1> d = {};
  for (int j = 0; j <= p; ++j) {
    d[static_cast<std::size_t>(j)] = spline.coefficients_mm[i - static_cast<std::size_t>(p - j)];
  }
  std::array<double, kMaxDegree + 1> taylor = {};
  long double factorial = 1;
  for (int r = 0; r <= p; ++r) {
    const int degree = p - r;
    taylor[static_cast<std::size_t>(r)] =
        static_cast<double>(DeBoor(d, degree, span, u) / factorial);
    factorial *= r + 1;
    // The derivative's coefficients, of a spline one degree lower on the same knots.
    for (int j = 0; j < degree; ++j) {
      const int knot = j + 1 - degree;
      const long double width = static_cast<long double>(span[knot + degree]) - span[knot];
      const auto k = static_cast<std::size_t>(j);
      d[k] = degree * (d[k + 1] - d[k]) / width;
    }
  }
  return taylor;
}

void AppendRow(PreparedBlade& blade, double centre, const std::array<double, kMaxDegree + 1>& c) {
  blade.rows.push_back(centre);
  blade.rows.insert(blade.rows.end(), c.begin(), c.end());
}

// One row a span, and the tangents at both ends as straight continuations.
void AppendRows(const RigidSpline& spline, PreparedBlade& blade) {
  const std::vector<double>& knots = spline.knots_mm;
  const auto degree = static_cast<std::size_t>(spline.degree);
  const std::size_t last = spline.coefficients_mm.size() - 1;  // the last span begins at its knot
  const double slack = kEndSlack * std::max(std::abs(knots.front()), std::abs(knots.back()));
  const auto first_tangent = TaylorOnSpan(spline, degree, knots.front());
  const auto last_tangent = TaylorOnSpan(spline, last, knots.back());
  AppendRow(blade, knots.front(), {first_tangent[0], first_tangent[1]});
  blade.ends = {-kBeyondAll, knots.front() - slack};
  for (std::size_t i = degree; i <= last; ++i) {
    if (knots[i] == knots[i + 1]) continue;
    const double centre = 0.5 * (knots[i] + knots[i + 1]);
    AppendRow(blade, centre, TaylorOnSpan(spline, i, centre));
    blade.ends.push_back(i == last ? knots[i + 1] + slack : knots[i + 1]);
  }
  AppendRow(blade, knots.back(), {last_tangent[0], last_tangent[1]});
  blade.ends.push_back(kBeyondAll);
}

using RowPolynomial = std::array<double, kMaxDegree + 1>;

RowPolynomial Derivative(const RowPolynomial& c) {
  RowPolynomial derivative = {};
  for (std::size_t i = 1; i < c.size(); ++i) derivative[i - 1] = static_cast<double>(i) * c[i];
  return derivative;
}

void WidenSlopeRange(BladeKernel& kernel, double slope, double u) {
  if (slope < kernel.slope_min) {
    kernel.slope_min = slope;
    kernel.u_slope_min = u;
  }
  if (slope > kernel.slope_max) {
    kernel.slope_max = slope;
    kernel.u_slope_max = u;
  }
}

// Where s' is least and greatest: at a span's ends or where s'' is 0.
void FindSlopeRange(BladeKernel& kernel) {
  kernel.slope_min = HUGE_VAL;
  kernel.slope_max = -HUGE_VAL;
  for (int row = 1; row + 1 < kernel.num_rows; ++row) {
    const double* centre = RowOf(&kernel, row);
    const double low = kernel.ends[row] - *centre, high = kernel.ends[row + 1] - *centre;
    RowPolynomial s;
    std::copy_n(centre + 1, s.size(), s.begin());
    const RowPolynomial slope = Derivative(s), bend = Derivative(slope);
    std::array<double, kMaxDegree + 1> places = {low, high};
    const int count =
        2 + PolynomialRoots(bend.data(), kernel.degree - 2, low, high, places.data() + 2);
    for (int i = 0; i < count; ++i) {
      double noise;
      const double t = places[static_cast<std::size_t>(i)];
      WidenSlopeRange(kernel, Polynomial(slope.data(), kernel.degree - 1, t, &noise), *centre + t);
    }
  }
}

double ShortestSpan(const PreparedBlade& blade) {
  double shortest = HUGE_VAL;
  for (std::size_t i = 2; i + 1 < blade.ends.size(); ++i) {
    shortest = std::min(shortest, blade.ends[i] - blade.ends[i - 1]);
  }
  return shortest;
}

void UseRows(PreparedBlade& blade) {
  blade.kernel.num_rows = static_cast<int>(blade.ends.size()) - 1;
  blade.kernel.rows = blade.rows.data();
  blade.kernel.ends = blade.ends.data();
}

void Prepare(const TaperedRectangle& shape, PreparedBlade& blade) {
  blade.kernel.a = shape.a_mm;
  blade.kernel.b = shape.b;
  blade.kernel.gain = shape.gain;
  blade.kernel.degree = 1;
  AppendRow(blade, 0, {});
  blade.ends = {-kBeyondAll, kBeyondAll};
  UseRows(blade);
}

void Prepare(const RigidSpline& spline, PreparedBlade& blade) {
  AppendRows(spline, blade);
  BladeKernel& kernel = blade.kernel;
  UseRows(blade);
  kernel.is_spline = 1;
  kernel.degree = spline.degree;
  const double length = spline.knots_mm.back() - spline.knots_mm.front();
  kernel.chord_slope = (spline.coefficients_mm.back() - spline.coefficients_mm.front()) / length;
  kernel.chord_offset =
      spline.coefficients_mm.front() - kernel.chord_slope * spline.knots_mm.front();
  kernel.near_mm = kNearSpan * ShortestSpan(blade);
  kernel.exact_mm =
      kExact * std::max(std::abs(spline.knots_mm.front()), std::abs(spline.knots_mm.back()));
  FindSlopeRange(kernel);
}

}  // namespace

std::shared_ptr<const PreparedBlade> PrepareBlade(const BladeShape& shape,
                                                  const CurveDomain& domain) {
  Check(domain);
  std::visit([](const auto& s) { Check(s); }, shape);
  auto blade = std::make_shared<PreparedBlade>();
  blade->kernel.x_min = domain.x_min_mm;
  blade->kernel.x_max = domain.x_max_mm;
  blade->kernel.theta_min = domain.theta_min_rad;
  blade->kernel.theta_max = domain.theta_max_rad;
  std::visit([&](const auto& s) { Prepare(s, *blade); }, shape);
  return blade;
}

}  // namespace bladecurve
