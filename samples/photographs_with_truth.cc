// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/photographs_with_truth.h"

#include <Eigen/QR>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "model/degrees.h"
#include "samples/json_arrays.h"
#include "samples/scene_truth.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTruthEnding = ".truth.json";

// The cubic that ends in 0 where the blade does, by least squares.
EdgeShape ShapeThrough(const std::vector<Eigen::Vector2d>& blade_mm) {
  EdgeShape shape{.from_mm = blade_mm.front().x(), .to_mm = blade_mm.back().x()};
  const auto count = static_cast<Eigen::Index>(blade_mm.size());
  Eigen::MatrixX3d basis(count, 3);
  Eigen::VectorXd v(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector2d& p = blade_mm[static_cast<std::size_t>(i)];
    const double t = (p.x() - shape.from_mm) / (shape.to_mm - shape.from_mm), s = 1 - t;
    basis.row(i) << s * s * s, 3 * s * s * t, 3 * s * t * t;
    v(i) = p.y();
  }
  const Eigen::Vector3d bernstein = basis.colPivHouseholderQr().solve(v);
  std::copy_n(bernstein.data(), 3, shape.bernstein_mm.begin());
  return shape;
}

EdgeTruth EdgeOf(const nlohmann::json& json) {
  constexpr std::size_t kFewest = 4;  // a cubic's
  EdgeTruth edge;
  edge.blade_mm = PointsOf(json.at("blade_mm"));
  edge.scissors_mm = PointsOf(json.at("scissors_mm"));
  edge.px = PointsOf(json.at("px"));
  const std::size_t count = edge.blade_mm.size();
  if (count < kFewest || edge.scissors_mm.size() != count || edge.px.size() != count)
    throw std::invalid_argument(
        "blade_mm, scissors_mm and px are not the same four points or more");
  edge.shape = ShapeThrough(edge.blade_mm);
  edge.free_from_mm = json.at("free_u_range_mm").at(0).get<double>();
  edge.end_px = edge.px.back();
  return edge;
}

CameraTruth CameraOf(const nlohmann::json& json) {
  CameraTruth camera;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) camera.k(r, c) = json.at("K").at(r).at(c).get<double>();
  }
  camera.k1 = json.at("distortion").at("k1").get<double>();
  return camera;
}

std::vector<MarkerTruth> MarkersOf(const nlohmann::json& json) {
  std::vector<MarkerTruth> markers;
  if (json.is_null()) return markers;
  for (const nlohmann::json& marker : json.at("markers"))
    markers.push_back({.id = marker.at("id").get<int>(),
                       .size_mm = marker.at("size_mm").get<double>(),
                       .corners_px = {}});
  return markers;
}

PhotographWithTruth FromJson(const nlohmann::json& json) {
  if (json.value("schema", "") != kTruthSchema)
    throw std::invalid_argument(std::string("its schema is not ") + kTruthSchema);
  PhotographWithTruth photograph;
  SceneTruth& truth = photograph.truth;
  photograph.to_refuse = json.value("expect", "ok") == "refuse";
  truth.width = json.at("image").at("width").get<int>();
  truth.height = json.at("image").at("height").get<int>();
  truth.theta_rad = json.at("theta_deg").get<double>() * kRadPerDeg;
  truth.pivot_px = PointOf(json.at("pivot").at("px"));
  const nlohmann::json screw = json.at("pivot").value("screw_top_center_px", nlohmann::json());
  truth.screw_px = screw.is_null() ? truth.pivot_px : PointOf(screw);
  truth.axis_px = PointOf(json.at("symmetry_axis").at("dir_px"));
  const nlohmann::json& scale = json.at("scale");
  truth.mm_per_px = scale.at("mm_per_px_edge_plane").at("at_pivot_along_axis").get<double>();
  truth.upper = EdgeOf(json.at("edge_upper"));
  truth.lower = EdgeOf(json.at("edge_lower"));
  truth.edge_height_mm = json.at("edge_upper").at("z_world_mm").get<double>();
  photograph.camera_known = json.at("camera").at("type") == "persp";
  if (photograph.camera_known) truth.camera = CameraOf(json.at("camera"));
  if (scale.at("known_mm_per_px").is_null()) truth.markers = MarkersOf(json.at("marker"));
  return photograph;
}

std::optional<fs::path> PictureBeside(const fs::path& truth) {
  const std::string stem = truth.string().substr(0, truth.string().size() - kTruthEnding.size());
  for (const char* ending : {".jpg", ".png"}) {
    if (fs::exists(stem + ending)) return stem + ending;
  }
  return std::nullopt;
}

PhotographWithTruth Read(const fs::path& path) try {
  const std::optional<fs::path> photo = PictureBeside(path);
  if (!photo) throw std::invalid_argument("neither a .jpg nor a .png of that name lies beside it");
  std::ifstream stream(path);
  PhotographWithTruth photograph = FromJson(nlohmann::json::parse(stream));
  photograph.photo = *photo;
  return photograph;
} catch (const std::exception& cause) {
  throw std::invalid_argument("--photographs: " + path.string() + ": " + cause.what());
}

}  // namespace

std::vector<PhotographWithTruth> PhotographsWithTruth(const fs::path& folder) {
  std::vector<fs::path> truths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().string().ends_with(kTruthEnding)) truths.push_back(entry.path());
  }
  if (truths.empty())
    throw std::invalid_argument("--photographs: " + folder.string() + " holds no NAME" +
                                std::string(kTruthEnding));
  std::sort(truths.begin(), truths.end());
  std::vector<PhotographWithTruth> photographs;
  for (const fs::path& truth : truths) photographs.push_back(Read(truth));
  return photographs;
}

}  // namespace bladecurve
