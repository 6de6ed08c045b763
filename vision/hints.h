// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "vision/photo/photo.h"

namespace bladecurve {

enum class ImageDirection { kRight, kLeft, kUp, kDown };

// What the user knows about the picture; all in displayed pixels.
struct SceneHints {
  std::optional<Eigen::Vector2d> pivot_px;
  std::optional<std::array<double, 4>> roi_px;  // x, y, width, height: the scissors to look at
  std::optional<ImageDirection> tips_toward;
  std::optional<double> theta_rad;
};

// Hints in stored pixels.
struct StoredHints {
  std::optional<cv::Rect> roi_px;
  std::optional<Eigen::Vector2d> pivot_px;
  std::optional<Eigen::Vector2d> tips_direction;  // unit
};

// Throws std::invalid_argument for a pivot or a region outside the picture, or the one outside the
// other.
[[nodiscard]] StoredHints InStored(const Photo& photo, const SceneHints& hints);

}  // namespace bladecurve
