// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "tests/samples/picture_files.h"

#include <cstdio>
// libjpeg needs <cstdio> before it.
#include <jpeglib.h>
#include <png.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "tests/vision/jpeg_images.h"

namespace bladecurve {
namespace {

J_COLOR_SPACE ColourSpace(int channels) {
  if (channels == 1) return JCS_GRAYSCALE;
  return channels == 3 ? JCS_RGB : JCS_CMYK;
}

cv::Mat AsStoredInJpeg(const cv::Mat& picture) {
  cv::Mat stored = picture.clone();
  if (picture.channels() == 3) cv::cvtColor(picture, stored, cv::COLOR_BGR2RGB);
  if (picture.channels() == 4) cv::bitwise_not(picture, stored);
  return stored;
}

void AppendToString(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(data), size);
}

int ColourType(PngKind kind) {
  switch (kind) {
    case PngKind::kGrey8:
    case PngKind::kGrey16:
      return PNG_COLOR_TYPE_GRAY;
    case PngKind::kRgb8:
    case PngKind::kRgb16:
      return PNG_COLOR_TYPE_RGB;
    case PngKind::kRgba8:
      return PNG_COLOR_TYPE_RGBA;
    case PngKind::kGreyAlpha8:
      return PNG_COLOR_TYPE_GRAY_ALPHA;
    case PngKind::kPalette:
      return PNG_COLOR_TYPE_PALETTE;
  }
  throw std::invalid_argument("unknown kind of PNG");
}

// Six levels a channel, as old web palettes have them.
std::vector<png_color> PaletteColours() {
  std::vector<png_color> colours;
  for (int i = 0; i < 216; ++i) {
    const auto level = [](int step) { return static_cast<png_byte>(51 * step); };
    colours.push_back({level(i / 36), level(i / 6 % 6), level(i % 6)});
  }
  return colours;
}

cv::Mat PaletteIndices(const cv::Mat& bgr) {
  cv::Mat1b indices(bgr.size());
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x) {
      const cv::Vec3b& pixel = bgr.at<cv::Vec3b>(y, x);
      const auto step = [](int value) { return (value + 25) / 51; };
      indices(y, x) = static_cast<uchar>(36 * step(pixel[2]) + 6 * step(pixel[1]) + step(pixel[0]));
    }
  }
  return indices;
}

cv::Mat GreyWithAlpha(const cv::Mat& grey) {
  cv::Mat both;
  const std::vector<cv::Mat> channels = {grey, cv::Mat(grey.size(), CV_8U, cv::Scalar(255))};
  cv::merge(channels, both);
  return both;
}

// 0..255 spread over 0..65535, big endian as PNG wants it.
cv::Mat SixteenBit(const cv::Mat& picture) {
  cv::Mat wide;
  picture.convertTo(wide, CV_16U, 257);  // both bytes are alike: byte order does not matter
  return wide;
}

cv::Mat RowsOf(const cv::Mat& bgr, PngKind kind) {
  cv::Mat grey, rgb;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  switch (kind) {
    case PngKind::kGrey8:
      return grey;
    case PngKind::kGrey16:
      return SixteenBit(grey);
    case PngKind::kRgb8:
      return rgb;
    case PngKind::kRgb16:
      return SixteenBit(rgb);
    case PngKind::kRgba8:
      cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGBA);
      return rgb;
    case PngKind::kGreyAlpha8:
      return GreyWithAlpha(grey);
    case PngKind::kPalette:
      return PaletteIndices(bgr);
  }
  throw std::invalid_argument("unknown kind of PNG");
}

}  // namespace

std::string JpegFile(const cv::Mat& picture) {
  const int channels = picture.channels();
  return Jpeg(AsStoredInJpeg(picture),
              {.space = ColourSpace(channels), .channels = channels, .quality = 95});
}

std::string WithOrientation(const std::string& jpeg, int orientation) {
  // APP1: "Exif", a big-endian TIFF header, one directory with one entry: tag 0x0112, one short.
  static constexpr char kHead[] =
      "\xff\xe1\0\0"
      "Exif\0\0"
      "MM\0\x2a\0\0\0\x08"
      "\0\x01"
      "\x01\x12\0\x03\0\0\0\x01\0";
  std::string entry(kHead, sizeof kHead - 1);
  entry += static_cast<char>(orientation);
  entry.append(6, '\0');                           // rest of the value; no further directory
  entry[3] = static_cast<char>(entry.size() - 2);  // the length leaves out the marker
  return jpeg.substr(0, 2) + entry + jpeg.substr(2);
}

cv::Mat StoredFor(const cv::Mat& shown, int orientation) {
  cv::Mat stored = shown.clone();
  switch (orientation) {
    case 2:
      cv::flip(shown, stored, 1);
      break;
    case 3:
      cv::rotate(shown, stored, cv::ROTATE_180);
      break;
    case 4:
      cv::flip(shown, stored, 0);
      break;
    case 5:
      cv::transpose(shown, stored);
      break;
    case 6:
      cv::rotate(shown, stored, cv::ROTATE_90_COUNTERCLOCKWISE);
      break;
    case 7: {
      cv::Mat turned;
      cv::rotate(shown, turned, cv::ROTATE_180);
      cv::transpose(turned, stored);
      break;
    }
    case 8:
      cv::rotate(shown, stored, cv::ROTATE_90_CLOCKWISE);
      break;
    default:
      break;
  }
  return stored;
}

std::string PngFile(const cv::Mat& bgr, PngKind kind) {
  cv::Mat rows = RowsOf(bgr, kind);
  const bool wide = kind == PngKind::kGrey16 || kind == PngKind::kRgb16;
  std::string file;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &file, AppendToString, nullptr);
  png_set_IHDR(png,
               info,
               static_cast<png_uint_32>(rows.cols),
               static_cast<png_uint_32>(rows.rows),
               wide ? 16 : 8,
               ColourType(kind),
               PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  const std::vector<png_color> palette = PaletteColours();
  if (kind == PngKind::kPalette)
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  png_write_info(png, info);
  for (int y = 0; y < rows.rows; ++y) png_write_row(png, rows.ptr(y));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return file;
}

}  // namespace bladecurve
