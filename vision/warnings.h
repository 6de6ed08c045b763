// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vision/pivot/pivot.h"
#include "vision/scale/plane_map.h"
#include "vision/scale/scale.h"
#include "vision/scene/scene.h"
#include "vision/scissors/located_blade.h"

namespace bladecurve {

// The doubts that make a result `review`, by name.
[[nodiscard]] std::vector<std::string> WarningsOf(const Scene& scene,
                                                  const ScaleResult& scale,
                                                  const PlaneMap& map,
                                                  const Pivot& pivot,
                                                  const Blades& blades);

}  // namespace bladecurve
