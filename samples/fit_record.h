// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "curvefit/fit.h"

namespace bladecurve {

// The "fit" object of a .blade.json: what the solver did and whether to believe it. mm_per_px turns
// the misfit into pixels.
[[nodiscard]] nlohmann::ordered_json FitRecord(const BladeFit& fit, double mm_per_px);

}  // namespace bladecurve
