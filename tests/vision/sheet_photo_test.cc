// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Scale from rendered photographs of sheets with markers, some of them under the scissors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "process_folder.h"
#include "tests/degree.h"
#include "vision/card_scene.h"
#include "vision/photo/png_writer.h"
#include "vision/render/render.h"
#include "vision/scale/card.h"
#include "vision/scale/scale.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;

Photo Save(const RenderedPhoto& photo, const std::string& name) {
  const fs::path path = ProcessFolder() / name;
  WritePng(path, photo.bgr);
  return Photo::Load(path);
}

bool Warns(const ScaleResult& result, const std::string& code) {
  const std::vector<std::string>& warnings = result.map->warnings();
  return std::find(warnings.begin(), warnings.end(), code) != warnings.end();
}

struct CardPhoto {
  Photo photo;
  SceneTruth truth;
  fs::path calibration;
};

CardPhoto Photographed(const SceneSpec& scene, const std::string& name) {
  const RenderedPhoto rendered = RenderScene(scene);
  return {Save(rendered, name + ".png"),
          rendered.truth,
          SaveCalibration(rendered.truth, ProcessFolder() / (name + ".camera.json"))};
}

// Rendered once for all tests.
const CardPhoto& CardSquarely() {
  static const CardPhoto photo = Photographed(OnCard(BuiltInCard(Paper::kA4), 0), "square");
  return photo;
}
const CardPhoto& CardTilted() {
  static const CardPhoto photo =
      Photographed(OnCard(BuiltInCard(Paper::kA4), 20 * kDegree), "tilted");
  return photo;
}

// The scissors cover some of the markers; a lens that bends and a tilt of 20 degrees.
TEST(FindScale, MeasuresAHundredMillimetresOnATiltedCardUnderScissors) {
  constexpr double kOnTheSheetMm = 0.02, kAboveItMm = 0.05;
  for (const CardPhoto* photo : {&CardSquarely(), &CardTilted()}) {
    const CardPhoto& seen = *photo;
    ScaleOptions options;
    options.camera = seen.calibration;
    options.plane_height_mm = 0;
    const ScaleResult on_sheet = FindScale(seen.photo, options);
    EXPECT_LT(on_sheet.markers.size(), seen.truth.markers.size()) << "the scissors cover none";
    EXPECT_LE(WorstOf100Mm(*on_sheet.map, seen.truth.camera, 0), kOnTheSheetMm);
    options.plane_height_mm = 2;
    const ScaleResult above = FindScale(seen.photo, options);
    EXPECT_LE(WorstOf100Mm(*above.map, seen.truth.camera, 2), kAboveItMm);
    EXPECT_GT(WorstOf100Mm(*on_sheet.map, seen.truth.camera, 2), 0.3) << "height matters";
  }
}

TEST(FindScale, SaysThatTheHeightOfTheBladesIsNotKnown) {
  const CardPhoto& seen = CardSquarely();
  ScaleOptions options;
  options.camera = seen.calibration;
  const ScaleResult unknown = FindScale(seen.photo, options);
  options.plane_height_mm = 2;
  const ScaleResult known = FindScale(seen.photo, options);
  EXPECT_TRUE(Warns(unknown, "plane_height_unknown"));
  EXPECT_FALSE(Warns(known, "plane_height_unknown"));
  // Blades lie up to 3.5 mm above the sheet, here seen from 420 mm: the 95 % interval holds them.
  for (const double height_mm : {0.5, 2.0, 3.5}) {
    EXPECT_LT(height_mm / (420 - height_mm), 1.96 * unknown.map->relative_sigma()) << height_mm;
  }
  EXPECT_LT(known.map->relative_sigma(), 0.2 * unknown.map->relative_sigma());
}

TEST(FindScale, WarnsWhereFourCornersAreAllThereIs) {
  SceneSpec scene = OnCard(BuiltInCard(Paper::kA4), 0);
  scene.markers.resize(1);
  const CardPhoto seen = Photographed(scene, "four-corners");
  ScaleOptions options;
  options.marker_mm = scene.markers.front().size_mm;
  EXPECT_TRUE(Warns(FindScale(seen.photo, options), "scale_four_corners"));
}

TEST(FindScale, WarnsOfACameraTooNear) {
  SceneSpec scene = OnCard(BuiltInCard(Paper::kA4), 0);
  scene.camera.distance_mm = 230;
  const CardPhoto seen = Photographed(scene, "near");
  ScaleOptions options;
  options.camera = seen.calibration;
  EXPECT_TRUE(Warns(FindScale(seen.photo, options), "camera_near"));
  options.camera = CardSquarely().calibration;  // 420 mm
  EXPECT_FALSE(Warns(FindScale(CardSquarely().photo, options), "camera_near"));
}

TEST(FindScale, NeedsALeaningCameraToTellHowFarAwayItIs) {
  const double leaning_rad = 10 * kDegree;
  const CardPhoto leaning = Photographed(OnCard(BuiltInCard(Paper::kA4), leaning_rad), "leaning");
  ScaleOptions options;
  options.plane_height_mm = 2;
  const ScaleResult from_above = FindScale(CardSquarely().photo, options);
  const ScaleResult by_perspective = FindScale(leaning.photo, options);
  EXPECT_TRUE(Warns(from_above, "camera_unknown"));
  EXPECT_FALSE(Warns(by_perspective, "camera_unknown"));
  constexpr double kMostMm = 0.01;
  EXPECT_LT(WorstOf100Mm(*by_perspective.map, leaning.truth.camera, 2), kMostMm);
  EXPECT_GT(WorstOf100Mm(*from_above.map, CardSquarely().truth.camera, 2), kMostMm);
}

// Paper that is not flat moves markers by a fraction of a millimetre each.
TEST(FindScale, WarnsOfABentSheetAndWidensTheUncertainty) {
  SceneSpec scene = OnCard(BuiltInCard(Paper::kA4), 0);
  const CardPhoto& flat = CardSquarely();
  std::mt19937 random(7);
  for (MarkerSpec& marker : scene.markers) {
    const auto off = [&] { return 0.3 * (static_cast<double>(random()) * 0x1p-31 - 1); };
    marker.center_mm += Vector2d(off(), off());
  }
  const CardPhoto bent = Photographed(scene, "bent");
  ScaleOptions options;
  options.camera = flat.calibration;
  options.plane_height_mm = 0;
  const ScaleResult of_flat = FindScale(flat.photo, options);
  const ScaleResult of_bent = FindScale(bent.photo, options);
  EXPECT_FALSE(Warns(of_flat, "sheet_bent"));
  EXPECT_TRUE(Warns(of_bent, "sheet_bent"));
  EXPECT_GT(of_bent.map->relative_sigma(), 1.1 * of_flat.map->relative_sigma());
}

// The head of a screw h above the plane of the edges is seen beside the place below it.
TEST(FootOf, FindsThePlaceBelowARaisedPoint) {
  const CardPhoto& seen = CardTilted();
  ScaleOptions options;
  options.camera = seen.calibration;
  const ScaleResult result = FindScale(seen.photo, options);
  ASSERT_TRUE(result.sheet.has_value());
  const Vector2d head_px = ImageOf(seen.truth.camera, {20, 10, 4});
  const Vector2d foot_px = ImageOf(seen.truth.camera, {20, 10, 2});
  ASSERT_GT((head_px - foot_px).norm(), 2);
  const PlacePx foot = FootOf(*result.sheet, {head_px, 2, 2, 0.5});
  EXPECT_LT((foot.point_px - foot_px).norm(), 0.02);
  // A quarter of the height uncertain: a quarter of the way.
  EXPECT_NEAR(std::sqrt(foot.covariance_px2.trace()), 0.25 * (head_px - foot_px).norm(), 0.05);
}

}  // namespace
}  // namespace bladecurve
