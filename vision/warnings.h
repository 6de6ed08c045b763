// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vision/located_blade.h"
#include "vision/pivot.h"
#include "vision/plane_map.h"
#include "vision/scale.h"
#include "vision/scene.h"

namespace bladecurve {

// The doubts that make a result `review`, by name.
[[nodiscard]] std::vector<std::string> WarningsOf(const Scene& scene,
                                                  const ScaleResult& scale,
                                                  const PlaneMap& map,
                                                  const Pivot& pivot,
                                                  const Blades& blades);

}  // namespace bladecurve
