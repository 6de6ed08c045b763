// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene_view.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "process_folder.h"
#include "vision/photo/png_writer.h"

namespace bladecurve {
namespace {

// Whatever the bands in which that is done: 756 rows to 480, 750 to 476, 751 to 477.
TEST(SmallColour, IsMadeOfMeansOverAreas) {
  constexpr int kLongest = 640;
  for (const cv::Size& size : {cv::Size(1008, 756), cv::Size(1008, 750), cv::Size(1009, 751)}) {
    cv::Mat grain(size, CV_8UC3);
    cv::RNG random(1);
    random.fill(grain, cv::RNG::UNIFORM, 0, 256);
    const std::filesystem::path file = ProcessFolder() / "grain.png";
    WritePng(file, grain, {});
    const Photo photo = Photo::Load(file);
    const cv::Mat small = SmallColour({photo, {}, {}}, kLongest).bgr;
    EXPECT_EQ(small.cols, kLongest);
    cv::Mat expected;
    cv::resize(grain, expected, small.size(), 0, 0, cv::INTER_AREA);
    EXPECT_LE(cv::norm(small, expected, cv::NORM_INF), 1) << size;
  }
}

}  // namespace
}  // namespace bladecurve
