// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/validation_run.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "model/degrees.h"
#include "samples/analysis.h"
#include "samples/json_arrays.h"
#include "samples/validation_errors.h"
#include "vision/photo/whole_file.h"
#include "vision/render/render.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

constexpr int kJpegQuality = 95;

void WriteCalibration(const fs::path& path, const SceneTruth& truth, const CameraTruth& camera) {
  const nlohmann::ordered_json calibration = {{"width", truth.width},
                                              {"height", truth.height},
                                              {"K", MatrixJson(camera.k)},
                                              {"dist", {camera.k1, 0, 0, 0}}};
  WriteFileWhole(path, calibration.dump());
}

// Files of one scene; gone when this goes.
class SceneFiles {
 public:
  SceneFiles(const RenderedPhoto& photo, const ValidationScene& scene, const fs::path& stem)
      : photo_(stem.string() + ".jpg"), camera_(stem.string() + ".camera.json") {
    WriteFileWhole(photo_, EncodeJpeg(photo.bgr, kJpegQuality));
    CameraTruth calibrated = photo.truth.camera;
    calibrated.k.diagonal().head<2>() *= 1 + scene.focal_error;
    calibrated.k1 += scene.k1_error;
    WriteCalibration(camera_, photo.truth, calibrated);
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

// What the program is told of a picture's scale and camera.
AnalysisSettings SettingsFor(const SceneTruth& truth,
                             double height_error_mm,
                             const std::optional<fs::path>& camera) {
  AnalysisSettings settings;
  ScaleOptions& scale = settings.measure.scale;
  if (truth.markers.empty()) {
    scale.mm_per_px = truth.mm_per_px;
    return settings;
  }
  scale.marker_mm = truth.markers.front().size_mm;
  scale.plane_height_mm = truth.edge_height_mm + height_error_mm;
  scale.camera = camera;
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

ValidationRow RowFor(std::string scene, std::string expected, const SceneTruth& truth) {
  ValidationRow row;
  row.scene = std::move(scene);
  row.expected = std::move(expected);
  row.theta_deg = truth.theta_rad * kDegPerRad;
  return row;
}

// Completes the row by what the program makes of the photograph.
ValidationRow Compared(ValidationRow row,
                       const fs::path& photo,
                       const AnalysisSettings& settings,
                       const SceneTruth& truth) {
  try {
    const Analysis analysis = AnalyzeScissors({photo}, settings);
    row.warnings = WarningsOf(analysis);
    row.outcome = row.warnings.empty() ? "ok" : "review";
    row.ms = analysis.photos.front().ms_total + analysis.fit_ms;
    row.errors = CompareWithTruth(analysis, truth);
  } catch (const PhotoRefused& refusal) {
    row.outcome = std::string(ReasonCode(refusal.reason()));
    row.detail = WithoutFolder(refusal.what(), photo.parent_path());
  }
  return row;
}

}  // namespace

ValidationRow ValidateScene(const ValidationScene& scene, const fs::path& folder) {
  const RenderedPhoto photo = RenderScene(scene.spec);
  const std::string number = std::to_string(scene.number);
  const SceneFiles files(photo, scene, folder / ("scene-" + number));
  const auto camera = scene.camera_known ? std::optional(files.camera()) : std::nullopt;
  return Compared(
      RowFor(number, scene.refuse ? std::string(ReasonCode(*scene.refuse)) : "ok", photo.truth),
      files.photo(),
      SettingsFor(photo.truth, scene.height_error_mm, camera),
      photo.truth);
}

ValidationRow ValidatePhotograph(const PhotographWithTruth& photograph, const fs::path& folder) {
  const SceneTruth& truth = photograph.truth;
  const std::string name = photograph.photo.stem().string();
  std::optional<fs::path> camera;
  if (photograph.camera_known) {
    camera = folder / (name + ".camera.json");
    WriteCalibration(*camera, truth, truth.camera);
  }
  return Compared(RowFor(name, photograph.to_refuse ? kAnyReason : "ok", truth),
                  photograph.photo,
                  SettingsFor(truth, 0, camera),
                  truth);
}

}  // namespace bladecurve
