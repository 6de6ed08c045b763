// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/bspline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "curvefit/choose_knots.h"
#include "curvefit/span_table.h"

namespace bladecurve {
namespace {

constexpr double kRounding = 1e-13;  // a few hundred operations on numbers of size 1

SplineSpace Uneven(int degree) { return ClampedSpace(degree, 0.2, 1.1, {0.3, 0.55, 0.6, 0.9}); }

std::vector<FlatPoint> PointsAt(const std::vector<double>& places) {
  std::vector<FlatPoint> points;
  for (const double u : places) points.push_back({u, std::sin(3 * u), 1.0});
  return points;
}

class EveryDegree : public testing::TestWithParam<int> {};

TEST_P(EveryDegree, BasisSumsToOne) {
  const SplineSpace space = Uneven(GetParam());
  for (double u = 0.2; u <= 1.1; u += 0.01) {
    const BasisRow row = EvalBasis(space, u);
    EXPECT_NEAR(std::accumulate(row.value.begin(), row.value.end(), 0.0), 1, kRounding) << u;
    EXPECT_NEAR(std::accumulate(row.slope.begin(), row.slope.end(), 0.0), 0, 1e-10) << u;
  }
}

TEST_P(EveryDegree, GrevilleAbscissaeSpellTheIdentity) {
  const SplineSpace space = Uneven(GetParam());
  const std::vector<double> xi = GrevilleAbscissae(space);
  for (double u = 0.2; u <= 1.1; u += 0.01) {
    const BasisRow row = EvalBasis(space, u);
    double sum = 0;
    for (int j = 0; j <= space.degree; ++j) sum += row.value[j] * xi[row.first + j];
    EXPECT_NEAR(sum, u, kRounding);
  }
}

TEST_P(EveryDegree, DerivativesMatchCentralDifferences) {
  const SplineSpace space = Uneven(GetParam());
  constexpr double kStep = 1e-5;
  for (double u = 0.2013; u < 1.09; u += 0.0371) {
    const BasisRow row = EvalBasis(space, u);
    const BasisRow plus = EvalBasis(space, u + kStep), minus = EvalBasis(space, u - kStep);
    ASSERT_EQ(plus.first, minus.first) << "a knot within the step at " << u;
    for (int j = 0; j <= space.degree; ++j) {
      EXPECT_NEAR(row.slope[j], (plus.value[j] - minus.value[j]) / (2 * kStep), 1e-4) << u;
    }
  }
}

TEST_P(EveryDegree, PolynomialsOfTheSpansEqualTheRecursionAlsoBeyondTheEnds) {
  const SplineSpace space = Uneven(GetParam());
  const std::vector<Span> spans = SpansOf(space);
  size_t span = 0;
  for (double u = 0.18; u <= 1.12; u += 0.007) {
    const BasisRow expected = EvalBasis(space, u);
    span = FindSpan(spans, u, span);
    ASSERT_EQ(static_cast<int>(span), expected.first) << u;
    const double t = (u - spans[span].centre) * spans[span].scale;
    for (int j = 0; j <= space.degree; ++j) {
      EXPECT_NEAR(Horner<kMaxSplineDegree>(spans[span].basis[j], t), expected.value[j], 1e-12) << u;
    }
  }
}

TEST_P(EveryDegree, PiecesOfACurveAreItAndItsSlope) {
  const SplineSpace space = Uneven(GetParam());
  Eigen::VectorXd c(space.size());
  for (int j = 0; j < space.size(); ++j) c(j) = std::sin(2.0 * j);
  const std::vector<Span> spans = SpansOf(space);
  const std::vector<Piece> pieces = PiecesOf(spans, space.degree, c);
  for (double u = 1.09; u >= 0.2; u -= 0.013) {
    const BasisRow row = EvalBasis(space, u);
    double value = 0, slope = 0;
    for (int j = 0; j <= space.degree; ++j) {
      value += row.value[j] * c(row.first + j);
      slope += row.slope[j] * c(row.first + j);
    }
    const size_t span = FindSpan(spans, u, spans.size() - 1);
    const double t = (u - spans[span].centre) * spans[span].scale;
    EXPECT_NEAR(Horner<kMaxSplineDegree>(pieces[span].value, t), value, 1e-12) << u;
    EXPECT_NEAR(Horner<kMaxSplineDegree>(pieces[span].slope, t), slope, 1e-10) << u;
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, EveryDegree, testing::Range(1, 6));

TEST(SchoenbergWhitney, PointsInEverySupportDo) {
  const SplineSpace space = ClampedSpace(3, 0, 1, {0.5});
  EXPECT_TRUE(SchoenbergWhitney(PointsAt({0, 0.2, 0.4, 0.6, 1}), space));
}

TEST(SchoenbergWhitney, TooFewPointsOnOneSideDoNot) {
  // The last two functions live on [0.5, 1] almost alone.
  const SplineSpace space = ClampedSpace(3, 0, 1, {0.4, 0.5});
  EXPECT_FALSE(SchoenbergWhitney(PointsAt({0, 0.1, 0.2, 0.25, 0.3, 0.35, 0.39}), space));
}

TEST(SchoenbergWhitney, CoincidingPointsCountOnce) {
  const SplineSpace space = ClampedSpace(1, 0, 1, {});
  EXPECT_FALSE(SchoenbergWhitney(PointsAt({0.5, 0.5, 0.5}), space));
}

TEST(ChooseKnots, LineNeedsNone) {
  std::vector<FlatPoint> points;
  for (int i = 0; i < 100; ++i) points.push_back({i / 99.0, 0.1 * i / 99.0, 1e4});
  KnotRequest request;
  request.effective_points = 100;
  const KnotChoice choice = ChooseKnots(points, request);
  EXPECT_EQ(choice.spline.space.degree, 1);
  EXPECT_EQ(choice.spline.space.size(), 2);
}

TEST(ChooseKnots, NeverMoreThanThePointsSupport) {
  std::vector<FlatPoint> points;
  for (int i = 0; i < 12; ++i) points.push_back({i / 11.0, i % 2 ? 1.0 : -1.0, 1e4});
  KnotRequest request;
  request.effective_points = 12;
  const KnotChoice choice = ChooseKnots(points, request);
  EXPECT_LE(3 * choice.spline.space.size(), 12);
}

}  // namespace
}  // namespace bladecurve
