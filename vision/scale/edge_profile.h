// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace bladecurve {

// Profile of a step edge, 0 on the dark side and 1 on the bright one, blurred by a Gaussian and
// averaged over square pixels; with its first two derivatives. Seen along a normal at an angle, the
// pixel is the trapezoid box(|cos|) * box(|sin|), so the profile is a second difference of the
// twice integrated normal distribution. Tabulated: `reach_px` bounds |distance|, beyond it the ends
// hold.
class EdgeProfile {
 public:
  struct Value {
    double level, slope_per_px, curvature_per_px2;
  };
  EdgeProfile(double normal_angle_rad, double blur_px);
  [[nodiscard]] Value At(double distance_px) const;

 private:
  double reach_px_;
  std::vector<Value> nodes_;
};

}  // namespace bladecurve
