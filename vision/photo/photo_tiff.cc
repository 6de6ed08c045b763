// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "vision/photo/photo_codec.h"

namespace bladecurve {
namespace {

// A file in memory, as libtiff's callbacks see it.
struct MemoryFile {
  std::string_view bytes;
  size_t position = 0;
  std::string message;  // the first error
};

MemoryFile& FileOf(thandle_t handle) { return *static_cast<MemoryFile*>(handle); }

tmsize_t Read(thandle_t handle, void* out, tmsize_t size) {
  MemoryFile& file = FileOf(handle);
  const size_t count = std::min(static_cast<size_t>(size), file.bytes.size() - file.position);
  std::memcpy(out, file.bytes.data() + file.position, count);
  file.position += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t RefuseToWrite(thandle_t, void*, tmsize_t) { return -1; }

toff_t Seek(thandle_t handle, toff_t offset, int whence) {
  MemoryFile& file = FileOf(handle);
  const size_t base = whence == SEEK_CUR   ? file.position
                      : whence == SEEK_END ? file.bytes.size()
                                           : 0;
  file.position = std::min<size_t>(base + offset, file.bytes.size());
  return file.position;
}

int Close(thandle_t) { return 0; }
toff_t Size(thandle_t handle) { return FileOf(handle).bytes.size(); }

int KeepError(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  MemoryFile& file = *static_cast<MemoryFile*>(user);
  char text[256] = "";
  std::vsnprintf(text, sizeof text, format, arguments);
  if (file.message.empty()) file.message = text;
  return 1;
}

int IgnoreWarning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffPointer = std::unique_ptr<TIFF, CloseTiff>;

TiffPointer Open(MemoryFile* file) {
  TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, KeepError, file);
  TIFFOpenOptionsSetWarningHandlerExtR(options, IgnoreWarning, nullptr);
  TIFF* const tiff = TIFFClientOpenExt(
      "photo", "rm", file, Read, RefuseToWrite, Seek, Close, Size, nullptr, nullptr, options);
  TIFFOpenOptionsFree(options);
  return TiffPointer(tiff);
}

[[noreturn]] void Fail(const MemoryFile& file) {
  throw std::runtime_error(file.message.empty() ? "damaged TIFF" : file.message);
}

std::optional<double> Dpi(TIFF* tiff) {
  float x = 0, y = 0;
  uint16_t unit = RESUNIT_INCH;
  if (!TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x) ||
      !TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y)) {
    return std::nullopt;
  }
  TIFFGetFieldDefaulted(tiff, TIFFTAG_RESOLUTIONUNIT, &unit);
  if (x != y || !(x > 0) || unit == RESUNIT_NONE) return std::nullopt;
  return unit == RESUNIT_CENTIMETER ? x * 2.54 : x;
}

FileFacts Facts(TIFF* tiff) {
  FileFacts facts;
  uint16_t orientation = 1;
  uint64_t exif_offset = 0;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
  facts.orientation = orientation >= 1 && orientation <= 8 ? orientation : 1;
  facts.dpi = Dpi(tiff);
  // Scanners write plain TIFF; an EXIF directory beside the picture is a camera's.
  facts.exposure_tags = TIFFGetField(tiff, TIFFTAG_EXIFIFD, &exif_offset) != 0;
  return facts;
}

// libtiff knows palettes, 16 bits, tiles, inks and bit orders; it hands out RGBA with alpha
// multiplied in.
cv::Mat ReadRgba(TIFF* tiff, cv::Size size, const MemoryFile& file) {
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);  // pixels as stored
  cv::Mat rgba(size, CV_8UC4);
  const int read = TIFFReadRGBAImageOriented(tiff,
                                             static_cast<uint32_t>(size.width),
                                             static_cast<uint32_t>(size.height),
                                             reinterpret_cast<uint32_t*>(rgba.data),
                                             ORIENTATION_TOPLEFT,
                                             1);
  if (read == 0 || !file.message.empty()) Fail(file);
  return rgba;
}

// White shows through where alpha, already multiplied in, leaves room.
void LayOverWhite(cv::Mat* rgba) {
  for (int y = 0; y < rgba->rows; ++y) {
    cv::Vec4b* row = rgba->ptr<cv::Vec4b>(y);
    for (int x = 0; x < rgba->cols; ++x) {
      const int white = 255 - row[x][3];
      for (int c = 0; c < 3; ++c) row[x][c] = cv::saturate_cast<uchar>(row[x][c] + white);
      row[x][3] = 255;
    }
  }
}

}  // namespace

DecodedPhoto DecodeTiff(std::string_view bytes, const DecodeOptions& options) {
  MemoryFile file{bytes, 0, ""};
  const TiffPointer tiff = Open(&file);
  if (!tiff) Fail(file);
  uint32_t width = 0, height = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  CheckPhotoSize(width, height);
  const cv::Size size(static_cast<int>(width), static_cast<int>(height));
  const FileFacts facts = Facts(tiff.get());
  cv::Mat rgba = ReadRgba(tiff.get(), size, file);
  LayOverWhite(&rgba);
  return {ConvertPixels(rgba, PixelLayout::kRgba, options.colour), size.width, size.height, facts};
}

}  // namespace bladecurve
