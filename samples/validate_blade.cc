// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/validate_blade.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "model/blade_file.h"
#include "samples/fitted_photo.h"
#include "samples/json_arrays.h"
#include "vision/photo/photo.h"
#include "vision/render/render_compare.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json PhotosOf(const fs::path& blade) {
  std::ifstream file(blade);
  const Json record = Json::parse(file, nullptr, false);
  if (!record.is_object() || !record.contains("photos") || record["photos"].empty()) {
    throw std::invalid_argument(
        blade.string() +
        ": photos: the file names none to compare with; make one with bladecurve fit");
  }
  return record["photos"];
}

fs::path FindPhoto(const std::string& name, const fs::path& blade) {
  const fs::path beside = blade.parent_path() / fs::path(name).filename();
  return fs::exists(name) || !fs::exists(beside) ? fs::path(name) : beside;
}

// The blade's drawn edge in stored pixels, and on which side of it the blade lies.
struct DrawnEdge {
  std::vector<Eigen::Vector2d> path_px;
  bool blade_on_left = false;
};

DrawnEdge DrawEdge(const Json& record, const BladeCurve& curve, const Photo& photo) {
  PhotoMeasurement measured;
  measured.upper_edge_px = PointsOf(record.at("upper_edge_px"));
  FittedPhoto fitted;
  fitted.pivot_px = PointOf(record.at("pivot_px"));
  fitted.axis_px = PointOf(record.at("axis_px"));
  fitted.theta_rad = record.at("theta_rad").get<double>();
  fitted.mm_per_px = record.at("mm_per_px").get<double>();
  measured.mm_per_px = fitted.mm_per_px;
  fitted.upper_edge_mm = PointsOf(record.at("upper_edge_mm"));
  const std::vector<Eigen::Vector2d> displayed = FittedEdgePx(measured, fitted, curve);
  if (displayed.size() < 2) throw std::invalid_argument("upper_edge_px: fewer than two points");
  DrawnEdge edge;
  for (const Eigen::Vector2d& p : displayed) edge.path_px.push_back(photo.StoredFromDisplayed(p));
  edge.blade_on_left = true;  // the upper blade lies on the +y side of the walk from pivot to tip
  return edge;
}

std::string Sentence(const std::string& name, const EdgeAgreement& agreement, double mm_per_px) {
  if (agreement.windows == 0) {
    return fmt::format("{}: no stretch of the drawn edge shows blade and background\n", name);
  }
  return fmt::format(
      "{}: the photograph's edge lies {:+.3f} px ({:+.4f} mm) out of the drawn one, {:.3f} px rms "
      "along it; "
      "pixels differ by {:.1f} % of the contrast (blur {} px, {} stretches)\n",
      name,
      agreement.shift_px,
      agreement.shift_px * mm_per_px,
      agreement.spread_px,
      100 * agreement.residual,
      agreement.blur_px,
      agreement.windows);
}

std::string ComparePhoto(const Json& record, const BladeCurve& curve, const fs::path& blade) {
  const std::string name = record.at("file").get<std::string>();
  const Photo photo = Photo::Load(FindPhoto(name, blade));
  if (record.contains("sha256") && record["sha256"] != photo.Sha256()) {
    throw std::invalid_argument(
        name + ": not the photograph that was measured; its contents have changed");
  }
  const DrawnEdge edge = DrawEdge(record, curve, photo);
  const EdgeAgreement agreement =
      CompareDrawnEdge(photo.grey(), SrgbToneCurve(), edge.path_px, edge.blade_on_left);
  return Sentence(name, agreement, record.at("mm_per_px").get<double>());
}

}  // namespace

std::string CompareBladeWithPhotographs(const fs::path& blade) {
  const BladeFile file = ReadBladeFile(blade);
  std::string text;
  try {
    for (const Json& record : PhotosOf(blade)) text += ComparePhoto(record, file.curve, blade);
  } catch (const Json::exception& error) {
    throw std::invalid_argument(blade.string() + ": photos: " + error.what() +
                                "; make it anew with bladecurve fit");
  }
  return text;
}

}  // namespace bladecurve
