// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/validation_run.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "samples/analysis.h"
#include "samples/validation_errors.h"
#include "vision/photo/whole_file.h"
#include "vision/render/render.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

constexpr int kJpegQuality = 95;

// Files of one scene; gone when this goes.
class SceneFiles {
 public:
  SceneFiles(const RenderedPhoto& photo, const ValidationScene& scene, const fs::path& stem)
      : photo_(stem.string() + ".jpg"), camera_(stem.string() + ".camera.json") {
    WriteFileWhole(photo_, EncodeJpeg(photo.bgr, kJpegQuality));
    Eigen::Matrix3d k = photo.truth.camera.k;
    k.diagonal().head<2>() *= 1 + scene.focal_error;
    const nlohmann::json calibration = {
        {"width", photo.truth.width},
        {"height", photo.truth.height},
        {"K",
         {{k(0, 0), k(0, 1), k(0, 2)}, {k(1, 0), k(1, 1), k(1, 2)}, {k(2, 0), k(2, 1), k(2, 2)}}},
        {"dist", {photo.truth.camera.k1 + scene.k1_error, 0, 0, 0}}};
    WriteFileWhole(camera_, calibration.dump());
  }
  ~SceneFiles() {
    std::error_code ignored;
    fs::remove(photo_, ignored);
    fs::remove(camera_, ignored);
  }
  SceneFiles(const SceneFiles&) = delete;
  SceneFiles& operator=(const SceneFiles&) = delete;

  [[nodiscard]] const fs::path& photo() const { return photo_; }
  [[nodiscard]] const fs::path& camera() const { return camera_; }

 private:
  fs::path photo_, camera_;
};

AnalysisSettings SettingsFor(const ValidationScene& scene, const SceneFiles& files) {
  const SceneSpec& spec = scene.spec;
  AnalysisSettings settings;
  if (spec.markers.empty()) {
    settings.measure.scale.mm_per_px = TruthOf(spec).mm_per_px;
    return settings;
  }
  settings.measure.scale.marker_mm = spec.markers.front().size_mm;
  settings.measure.scale.plane_height_mm = spec.edge_height_mm + scene.height_error_mm;
  if (scene.camera_known) settings.measure.scale.camera = files.camera();
  return settings;
}

// The folder has another name in each run.
std::string WithoutFolder(std::string text, const fs::path& folder) {
  const std::string prefix = folder.string() + "/";
  for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
    text.erase(at, prefix.size());
  return text;
}

std::vector<std::string> WarningsOf(const Analysis& analysis) {
  std::vector<std::string> warnings = analysis.photos.front().warnings;
  warnings.insert(warnings.end(), analysis.fit.warnings.begin(), analysis.fit.warnings.end());
  return warnings;
}

}  // namespace

ValidationRow ValidateScene(const ValidationScene& scene, const fs::path& folder) {
  const RenderedPhoto photo = RenderScene(scene.spec);
  const SceneFiles files(photo, scene, folder / ("scene-" + std::to_string(scene.number)));
  ValidationRow row;
  row.number = scene.number;
  row.expected = scene.refuse ? std::string(ReasonCode(*scene.refuse)) : "ok";
  row.theta_deg = scene.spec.theta_rad * 180 / std::numbers::pi;
  try {
    const Analysis analysis = AnalyzeScissors({files.photo()}, SettingsFor(scene, files));
    row.warnings = WarningsOf(analysis);
    row.outcome = row.warnings.empty() ? "ok" : "review";
    row.ms = analysis.photos.front().ms_total + analysis.fit_ms;
    row.errors = CompareWithTruth(analysis, photo.truth);
  } catch (const PhotoRefused& refusal) {
    row.outcome = std::string(ReasonCode(refusal.reason()));
    row.detail = WithoutFolder(refusal.what(), folder);
  }
  return row;
}

}  // namespace bladecurve
