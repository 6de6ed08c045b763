// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/card_scene.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace bladecurve {

using Eigen::Vector2d;

SceneSpec OnCard(const Card& card, double tilt_rad) {
  SceneSpec scene;
  scene.width = 1800;
  scene.height = 1350;
  scene.camera = {.mm_per_px = 0.2, .distance_mm = 420, .tilt_rad = tilt_rad, .k1 = -0.02};
  scene.camera.tilt_azimuth_rad = 0.7;
  scene.pivot_mm = {-45, 0};
  const Vector2d middle_mm(0.5 * card.width_mm, 0.5 * card.height_mm);
  for (const Card::Marker& marker : card.markers) {
    scene.markers.push_back({.id = marker.id,
                             .size_mm = card.marker_mm,
                             .center_mm = marker.centre_mm - middle_mm,
                             .margin_mm = 3});
  }
  return scene;
}

std::filesystem::path SaveCalibration(const SceneTruth& truth, const std::filesystem::path& path) {
  const Eigen::Matrix3d& k = truth.camera.k;
  const nlohmann::json calibration = {
      {"width", truth.width},
      {"height", truth.height},
      {"K",
       {{k(0, 0), k(0, 1), k(0, 2)}, {k(1, 0), k(1, 1), k(1, 2)}, {k(2, 0), k(2, 1), k(2, 2)}}},
      {"dist", {truth.camera.k1, 0, 0, 0}}};
  std::ofstream(path) << calibration;
  return path;
}

Vector2d ImageOf(const CameraTruth& camera, const Eigen::Vector3d& world_mm) {
  const Eigen::Vector3d p = camera.camera_from_world * world_mm + camera.world_in_camera_mm;
  const Vector2d ideal = p.head<2>() / p.z();
  return camera.k(0, 0) * ideal * (1 + camera.k1 * ideal.squaredNorm()) +
         camera.k.block<2, 1>(0, 2);
}

double WorstOf100Mm(const PlaneMap& map, const CameraTruth& camera, double height_mm) {
  const std::vector<std::pair<Vector2d, Vector2d>> lengths = {
      {{-50, 0}, {50, 0}}, {{0, -50}, {0, 50}}, {{-100, -40}, {-20, 20}}, {{10, 40}, {110, 40}}};
  double worst = 0;
  for (const auto& [from, to] : lengths) {
    const auto seen = [&](const Vector2d& mm) {
      return map.PlaneFromImage(ImageOf(camera, {mm.x(), mm.y(), height_mm}));
    };
    worst = std::max(worst, std::abs((seen(to) - seen(from)).norm() - (to - from).norm()));
  }
  return worst;
}

}  // namespace bladecurve
