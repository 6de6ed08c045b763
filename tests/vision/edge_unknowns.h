// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace bladecurve::testing {

// What is not known of a straight blurred edge between even light on either side: place and
// direction, px and rad, both levels, and the blur, px.
enum Unknown { kOffset, kAngle, kBlade, kGround, kBlur, kUnknowns };
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;

}  // namespace bladecurve::testing
