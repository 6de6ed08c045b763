// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/known_camera.h"

#include <algorithm>

namespace bladecurve {
namespace {

// Standard uncertainties of what is known beforehand.
constexpr double kExifFocal =
    0.03;  // whole millimetres of some 28, and the crop that stabilisation takes
constexpr double kUnknownFocal =
    0.6;  // 0.65 to 2.2 times the long side covers phones to short telephoto lenses
constexpr double kUnknownFocalPerSide = 1.2;
constexpr double kUnknownK1 = 0.02;  // cameras correct their lenses to half a percent at the corner

}  // namespace

CameraKnowledge KnowCamera(const Photo& photo,
                           const std::optional<std::filesystem::path>& calibration) {
  const int width = photo.grey().cols, height = photo.grey().rows;
  if (calibration)
    return {ReadCamera(*calibration, width, height), kCalibratedFocalSigma, kCalibratedK1Sigma};
  const std::optional<double> exif = photo.metadata().focal_length_px;
  if (exif) return {CentredCamera(*exif, width, height), kExifFocal, kUnknownK1};
  const double guess = kUnknownFocalPerSide * std::max(width, height);
  return {CentredCamera(guess, width, height), kUnknownFocal, kUnknownK1};
}

}  // namespace bladecurve
