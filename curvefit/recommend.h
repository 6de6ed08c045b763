// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "curvefit/family_fit.h"
#include "curvefit/fit.h"

namespace bladecurve {

// Chooses between the two fits and fills in what follows from both: difference, gain, warnings.
void Recommend(const FamilyInput& input,
               const FitOptions& options,
               FamilyFit spline,
               FamilyFit tapered,
               BladeFit& report);

}  // namespace bladecurve
