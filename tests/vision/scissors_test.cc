// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/scissors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "path_distance.h"
#include "process_folder.h"
#include "vision/measure.h"
#include "vision/photo/photo.h"
#include "vision/photo/png_writer.h"
#include "vision/refused.h"
#include "vision/render/render.h"
#include "vision/render/synthetic_scene.h"

namespace bladecurve {
namespace {

PhotoMeasurement MeasureRendered(const SceneSpec& spec) {
  MeasureOptions options;
  options.scale.mm_per_px = spec.camera.mm_per_px;
  const std::filesystem::path file = ProcessFolder() / "picture.png";
  WritePng(file, RenderScene(spec).bgr);
  return MeasurePhoto(file, options);
}

// In direct sun the likeliest mask may follow a shadow's border.
TEST(LocateScissors, MeasuresInAnotherMaskWhatTheLikeliestWasRefusedFor) {
  const SceneSpec spec = RandomScene(10, Difficulty::kSun);
  const PhotoMeasurement result = MeasureRendered(spec);
  EXPECT_TRUE(std::any_of(result.plan.begin(), result.plan.end(), [](const StageRecord& record) {
    return record.stage == "scene-again" && record.ran && !record.why.empty();
  }));
  EXPECT_EQ(std::count(result.warnings.begin(), result.warnings.end(), "scene_doubtful"), 1);
  EXPECT_LT((result.pivot_px - TruthOf(spec).pivot_px).norm(), 3 * result.pivot_sigma_px);
}

// Direct sun: steel, brighter than its ground, casts hard shadows as plain as the blades.
TEST(LocateScissors, TellsBladesFromTheHardShadowsThatTheyCast) {
  constexpr double kClosePx = 1;
  for (const std::uint64_t seed : {4004012046, 4004012059}) {
    const SceneSpec spec = RandomScene(seed, Difficulty::kSun);
    const PhotoMeasurement result = MeasureRendered(spec);
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(RmsToPath(result.upper_edge_px, truth.upper.px), kClosePx) << seed;
    EXPECT_LT(RmsToPath(result.lower_edge_px, truth.lower.px), kClosePx) << seed;
  }
}

// Seen at a slant, right edges differ, and where the one would mirror the other the ground has
// faint lines.
TEST(LocateScissors, LeavesNoClearEdgeForAFarVaguerLineWithoutMarkers) {
  constexpr double kClosePx = 0.5;
  SceneSpec spec = RandomScene(5349, Difficulty::kHard);
  spec.markers.clear();
  const PhotoMeasurement result = MeasureRendered(spec);
  const SceneTruth truth = TruthOf(spec);
  EXPECT_LT(RmsToPath(result.upper_edge_px, truth.upper.px), kClosePx);
  EXPECT_LT(RmsToPath(result.lower_edge_px, truth.lower.px), kClosePx);
}

// Jaws, however they are looked at.
TEST(LocateScissors, GivesUpAfterTheLastLookForTheFirstReason) {
  SceneSpec spec;
  spec.width = 1000;
  spec.height = 750;
  spec.camera.mm_per_px = 0.25;
  spec.scissors.inclination = spec.scissors.bow_mm = 0;
  const std::filesystem::path file = ProcessFolder() / "jaws.png";
  WritePng(file, RenderScene(spec).bgr);
  const Photo photo = Photo::Load(file);
  ScaleOptions options;
  options.mm_per_px = spec.camera.mm_per_px;
  const ScaleResult scale = FindScale(photo, options);
  StageLog log;
  SceneFinder finder(photo, scale.markers, {}, &log);
  try {
    (void)LocateScissors({photo, scale, {}}, &finder, &log);
    ADD_FAILURE() << "measured jaws";
  } catch (const Refused& refused) {
    EXPECT_EQ(refused.reason(), Reason::kNotScissors);
  }
  std::vector<std::string> refusals;
  for (const StageRecord& record : log.records())
    if (record.stage == "scene-again") refusals.push_back(record.why);
  ASSERT_EQ(refusals.size(), SceneFinder::kLooks - 1);
  EXPECT_NE(refusals.front().find("jaws"), std::string::npos) << refusals.front();
}

}  // namespace
}  // namespace bladecurve
