// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Accuracy and time of phi and of its contacts side by side. The reference of the accuracy is the
// definition of B-splines in extended precision; times are the best of many runs over random (x,
// theta), with a multiplication's latency beside them as a measure of the machine.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "model/blade_curve.h"
#include "tests/model/test_blades.h"

namespace bladecurve {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kCalls = 4096;
constexpr int kRuns = 200;

double sink = 0;  // keeps the calls from being left out

struct Inputs {
  std::vector<double> x_mm, theta_rad;
};

Inputs RandomInputs() {
  std::mt19937 random(1);
  Inputs inputs;
  for (std::size_t i = 0; i < kCalls; ++i) {
    inputs.x_mm.push_back(Uniform(random, 25, 95));
    inputs.theta_rad.push_back(Uniform(random, 0.05, 0.9));
  }
  return inputs;
}

// The shortest time of one call, over many runs.
template <typename Call>
double NanosecondsPerCall(const Inputs& inputs, const Call& call) {
  double best = HUGE_VAL;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = Clock::now();
    double sum = 0;
    for (std::size_t i = 0; i < kCalls; ++i) sum += call(inputs.x_mm[i], inputs.theta_rad[i]);
    const std::chrono::duration<double, std::nano> time = Clock::now() - start;
    sink += sum;
    best = std::min(best, time.count() / static_cast<double>(kCalls));
  }
  return best;
}

double MultiplicationLatency(const Inputs& inputs) {
  double product = 1;
  return NanosecondsPerCall(inputs,
                            [&product](double x, double) { return product *= 1 + 1e-9 * x; });
}

// Worst errors of phi, phi_x and phi_theta against the reference, at known points of the edge.
struct Errors {
  double phi_mm = 0, phi_x = 0, phi_theta = 0;
};

void Compare(const CurveSample& s, const CurveSample& truth, Errors& errors) {
  errors.phi_mm = std::max(errors.phi_mm, std::abs(s.phi_mm - truth.phi_mm));
  errors.phi_x = std::max(errors.phi_x, std::abs(s.phi_x - truth.phi_x));
  errors.phi_theta =
      std::max(errors.phi_theta, std::abs(s.phi_theta_mm_per_rad - truth.phi_theta_mm_per_rad));
}

Errors WorstErrors(const BladeCurve& blade, const RigidSpline& spline) {
  std::mt19937 random(2);
  Errors errors;
  for (int i = 0; i < 20000; ++i) {
    const double theta = Uniform(random, 0, 1);
    const long double c = std::cos(0.5L * theta), n = std::sin(0.5L * theta);
    const long double u = Uniform(random, 25, 95);
    const SplineValue v = ReferenceSpline(spline, u);
    const long double x = u * c - v.s * n, y = u * n + v.s * c;
    const long double slope = (n + v.s1 * c) / (c - v.s1 * n);
    // x is rounded on its way in: phi at the rounded x, to first order.
    const auto x_in = static_cast<double>(x);
    const long double phi = y + slope * (x_in - x);
    CurveSample truth;
    truth.phi_mm = static_cast<double>(phi);
    truth.phi_x = static_cast<double>(slope);
    truth.phi_theta_mm_per_rad = static_cast<double>(0.5L * (x_in + phi * slope));
    Compare(blade.Eval(x_in, theta), truth, errors);
  }
  return errors;
}

Errors WorstErrors(const BladeCurve& blade, const TaperedRectangle& shape) {
  std::mt19937 random(2);
  Errors errors;
  for (int i = 0; i < 20000; ++i) {
    const double theta = Uniform(random, 0, 1), x = Uniform(random, 25, 95);
    const long double t = std::tan(0.5L * theta);
    const long double slope = shape.b + shape.gain * t;
    CurveSample truth;
    truth.phi_mm = static_cast<double>(shape.a_mm + x * slope);
    truth.phi_x = static_cast<double>(slope);
    truth.phi_theta_mm_per_rad = static_cast<double>(0.5L * x * shape.gain * (1 + t * t));
    Compare(blade.Eval(x, theta), truth, errors);
  }
  return errors;
}

double ContactsTime(const BladeCurve& blade, const Inputs& inputs) {
  return NanosecondsPerCall(inputs, [&blade](double, double theta) {
    std::array<double, 8> x;
    return static_cast<double>(blade.Contacts(1, theta, x));
  });
}

template <typename Shape>
void Report(const std::string& name, const Shape& shape) {
  const BladeCurve blade(shape, {10, 110, 0, 1});
  const Inputs inputs = RandomInputs();
  const Errors errors = WorstErrors(blade, shape);
  const double eval = NanosecondsPerCall(inputs, [&blade](double x, double theta) {
    const CurveSample s = blade.Eval(x, theta);
    return s.phi_mm + s.phi_theta_mm_per_rad;
  });
  const double phi =
      NanosecondsPerCall(inputs, [&blade](double x, double theta) { return blade.Phi(x, theta); });
  std::printf("%-28s %10.1e %10.1e %10.1e %10.2f %10.2f %10.0f\n",
              name.c_str(),
              errors.phi_mm,
              errors.phi_x,
              errors.phi_theta,
              phi,
              eval,
              ContactsTime(blade, inputs));
}

int Run() {
  std::printf("%-28s %10s %10s %10s %10s %10s %10s\n",
              "",
              "phi",
              "phi_x",
              "phi_theta",
              "phi",
              "eval",
              "contacts");
  std::printf(
      "%-28s %10s %10s %10s %10s %10s %10s\n", "", "error mm", "error", "error", "ns", "ns", "ns");
  Report("tapered rectangle", TaperedRectangle{-11, 0.14, 0.5});
  std::mt19937 random(3);
  for (int degree = 1; degree <= 5; ++degree) {
    for (const int spans : {1, 4, 16}) {
      if (degree == 1 && spans > 1) continue;  // kinks: the reference's slope jumps
      Report("spline degree " + std::to_string(degree) + ", " + std::to_string(spans) + " spans",
             RandomSpline(random, degree, spans, 0.2));
    }
  }
  std::printf("one multiplication, latency: %.2f ns\n", MultiplicationLatency(RandomInputs()));
  return std::isfinite(sink) ? 0 : 1;
}

}  // namespace
}  // namespace bladecurve

int main() { return bladecurve::Run(); }
