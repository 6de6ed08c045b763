// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "curvefit/fit.h"

namespace bladecurve {

// Standard uncertainty of phi(x, theta), mm: the covariance of the fitted parameters, propagated to
// first order.
[[nodiscard]] double PhiSigma(const FamilyFit& fit, double x_mm, double theta_rad);

}  // namespace bladecurve
