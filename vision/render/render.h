// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "vision/render/synthetic_scene.h"

namespace bladecurve {

// A cutting edge as one cubic over [from_mm, to_mm] in its blade's frame (upper blade: v = s(u),
// lower blade: v mirrored).
struct EdgeShape {
  double from_mm = 0, to_mm = 0;               // u of heel and distal end
  std::array<double, 4> bernstein_mm{};        // the last is 0: theta is measured to the distal end
  [[nodiscard]] double At(double u_mm) const;  // beyond the ends: linear continuation
  [[nodiscard]] double SlopeAt(double u_mm) const;
};

struct EdgeTruth {
  EdgeShape shape;
  std::vector<Eigen::Vector2d> blade_mm;     // (u, s(u)), heel to distal end
  std::vector<Eigen::Vector2d> scissors_mm;  // the same in physics.md's frame
  std::vector<Eigen::Vector2d> px;           // the same in the picture
  double free_from_mm = 0;  // u of the crotch: from there to the distal end nothing lies beside it
  Eigen::Vector2d end_px = Eigen::Vector2d::Zero();  // distal end
};

struct MarkerTruth {
  int id = 0;
  double size_mm = 0;
  std::array<Eigen::Vector2d, 4> corners_px;  // clockwise from the marker's own top left
};

// World (mm, y up, z towards the camera) to pixels: K [R | t], then k1.
struct CameraTruth {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d camera_from_world = Eigen::Matrix3d::Identity();
  Eigen::Vector3d world_in_camera_mm = Eigen::Vector3d::Zero();
  double k1 = 0;
};

// What a perfect measurement of the picture would say. Pixels: centre of the top-left one is (0,
// 0).
struct SceneTruth {
  int width = 0, height = 0;
  double theta_rad = 0;
  Eigen::Vector2d pivot_px =
      Eigen::Vector2d::Zero();  // of the pivot's axis, at the height of the edges
  Eigen::Vector2d screw_px =
      Eigen::Vector2d::Zero();  // centre of the screw's rim; parallax parts the two
  Eigen::Vector2d axis_px = Eigen::Vector2d::UnitX();  // image of +x at the pivot, unit
  double mm_per_px = 0;  // at the pivot along the axis, height of the edges
  double edge_height_mm = 0;
  EdgeTruth upper, lower;
  std::vector<MarkerTruth> markers;
  CameraTruth camera;
  bool tips_in_frame = false;
};

struct RenderedPhoto {
  cv::Mat bgr;  // CV_8UC3
  SceneTruth truth;
};

// The photograph that the camera would take of the scene. The outlines' share in every pixel,
// blurred by the lens, is exact to 1e-3 for blur >= 0.5 px; the same spec gives the same bytes.
// Throws std::invalid_argument naming a field of the spec that cannot be.
[[nodiscard]] RenderedPhoto RenderScene(const SceneSpec& spec);

// The truth alone, without rendering.
[[nodiscard]] SceneTruth TruthOf(const SceneSpec& spec);

// A JPEG file of a CV_8UC3 picture, 4:2:0 as phones write it. Quality 1 to 100.
[[nodiscard]] std::string EncodeJpeg(const cv::Mat& bgr, int quality);

}  // namespace bladecurve
