// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/pivot/screw_profiles.h"

namespace bladecurve {

// Brushed metal is uneven across its brushing and even along it: where the rim runs with the
// brushing it is lost in grain that neighbouring profiles share, where it crosses the brushing it
// is not. Shifts, amplitudes and precisions anew, by generalised least squares in the noise that
// the profiles leave over at each place of the rim and opposite.
void MatchInGrain(const RimProfiles& profiles, RimMatches& matches);

}  // namespace bladecurve
