// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/photo.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string_view>

#include "vision/photo_codec.h"
#include "vision/photo_exif.h"
#include "vision/refused.h"
#include "vision/sha256.h"

namespace bladecurve {
namespace {

// Rejects videos and disk images before they fill the memory.
constexpr uintmax_t kMaxFileBytes = uintmax_t{1} << 31;
// Flatbed scanners work between these. Below lie the 72, 96 and 100 dpi that editors invent.
constexpr double kMinScannerDpi = 150, kMaxScannerDpi = 4800;

enum class Format { kJpeg, kPng, kTiff, kHeic };

std::string_view FormatName(Format format) {
  switch (format) {
    case Format::kJpeg:
      return "jpeg";
    case Format::kPng:
      return "png";
    case Format::kTiff:
      return "tiff";
    case Format::kHeic:
      return "heic";
  }
  throw std::logic_error("photo: unknown format");
}

bool IsHeic(std::string_view bytes) {
  if (bytes.substr(4, 4) != "ftyp") return false;
  const std::string_view brand = bytes.substr(8, 4);
  for (const std::string_view known :
       {"heic", "heix", "hevc", "heim", "heis", "mif1", "msf1", "avif"}) {
    if (brand == known) return true;
  }
  return false;
}

// By content: names lie.
Format FormatOf(std::string_view bytes) {
  if (bytes.empty()) throw std::runtime_error("the file is empty");
  if (bytes.starts_with("\xff\xd8\xff")) return Format::kJpeg;
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return Format::kPng;
  if (bytes.starts_with(std::string_view("II*\0", 4)) ||
      bytes.starts_with(std::string_view("MM\0*", 4))) {
    return Format::kTiff;
  }
  if (bytes.size() > 12 && IsHeic(bytes)) return Format::kHeic;
  throw std::runtime_error("it is no JPEG, PNG, TIFF or HEIC picture, whatever its name says");
}

DecodedPhoto Decode(std::string_view bytes, const DecodeOptions& options) {
  switch (FormatOf(bytes)) {
    case Format::kJpeg:
      return DecodeJpeg(bytes, options);
    case Format::kPng:
      return DecodePng(bytes, options);
    case Format::kTiff:
      return DecodeTiff(bytes, options);
    case Format::kHeic:
      return DecodeHeic(bytes, options);
  }
  throw std::logic_error("photo: unknown format");
}

std::string ReadWholeFile(const std::filesystem::path& path) {
  const std::filesystem::file_status status = std::filesystem::status(path);
  if (!std::filesystem::exists(status)) throw std::runtime_error("there is no such file");
  if (std::filesystem::is_directory(status)) throw std::runtime_error("it is a folder");
  if (!std::filesystem::is_regular_file(status)) throw std::runtime_error("it is no regular file");
  const uintmax_t size = std::filesystem::file_size(path);
  if (size > kMaxFileBytes) throw std::runtime_error("it is larger than 2 GB");
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(size, '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
    throw std::runtime_error("it cannot be read; check its permissions");
  }
  return bytes;
}

// A resolution is a scale only in a scan. Cameras write a meaningless 72, 180 or 300 dpi beside
// their exposure.
std::optional<double> ScannerDpi(const FileFacts& file, const ExifFacts& exif) {
  const std::optional<double> dpi = file.dpi ? file.dpi : exif.dpi;
  const bool camera = file.exposure_tags || exif.exposure_tags;
  if (!dpi || camera || *dpi < kMinScannerDpi || *dpi > kMaxScannerDpi) return std::nullopt;
  return dpi;
}

PhotoMetadata Describe(std::string_view bytes, const DecodedPhoto& decoded) {
  const Format format = FormatOf(bytes);
  const ExifFacts exif = ReadExif(decoded.facts.exif);
  PhotoMetadata metadata;
  metadata.format = FormatName(format);
  // libheif has turned a HEIC already; its EXIF orientation is history.
  metadata.orientation =
      format == Format::kHeic ? 1 : exif.orientation.value_or(decoded.facts.orientation);
  metadata.dpi = ScannerDpi(decoded.facts, exif);
  metadata.focal_length_px = FocalLengthPx(exif, decoded.stored_width, decoded.stored_height);
  metadata.sha256 = Sha256Hex(bytes);
  return metadata;
}

[[noreturn]] void Refuse(const std::filesystem::path& path, const std::string& cause) {
  throw Refused(Reason::kUnreadable,
                "photo: " + path.string() + " cannot be read: " + cause +
                    "; give a whole JPEG, PNG, TIFF or HEIC file");
}

}  // namespace

Photo Photo::Load(const std::filesystem::path& path) {
  try {
    Photo photo;
    photo.bytes_ = ReadWholeFile(path);
    const DecodedPhoto decoded = Decode(photo.bytes_, {});
    photo.grey_ = decoded.pixels;
    photo.metadata_ = Describe(photo.bytes_, decoded);
    return photo;
  } catch (const std::bad_alloc&) {
    Refuse(path, "there is not enough memory for it");
  } catch (const std::exception& error) {
    Refuse(path, error.what());
  }
}

cv::Mat Photo::DecodeColour(int max_side) const {
  if (max_side < 1) throw std::invalid_argument("Photo::DecodeColour: max_side must be at least 1");
  const cv::Mat colour = Decode(bytes_, {true, max_side}).pixels;
  const double factor = static_cast<double>(max_side) / std::max(colour.cols, colour.rows);
  if (factor >= 1) return colour;
  const cv::Size size(std::max(1, static_cast<int>(std::lround(colour.cols * factor))),
                      std::max(1, static_cast<int>(std::lround(colour.rows * factor))));
  cv::Mat small;
  cv::resize(colour, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

int Photo::displayed_width() const { return metadata_.orientation < 5 ? grey_.cols : grey_.rows; }

int Photo::displayed_height() const { return metadata_.orientation < 5 ? grey_.rows : grey_.cols; }

bool Photo::mirrored() const {
  const int turn = metadata_.orientation;
  return turn == 2 || turn == 4 || turn == 5 || turn == 7;
}

// EXIF 2.3, tag 0x0112: where the displayed picture's left column and top row lie in the stored
// one.
Eigen::Vector2d Photo::DisplayedFromStored(const Eigen::Vector2d& stored_px) const {
  const double x = stored_px.x(), y = stored_px.y();
  const double right = grey_.cols - 1, bottom = grey_.rows - 1;
  switch (metadata_.orientation) {
    case 2:
      return {right - x, y};
    case 3:
      return {right - x, bottom - y};
    case 4:
      return {x, bottom - y};
    case 5:
      return {y, x};
    case 6:
      return {bottom - y, x};
    case 7:
      return {bottom - y, right - x};
    case 8:
      return {y, right - x};
    default:
      return stored_px;
  }
}

Eigen::Vector2d Photo::StoredFromDisplayed(const Eigen::Vector2d& displayed_px) const {
  const double x = displayed_px.x(), y = displayed_px.y();
  const double right = grey_.cols - 1, bottom = grey_.rows - 1;
  switch (metadata_.orientation) {
    case 2:
      return {right - x, y};
    case 3:
      return {right - x, bottom - y};
    case 4:
      return {x, bottom - y};
    case 5:
      return {y, x};
    case 6:
      return {y, bottom - x};
    case 7:
      return {right - y, bottom - x};
    case 8:
      return {right - y, x};
    default:
      return displayed_px;
  }
}

}  // namespace bladecurve
