// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/photo/photo.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string_view>

#include "vision/image/reduced.h"
#include "vision/parallel.h"
#include "vision/photo/photo_codec.h"
#include "vision/photo/photo_exif.h"
#include "vision/photo/sha256.h"
#include "vision/refused.h"

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
  return metadata;
}

// EXIF orientations that no turning explains become those of the same picture, its columns flipped.
int WithColumnsFlipped(int orientation) {
  switch (orientation) {
    case 2:
      return 1;
    case 4:
      return 3;
    case 5:
      return 8;
    case 7:
      return 6;
    default:
      return orientation;
  }
}

[[noreturn]] void Refuse(const std::filesystem::path& path,
                         const std::string& cause,
                         const std::string& instead) {
  throw Refused(Reason::kUnreadable,
                "photo: " + path.string() + " cannot be read: " + cause + "; give " + instead);
}

}  // namespace

Photo Photo::Load(const std::filesystem::path& path) {
  try {
    Photo photo;
    photo.bytes_ = ReadWholeFile(path);
    const DecodedPhoto decoded = Decode(photo.bytes_, {.num_threads = UsableThreads()});
    photo.metadata_ = Describe(photo.bytes_, decoded);
    const int orientation = photo.metadata_.orientation;
    photo.metadata_.orientation = WithColumnsFlipped(orientation);
    photo.mirrored_ = photo.metadata_.orientation != orientation;
    photo.grey_ = photo.Unmirrored(decoded.picture.pixels);
    return photo;
  } catch (const std::bad_alloc&) {
    Refuse(path, "there is not enough memory for it", "a smaller picture");
  } catch (const PhotoTooLarge& error) {
    Refuse(path, error.what(), "a smaller picture");
  } catch (const std::exception& error) {
    Refuse(path, error.what(), "a whole JPEG, PNG, TIFF or HEIC file");
  }
}

cv::Mat Photo::Unmirrored(const cv::Mat& pixels) const {
  if (!mirrored_) return pixels;
  cv::Mat flipped;
  cv::flip(pixels, flipped, 1);
  return flipped;
}

cv::Rect Photo::Unmirrored(const cv::Rect& area_px) const {
  if (!mirrored_) return area_px;
  return {cv::Point(grey_.cols - area_px.br().x, area_px.y), area_px.size()};
}

std::string Photo::Sha256() const { return Sha256Hex(bytes_); }

cv::Mat Photo::DecodeColour(int max_side, double slack, double least) const {
  if (max_side < 1) throw std::invalid_argument("Photo::DecodeColour: max_side must be at least 1");
  const auto least_side = static_cast<int>(std::ceil(least * max_side));
  const cv::Mat colour = Unmirrored(
      Decode(bytes_, {.colour = true, .long_side = least_side, .num_threads = UsableThreads()})
          .picture.pixels);
  const double factor = static_cast<double>(max_side) / std::max(colour.cols, colour.rows);
  if (factor * slack >= 1) return colour;
  const cv::Size size(std::max(1, static_cast<int>(std::lround(colour.cols * factor))),
                      std::max(1, static_cast<int>(std::lround(colour.rows * factor))));
  return Reduced(colour, size);
}

PicturePart Photo::DecodeColourPart(const cv::Rect& part_px) const {
  const cv::Rect part = part_px & cv::Rect({0, 0}, grey_.size());
  if (part.empty()) throw std::invalid_argument("Photo::DecodeColourPart: nothing of the picture");
  const PicturePart decoded = Decode(bytes_, {.colour = true, .part = Unmirrored(part)}).picture;
  return {Unmirrored(decoded.pixels), Unmirrored(decoded.Area()).tl()};
}

cv::Mat Photo::DecodeTopColour(double share, int max_side) const {
  if (!(share > 0 && share <= 1))
    throw std::invalid_argument("Photo::DecodeTopColour: share must be in (0, 1]");
  const cv::Rect top(0, 0, grey_.cols, static_cast<int>(std::ceil(share * grey_.rows)));
  const cv::Mat colour = Unmirrored(
      Decode(bytes_, {.colour = true, .long_side = max_side, .part = top}).picture.pixels);
  const double rows = share * colour.cols * grey_.rows / grey_.cols;
  return colour.rowRange(0, std::clamp(static_cast<int>(std::ceil(rows)), 1, colour.rows));
}

int Photo::displayed_width() const { return metadata_.orientation < 5 ? grey_.cols : grey_.rows; }

int Photo::displayed_height() const { return metadata_.orientation < 5 ? grey_.rows : grey_.cols; }

namespace {

// EXIF 2.3, tag 0x0112, as what turns the stored picture into the displayed one: first flips of its
// columns and rows, then an exchange of both.
struct Turn {
  bool flip_x = false, flip_y = false, exchange = false;
};

Turn TurnOf(int orientation) {
  switch (orientation) {
    case 3:
      return {true, true, false};
    case 6:
      return {false, true, true};
    case 8:
      return {true, false, true};
    default:
      return {};
  }
}

Eigen::Vector2d Flipped(const Eigen::Vector2d& stored_px, const Turn& turn, const cv::Size& size) {
  return {turn.flip_x ? size.width - 1 - stored_px.x() : stored_px.x(),
          turn.flip_y ? size.height - 1 - stored_px.y() : stored_px.y()};
}

}  // namespace

Eigen::Vector2d Photo::DisplayedFromStored(const Eigen::Vector2d& stored_px) const {
  const Turn turn = TurnOf(metadata_.orientation);
  const Eigen::Vector2d flipped = Flipped(stored_px, turn, grey_.size());
  if (turn.exchange) return flipped.reverse();
  return flipped;
}

Eigen::Vector2d Photo::StoredFromDisplayed(const Eigen::Vector2d& displayed_px) const {
  const Turn turn = TurnOf(metadata_.orientation);
  const Eigen::Vector2d exchanged = turn.exchange ? displayed_px.reverse().eval() : displayed_px;
  return Flipped(exchanged, turn, grey_.size());
}

}  // namespace bladecurve
