// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Makes the photographs in samples/photos, with their truth beside them:
// bladecurve_sample_photographs DIRECTORY
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/degrees.h"
#include "samples/scene_truth.h"
#include "vision/render/render.h"

namespace bladecurve {
namespace {

struct Sample {
  std::string name;
  std::string expect;  // "ok" or "refuse"
  SceneSpec scene;
};

// Loose markers near the corners of a sheet, a little askew, as one lays them by hand.
void LayFourMarkers(double size_mm, double half_width_mm, double half_height_mm, SceneSpec* scene) {
  constexpr double kAskew[] = {0.05, -0.08, 0.11, -0.03};
  for (int i = 0; i < 4; ++i) {
    const double x = (i % 2 == 0 ? -1 : 1) * half_width_mm;
    const double y = (i < 2 ? 1 : -1) * half_height_mm;
    scene->markers.push_back({.id = i,
                              .size_mm = size_mm,
                              .center_mm = Eigen::Vector2d(x, y),
                              .angle_rad = kAskew[i],
                              .margin_mm = 0.2 * size_mm});
  }
}

// A Mayo on white paper, the camera leaning a little.
SceneSpec MayoOnPaper(double theta_deg) {
  SceneSpec scene;
  scene.theta_rad = theta_deg * kRadPerDeg;
  scene.heading_rad = 0.16;
  scene.pivot_mm = {24, 3};
  scene.camera = {.mm_per_px = 0.14,
                  .distance_mm = 430,
                  .tilt_rad = 5 * kRadPerDeg,
                  .tilt_azimuth_rad = 1.1,
                  .k1 = -0.012};
  LayFourMarkers(25, 115, 83, &scene);
  return scene;
}

SceneSpec MetzenbaumOnDrape() {
  SceneSpec scene;
  scene.scissors = {.length_mm = 50,
                    .heel_mm = 6,
                    .inclination = 0.075,
                    .bow_mm = 0.5,
                    .joint_mm = 10,
                    .width_mm = 8,
                    .tip_radius_mm = 1.0,
                    .shank_mm = 4.4,
                    .shank_length_mm = 95,
                    .screw_radius_mm = 2.1,
                    .slot_rad = 2.1,
                    .upper_on_top = false};
  scene.theta_rad = 31 * kRadPerDeg;
  scene.heading_rad = 2.75;
  scene.pivot_mm = {-30, 12};
  scene.edge_height_mm = 2.6;
  scene.camera = {.mm_per_px = 0.15,
                  .distance_mm = 480,
                  .tilt_rad = 9 * kRadPerDeg,
                  .tilt_azimuth_rad = 4.0,
                  .k1 = 0.02};
  scene.backdrop = Backdrop::kDrape;
  scene.light.glint = 0.9;
  scene.seed = 5;
  LayFourMarkers(25, 122, 88, &scene);
  return scene;
}

SceneSpec IrisOnWood() {
  SceneSpec scene;
  scene.scissors = {.length_mm = 31,
                    .heel_mm = 5,
                    .inclination = 0.09,
                    .bow_mm = 0.2,
                    .joint_mm = 7.5,
                    .width_mm = 6.8,
                    .tip_radius_mm = 0.4,
                    .bevel_mm = 1.0,
                    .shank_mm = 3.6,
                    .shank_length_mm = 52,
                    .ring_mm = 21,
                    .screw_radius_mm = 1.7};
  scene.finish = Finish::kGold;
  scene.theta_rad = 38 * kRadPerDeg;
  scene.heading_rad = -1.2;
  scene.pivot_mm = {10, -14};
  scene.camera = {.mm_per_px = 0.10, .distance_mm = 330, .tilt_rad = 3 * kRadPerDeg};
  scene.backdrop = Backdrop::kWood;
  scene.seed = 9;
  LayFourMarkers(18, 82, 58, &scene);
  return scene;
}

std::vector<Sample> Samples() {
  return {{"mayo", "ok", MayoOnPaper(24)},
          {"mayo_wide", "ok", MayoOnPaper(43)},
          {"metzenbaum_drape", "ok", MetzenbaumOnDrape()},
          {"iris_wood", "ok", IrisOnWood()},
          {"mayo_closed", "refuse", MayoOnPaper(-3)}};
}

void WriteFile(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  file.close();
  if (!file)
    throw std::runtime_error("cannot write " + path.string() +
                             "; is the disk full or the folder missing?");
}

void WriteSample(const Sample& sample, const std::filesystem::path& folder) {
  constexpr int kJpegQuality = 92;  // as phones save
  const std::string file = sample.name + ".jpg";
  const RenderedPhoto photo = RenderScene(sample.scene);
  WriteFile(folder / file, EncodeJpeg(photo.bgr, kJpegQuality));
  WriteFile(folder / (sample.name + ".truth.json"),
            SceneTruthJson(photo.truth, file, sample.expect).dump() + "\n");
}

}  // namespace
}  // namespace bladecurve

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: bladecurve_sample_photographs DIRECTORY\n";
    return 2;
  }
  try {
    for (const bladecurve::Sample& sample : bladecurve::Samples())
      bladecurve::WriteSample(sample, argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "bladecurve_sample_photographs: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
