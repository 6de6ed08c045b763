// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "curvefit/fit_report.h"
#include "model/blade_curve.h"

namespace bladecurve {

// Sharp cutting of a thin plate, tau = J_c h phi_theta/phi_x where phi(x, theta) = 0, without J_c
// h: mm/rad. Nothing where the edge does not cross the axis rising.
[[nodiscard]] std::optional<double> ThinPlateTorque(const BladeCurve& curve, double theta_rad);

// Where two curves of the same domain differ most, and how far at the angles of photographs.
// Torque: sharp cutting of a thin plate, tau = J_c h phi_theta/phi_x where phi(x, theta) = 0; as a
// ratio, J_c and h cancel.
[[nodiscard]] FamilyDifference CompareFamilies(const BladeCurve& a,
                                               const BladeCurve& b,
                                               const std::vector<double>& photographed_rad);

}  // namespace bladecurve
