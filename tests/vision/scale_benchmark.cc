// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Error of a marker's corners beside the information limit, and the time of it: one line a case.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <random>
#include <utility>

#include "process_folder.h"
#include "stopwatch.h"
#include "vision/card_scene.h"
#include "vision/corner_bound.h"
#include "vision/photo/png_writer.h"
#include "vision/scale/marker_corners.h"
#include "vision/scale/scale.h"
#include "vision/square_images.h"
#include "vision/tone_scene.h"

namespace bladecurve {
namespace {

struct Outcome {
  double rms_px = 0, bias_px = 0, stated_px = 0, ms = 0;
};

Outcome Run(SquareImage image, int draws) {
  std::mt19937 random(17);
  const ToneCurve tone = LinearToneCurve();
  Outcome outcome;
  for (int i = 0; i < draws; ++i) {
    image.angle_rad = Uniform(&random, -0.7, 0.7);
    image.centre_px = {0.5 * image.width + Uniform(&random, -1, 1),
                       0.5 * image.height + Uniform(&random, -1, 1)};
    const cv::Mat grey = Draw(image, &random);
    RoughMarker rough{*image.marker, Corners(image)};
    for (Eigen::Vector2d& corner : rough.corners_px) {
      corner += Eigen::Vector2d(Uniform(&random, -1, 1), Uniform(&random, -1, 1));
    }
    const Stopwatch stopwatch;
    const SeenMarker marker = LocateMarkerCorners(grey, tone, rough, {2, std::nullopt});
    outcome.ms += stopwatch.Milliseconds() / draws;
    outcome.stated_px += marker.corner_sigma_px / draws;
    for (size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d error = marker.corners_px[k] - Corners(image)[k];
      outcome.rms_px += error.squaredNorm() / (8 * draws);
      outcome.bias_px +=
          error.dot((Corners(image)[k] - image.centre_px).normalized()) / (4 * draws);
    }
  }
  outcome.rms_px = std::sqrt(outcome.rms_px);
  return outcome;
}

// Lengths of 100 mm measured on rendered photographs of scissors on the card: on the sheet with
// focal length and lens from the card's surplus corners alone; 2 mm above it so, too, which a
// camera that looks straight down cannot, and with its calibration.
void PrintHundredMillimetres() {
  std::printf("\n100 mm on the card under scissors, largest of four errors\n");
  std::printf("tilt_deg  on_sheet_mm  2_mm_above_mm  2_mm_above_calibrated_mm     ms\n");
  const std::filesystem::path picture = ProcessFolder() / "scale.png";
  for (const double tilt_deg : {0.0, 10.0, 20.0}) {
    const RenderedPhoto rendered =
        RenderScene(OnCard(BuiltInCard(Paper::kA4), tilt_deg * std::numbers::pi / 180));
    WritePng(picture, rendered.bgr);
    const Photo photo = Photo::Load(picture);
    ScaleOptions options;
    options.plane_height_mm = 0;
    const Stopwatch stopwatch;
    const ScaleResult on_sheet = FindScale(photo, options);
    const double on_sheet_ms = stopwatch.Milliseconds();
    options.plane_height_mm = 2;
    const ScaleResult above = FindScale(photo, options);
    options.camera = SaveCalibration(rendered.truth, ProcessFolder() / "camera.json");
    const ScaleResult calibrated = FindScale(photo, options);
    std::printf("%8.0f %12.4f %14.4f %25.4f %6.1f\n",
                tilt_deg,
                WorstOf100Mm(*on_sheet.map, rendered.truth.camera, 0),
                WorstOf100Mm(*above.map, rendered.truth.camera, 2),
                WorstOf100Mm(*calibrated.map, rendered.truth.camera, 2),
                on_sheet_ms);
  }
}

// Edges beside a card, encoded with a power law: with the tone curve taken for sRGB, and as the
// card's borders show it.
void PrintToneCurves() {
  std::printf(
      "\nEdges of blur 1, noise 1, encoded with a power law: taken for sRGB, and by a card\n");
  std::printf("gamma  exponent_sigma  blade  ground     sRGB_px     card_px\n");
  for (const double gamma : {1.8, 2.0, 2.2, 2.4, 2.6}) {
    const ToneCurve tone = testing::ToneByCard({.srgb = false, .gamma = gamma});
    for (const auto& [blade, ground] :
         {std::pair(120.0, 200.0), std::pair(20.0, 200.0), std::pair(200.0, 40.0)}) {
      const testing::EdgeLook look{1, blade, ground, 1, gamma};
      std::printf("%5.1f %15.3f %6.0f %7.0f %+11.4f %+11.4f\n",
                  gamma,
                  tone.exponent_sigma,
                  blade,
                  ground,
                  testing::OffsetOfEdge(look, SrgbToneCurve()),
                  testing::OffsetOfEdge(look, tone));
    }
  }
}

}  // namespace
}  // namespace bladecurve

int main() {
  using namespace bladecurve;
  std::printf(
      "side_px blur_px noise   rms_px  bound_px  ratio  outward_bias_px  stated_px     ms\n");
  for (const double side : {60.0, 150.0, 300.0}) {
    for (const double blur : {0.6, 0.8, 1.0, 1.5}) {
      SquareImage image;
      image.side_px = side;
      image.marker = 7;
      image.blur_px = blur;
      image.width = image.height = static_cast<int>(1.5 * side) + 40;
      image.centre_px = Eigen::Vector2d::Constant(image.width / 2);
      const Outcome outcome = Run(image, 60);
      const double bound = CornerBound(image);
      std::printf("%7.0f %7.1f %5.1f %8.4f %9.4f %6.2f %16.4f %10.4f %6.2f\n",
                  side,
                  blur,
                  image.noise,
                  outcome.rms_px,
                  bound,
                  outcome.rms_px / bound,
                  outcome.bias_px,
                  outcome.stated_px,
                  outcome.ms);
    }
  }
  PrintHundredMillimetres();
  PrintToneCurves();
  return 0;
}
