// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "vision/render/render.h"

namespace bladecurve {

// A photograph, NAME.jpg or NAME.png, and what NAME.truth.json beside it says is true: schema
// scissors-heldout/1, as SceneTruthJson writes it.
struct PhotographWithTruth {
  std::filesystem::path photo;
  bool to_refuse = false;     // expect: "refuse"
  bool camera_known = false;  // camera.type: "persp"
  SceneTruth truth;  // edges: the cubic nearest to blade_mm; no markers: the scale is given
};

// Those of a folder, by name. Throws std::invalid_argument where there is none, or where a truth
// lacks its photograph or something that it must say.
[[nodiscard]] std::vector<PhotographWithTruth> PhotographsWithTruth(
    const std::filesystem::path& folder);

}  // namespace bladecurve
