// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "vision/photo/photo_codec.h"

namespace bladecurve {
namespace {

// Rejects decompression bombs: the largest cameras and A3 scans at 1200 dpi stay below.
constexpr double kMaxPixels = 400e6;

// Rounded a * b / 255.
uchar Product(int a, int b) { return static_cast<uchar>((a * b + 127) / 255); }

uchar OverWhite(int value, int alpha) {
  return static_cast<uchar>(255 - Product(255 - value, alpha));
}

cv::Mat GreyOverWhite(const cv::Mat& grey_alpha) {
  cv::Mat grey(grey_alpha.size(), CV_8UC1);
  for (int y = 0; y < grey.rows; ++y) {
    const cv::Vec2b* in = grey_alpha.ptr<cv::Vec2b>(y);
    uchar* out = grey.ptr<uchar>(y);
    for (int x = 0; x < grey.cols; ++x) out[x] = OverWhite(in[x][0], in[x][1]);
  }
  return grey;
}

// Rgb from pixels of four channels by a rule for one pixel.
template <typename Rule>
cv::Mat RgbFromFour(const cv::Mat& four, Rule rule) {
  cv::Mat rgb(four.size(), CV_8UC3);
  for (int y = 0; y < four.rows; ++y) {
    const cv::Vec4b* in = four.ptr<cv::Vec4b>(y);
    cv::Vec3b* out = rgb.ptr<cv::Vec3b>(y);
    for (int x = 0; x < four.cols; ++x) out[x] = rule(in[x]);
  }
  return rgb;
}

cv::Vec3b RgbOverWhite(const cv::Vec4b& p) {
  return {OverWhite(p[0], p[3]), OverWhite(p[1], p[3]), OverWhite(p[2], p[3])};
}

// Adobe writes CMYK with 255 = no ink; then the product of ink and black is the light.
cv::Vec3b RgbFromInvertedCmyk(const cv::Vec4b& p) {
  return {Product(p[0], p[3]), Product(p[1], p[3]), Product(p[2], p[3])};
}

cv::Vec3b RgbFromCmyk(const cv::Vec4b& p) {
  return RgbFromInvertedCmyk({static_cast<uchar>(255 - p[0]),
                              static_cast<uchar>(255 - p[1]),
                              static_cast<uchar>(255 - p[2]),
                              static_cast<uchar>(255 - p[3])});
}

// Grey or RGB without alpha, ink or black.
cv::Mat Flattened(const cv::Mat& stored, PixelLayout layout) {
  switch (layout) {
    case PixelLayout::kGrey:
    case PixelLayout::kRgb:
      return stored;
    case PixelLayout::kGreyAlpha:
      return GreyOverWhite(stored);
    case PixelLayout::kRgba:
      return RgbFromFour(stored, RgbOverWhite);
    case PixelLayout::kCmyk:
      return RgbFromFour(stored, RgbFromCmyk);
    case PixelLayout::kInvertedCmyk:
      return RgbFromFour(stored, RgbFromInvertedCmyk);
  }
  throw std::logic_error("photo: unknown pixel layout");
}

}  // namespace

int ChannelsOf(PixelLayout layout) {
  switch (layout) {
    case PixelLayout::kGrey:
      return 1;
    case PixelLayout::kGreyAlpha:
      return 2;
    case PixelLayout::kRgb:
      return 3;
    default:
      return 4;
  }
}

cv::Mat NewPicture(const cv::Size& size, int type) {
  cv::Mat picture(size, type);
#ifdef MADV_HUGEPAGE
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(picture.datastart);
  const std::uintptr_t first = (begin + page - 1) / page * page;
  const std::uintptr_t last = reinterpret_cast<std::uintptr_t>(picture.dataend) / page * page;
  // A wish only: without large pages the picture is as good.
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
  return picture;
}

cv::Mat ConvertPixels(const cv::Mat& stored, PixelLayout layout, bool colour) {
  const cv::Mat flat = Flattened(stored, layout);
  const bool is_grey = flat.channels() == 1;
  if (is_grey && !colour) return flat;
  cv::Mat converted;
  const int to_colour = is_grey ? cv::COLOR_GRAY2BGR : cv::COLOR_RGB2BGR;
  cv::cvtColor(flat, converted, colour ? to_colour : static_cast<int>(cv::COLOR_RGB2GRAY));
  return converted;
}

void CheckPhotoSize(double width, double height) {
  if (width < 1 || height < 1) throw std::runtime_error("it has no pixels");
  if (width * height > kMaxPixels) {
    throw PhotoTooLarge("it is " + std::to_string(static_cast<long>(width)) + " x " +
                        std::to_string(static_cast<long>(height)) +
                        " pixels, above the limit of 400 million");
  }
}

}  // namespace bladecurve
