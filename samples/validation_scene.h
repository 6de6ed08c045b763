// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "vision/refused.h"
#include "vision/synthetic_scene.h"

namespace bladecurve {

// A photograph to be rendered and measured, and what an honest program says about it.
struct ValidationScene {
  int number = 0;
  SceneSpec spec;
  std::optional<Reason>
      refuse;  // the reason for which it must be refused; none: it can be measured
};

// Scene `number` of the series that `seed` begins. Every tenth must be refused: closed scissors, a
// tip outside the picture, an empty sheet, in turn.
[[nodiscard]] ValidationScene MakeValidationScene(int number,
                                                  std::uint64_t seed,
                                                  Difficulty difficulty);

}  // namespace bladecurve
