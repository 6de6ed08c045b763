// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "model/identify.h"

namespace bladecurve {

// Every cut of the input by itself, with this blade in the place of the input's and the mean of
// these empty runs, one or more, for friction. Throws as IdentifyMaterial does.
[[nodiscard]] std::vector<IdentifiedCut> IdentifyCuts(const IdentifyInput& input,
                                                      const std::vector<const ForceLog*>& empties,
                                                      const BladeCurve& blade);

}  // namespace bladecurve
