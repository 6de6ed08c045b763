// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/photo/jpeg_lower_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "jpeg_images.h"
#include "vision/photo/photo_codec.h"

namespace bladecurve {
namespace {

struct Part {
  std::optional<std::string> file;
  int mcu_rows = 0;  // of pixels
};

Part LowerPart(const std::string& jpeg, int first_mcu_row) {
  jpeg_decompress_struct info = {};
  jpeg_error_mgr errors;
  info.err = jpeg_std_error(&errors);
  jpeg_create_decompress(&info);
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(jpeg.data()), jpeg.size());
  jpeg_read_header(&info, TRUE);
  jpeg_start_decompress(&info);
  Part part{LowerPartOfJpeg(jpeg, info, first_mcu_row), McuRowHeight(info)};
  jpeg_destroy_decompress(&info);
  return part;
}

cv::Mat Decoded(const std::string& jpeg) {
  return DecodeJpeg(jpeg, {.colour = true, .num_threads = 1}).picture.pixels;
}

// Flat above, and more and more noise below: the shortest codes and the longest.
cv::Mat Picture(unsigned seed) {
  cv::Mat picture(301, 413, CV_8UC1);
  cv::RNG random(seed);
  for (int y = 0; y < picture.rows; ++y) {
    const int amplitude = std::max(0, y - 48) / 2;
    for (int x = 0; x < picture.cols; ++x) {
      const int noise = amplitude > 0 ? random.uniform(-amplitude, amplitude) : 0;
      picture.at<uchar>(y, x) = cv::saturate_cast<uchar>(std::min(x, 200) + noise);
    }
  }
  return picture;
}

// The rows that the part and the whole share, but for the uppermost: its colours reach above.
void ExpectTheSameRows(const std::string& jpeg, int first_mcu_row) {
  const Part part = LowerPart(jpeg, first_mcu_row);
  ASSERT_TRUE(part.file.has_value());
  const cv::Mat whole = Decoded(jpeg), lower = Decoded(*part.file);
  const int first = first_mcu_row * part.mcu_rows;
  ASSERT_EQ(lower.rows, whole.rows - first + part.mcu_rows);
  const cv::Mat expected = whole.rowRange(first + part.mcu_rows, whole.rows);
  const cv::Mat rows = lower.rowRange(2 * part.mcu_rows, lower.rows);
  EXPECT_EQ(cv::norm(rows, expected, cv::NORM_INF), 0);
}

TEST(LowerPartOfJpeg, DecodesAsTheWholeDoes) {
  const std::vector<cv::Size> samplings = {{1, 1}, {2, 1}, {1, 2}, {2, 2}, {4, 1}};
  for (const cv::Size& luma_per_chroma : samplings) {
    for (const int quality : {30, 75, 92, 100}) {
      for (const bool own_tables : {false, true}) {
        const std::string jpeg = Jpeg(Picture(static_cast<unsigned>(quality)),
                                      {.space = JCS_YCbCr,
                                       .channels = 3,
                                       .luma_per_chroma = luma_per_chroma,
                                       .quality = quality,
                                       .own_tables = own_tables});
        for (int row = 1; row <= 16; row += 3) {
          SCOPED_TRACE(testing::Message() << luma_per_chroma << " quality " << quality << " own "
                                          << own_tables << " row " << row);
          ExpectTheSameRows(jpeg, row);
        }
      }
    }
  }
}

TEST(LowerPartOfJpeg, DecodesAsTheWholeDoesWithoutColour) {
  for (const int quality : {30, 100}) {
    const std::string jpeg = Jpeg(Picture(1), {.quality = quality, .own_tables = true});
    for (int row = 1; row <= 36; ++row) ExpectTheSameRows(jpeg, row);
  }
}

// Whatever the bit at which the part's codes begin.
TEST(LowerPartOfJpeg, GoesOnForEverySeed) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const int quality = 20 + static_cast<int>(seed % 80);
    ExpectTheSameRows(Jpeg(Picture(seed), {.quality = 97}), 20);
    ExpectTheSameRows(Jpeg(Picture(seed), {.quality = quality, .own_tables = true}), 20);
  }
}

// Tables of which the shortest codes that lengthen a row by an odd number of bits skip
// coefficients.
TEST(LowerPartOfJpeg, FindsCodesThatFitInAnyTable) {
  cv::RNG random(1);
  for (int quality = 30; quality < 80; quality += 5) {
    SCOPED_TRACE(quality);
    cv::Mat picture(301, 413, CV_8UC1);
    random.fill(picture, cv::RNG::NORMAL, 128, 2);
    const std::string jpeg = Jpeg(picture, {.quality = quality, .own_tables = true});
    for (int row = 1; row <= 36; ++row) ExpectTheSameRows(jpeg, row);
  }
}

TEST(LowerPartOfJpeg, IsNothingWhereCodesAreOfAnotherKind) {
  const JpegSettings settings = {.space = JCS_YCbCr, .channels = 3};
  JpegSettings progressive = settings, restarted = settings;
  progressive.progressive = true;
  restarted.restart_rows = 2;
  EXPECT_TRUE(LowerPart(Jpeg(Picture(1), settings), 9).file.has_value());
  EXPECT_FALSE(LowerPart(Jpeg(Picture(1), progressive), 9).file.has_value());
  EXPECT_FALSE(LowerPart(Jpeg(Picture(1), restarted), 9).file.has_value());
}

TEST(LowerPartOfJpeg, IsNothingWhereTheFileEndsBefore) {
  const std::string jpeg = Jpeg(Picture(1), {});
  const std::string cut = jpeg.substr(0, jpeg.size() / 2);
  EXPECT_FALSE(LowerPart(cut, 36).file.has_value());
  EXPECT_FALSE(LowerPart(cut + "\xff\xd9", 36).file.has_value());
}

}  // namespace
}  // namespace bladecurve
