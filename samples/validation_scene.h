// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "vision/refused.h"
#include "vision/render/synthetic_scene.h"

namespace bladecurve {

// A photograph to be rendered and measured, and what an honest program says about it.
struct ValidationScene {
  int number = 0;
  SceneSpec spec;
  std::optional<Reason>
      refuse;  // the reason for which it must be refused; none: it can be measured
  // By how much the calibration and the height given to the program are off: drawn from what it
  // takes them to be good for. So are, in `spec`, the height of the screw's head and its slot's
  // place.
  double focal_error = 0, k1_error = 0, height_error_mm = 0;
  bool camera_known = true;  // whether the program is given that calibration
};

// Scene `number` of the series that `seed` begins. Every tenth must be refused: closed scissors, a
// tip outside the picture, an empty sheet, in turn.
[[nodiscard]] ValidationScene MakeValidationScene(int number,
                                                  std::uint64_t seed,
                                                  Difficulty difficulty);

}  // namespace bladecurve
