// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/scene_truth.h"

#include <nlohmann/json.hpp>
#include <numbers>

#include "samples/json_arrays.h"

namespace bladecurve {
namespace {

using Json = nlohmann::ordered_json;

Json EdgeJson(const EdgeTruth& edge, double height_mm) {
  return {{"z_world_mm", height_mm},
          {"bernstein_mm", edge.shape.bernstein_mm},
          {"u_range_mm", {edge.shape.from_mm, edge.shape.to_mm}},
          {"free_u_range_mm", {edge.free_from_mm, edge.shape.to_mm}},
          {"end_px", PointJson(edge.end_px)},
          {"blade_mm", PointsJson(edge.blade_mm)},
          {"scissors_mm", PointsJson(edge.scissors_mm)},
          {"px", PointsJson(edge.px)}};
}

Json MarkersJson(const std::vector<MarkerTruth>& markers) {
  if (markers.empty()) return nullptr;
  Json list = Json::array();
  for (const MarkerTruth& marker : markers) {
    Json corners = Json::array();
    for (const Eigen::Vector2d& corner : marker.corners_px) corners.push_back(PointJson(corner));
    list.push_back({{"id", marker.id}, {"size_mm", marker.size_mm}, {"corners_px", corners}});
  }
  return {{"dictionary", "DICT_4X4_50"},
          {"size_mm", markers.front().size_mm},
          {"plane_z_world_mm", 0},
          {"markers", list}};
}

Json CameraJson(const CameraTruth& camera) {
  const Eigen::Vector3d& t = camera.world_in_camera_mm;
  return {{"type", "persp"},
          {"K", MatrixJson(camera.k)},
          {"R_world_to_cam", MatrixJson(camera.camera_from_world)},
          {"t_world_to_cam", {t.x(), t.y(), t.z()}},
          {"distortion", {{"k1", camera.k1}}}};
}

}  // namespace

Json SceneTruthJson(const SceneTruth& truth, const std::string& file, const std::string& expect) {
  return {{"schema", kTruthSchema},
          {"expect", expect},
          {"image", {{"file", file}, {"width", truth.width}, {"height", truth.height}}},
          {"units", "mm, degrees"},
          {"theta_deg", truth.theta_rad * 180 / std::numbers::pi},
          {"pivot",
           {{"px", PointJson(truth.pivot_px)}, {"screw_top_center_px", PointJson(truth.screw_px)}}},
          {"symmetry_axis", {{"dir_px", PointJson(truth.axis_px)}}},
          {"scale",
           {{"known_mm_per_px", nullptr},
            {"mm_per_px_edge_plane", {{"at_pivot_along_axis", truth.mm_per_px}}}}},
          {"camera", CameraJson(truth.camera)},
          {"marker", MarkersJson(truth.markers)},
          {"edge_upper", EdgeJson(truth.upper, truth.edge_height_mm)},
          {"edge_lower", EdgeJson(truth.lower, truth.edge_height_mm)}};
}

}  // namespace bladecurve
