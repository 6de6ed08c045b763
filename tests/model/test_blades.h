// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <vector>

#include "model/blade_curve.h"
#include "tests/model/uniform.h"

namespace bladecurve {

// A spline from u = 10 to 110 mm of the given degree and number of spans, with knots anywhere and
// coefficients on a slope of -0.05 give or take `waviness_mm`.
RigidSpline RandomSpline(std::mt19937& random, int degree, int num_spans, double waviness_mm);

// Either family, of the sizes that scissors have.
BladeCurve RandomBlade(std::mt19937& random);

// The largest |a - b| over phi and all derivatives, each relative to 1 + |a|.
double LargestDifference(const CurveSample& a, const CurveSample& b);

// Whether all values of both are the same, bit for bit.
bool SameBits(const CurveSample& a, const CurveSample& b);

// s(u) and its first two derivatives by the definition of B-splines (Cox and de Boor), in extended
// precision.
struct SplineValue {
  long double s, s1, s2;
};
SplineValue ReferenceSpline(const RigidSpline& spline, long double u);

}  // namespace bladecurve
