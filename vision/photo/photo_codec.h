// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "vision/image/picture_part.h"

namespace bladecurve {

struct DecodeOptions {
  bool colour = false;  // CV_8UC3 BGR instead of CV_8UC1 luma
  int long_side =
      0;  // a codec may decode smaller as long as the longest side keeps this; 0: full size
  int num_threads = 1;  // a codec may use as many; the pixels are the same
  cv::Rect part = {};   // of the full size, all that is wanted; empty: everything
};

// What a file says beside its pixels, as far as its container knows.
struct FileFacts {
  int orientation = 1;  // EXIF 1 to 8
  std::optional<double>
      dpi;  // of the container (JFIF, pHYs, TIFF tags), if in a physical unit and square
  bool exposure_tags = false;  // the container itself names an exposure: taken by a camera
  std::string exif;            // TIFF structure of the EXIF block, without "Exif\0\0"; may be empty
};

struct DecodedPhoto {
  PicturePart picture;  // as asked for by DecodeOptions, stored orientation; a codec may give more
  int stored_width = 0, stored_height = 0;
  FileFacts facts;
};

// Each decodes a whole file held in memory. Alpha is laid over white, 16 bits are rounded to 8.
// They throw std::runtime_error with the cause alone ("premature end of JPEG data").
[[nodiscard]] DecodedPhoto DecodeJpeg(std::string_view bytes, const DecodeOptions& options);
[[nodiscard]] DecodedPhoto DecodePng(std::string_view bytes, const DecodeOptions& options);
[[nodiscard]] DecodedPhoto DecodeTiff(std::string_view bytes, const DecodeOptions& options);
[[nodiscard]] DecodedPhoto DecodeHeic(std::string_view bytes, const DecodeOptions& options);

// How a codec's pixels are laid out, 8 bits each.
enum class PixelLayout { kGrey, kGreyAlpha, kRgb, kRgba, kCmyk, kInvertedCmyk };
[[nodiscard]] int ChannelsOf(PixelLayout layout);

// A picture whose pixels are not set yet, in large pages of memory where the system has them: the
// first touch of 12 megapixels in pages of 4 KiB costs a tenth of decoding them.
[[nodiscard]] cv::Mat NewPicture(const cv::Size& size, int type);

// BT.601 luma (what JPEG stores) or BGR; grey stays the same buffer.
[[nodiscard]] cv::Mat ConvertPixels(const cv::Mat& stored, PixelLayout layout, bool colour);

struct PhotoTooLarge : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws std::runtime_error for pictures without pixels, and PhotoTooLarge for decompression bombs.
void CheckPhotoSize(double width, double height);

}  // namespace bladecurve
