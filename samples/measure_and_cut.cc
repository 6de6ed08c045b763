// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>

#include "curvefit/fit.h"
#include "model/torque.h"
#include "vision/measure.h"

// measure_and_cut PHOTO: the scissors in a photograph with 25 mm markers close on paper by 18
// degrees.
int main(int argc, char** argv) try {
  bladecurve::MeasureOptions options;
  options.scale.marker_mm = 25;
  const auto photo = bladecurve::MeasurePhoto(argc > 1 ? argv[1] : "", options);
  const auto fit = bladecurve::FitBlade({photo.edges});

  const bladecurve::Material paper{"paper", 4.9, 0.1, bladecurve::ForceDeflection(5.0)};
  bladecurve::TorqueModel scissors(fit.recommended.curve, paper, {20, 43});
  for (int ms = 0; ms <= 6000; ++ms) {  // 3 degrees a second, a haptic loop of 1 kHz
    const double theta_rad = photo.theta_rad - ms * 0.0523598775598 / 1000;
    const auto sample = scissors.Step(theta_rad, 0, 0.001);
    if (ms % 250 == 0) std::printf("%.4f rad  %8.3f N mm\n", theta_rad, sample.torque_nmm);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
