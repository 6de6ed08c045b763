// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/synthetic_scene.h"

namespace bladecurve {

// The usual scissors in a small picture.
inline SceneSpec SmallScene() {
  SceneSpec spec;
  spec.width = 1000;
  spec.height = 750;
  spec.camera.mm_per_px = 0.25;
  return spec;
}

}  // namespace bladecurve
