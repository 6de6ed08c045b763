// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/blade_curve.h"
#include "tests/model/test_blades.h"

namespace bladecurve {
namespace {

std::vector<double> ContactsOf(const BladeCurve& blade, double y, double theta) {
  std::array<double, 64> x;
  const int count = blade.Contacts(y, theta, x);
  EXPECT_LE(count, 64);
  return {x.begin(), x.begin() + count};
}

// Sign changes of phi - y on a fine grid: brute force that misses only pairs closer than a step.
std::vector<double> CrossingsOnGrid(const BladeCurve& blade, double y, double theta, int steps) {
  const CurveDomain& d = blade.domain();
  std::vector<double> crossings;
  double last = blade.Eval(d.x_min_mm, theta).phi_mm - y;
  for (int i = 1; i <= steps; ++i) {
    const double x = d.x_min_mm + (d.x_max_mm - d.x_min_mm) * i / steps;
    const double gap = blade.Eval(x, theta).phi_mm - y;
    if ((gap > 0) != (last > 0)) crossings.push_back(x);
    last = gap;
  }
  return crossings;
}

// A parabola s = (u - 50)^2 / 100 - 1 from 0 to 100.
BladeCurve Parabola() {
  return {RigidSpline{2, {0, 0, 0, 100, 100, 100}, {24, -26, 24}}, {0, 100, -1, 1}};
}

TEST(Contacts, AreAllThatBruteForceFinds) {
  constexpr int kSteps = 4000;
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    const BladeCurve blade(RandomSpline(random, 1 + i % 5, 1 + i % 9, 3), {12, 105, 0.1, 0.8});
    // Also beyond the theta domain; but there the continuation of a polyline jumps at its kinks.
    const double theta = i % 5 == 0 ? Uniform(random, 0.1, 0.8) : Uniform(random, -0.2, 1.1);
    const double y = blade.Eval(Uniform(random, 12, 105), theta).phi_mm;
    const std::vector<double> found = ContactsOf(blade, y, theta);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    for (const double x : found) {
      const CurveSample s = blade.Eval(x, theta);
      EXPECT_NEAR(s.phi_mm, y, 1e-10 * (1 + std::abs(s.phi_x))) << "x " << x << " theta " << theta;
    }
    for (const double x : CrossingsOnGrid(blade, y, theta, kSteps)) {
      const bool seen = std::any_of(found.begin(), found.end(), [x](double contact) {
        return contact <= x + 1e-9 && contact >= x - 93.0 / kSteps - 1e-9;
      });
      EXPECT_TRUE(seen) << "missed near " << x << ", degree " << 1 + i % 5 << " theta " << theta;
    }
  }
}

TEST(Contacts, OfATaperedRectangleIsTheClosedForm) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const TaperedRectangle shape = {Uniform(random, -20, 0), Uniform(random, 0.05, 0.3), 0.5};
    const BladeCurve blade(shape, {10, 120, 0, 1});
    const double theta = Uniform(random, 0, 1), y = Uniform(random, 0, 10);
    const double expected = (y - shape.a_mm) / (shape.b + 0.5 * std::tan(0.5 * theta));
    const std::vector<double> found = ContactsOf(blade, y, theta);
    const bool inside = expected >= 10 && expected <= 120;
    ASSERT_EQ(found.size(), inside ? 1u : 0u);
    for (const double x : found) EXPECT_NEAR(x, expected, 1e-12 * expected);
  }
}

TEST(Contacts, OfTwoBranchesAreBothFoundAndATouchOnce) {
  const BladeCurve blade = Parabola();
  const std::vector<double> two = ContactsOf(blade, 0, 0);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_NEAR(two[0], 40, 1e-9);
  EXPECT_NEAR(two[1], 60, 1e-9);
  const std::vector<double> touch = ContactsOf(blade, -1, 0);
  ASSERT_EQ(touch.size(), 1u);
  EXPECT_NEAR(touch[0], 50, 1e-6);
  EXPECT_TRUE(ContactsOf(blade, -1.0001, 0).empty());
}

TEST(Contacts, AtTheDomainsEndsCountAndBeyondThemDoNot) {
  const BladeCurve blade = Parabola();
  EXPECT_EQ(ContactsOf(blade, 24, 0).size(), 2u);
  EXPECT_TRUE(ContactsOf(blade, 24.001, 0).empty());
}

TEST(Contacts, OnAKnotIsOneContact) {
  const BladeCurve blade(RigidSpline{1, {0, 0, 50, 100, 100}, {-1, 0, 3}}, {0, 100, 0, 1});
  const std::vector<double> found = ContactsOf(blade, 0, 0);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0], 50, 1e-9);
}

TEST(Contacts, CountsAllAndWritesAsManyAsFit) {
  const BladeCurve blade = Parabola();
  std::array<double, 1> one = {-1};
  EXPECT_EQ(blade.Contacts(0, 0, one), 2);
  EXPECT_NEAR(one[0], 40, 1e-9);
  EXPECT_EQ(blade.Contacts(0, 0, {}), 2);
}

}  // namespace
}  // namespace bladecurve
