// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "jpeg_images.h"

#include <cstdlib>
#include <vector>

namespace bladecurve {

std::string Jpeg(const cv::Mat& picture, const JpegSettings& settings) {
  cv::Mat stored = picture;
  if (picture.channels() != settings.channels)
    cv::merge(std::vector<cv::Mat>(static_cast<size_t>(settings.channels), picture), stored);
  jpeg_compress_struct info = {};
  jpeg_error_mgr errors;
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &buffer, &size);
  info.image_width = static_cast<JDIMENSION>(stored.cols);
  info.image_height = static_cast<JDIMENSION>(stored.rows);
  info.input_components = settings.channels;
  info.in_color_space = settings.space;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, settings.quality, TRUE);
  info.optimize_coding = settings.own_tables ? TRUE : FALSE;
  info.restart_in_rows = settings.restart_rows;
  if (settings.channels == 3) {
    info.comp_info[0].h_samp_factor = settings.luma_per_chroma.width;
    info.comp_info[0].v_samp_factor = settings.luma_per_chroma.height;
  }
  if (settings.progressive) jpeg_simple_progression(&info);
  if (settings.density > 0) {
    info.density_unit = 1;
    info.X_density = info.Y_density = static_cast<UINT16>(settings.density);
  }
  jpeg_start_compress(&info, TRUE);
  if (!settings.exif.empty()) {
    jpeg_write_marker(&info,
                      JPEG_APP0 + 1,
                      reinterpret_cast<const JOCTET*>(settings.exif.data()),
                      static_cast<unsigned>(settings.exif.size()));
  }
  while (info.next_scanline < info.image_height) {
    JSAMPROW row = stored.ptr(static_cast<int>(info.next_scanline));
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  std::string bytes(reinterpret_cast<char*>(buffer), size);
  jpeg_destroy_compress(&info);
  std::free(buffer);
  return bytes;
}

}  // namespace bladecurve
