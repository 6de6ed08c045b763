// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <csetjmp>
#include <cstdio>
// jpeglib.h needs FILE and size_t declared before it.
#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "vision/parallel.h"
#include "vision/photo/photo_codec.h"

namespace bladecurve {
namespace {

constexpr unsigned kExifMarker = JPEG_APP0 + 1;
constexpr std::string_view kExifPrefix("Exif\0\0", 6);
// Rejects progressive bombs: encoders write about ten scans, never hundreds.
constexpr int kMaxScans = 500;

// Most of libjpeg's warnings mean lost pixels. These do no harm: stray bytes between segments, odd
// version numbers, an ICC profile that is not used here anyway.
bool LosesPixels(int code) {
  return code != JWRN_EXTRANEOUS_DATA && code != JWRN_ADOBE_XFORM && code != JWRN_JFIF_MAJOR &&
         code != JWRN_BOGUS_ICC;
}

// libjpeg reports by callbacks into C frames, where exceptions must not pass: it jumps back to
// Guarded instead.
struct ErrorManager {
  jpeg_error_mgr base;  // first, so that libjpeg's pointer is ours
  jmp_buf jump;
  char message[JMSG_LENGTH_MAX];
};

[[noreturn]] void Fail(j_common_ptr info) {
  ErrorManager* const errors = reinterpret_cast<ErrorManager*>(info->err);
  info->err->format_message(info, errors->message);
  longjmp(errors->jump, 1);
}

void Warn(j_common_ptr info, int level) {
  if (level < 0 && LosesPixels(info->err->msg_code)) Fail(info);
}

void CountScans(j_common_ptr info) {
  if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= kMaxScans) return;
  ERREXIT(info, JERR_BAD_PROGRESSION);
}

struct Decompressor {
  jpeg_decompress_struct info = {};
  Decompressor() = default;
  ~Decompressor() { jpeg_destroy_decompress(&info); }  // does nothing before jpeg_create_decompress
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;
};

// One file being read. Stays where it is: libjpeg keeps pointers into it.
class JpegReader {
 public:
  explicit JpegReader(std::string_view bytes) {
    info_.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = Fail;
    errors_.base.emit_message = Warn;
    Guarded([&] {
      jpeg_create_decompress(&info_);
      jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
      jpeg_save_markers(&info_, kExifMarker, 0xffff);
      jpeg_read_header(&info_, TRUE);
    });
    progress_.progress_monitor = CountScans;
    info_.progress = &progress_;
  }

  int width() const { return static_cast<int>(info_.image_width); }
  int height() const { return static_cast<int>(info_.image_height); }
  PicturePart Decode(const DecodeOptions& options);
  // Whether parts of the picture may be decoded beside each other, and quicker than all in turn.
  bool Divisible();
  FileFacts Facts() const;

  // Decoding in steps; Decode takes all of them. What the pixels will look like as they are stored:
  struct Stored {
    cv::Size size;
    PixelLayout layout;
    int block_rows = 0;  // of pictures with halved colour; whole ones are skipped best
  };
  Stored Begin(const DecodeOptions& options);
  // Once: rows [first, last) into the same rows of `stored`.
  void DecodeRows(int first, int last, cv::Mat* stored);

 private:
  // `step` must hold no object with a destructor while it calls libjpeg: a jump would skip it.
  template <typename Step>
  void Guarded(Step step) {
    if (setjmp(errors_.jump) != 0) throw std::runtime_error(errors_.message);
    step();
  }
  PixelLayout ChooseLayout(bool colour);
  void ChooseSize(int long_side);
  // The part, in pixels as they are decoded, grown to whole blocks of columns; what lies before its
  // first row is passed over.
  cv::Rect GoTo(const cv::Rect& part);
  // From the next row to be decoded to `last`, into rows that begin with `first`.
  void ReadRows(int first, int last, cv::Mat* pixels);

  Decompressor owner_;
  jpeg_decompress_struct& info_ = owner_.info;
  jpeg_progress_mgr progress_ = {};
  ErrorManager errors_ = {};
};

PixelLayout JpegReader::ChooseLayout(bool colour) {
  if (info_.jpeg_color_space == JCS_CMYK || info_.jpeg_color_space == JCS_YCCK) {
    info_.out_color_space = JCS_CMYK;
    return info_.saw_Adobe_marker ? PixelLayout::kInvertedCmyk : PixelLayout::kCmyk;
  }
  // Luma alone is decoded without touching the colour planes' transforms.
  info_.out_color_space = colour ? JCS_RGB : JCS_GRAYSCALE;
  return colour ? PixelLayout::kRgb : PixelLayout::kGrey;
}

// The smallest of 1/8, 1/4, 1/2, 1 that keeps the longest side.
void JpegReader::ChooseSize(int long_side) {
  info_.scale_num = 8;
  info_.scale_denom = 8;
  if (long_side <= 0) return;
  const int full = std::max(width(), height());
  for (int eighths : {4, 2, 1}) {
    if ((full * eighths + 7) / 8 >= long_side) info_.scale_num = static_cast<unsigned>(eighths);
  }
}

JpegReader::Stored JpegReader::Begin(const DecodeOptions& options) {
  const PixelLayout layout = ChooseLayout(options.colour);
  ChooseSize(options.long_side);
  Guarded([&] { jpeg_start_decompress(&info_); });
  return {{static_cast<int>(info_.output_width), static_cast<int>(info_.output_height)},
          layout,
          2 * static_cast<int>(info_.scale_num)};
}

PicturePart JpegReader::Decode(const DecodeOptions& options) {
  const Stored all = Begin(options);
  const cv::Rect part = options.part.empty() ? cv::Rect({0, 0}, all.size) : GoTo(options.part);
  cv::Mat stored = NewPicture(part.size(), CV_8UC(ChannelsOf(all.layout)));
  ReadRows(part.y, part.br().y, &stored);
  return {ConvertPixels(stored, all.layout, options.colour), part.tl()};
}

cv::Rect JpegReader::GoTo(const cv::Rect& part) {
  const int eighths = static_cast<int>(info_.scale_num);
  const cv::Point first = part.tl() * eighths / 8;
  const cv::Point last((part.br().x * eighths + 7) / 8, (part.br().y * eighths + 7) / 8);
  auto column = static_cast<JDIMENSION>(first.x),
       columns = static_cast<JDIMENSION>(last.x - first.x);
  Guarded([&] {
    jpeg_crop_scanline(&info_, &column, &columns);
    jpeg_skip_scanlines(&info_, static_cast<JDIMENSION>(first.y));
  });
  return {static_cast<int>(column), first.y, static_cast<int>(columns), last.y - first.y};
}

void JpegReader::ReadRows(int first, int last, cv::Mat* pixels) {
  Guarded([&] {
    while (info_.output_scanline < static_cast<JDIMENSION>(last)) {
      JSAMPROW row = pixels->ptr<uchar>(static_cast<int>(info_.output_scanline) - first);
      jpeg_read_scanlines(&info_, &row, 1);
    }
  });
}

bool JpegReader::Divisible() {
  constexpr double kWorthAThread = 1e6;  // pixels; a thread costs as much as decoding a tenth
  const bool luma_stored =
      info_.jpeg_color_space == JCS_YCbCr || info_.jpeg_color_space == JCS_GRAYSCALE;
  return luma_stored && !jpeg_has_multiple_scans(&info_) &&
         1.0 * width() * height() > kWorthAThread;
}

void JpegReader::DecodeRows(int first, int last, cv::Mat* stored) {
  Guarded([&] { jpeg_skip_scanlines(&info_, static_cast<JDIMENSION>(first)); });
  ReadRows(0, last, stored);
}

FileFacts JpegReader::Facts() const {
  FileFacts facts;
  const bool square = info_.X_density == info_.Y_density && info_.X_density > 0;
  if (info_.saw_JFIF_marker && square && info_.density_unit == 1) facts.dpi = info_.X_density;
  if (info_.saw_JFIF_marker && square && info_.density_unit == 2)
    facts.dpi = info_.X_density * 2.54;
  for (jpeg_saved_marker_ptr m = info_.marker_list; m != nullptr; m = m->next) {
    const std::string_view data(reinterpret_cast<const char*>(m->data), m->data_length);
    if (m->marker != kExifMarker || data.substr(0, kExifPrefix.size()) != kExifPrefix) continue;
    facts.exif = data.substr(kExifPrefix.size());
    break;
  }
  return facts;
}

// Two readers, one for the upper rows, one for the lower. Huffman codes cannot be entered half-way,
// so the second reads those of the upper rows as well: two thirds of the work of decoding them,
// more where the picture is decoded smaller.
cv::Mat DecodeInTwo(std::string_view bytes, const DecodeOptions& options, JpegReader* upper) {
  constexpr double kUpperShare = 0.7;  // both take about as long
  const JpegReader::Stored all = upper->Begin(options);
  const int seam =
      static_cast<int>(kUpperShare * all.size.height) / all.block_rows * all.block_rows;
  cv::Mat stored = NewPicture(all.size, CV_8UC(ChannelsOf(all.layout)));
  ParallelFor(2, [&](int part) {
    if (part == 0) {
      upper->DecodeRows(0, seam, &stored);
    } else {
      JpegReader lower(bytes);
      lower.Begin(options);
      lower.DecodeRows(seam, all.size.height, &stored);
    }
  });
  return ConvertPixels(stored, all.layout, options.colour);
}

}  // namespace

DecodedPhoto DecodeJpeg(std::string_view bytes, const DecodeOptions& options) {
  JpegReader reader(bytes);
  const cv::Size size(reader.width(), reader.height());
  CheckPhotoSize(size.width, size.height);
  const bool in_two = options.part.empty() && options.num_threads >= 2 && reader.Divisible();
  return {in_two ? PicturePart(DecodeInTwo(bytes, options, &reader)) : reader.Decode(options),
          size.width,
          size.height,
          reader.Facts()};
}

}  // namespace bladecurve
