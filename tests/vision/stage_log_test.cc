// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/stage_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "process_folder.h"

namespace bladecurve {
namespace {

using std::chrono::milliseconds;

TEST(StageLog, DrawingPicturesIsNoStagesTime) {
  constexpr milliseconds kWork{20}, kDrawing{400};
  const std::filesystem::path folder = ProcessFolder() / "stages";
  StageLog log(folder);
  std::this_thread::sleep_for(kWork);
  log.Picture("edges", [&] {
    std::this_thread::sleep_for(kDrawing);
    return cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(0));
  });
  log.Ran("edges", "they are wanted");
  EXPECT_TRUE(std::filesystem::exists(folder / "01_edges.png"));
  ASSERT_EQ(log.records().size(), 1U);
  EXPECT_GE(log.records()[0].ms, kWork.count());
  EXPECT_LT(log.records()[0].ms, kDrawing.count());
  EXPECT_DOUBLE_EQ(log.total_ms(), log.records()[0].ms);
}

TEST(StageLog, DrawsNothingThatIsNotAskedFor) {
  StageLog log;
  log.Picture("edges", []() -> cv::Mat { throw std::logic_error("drawn"); });
  EXPECT_TRUE(log.records().empty());
}

}  // namespace
}  // namespace bladecurve
