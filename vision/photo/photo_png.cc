// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <png.h>

#include <cmath>
#include <csetjmp>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "vision/photo/photo_codec.h"

namespace bladecurve {
namespace {

constexpr double kMetresPerInch = 0.0254;

struct ByteSource {
  std::string_view rest;
  std::string message;  // what libpng complained about
};

void ReadBytes(png_structp png, png_bytep out, size_t size) {
  ByteSource* const source = static_cast<ByteSource*>(png_get_io_ptr(png));
  if (source->rest.size() < size) png_error(png, "premature end of PNG data");
  std::memcpy(out, source->rest.data(), size);
  source->rest.remove_prefix(size);
}

[[noreturn]] void Fail(png_structp png, png_const_charp message) {
  static_cast<ByteSource*>(png_get_error_ptr(png))->message = message;
  png_longjmp(png, 1);
}

void IgnoreWarning(png_structp, png_const_charp) {
}  // libpng warns of odd metadata; lost pixels are errors

struct ReadStruct {
  png_structp png = nullptr;
  png_infop info = nullptr;
  ReadStruct() = default;
  ~ReadStruct() { png_destroy_read_struct(&png, &info, nullptr); }
  ReadStruct(const ReadStruct&) = delete;
  ReadStruct& operator=(const ReadStruct&) = delete;
};

// One file being read. libpng jumps out of its C frames on errors; Guarded catches that.
class PngReader {
 public:
  explicit PngReader(std::string_view bytes) : source_{bytes, ""} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, Fail, IgnoreWarning);
    if (png_ == nullptr) throw std::bad_alloc();
    info_ = png_create_info_struct(png_);
    Guarded([&] {
      png_set_user_limits(png_, 0x7fffffff, 0x7fffffff);
      png_set_read_fn(png_, &source_, ReadBytes);
      png_read_info(png_, info_);
    });
  }

  int width() const { return static_cast<int>(png_get_image_width(png_, info_)); }
  int height() const { return static_cast<int>(png_get_image_height(png_, info_)); }
  cv::Mat Decode(const DecodeOptions& options);
  FileFacts Facts() const;

 private:
  // `step` must hold no object with a destructor while it calls libpng: a jump would skip it.
  template <typename Step>
  void Guarded(Step step) {
    if (setjmp(png_jmpbuf(png_)) != 0) throw std::runtime_error(source_.message);
    step();
  }
  PixelLayout Layout() const;

  ByteSource source_;
  ReadStruct owner_;
  png_structp& png_ = owner_.png;
  png_infop& info_ = owner_.info;
};

PixelLayout PngReader::Layout() const {
  const int type = png_get_color_type(png_, info_);
  const bool alpha = (type & PNG_COLOR_MASK_ALPHA) != 0;
  if ((type & PNG_COLOR_MASK_COLOR) != 0) return alpha ? PixelLayout::kRgba : PixelLayout::kRgb;
  return alpha ? PixelLayout::kGreyAlpha : PixelLayout::kGrey;
}

cv::Mat PngReader::Decode(const DecodeOptions& options) {
  Guarded([&] {
    png_set_expand(png_);  // palette to RGB, 1 to 4 bits to 8, transparent colour to alpha
    png_set_scale_16(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
  });
  const PixelLayout layout = Layout();
  // Of an interlaced picture every row comes in several passes over all of it.
  const bool interlaced = png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE;
  const int last = interlaced || options.part.empty() ? height() : options.part.br().y;
  cv::Mat stored = NewPicture(cv::Size(width(), last), CV_8UC(ChannelsOf(layout)));
  std::vector<png_bytep> rows(static_cast<size_t>(stored.rows));
  for (int y = 0; y < stored.rows; ++y) rows[static_cast<size_t>(y)] = stored.ptr<uchar>(y);
  Guarded([&] {
    if (interlaced) {
      png_read_image(png_, rows.data());
    } else {
      png_read_rows(png_, rows.data(), nullptr, static_cast<png_uint_32>(stored.rows));
    }
  });
  return ConvertPixels(stored, layout, options.colour);
}

FileFacts PngReader::Facts() const {
  FileFacts facts;
  png_uint_32 x = 0, y = 0;
  int unit = 0;
  const bool has_size = png_get_pHYs(png_, info_, &x, &y, &unit) != 0;
  if (has_size && unit == PNG_RESOLUTION_METER && x == y && x > 0) facts.dpi = x * kMetresPerInch;
  png_bytep exif = nullptr;
  png_uint_32 exif_size = 0;
  if (png_get_eXIf_1(png_, info_, &exif_size, &exif) != 0) {
    facts.exif.assign(reinterpret_cast<const char*>(exif), exif_size);
  }
  return facts;
}

}  // namespace

DecodedPhoto DecodePng(std::string_view bytes, const DecodeOptions& options) {
  PngReader reader(bytes);
  CheckPhotoSize(reader.width(), reader.height());
  return {reader.Decode(options), reader.width(), reader.height(), reader.Facts()};
}

}  // namespace bladecurve
