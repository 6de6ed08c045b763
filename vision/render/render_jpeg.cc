// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "vision/render/render.h"

extern "C" {
#include <jpeglib.h>
}

namespace bladecurve {
namespace {

[[noreturn]] void ThrowJpegError(j_common_ptr info) {
  char message[JMSG_LENGTH_MAX];
  info->err->format_message(info, message);
  throw std::runtime_error(std::string("EncodeJpeg: ") + message);
}

// Invariant: a compressor that is released, with its buffer, however encoding ends.
class Compressor {
 public:
  Compressor() {
    info_.err = jpeg_std_error(&errors_);
    errors_.error_exit = ThrowJpegError;
    jpeg_create_compress(&info_);
    jpeg_mem_dest(&info_, &buffer_, &size_);
  }
  ~Compressor() {
    jpeg_destroy_compress(&info_);
    std::free(buffer_);
  }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  std::string Encode(const cv::Mat& bgr, int quality) {
    info_.image_width = static_cast<JDIMENSION>(bgr.cols);
    info_.image_height = static_cast<JDIMENSION>(bgr.rows);
    info_.input_components = 3;
    info_.in_color_space = JCS_EXT_BGR;
    jpeg_set_defaults(&info_);
    jpeg_set_quality(&info_, quality, TRUE);
    jpeg_start_compress(&info_, TRUE);
    for (int r = 0; r < bgr.rows; ++r) {
      auto* row = const_cast<JSAMPROW>(bgr.ptr<JSAMPLE>(r));
      jpeg_write_scanlines(&info_, &row, 1);
    }
    jpeg_finish_compress(&info_);
    return {reinterpret_cast<const char*>(buffer_), size_};
  }

 private:
  jpeg_compress_struct info_{};
  jpeg_error_mgr errors_{};
  unsigned char* buffer_ = nullptr;
  unsigned long size_ = 0;
};

}  // namespace

std::string EncodeJpeg(const cv::Mat& bgr, int quality) {
  if (bgr.type() != CV_8UC3 || bgr.empty()) {
    throw std::invalid_argument("EncodeJpeg: the picture must be CV_8UC3 and not empty");
  }
  if (quality < 1 || quality > 100) {
    throw std::invalid_argument("EncodeJpeg: quality = " + std::to_string(quality) +
                                " must be 1 to 100");
  }
  return Compressor().Encode(bgr, quality);
}

}  // namespace bladecurve
