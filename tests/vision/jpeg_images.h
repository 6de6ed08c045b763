// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <opencv2/core.hpp>
#include <string>
// jpeglib.h needs FILE and size_t declared before it.
#include <jpeglib.h>

namespace bladecurve {

struct JpegSettings {
  J_COLOR_SPACE space = JCS_GRAYSCALE;
  int channels = 1;
  int density = 0;  // dots per inch
  std::string exif = {};
  cv::Size luma_per_chroma = {2, 2};  // of colour pictures
  bool progressive = false;
  int quality = 98;
  bool own_tables = false;  // of Huffman codes, instead of the standard's
  int restart_rows = 0;     // of MCUs between restart markers; 0: none
};

// picture: the channels as settings.space has them, or one, whose value every channel gets.
[[nodiscard]] std::string Jpeg(const cv::Mat& picture, const JpegSettings& settings);

}  // namespace bladecurve
