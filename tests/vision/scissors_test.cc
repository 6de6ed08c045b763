// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "process_folder.h"
#include "small_scene.h"
#include "vision/measure.h"
#include "vision/png_writer.h"
#include "vision/refused.h"
#include "vision/render.h"
#include "vision/synthetic_scene.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

fs::path Written(const SceneSpec& spec) {
  fs::path file = ProcessFolder() / "scissors.png";
  WritePng(file, RenderScene(spec).bgr);
  return file;
}

TEST(SceneFinder, ShowsTheSameScissorsInAnotherMask) {
  const Photo photo = Photo::Load(Written(SmallScene()));
  StageLog log;
  SceneFinder finder(photo, {}, {}, &log);
  const Scene likeliest = finder.Likeliest();
  finder.LookAgain();
  const Scene again = finder.Likeliest();
  EXPECT_FALSE(likeliest.IsDoubtful());
  EXPECT_TRUE(again.second_look && again.IsDoubtful());
  EXPECT_EQ(again.warnings, std::vector<std::string>{"scene_doubtful"});
  const double near_px = 0.2 * (likeliest.left.tip_px - likeliest.pivot_px).norm();
  EXPECT_LT((again.pivot_px - likeliest.pivot_px).norm(), near_px);
  EXPECT_LT((again.left.tip_px - likeliest.left.tip_px).norm(), near_px);
  EXPECT_LT((again.right.tip_px - likeliest.right.tip_px).norm(), near_px);
}

TEST(SceneFinder, LooksUntilNoMaskIsLeft) {
  const Photo photo = Photo::Load(Written(SmallScene()));
  StageLog log;
  SceneFinder finder(photo, {}, {}, &log);
  constexpr int kMoreThanThereAre = 1000;
  EXPECT_THROW(
      {
        for (int look = 0; look < kMoreThanThereAre; ++look) finder.LookAgain();
      },
      Refused);
}

// In direct sun the likeliest mask may follow a shadow's border.
TEST(LocateScissors, MeasuresInAnotherMaskWhatTheLikeliestWasRefusedFor) {
  const SceneSpec spec = RandomScene(222, Difficulty::kSun);
  MeasureOptions options;
  options.scale.mm_per_px = spec.camera.mm_per_px;
  const PhotoMeasurement result = MeasurePhoto(Written(spec), options);
  EXPECT_TRUE(std::any_of(result.plan.begin(), result.plan.end(), [](const StageRecord& record) {
    return record.stage == "scene-again" && record.ran && !record.why.empty();
  }));
  EXPECT_EQ(std::count(result.warnings.begin(), result.warnings.end(), "scene_doubtful"), 1);
  EXPECT_LT((result.pivot_px - TruthOf(spec).pivot_px).norm(), 3 * result.pivot_sigma_px);
}

}  // namespace
}  // namespace bladecurve
