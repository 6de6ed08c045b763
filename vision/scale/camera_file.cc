// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "vision/scale/camera.h"

namespace bladecurve {
namespace {

// Two pictures of one camera have the same shape; rejects calibrations of another camera or of a
// turned or cropped picture.
constexpr double kShapeTolerance = 0.002;

[[noreturn]] void Fail(const std::filesystem::path& path, const std::string& cause) {
  throw std::invalid_argument("camera: " + path.string() + ": " + cause +
                              R"(; expected {"width","height","K":[[3x3]],"dist":[k1,k2,p1,p2]})");
}

double Number(const std::filesystem::path& path,
              const nlohmann::json& value,
              const std::string& field) {
  if (!value.is_number()) Fail(path, field + " is no number");
  const double number = value.get<double>();
  if (!std::isfinite(number)) Fail(path, field + " is not finite");
  return number;
}

nlohmann::json Parse(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) Fail(path, "cannot be opened");
  nlohmann::json json = nlohmann::json::parse(stream, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) Fail(path, "is no JSON object");
  for (const char* field : {"width", "height", "K", "dist"}) {
    if (!json.contains(field)) Fail(path, std::string(field) + " is missing");
  }
  return json;
}

Eigen::Matrix3d ReadMatrix(const std::filesystem::path& path, const nlohmann::json& rows) {
  if (!rows.is_array() || rows.size() != 3) Fail(path, "K has not three rows");
  Eigen::Matrix3d k;
  for (int r = 0; r < 3; ++r) {
    const nlohmann::json& row = rows[static_cast<size_t>(r)];
    if (!row.is_array() || row.size() != 3) Fail(path, "K has a row that is not of three numbers");
    for (int c = 0; c < 3; ++c) k(r, c) = Number(path, row[static_cast<size_t>(c)], "K");
  }
  const bool triangular = k(1, 0) == 0 && k(2, 0) == 0 && k(2, 1) == 0 && k(2, 2) == 1;
  if (!triangular || k(0, 0) <= 0 || k(1, 1) <= 0) Fail(path, "K is no camera matrix");
  return k;
}

// Pixel centres are whole numbers, so a picture s times the size has u' = s (u + 1/2) - 1/2.
void ScalePixels(Eigen::Matrix3d* k, double sx, double sy) {
  Eigen::Matrix3d scaled_from_original;
  scaled_from_original << sx, 0, 0.5 * sx - 0.5, 0, sy, 0.5 * sy - 0.5, 0, 0, 1;
  *k = scaled_from_original * *k;
}

}  // namespace

Camera ReadCamera(const std::filesystem::path& path, int width, int height) {
  const nlohmann::json json = Parse(path);
  const double calibrated_width = Number(path, json["width"], "width");
  const double calibrated_height = Number(path, json["height"], "height");
  const double sx = width / calibrated_width, sy = height / calibrated_height;
  if (!(sx > 0) || !(sy > 0) || std::abs(sx / sy - 1) > kShapeTolerance) {
    Fail(path,
         "is for pictures of " + json["width"].dump() + " x " + json["height"].dump() +
             " pixels, this one is stored as " + std::to_string(width) + " x " +
             std::to_string(height));
  }
  Camera camera;
  camera.k = ReadMatrix(path, json["K"]);
  ScalePixels(&camera.k, sx, sy);
  const nlohmann::json& dist = json["dist"];
  if (!dist.is_array() || dist.size() < 4) Fail(path, "dist has not four numbers");
  for (size_t i = 0; i < dist.size(); ++i) {
    const double value = Number(path, dist[i], "dist");
    if (i < 4) camera.distortion[i] = value;
    if (i >= 4 && value != 0)
      Fail(path, "dist has coefficients beyond p2, which this lens model lacks");
  }
  return camera;
}

}  // namespace bladecurve
