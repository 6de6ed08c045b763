// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/edge/edge_band.h"

namespace bladecurve {

// Where along a path a side of it is brighter than the picture can store: its true light is then
// unknown, and pixels near white say only that it is no less.
class Overexposure {
 public:
  // The band's pixels at `inner`..`outer` px from the path are taken as the sides themselves.
  static constexpr double kNear = 2.5, kFar = 7;

  Overexposure() = default;
  explicit Overexposure(const PixelBand& band);

  [[nodiscard]] bool OfBlade(int sample) const;
  [[nodiscard]] bool OfGround(int sample) const;
  [[nodiscard]] double Share() const;  // of the path, either side

  // Above this light a pixel beside an overexposed side tells nothing; linear, 0 to 1.
  static constexpr double kTrusted = 0.75;

 private:
  struct Stretch {
    bool blade = false, ground = false;
  };
  [[nodiscard]] const Stretch* At(int sample) const;

  std::vector<Stretch> stretches_;
};

}  // namespace bladecurve
