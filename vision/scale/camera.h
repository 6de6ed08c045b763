// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>

namespace bladecurve {

// A pinhole camera with the lens model of OpenCV. Pixels in stored orientation.
struct Camera {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();  // pixels from normalised image coordinates
  std::array<double, 4> distortion = {0, 0, 0, 0};  // k1, k2, p1, p2

  [[nodiscard]] double focal_length_px() const { return 0.5 * (k(0, 0) + k(1, 1)); }
};

// Square pixels, principal point in the middle of the picture, no distortion.
[[nodiscard]] Camera CentredCamera(double focal_length_px, int width, int height);

// Where the pinhole alone would have imaged what is seen at `image_px`, and back.
[[nodiscard]] Eigen::Vector2d Undistorted(const Camera& camera, const Eigen::Vector2d& image_px);
[[nodiscard]] Eigen::Vector2d Distorted(const Camera& camera,
                                        const Eigen::Vector2d& undistorted_px);

// Reads {"width","height","K":[[3x3]],"dist":[k1,k2,p1,p2]} and fits it to a picture of width x
// height: a calibration of the same picture at another size is scaled. Throws std::invalid_argument
// naming file and field.
[[nodiscard]] Camera ReadCamera(const std::filesystem::path& path, int width, int height);

}  // namespace bladecurve
