// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/scale.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "vision/image/robust_statistics.h"
#include "vision/refused.h"
#include "vision/scale/sheet_scale.h"

namespace bladecurve {
namespace {

// Flatbed scanners keep their stated resolution to a few parts in a thousand.
constexpr double kScannerRelativeSigma = 0.002;

void CheckPositive(const std::optional<double>& value, const char* field) {
  if (value && (!(*value > 0) || !std::isfinite(*value))) {
    throw std::invalid_argument(std::string("scale: ") + field + " must be positive, not " +
                                std::to_string(*value));
  }
}

void CheckOptions(const ScaleOptions& options) {
  CheckPositive(options.mm_per_px, "mm_per_px");
  CheckPositive(options.dpi, "dpi");
  CheckPositive(options.length_mm, "length_mm");
  CheckPositive(options.marker_mm, "marker_mm");
  CheckPositive(options.print_scale, "print_scale");
  const int given = options.mm_per_px.has_value() + options.dpi.has_value() +
                    options.length_mm.has_value() + options.marker_mm.has_value() +
                    options.card.has_value() + (options.pixels ? 1 : 0);
  if (given > 1) {
    throw std::invalid_argument(
        "scale: give only one of mm_per_px, dpi, length_mm, marker_mm, card and pixels");
  }
  const bool no_sheet = options.mm_per_px || options.dpi || options.length_mm || options.pixels;
  if (no_sheet && (options.plane_height_mm || options.print_scale != 1))
    throw std::invalid_argument("scale: plane_height_mm and print_scale are a sheet's");
  if (options.camera && (options.dpi || options.pixels))
    throw std::invalid_argument("scale: camera says nothing about a scan, or pixels");
}

PlaneMap FromDpi(double dpi, const std::string& source) {
  return PlaneMap::Uniform(kMmPerInch / dpi, kScannerRelativeSigma, source);
}

[[noreturn]] void RefuseWithoutScale() {
  throw Refused(Reason::kNoScale,
                "scale: nothing says how many mm a pixel is; print a card (bladecurve card) and "
                "lay the scissors on "
                "it, or give --mm-per-px, --dpi, --length-mm or --marker-mm, or --units px");
}

// What is said of a printed sheet is to be used, not passed over.
bool NeedsSheet(const ScaleOptions& options) {
  return options.print_scale != 1 || options.plane_height_mm || options.camera;
}

// The map that needs no marker, if the options or the file say one.
std::optional<PlaneMap> UniformMap(const Photo& photo,
                                   const ScaleOptions& options,
                                   const std::optional<CameraKnowledge>& camera) {
  if (options.pixels) return PlaneMap::Uniform(1, 0, kPixelsSource);
  if (options.mm_per_px)
    return PlaneMap::Uniform(*options.mm_per_px, 0, "mm-per-px", camera->camera);
  if (options.dpi) return FromDpi(*options.dpi, "dpi");
  if (!photo.metadata().dpi || NeedsSheet(options)) return std::nullopt;
  return FromDpi(*photo.metadata().dpi, "file-dpi").WithWarnings({"scale_from_file_dpi"});
}

bool SaysUniform(const ScaleOptions& options) {
  return options.pixels || options.mm_per_px || options.dpi;
}

}  // namespace

std::optional<double> PrintBlurPx(const std::vector<SeenMarker>& markers) {
  std::vector<double> blurs;
  for (const SeenMarker& marker : markers) {
    if (std::isfinite(marker.blur_px)) blurs.push_back(marker.blur_px);
  }
  if (blurs.empty()) return std::nullopt;
  return Median(std::move(blurs));
}

ScaleResult FindScale(const Photo& photo, const ScaleOptions& options) {
  CheckOptions(options);
  ScaleResult result;
  result.tone = SrgbToneCurve();
  if (options.length_mm) {
    result.camera = KnowCamera(photo, options.camera);
    return result;
  }
  if (options.marker_mm) return ScaleFromLooseMarkers(photo, options);
  if (options.card) return ScaleFromCard(photo, options);
  if (!SaysUniform(options)) {
    std::optional<ScaleResult> card = ScaleFromCardIfSeen(photo, options);
    if (card) return *std::move(card);
  }
  if (options.mm_per_px || options.pixels) result.camera = KnowCamera(photo, options.camera);
  result.map = UniformMap(photo, options, result.camera);
  if (!result.map) RefuseWithoutScale();
  return result;
}

}  // namespace bladecurve
