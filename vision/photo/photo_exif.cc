// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/photo/photo_exif.h"

#include <libexif/exif-data.h>

#include <cmath>
#include <memory>
#include <string>

#include "vision/photo/photo.h"

namespace bladecurve {
namespace {

constexpr double kFilmDiagonalMm = 43.2666;  // 36 x 24 mm
// Rejects EXIF blocks that no JPEG segment could hold and that libexif would copy.
constexpr size_t kMaxBlock = 1 << 20;

struct FreeExif {
  void operator()(ExifData* data) const { exif_data_unref(data); }
};
using ExifPointer = std::unique_ptr<ExifData, FreeExif>;

ExifPointer Parse(std::string_view tiff_block) {
  ExifPointer data(exif_data_new());
  // By default libexif adds the tags the standard demands, with values of its own: 72 dpi, say.
  exif_data_unset_option(data.get(), EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
  const std::string block = std::string("Exif\0\0", 6) + std::string(tiff_block);
  exif_data_load_data(data.get(),
                      reinterpret_cast<const unsigned char*>(block.data()),
                      static_cast<unsigned>(block.size()));
  return data;
}

bool Has(ExifData* data, ExifTag tag) {
  return exif_content_get_entry(data->ifd[EXIF_IFD_EXIF], tag) != nullptr;
}

// Positive numbers only: zero and nonsense mean "unknown" in EXIF.
std::optional<double> Number(ExifData* data, ExifIfd ifd, ExifTag tag) {
  const ExifEntry* const entry = exif_content_get_entry(data->ifd[ifd], tag);
  if (entry == nullptr || entry->components < 1 || entry->data == nullptr) return std::nullopt;
  if (entry->size < exif_format_get_size(entry->format)) return std::nullopt;
  const ExifByteOrder order = exif_data_get_byte_order(data);
  double value = 0;
  if (entry->format == EXIF_FORMAT_SHORT) {
    value = exif_get_short(entry->data, order);
  } else if (entry->format == EXIF_FORMAT_LONG) {
    value = exif_get_long(entry->data, order);
  } else if (entry->format == EXIF_FORMAT_RATIONAL) {
    const ExifRational ratio = exif_get_rational(entry->data, order);
    value = static_cast<double>(ratio.numerator) / ratio.denominator;
  }
  return std::isfinite(value) && value > 0 ? std::optional<double>(value) : std::nullopt;
}

// mm in EXIF's resolution units: 2 is inch, 3 is cm.
std::optional<double> UnitMm(ExifData* data, ExifIfd ifd, ExifTag tag) {
  const double unit = Number(data, ifd, tag).value_or(2);
  if (unit == 2) return kMmPerInch;
  if (unit == 3) return 10.0;
  return std::nullopt;
}

std::optional<double> Dpi(ExifData* data) {
  const std::optional<double> x = Number(data, EXIF_IFD_0, EXIF_TAG_X_RESOLUTION);
  const std::optional<double> y = Number(data, EXIF_IFD_0, EXIF_TAG_Y_RESOLUTION);
  const std::optional<double> unit = UnitMm(data, EXIF_IFD_0, EXIF_TAG_RESOLUTION_UNIT);
  if (!x || !y || !unit || *x != *y) return std::nullopt;
  return *x * kMmPerInch / *unit;
}

std::optional<double> FocalPlanePxPerMm(ExifData* data) {
  const auto per_unit = Number(data, EXIF_IFD_EXIF, EXIF_TAG_FOCAL_PLANE_X_RESOLUTION);
  const auto unit = UnitMm(data, EXIF_IFD_EXIF, EXIF_TAG_FOCAL_PLANE_RESOLUTION_UNIT);
  if (!per_unit || !unit) return std::nullopt;
  return *per_unit / *unit;
}

}  // namespace

ExifFacts ReadExif(std::string_view tiff_block) {
  ExifFacts facts;
  if (tiff_block.empty() || tiff_block.size() > kMaxBlock) return facts;
  const ExifPointer data = Parse(tiff_block);
  const std::optional<double> turn = Number(data.get(), EXIF_IFD_0, EXIF_TAG_ORIENTATION);
  if (turn && *turn >= 1 && *turn <= 8) facts.orientation = static_cast<int>(*turn);
  facts.focal_length_35mm = Number(data.get(), EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM);
  facts.focal_length_mm = Number(data.get(), EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH);
  facts.focal_plane_px_per_mm = FocalPlanePxPerMm(data.get());
  facts.focal_plane_width_px = Number(data.get(), EXIF_IFD_EXIF, EXIF_TAG_PIXEL_X_DIMENSION);
  facts.dpi = Dpi(data.get());
  for (const ExifTag tag : {EXIF_TAG_EXPOSURE_TIME,
                            EXIF_TAG_FNUMBER,
                            EXIF_TAG_ISO_SPEED_RATINGS,
                            EXIF_TAG_FOCAL_LENGTH,
                            EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM}) {
    facts.exposure_tags = facts.exposure_tags || Has(data.get(), tag);
  }
  return facts;
}

std::optional<double> FocalLengthPx(const ExifFacts& exif, int width, int height) {
  if (exif.focal_length_35mm) {
    return *exif.focal_length_35mm * std::hypot(width, height) / kFilmDiagonalMm;
  }
  if (!exif.focal_length_mm || !exif.focal_plane_px_per_mm) return std::nullopt;
  // A picture made smaller after it was taken keeps the tags of the large one.
  const double reduction = width / exif.focal_plane_width_px.value_or(width);
  return *exif.focal_length_mm * *exif.focal_plane_px_per_mm * reduction;
}

}  // namespace bladecurve
