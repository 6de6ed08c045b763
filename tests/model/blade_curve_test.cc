// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/blade_curve.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "tests/model/test_blades.h"

namespace bladecurve {
namespace {

constexpr double kRounding = 1e-12;  // what the interface promises, relative to 1 + |value|
constexpr CurveDomain kDomain = {20, 100, 0, 1};

// Central differences of phi and of its first derivatives, with Richardson's extrapolation.
template <typename Function>
double Slope(const Function& f, double h) {
  const double wide = (f(h) - f(-h)) / (2 * h);
  const double narrow = (f(h / 2) - f(-h / 2)) / h;
  return (4 * narrow - wide) / 3;
}

CurveSample ByDifferences(const BladeCurve& blade, double x, double theta) {
  constexpr double kStepX = 2e-2;
  constexpr double kStepTheta = 2e-3;
  const auto phi_x = [&](double dx, double dt) { return blade.Eval(x + dx, theta + dt).phi_x; };
  const auto phi_t = [&](double dt) { return blade.Eval(x, theta + dt).phi_theta_mm_per_rad; };
  CurveSample s = blade.Eval(x, theta);
  s.phi_x = Slope([&](double h) { return blade.Eval(x + h, theta).phi_mm; }, kStepX);
  s.phi_theta_mm_per_rad =
      Slope([&](double h) { return blade.Eval(x, theta + h).phi_mm; }, kStepTheta);
  s.phi_xx_per_mm = Slope([&](double h) { return phi_x(h, 0); }, kStepX);
  s.phi_xtheta_per_rad = Slope([&](double h) { return phi_x(0, h); }, kStepTheta);
  s.phi_thetatheta_mm_per_rad2 = Slope([&](double h) { return phi_t(h); }, kStepTheta);
  return s;
}

// The point of a spline's edge at u, turned by theta/2, and phi there by implicit differentiation.
struct TurnedPoint {
  double x;
  CurveSample phi;
};

TurnedPoint Turned(const RigidSpline& spline, double u, double theta) {
  const SplineValue v = ReferenceSpline(spline, u);
  const long double c = std::cos(0.5L * theta);
  const long double n = std::sin(0.5L * theta);
  const long double x = u * c - v.s * n;
  const long double y = u * n + v.s * c;
  const long double advance = c - v.s1 * n;
  const long double phi_x = (n + v.s1 * c) / advance;
  const long double phi_xx = v.s2 / (advance * advance * advance);
  const long double phi_t = 0.5L * (x + y * phi_x);
  const long double phi_xt = 0.5L * (1 + phi_x * phi_x + y * phi_xx);
  const auto d = [](long double value) { return static_cast<double>(value); };
  return {d(x),
          {d(y), d(phi_x), d(phi_t), d(phi_xx), d(phi_xt), d(0.5L * (phi_t * phi_x + y * phi_xt))}};
}

// A hook: it rises ever more steeply, so that turning makes it overhang.
RigidSpline Hook() { return {2, {0, 0, 0, 100, 100, 100}, {0, 0, 150}}; }

TEST(BladeCurve, TaperedRectangleIsTheClosedForm) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const double a = Uniform(random, -20, 20), b = Uniform(random, -1, 1),
                 c = Uniform(random, 0.3, 1.2);
    const BladeCurve blade(TaperedRectangle{a, b, c}, {-200, 200, -2, 2});
    const double x = Uniform(random, -200, 200), theta = Uniform(random, -2, 2);
    const double t = std::tan(0.5 * theta), turn = 0.5 * c * (1 + t * t);
    const CurveSample expected = {a + x * (b + c * t), b + c * t, x * turn, 0, turn, x * turn * t};
    EXPECT_LT(LargestDifference(expected, blade.Eval(x, theta)), kRounding) << x << " " << theta;
  }
}

TEST(BladeCurve, DegreeOneSplineIsATurningLine) {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    const double s0 = Uniform(random, -10, 10), slope = Uniform(random, -0.4, 0.4);
    const BladeCurve blade(RigidSpline{1, {0, 0, 120, 120}, {s0, s0 + 120 * slope}},
                           {10, 90, 0, 1.4});
    const double x = Uniform(random, 10, 90), theta = Uniform(random, 0, 1.4);
    const double half = 0.5 * theta, angle = half + std::atan(slope);
    const double offset =
        s0 * std::cos(std::atan(slope)) / std::cos(angle);  // where it meets x = 0
    const double phi = offset + x * std::tan(angle);
    const CurveSample s = blade.Eval(x, theta);
    EXPECT_NEAR(s.phi_mm, phi, kRounding * (1 + std::abs(phi)));
    EXPECT_NEAR(s.phi_x, std::tan(angle), kRounding);
    const double cosine = std::cos(angle);
    const double turned = 0.5 * (x / (cosine * cosine) + offset * std::tan(angle));
    EXPECT_NEAR(s.phi_theta_mm_per_rad, turned, kRounding * (1 + std::abs(turned)));
    EXPECT_NEAR(s.phi_xx_per_mm, 0, kRounding);
  }
}

TEST(BladeCurve, SplineOfEveryDegreeTurnsRigidly) {
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    const int degree = 1 + i % 5;
    const RigidSpline spline = RandomSpline(random, degree, 1 + i % 7, 1);
    const BladeCurve blade(spline, {-300, 300, -1.5, 1.5});
    const double theta = Uniform(random, 0, 1.2);
    const TurnedPoint expected = Turned(spline, Uniform(random, 10, 110), theta);
    const CurveSample s = blade.Eval(expected.x, theta);
    if (s.flags & kCurveNotGraph) continue;
    // The curve cannot know x better than to its last bit, which short knot spans magnify.
    const double conditioning = 1 + std::abs(expected.phi.phi_x) + 100 * std::abs(s.phi_xx_per_mm);
    EXPECT_LT(LargestDifference(expected.phi, s), kRounding * conditioning * conditioning)
        << "degree " << degree << " x " << expected.x << " theta " << theta;
  }
}

TEST(BladeCurve, PolylineWithKinksIsFollowedExactly) {
  std::mt19937 random(4);
  for (int i = 0; i < 2000; ++i) {
    const RigidSpline line = RandomSpline(random, 1, 12, 2);
    const BladeCurve blade(line, {0, 150, 0, 1});
    const double theta = Uniform(random, 0, 0.6);
    const TurnedPoint expected = Turned(line, Uniform(random, 10, 110), theta);
    const CurveSample s = blade.Eval(expected.x, theta);
    if (s.flags & kCurveNotGraph) continue;
    EXPECT_NEAR(s.phi_mm, expected.phi.phi_mm, 1e-10 * (1 + std::abs(s.phi_x)));
  }
}

TEST(BladeCurve, DerivativesAreCentralDifferences) {
  std::mt19937 random(5);
  for (int i = 0; i < 1500; ++i) {
    const BladeCurve tapered(
        TaperedRectangle{Uniform(random, -20, 20), Uniform(random, -1, 1), 0.5}, kDomain);
    const BladeCurve spline(RandomSpline(random, 4 + i % 2, 1, 2), kDomain);
    for (const BladeCurve* blade : {&tapered, &spline}) {
      const double x = Uniform(random, 30, 90), theta = Uniform(random, 0.05, 0.95);
      const CurveSample s = blade->Eval(x, theta);
      if (s.flags & kCurveNotGraph) continue;
      EXPECT_LT(LargestDifference(ByDifferences(*blade, x, theta), s), 1e-8) << x << " " << theta;
    }
  }
}

TEST(BladeCurve, DerivativesBeyondTheDomainAreThoseOfTheContinuation) {
  std::mt19937 random(6);
  for (int i = 0; i < 1000; ++i) {
    const BladeCurve blade(RandomSpline(random, 5, 1, 2), {30, 80, 0.2, 0.6});
    const double x = i % 2 ? Uniform(random, 85, 200) : Uniform(random, -100, 25);
    const double theta = i % 3 ? Uniform(random, 0.7, 2) : Uniform(random, 0.3, 0.5);
    const double inside_x = i % 5 ? x : Uniform(random, 40, 70);
    const CurveSample s = blade.Eval(inside_x, theta);
    EXPECT_LT(LargestDifference(ByDifferences(blade, inside_x, theta), s), 1e-8)
        << x << " " << theta;
  }
}

TEST(BladeCurve, ValueAndSlopesAreContinuousAtTheDomainsBorder) {
  constexpr double kStep = 1e-9;
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    const BladeCurve blade = RandomBlade(random);
    const CurveDomain& d = blade.domain();
    const double x = i % 2 ? d.x_max_mm : d.x_min_mm;
    const double theta = Uniform(random, d.theta_min_rad, d.theta_max_rad);
    const double edge = i % 3 ? d.theta_max_rad : d.theta_min_rad;
    const std::array<std::pair<CurveSample, CurveSample>, 2> pairs = {
        {{blade.Eval(x - kStep, theta), blade.Eval(x + kStep, theta)},
         {blade.Eval(x, edge - kStep), blade.Eval(x, edge + kStep)}}};
    for (const auto& [before, after] : pairs) {
      EXPECT_NEAR(before.phi_mm, after.phi_mm, 1e-6);
      EXPECT_NEAR(before.phi_x, after.phi_x, 1e-6);
      EXPECT_NEAR(before.phi_theta_mm_per_rad, after.phi_theta_mm_per_rad, 1e-5);
    }
  }
}

TEST(BladeCurve, BeyondTheDomainItIsLinearAndFlagged) {
  const BladeCurve blade(RandomSpline(*std::make_unique<std::mt19937>(8), 3, 4, 0.5), kDomain);
  const CurveSample end = blade.Eval(kDomain.x_max_mm, 0.5);
  const CurveSample far = blade.Eval(kDomain.x_max_mm + 50, 0.5);
  EXPECT_EQ(far.flags & kCurveXOutside, kCurveXOutside);
  EXPECT_NEAR(far.phi_mm, end.phi_mm + 50 * end.phi_x, 1e-10);
  EXPECT_EQ(far.phi_xx_per_mm, 0);
  const CurveSample wide = blade.Eval(60, kDomain.theta_max_rad);
  const CurveSample wider = blade.Eval(60, kDomain.theta_max_rad + 0.5);
  EXPECT_EQ(wider.flags, kCurveThetaOutside);
  EXPECT_NEAR(wider.phi_mm, wide.phi_mm + 0.5 * wide.phi_theta_mm_per_rad, 1e-10);
  EXPECT_EQ(wider.phi_thetatheta_mm_per_rad2, 0);
  EXPECT_EQ(blade.Eval(60, 0.5).flags, kCurveOk);
}

TEST(BladeCurve, SplineEndsInsideTheDomainAreTheDomainsStraightContinuation) {
  const RigidSpline spline = {2, {20, 20, 20, 80, 80, 80}, {4, 5, 0}};
  const BladeCurve blade(spline, {10, 100, 0, 1});
  const double theta = 0.4;
  const TurnedPoint end = Turned(spline, 80, theta);
  EXPECT_EQ(blade.Eval(end.x, theta).flags, kCurveOk);  // the last point itself is not beyond
  const CurveSample beyond = blade.Eval(end.x + 5, theta);
  EXPECT_EQ(beyond.flags, kCurveXOutside);
  EXPECT_NEAR(beyond.phi_mm, end.phi.phi_mm + 5 * end.phi.phi_x, 1e-12);
}

TEST(BladeCurve, PhiAloneHasTheSameBits) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const BladeCurve blade = RandomBlade(random);
    for (int place = 0; place < 50; ++place) {
      const double x = Uniform(random, -50, 200), theta = Uniform(random, -1, 4);
      ASSERT_EQ(blade.Phi(x, theta), blade.Eval(x, theta).phi_mm) << x << " " << theta;
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(RandomBlade(random).Phi(nan, 0.3), 0);
}

TEST(BladeCurve, NotFiniteInputGivesZerosAndAFlag) {
  std::mt19937 random(9);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 20; ++i) {
    const BladeCurve blade = RandomBlade(random);
    for (const double bad : {kNan, kInf, -kInf}) {
      for (const CurveSample& s :
           {blade.Eval(bad, 0.3), blade.Eval(50, bad), blade.Eval(bad, bad)}) {
        EXPECT_EQ(s.flags, kCurveNotFinite);
        EXPECT_EQ(LargestDifference(CurveSample(), s), 0);
      }
      std::array<double, 4> x;
      EXPECT_EQ(blade.Contacts(bad, 0.3, x), 0);
      EXPECT_EQ(blade.Contacts(1, bad, x), 0);
    }
  }
}

TEST(BladeCurve, IsFiniteForEveryFiniteInputAndShape) {
  std::mt19937 random(10);
  const auto anything = [&] {
    return std::ldexp(Uniform(random, -1, 1), static_cast<int>(random() % 2000) - 1000);
  };
  for (int i = 0; i < 3000; ++i) {
    const double size = std::pow(10, Uniform(random, -6, 4));
    RigidSpline spline = RandomSpline(random, 1 + i % 5, 1 + i % 9, 50);
    for (double& knot : spline.knots_mm) knot *= size / 100;
    for (double& c : spline.coefficients_mm) c *= size / Uniform(random, 1, 100);
    const BladeCurve blade(spline, {-size, size, -3.1, 3.1});
    for (int k = 0; k < 20; ++k) {
      const double x = k % 2 ? anything() : Uniform(random, -size, size);
      const double theta = k % 3 ? Uniform(random, -3.2, 3.2) : anything();
      const CurveSample s = blade.Eval(x, theta);
      EXPECT_TRUE(std::isfinite(LargestDifference(CurveSample(), s))) << x << " " << theta;
      std::array<double, 8> contacts;
      EXPECT_GE(blade.Contacts(s.phi_mm, theta, contacts), 0);
    }
  }
}

TEST(BladeCurve, OverhangIsFlaggedAndHoldsTheNearestValue) {
  const BladeCurve blade(Hook(), {-50, 100, 0, 1.5});
  const double theta = 1.2;
  // s' = 0.03 u reaches cot(theta/2) at the fold, from where the edge hangs back to its end.
  const TurnedPoint fold = Turned(Hook(), 1 / (0.03 * std::tan(0.5 * theta)), theta);
  const TurnedPoint end = Turned(Hook(), 100, theta);
  // The graph ends where dx/du = 1e-3 is left, so much of u before the fold.
  const double before_fold_mm = 1e-3 / (0.03 * std::sin(0.5 * theta));
  for (double x = -50; x <= 100; x += 0.01) {
    const CurveSample s = blade.Eval(x, theta);
    EXPECT_TRUE(std::isfinite(LargestDifference(CurveSample(), s))) << x;
    EXPECT_EQ((s.flags & kCurveNotGraph) != 0, x >= end.x) << x;
    if (x > fold.x) {
      EXPECT_NEAR(s.phi_mm, fold.phi.phi_mm, 2 * before_fold_mm) << x;
    }
  }
}

TEST(BladeCurve, CopiesAndMovedCurvesAreTheSameCurve) {
  std::mt19937 random(11);
  BladeCurve blade = RandomBlade(random);
  const CurveSample expected = blade.Eval(50, 0.3);
  const BladeCurve copy = blade;
  const BladeCurve moved = std::move(blade);
  EXPECT_TRUE(SameBits(copy.Eval(50, 0.3), expected));
  EXPECT_TRUE(SameBits(moved.Eval(50, 0.3), expected));
  EXPECT_TRUE(
      SameBits(blade.Eval(50, 0.3), expected));  // NOLINT(bugprone-use-after-move): the claim
}

std::string Complaint(const BladeShape& shape, const CurveDomain& domain) {
  try {
    const BladeCurve blade(shape, domain);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(BladeCurve, ImpossibleShapesAreRefusedByName) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto expect =
      [](const BladeShape& shape, const CurveDomain& domain, const std::string& word) {
        const std::string complaint = Complaint(shape, domain);
        EXPECT_NE(complaint.find(word), std::string::npos) << word << ": " << complaint;
      };
  const TaperedRectangle plain;
  expect(TaperedRectangle{kNan, 0, 0.5}, kDomain, "a_mm");
  expect(TaperedRectangle{0, 1e9, 0.5}, kDomain, "b is");
  expect(TaperedRectangle{0, 0, kNan}, kDomain, "gain");
  expect(plain, {5, 5, 0, 1}, "x_mm");
  expect(plain, {5, kNan, 0, 1}, "x_mm");
  expect(plain, {5, 6, 1, 0}, "theta_rad");
  expect(plain, {5, 6, 0, 4}, "theta_rad");
  expect(RigidSpline{0, {0, 1}, {1}}, kDomain, "degree");
  expect(RigidSpline{6, std::vector<double>(14), std::vector<double>(7)}, kDomain, "degree");
  expect(RigidSpline{3, {0, 0, 1, 1}, {1, 2}}, kDomain, "coefficients_mm");
  expect(RigidSpline{1, {0, 0, 1}, {1, 2}}, kDomain, "knots_mm");
  expect(RigidSpline{1, {0, 1, 2, 2}, {1, 2}}, kDomain, "clamped");
  expect(RigidSpline{1, {0, 0, 3, 2, 4, 4}, {1, 2, 3, 4}}, kDomain, "decrease");
  expect(RigidSpline{1, {0, 0, 2, 2, 4, 4}, {1, 2, 3, 4}}, kDomain, "repeated");
  expect(RigidSpline{1, {0, 0, kNan, 4, 4}, {1, 2, 3}}, kDomain, "knots_mm");
  expect(RigidSpline{1, {0, 0, 4, 4}, {1, kNan}}, kDomain, "coefficients_mm");
  expect(RigidSpline{1, {4, 4, 4, 4}, {1, 2}}, kDomain, "knots_mm");
  EXPECT_EQ(Complaint(plain, kDomain), "");
}

}  // namespace
}  // namespace bladecurve
