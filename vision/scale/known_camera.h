// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <numbers>
#include <optional>

#include "vision/photo/photo.h"
#include "vision/scale/camera.h"

namespace bladecurve {

// How well users know a camera calibrated with care and refocused since, standard uncertainties.
inline constexpr double kCalibratedFocalSigma = 0.002;  // relative
inline constexpr double kCalibratedK1Sigma = 0.002;

// Standard uncertainty of its logarithm below which a focal length counts as known.
inline constexpr double kFocalKnown = 0.15;

// By how much pictures taken from above are off the vertical, about either axis of the picture,
// where nothing tells: a standard uncertainty, rad.
inline constexpr double kFreehandSlantRad = 3 * std::numbers::pi / 180;

// What is known of the camera beforehand. A sigma of zero: exactly.
struct CameraKnowledge {
  Camera camera;
  double log_focal_sigma = 0;
  double k1_sigma = 0;
};

// By CALIB.json, else by EXIF's focal length, else what most cameras are.
[[nodiscard]] CameraKnowledge KnowCamera(const Photo& photo,
                                         const std::optional<std::filesystem::path>& calibration);

}  // namespace bladecurve
