// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "vision/edge/edge_clipping.h"
#include "vision/edge/edge_slice.h"
#include "vision/edge/edge_windows.h"

namespace bladecurve {

// Noise of a pixel on either side of an edge, linear light: metal and cloth differ, and do so more
// once gamma is undone.
struct SideNoise {
  double blade = 0.02, ground = 0.02;

  // Inverse variance of a pixel, `step` of which sees the ground.
  [[nodiscard]] double Weight(double step) const {
    return 1 / ((1 - step) * blade * blade + step * ground * ground);
  }
};

// How pixels beside a side brighter than white count in a fit: where they are white they are left
// out, and the side's light becomes an unknown. Sound only where the blur is known: without it the
// flank that remains may be anything.
class Glare {
 public:
  Glare() = default;  // none
  explicit Glare(const PixelBand& band) : where_(band) {}

  [[nodiscard]] bool At(int sample) const {
    return where_.OfBlade(sample) || where_.OfGround(sample);
  }

  // The noise of an overexposed side is cut off with its light: the other side's stands in.
  [[nodiscard]] double Weight(int sample, double step, const SideNoise& noise) const;

  // Takes pixels of a sample with glare out of the balance, by what the levels say they should show
  // (for what they do show is cut off), or by what they show while levels are not known.
  static void HideWhite(const std::optional<LevelVector>& levels,
                        std::vector<PreparedPixel>* pixels);

  // Adds what is known of the light of an overexposed side where its flank says little.
  void AddUnknownLight(int sample, EdgeWindows* windows) const;

 private:
  Overexposure where_;
};

}  // namespace bladecurve
