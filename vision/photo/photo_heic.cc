// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <libheif/heif.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "vision/photo/photo_codec.h"

namespace bladecurve {
namespace {

template <auto Free>
struct Release {
  template <typename T>
  void operator()(T* object) const {
    Free(object);
  }
};
using Context = std::unique_ptr<heif_context, Release<heif_context_free>>;
using Handle = std::unique_ptr<heif_image_handle, Release<heif_image_handle_release>>;
using Image = std::unique_ptr<heif_image, Release<heif_image_release>>;

void Check(const heif_error& error) {
  if (error.code != heif_error_Ok) throw std::runtime_error(error.message);
}

Handle PrimaryImage(heif_context* context) {
  heif_image_handle* handle = nullptr;
  Check(heif_context_get_primary_image_handle(context, &handle));
  return Handle(handle);
}

// libheif has turned the pixels already, so an EXIF orientation no longer applies.
FileFacts Facts(const heif_image_handle* handle) {
  constexpr size_t kOffsetBytes = 4 + 6;  // where the TIFF header begins, then "Exif\0\0"
  FileFacts facts;
  heif_item_id id = 0;
  if (heif_image_handle_get_list_of_metadata_block_IDs(handle, "Exif", &id, 1) != 1) return facts;
  std::vector<char> block(heif_image_handle_get_metadata_size(handle, id));
  Check(heif_image_handle_get_metadata(handle, id, block.data()));
  if (block.size() > kOffsetBytes) facts.exif.assign(block.begin() + kOffsetBytes, block.end());
  return facts;
}

cv::Mat DecodeRgb(const heif_image_handle* handle, bool colour) {
  const bool alpha = heif_image_handle_has_alpha_channel(handle) != 0;
  const heif_chroma chroma = alpha ? heif_chroma_interleaved_RGBA : heif_chroma_interleaved_RGB;
  heif_image* decoded = nullptr;
  Check(heif_decode_image(handle, &decoded, heif_colorspace_RGB, chroma, nullptr));
  const Image image(decoded);
  int stride = 0;
  uint8_t* const plane = heif_image_get_plane(decoded, heif_channel_interleaved, &stride);
  if (plane == nullptr) throw std::runtime_error("HEIC without pixels");
  const PixelLayout layout = alpha ? PixelLayout::kRgba : PixelLayout::kRgb;
  const cv::Mat view(heif_image_get_height(decoded, heif_channel_interleaved),
                     heif_image_get_width(decoded, heif_channel_interleaved),
                     CV_8UC(ChannelsOf(layout)),
                     plane,
                     static_cast<size_t>(stride));
  return ConvertPixels(view, layout, colour);
}

}  // namespace

DecodedPhoto DecodeHeic(std::string_view bytes, const DecodeOptions& options) {
  const Context context(heif_context_alloc());
  Check(heif_context_read_from_memory_without_copy(
      context.get(), bytes.data(), bytes.size(), nullptr));
  const Handle handle = PrimaryImage(context.get());
  const int width = heif_image_handle_get_width(handle.get());
  const int height = heif_image_handle_get_height(handle.get());
  CheckPhotoSize(width, height);
  const cv::Mat pixels = DecodeRgb(handle.get(), options.colour);
  return {pixels, pixels.cols, pixels.rows, Facts(handle.get())};
}

}  // namespace bladecurve
