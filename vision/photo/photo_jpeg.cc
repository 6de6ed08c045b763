// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <csetjmp>
#include <cstdio>
// jpeglib.h needs FILE and size_t declared before it.
#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "vision/parallel.h"
#include "vision/photo/jpeg_lower_part.h"
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
  explicit JpegReader(std::string_view bytes) : bytes_(bytes) {
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
  // The upper rows' share of two parts that take about as long.
  double UpperShare() const;
  FileFacts Facts() const;

  // Decoding in steps; Decode takes all of them. What the pixels will look like as they are stored:
  struct Stored {
    cv::Size size;
    PixelLayout layout;
    int mcu_rows = 0;  // rows of pixels in a row of MCUs
  };
  Stored Begin(bool colour, int eighths);
  // How much smaller that may be.
  int EighthsFor(int long_side) const;
  void Skip(int rows);
  void Read(cv::Mat* rows);  // the next ones, as many as it has
  // The picture from a row of MCUs on, behind another one: see LowerPartOfJpeg.
  [[nodiscard]] std::optional<std::string> From(int mcu_row) const;

 private:
  // `step` must hold no object with a destructor while it calls libjpeg: a jump would skip it.
  template <typename Step>
  void Guarded(Step step) {
    if (setjmp(errors_.jump) != 0) throw std::runtime_error(errors_.message);
    step();
  }
  PixelLayout ChooseLayout(bool colour);
  // The part, in pixels as they are decoded, grown to whole blocks of columns; what lies before its
  // first row is passed over.
  cv::Rect GoTo(const cv::Rect& part);

  std::string_view bytes_;
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
int JpegReader::EighthsFor(int long_side) const {
  int smallest = 8;
  if (long_side <= 0) return smallest;
  const int full = std::max(width(), height());
  for (const int eighths : {4, 2, 1}) {
    if ((full * eighths + 7) / 8 >= long_side) smallest = eighths;
  }
  return smallest;
}

JpegReader::Stored JpegReader::Begin(bool colour, int eighths) {
  const PixelLayout layout = ChooseLayout(colour);
  info_.scale_num = static_cast<unsigned>(eighths);
  info_.scale_denom = 8;
  Guarded([&] { jpeg_start_decompress(&info_); });
  return {{static_cast<int>(info_.output_width), static_cast<int>(info_.output_height)},
          layout,
          McuRowHeight(info_) * eighths / 8};
}

PicturePart JpegReader::Decode(const DecodeOptions& options) {
  const Stored all = Begin(options.colour, EighthsFor(options.long_side));
  const cv::Rect part = options.part.empty() ? cv::Rect({0, 0}, all.size) : GoTo(options.part);
  cv::Mat stored = NewPicture(part.size(), CV_8UC(ChannelsOf(all.layout)));
  Read(&stored);
  return {ConvertPixels(stored, all.layout, options.colour), part.tl()};
}

cv::Rect JpegReader::GoTo(const cv::Rect& part) {
  const int eighths = static_cast<int>(info_.scale_num);
  const cv::Point first = part.tl() * eighths / 8;
  const cv::Point last((part.br().x * eighths + 7) / 8, (part.br().y * eighths + 7) / 8);
  auto column = static_cast<JDIMENSION>(first.x),
       columns = static_cast<JDIMENSION>(last.x - first.x);
  Guarded([&] { jpeg_crop_scanline(&info_, &column, &columns); });
  Skip(first.y);
  return {static_cast<int>(column), first.y, static_cast<int>(columns), last.y - first.y};
}

void JpegReader::Skip(int rows) {
  Guarded([&] { jpeg_skip_scanlines(&info_, static_cast<JDIMENSION>(rows)); });
}

void JpegReader::Read(cv::Mat* rows) {
  assert(rows->empty() || rows->cols == static_cast<int>(info_.output_width));
  Guarded([&] {
    for (int i = 0; i < rows->rows; ++i) {
      JSAMPROW row = rows->ptr<uchar>(i);
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

// Where codes are not counted, the lower part's reader decodes those of the upper rows as well: two
// thirds of the work of decoding them, more where the picture is decoded smaller.
double JpegReader::UpperShare() const { return HasCountableCodes(info_) ? 0.6 : 0.7; }

std::optional<std::string> JpegReader::From(int mcu_row) const {
  return LowerPartOfJpeg(bytes_, info_, mcu_row);
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

// Where and how a picture is divided.
struct Division {
  int mcu_row = 0;  // the first of the lower part
  bool colour = false;
  int eighths = 8;
};

// The lower rows from a part of the file that has them alone. Returns the row of MCUs above, which
// it has as well, for the colours between, and which should be as the upper rows' reader has it.
cv::Mat ReadPart(std::string_view part, const Division& division, cv::Mat* rows) {
  JpegReader reader(part);
  const int mcu_rows = reader.Begin(division.colour, division.eighths).mcu_rows;
  cv::Mat above(mcu_rows, rows->cols, rows->type());
  reader.Skip(mcu_rows);
  reader.Read(&above);
  reader.Read(rows);
  return above;
}

// The same; nothing, and the rows from the whole file, where there is no such part.
cv::Mat ReadLower(std::string_view bytes, const Division& division, cv::Mat* rows) {
  JpegReader all(bytes);
  const int mcu_rows = all.Begin(division.colour, division.eighths).mcu_rows;
  try {
    const auto part = division.mcu_row > 0 ? all.From(division.mcu_row - 1) : std::nullopt;
    if (part) return ReadPart(*part, division, rows);
  } catch (const std::runtime_error&) {
    // If the whole file is damaged as well, its reader says so below.
  }
  all.Skip(division.mcu_row * mcu_rows);
  all.Read(rows);
  return {};
}

// Two readers, one for the upper rows, one for the lower. Nothing if they do not agree about what
// both decoded.
cv::Mat DecodeInTwo(std::string_view bytes, const DecodeOptions& options) {
  JpegReader upper(bytes);
  const int eighths = upper.EighthsFor(options.long_side);
  const JpegReader::Stored all = upper.Begin(options.colour, eighths);
  const int mcu_row = static_cast<int>(upper.UpperShare() * all.size.height) / all.mcu_rows;
  const int seam = mcu_row * all.mcu_rows;
  cv::Mat stored = NewPicture(all.size, CV_8UC(ChannelsOf(all.layout)));
  cv::Mat upper_rows = stored.rowRange(0, seam), above;
  cv::Mat lower_rows = stored.rowRange(seam, all.size.height);
  ParallelFor(2, [&](int part) {
    if (part == 0) {
      upper.Read(&upper_rows);
    } else {
      above = ReadLower(bytes, {mcu_row, options.colour, eighths}, &lower_rows);
    }
  });
  if (!above.empty()) {
    const int half = all.mcu_rows / 2;  // the first one mixes its colours with those above itself
    const cv::Mat by_lower = above.rowRange(half, all.mcu_rows);
    const cv::Mat by_upper = stored.rowRange(seam - all.mcu_rows + half, seam);
    if (cv::norm(by_lower, by_upper, cv::NORM_INF) > 0) return {};
  }
  return ConvertPixels(stored, all.layout, options.colour);
}

}  // namespace

DecodedPhoto DecodeJpeg(std::string_view bytes, const DecodeOptions& options) {
  JpegReader reader(bytes);
  const cv::Size size(reader.width(), reader.height());
  CheckPhotoSize(size.width, size.height);
  const bool divided = options.part.empty() && options.num_threads >= 2 && reader.Divisible();
  const cv::Mat in_two = divided ? DecodeInTwo(bytes, options) : cv::Mat();
  return {in_two.empty() ? reader.Decode(options) : PicturePart(in_two),
          size.width,
          size.height,
          reader.Facts()};
}

}  // namespace bladecurve
