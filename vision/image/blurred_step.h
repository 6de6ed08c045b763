// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace bladecurve {

// What a square pixel sees of a blurred straight step from 0 to 1, and how that changes.
struct StepSample {
  double step = 0;    // S: 0 deep inside the blade, 1 far out in the background
  double slope = 0;   // dS/dd, per px
  double spread = 0;  // dS/dblur, per px
};

// S(d) = step (*) Gaussian(blur) (*) unit pixel box, d = signed distance of the pixel's centre from
// the edge. Seen along the normal (a, b) the box is a trapezoid, box(|a|) (*) box(|b|), so S is a
// second difference of the twice integrated normal distribution: closed form, here through a table
// that is good to 1e-8.
class BlurredStep {
 public:
  // normal: unit; blur_px > 0.
  BlurredStep(const Eigen::Vector2d& normal, double blur_px);

  [[nodiscard]] StepSample At(double across_px) const;

 private:
  double blur_px_, per_blur_;
  double half_sum_, half_difference_;  // (|a| + |b|)/2 and (|a| - |b|)/2
  double per_area_;                    // 1/(|a| |b|)
  double reach_px_;                    // the step is complete to 1e-7 beyond
};

// Light that goes with a power (0, 1 or 2) of the distance beyond a line and is none before, as a
// lens shows it `across_px` from the line: the power's mean over a Gaussian, no pixel box.
[[nodiscard]] double BlurredPower(double across_px, int power, double blur_px);

// Variance of blur and pixel box together, along any direction: blur^2 + 1/12.
[[nodiscard]] double TotalBlurVariance(double blur_px);

}  // namespace bladecurve
