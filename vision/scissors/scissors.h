// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/photo/photo.h"
#include "vision/pivot/pivot.h"
#include "vision/scale/scale.h"
#include "vision/scene/scene.h"
#include "vision/scissors/located_blade.h"
#include "vision/stage_log.h"

namespace bladecurve {

// The scissors in full resolution, stored pixels.
struct Scissors {
  Scene scene;  // where they were looked for
  Pivot pivot;
  Blades blades;
};

// What they are measured by.
struct ScissorsView {
  const Photo& photo;
  const ScaleResult& scale;
  const StoredHints& hints;
};

// Edges, ends and pivot. Where the likeliest scene proves to be no scissors, what else is seen is
// tried; where that fails as well, throws Refused for the reason the likeliest gave.
[[nodiscard]] Scissors LocateScissors(const ScissorsView& view, SceneFinder* finder, StageLog* log);

}  // namespace bladecurve
