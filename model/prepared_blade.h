// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "model/blade_curve.h"
#include "model/kernel_spline.h"

namespace bladecurve {

// A blade ready to evaluate: the kernel points into the two vectors, hence never copied.
struct PreparedBlade {
  std::vector<double> rows;
  std::vector<double> ends;
  BladeKernel kernel = {};

  PreparedBlade() = default;
  PreparedBlade(const PreparedBlade&) = delete;
  PreparedBlade& operator=(const PreparedBlade&) = delete;
};

// Checks the shape and the domain and cuts a spline into polynomials.
// Throws std::invalid_argument that names the field, the value and the bound.
[[nodiscard]] std::shared_ptr<const PreparedBlade> PrepareBlade(const BladeShape& shape,
                                                                const CurveDomain& domain);

}  // namespace bladecurve
