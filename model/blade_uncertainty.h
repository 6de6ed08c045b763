// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "model/blade_file.h"

namespace bladecurve {

// Standard uncertainties of what a function makes of a blade: sqrt(g^T C g), g its change with each
// parameter of phi, C their covariance; to first order. Parameters without a variance count as
// exact; zeros if the file has no covariance.
[[nodiscard]] std::vector<double> PropagateBladeUncertainty(
    const BladeFile& blade, const std::function<std::vector<double>(const BladeCurve&)>& function);

// Whether the file knows the variance of all parameters that a fit estimates. The gain of a tapered
// rectangle may be fixed: the paper's.
[[nodiscard]] bool KnowsBladeUncertainty(const BladeFile& blade);

}  // namespace bladecurve
