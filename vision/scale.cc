// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "vision/marker_corners.h"
#include "vision/refused.h"
#include "vision/sheet_scale.h"

namespace bladecurve {
namespace {

constexpr double kMmPerInch = 25.4;
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

// The corners' own sigma knows of noise, not of the raster of the print or of paper that is not
// quite flat.
constexpr double kPaperSigmaPx = 0.015;

SquareObservation Observe(const SeenMarker& marker) {
  return {marker.corners_px, std::hypot(marker.corner_sigma_px, kPaperSigmaPx), std::nullopt};
}

std::vector<SeenMarker> Located(const std::vector<SeenMarker>& markers) {
  std::vector<SeenMarker> located;
  std::copy_if(
      markers.begin(), markers.end(), std::back_inserter(located), [](const SeenMarker& m) {
        return std::isfinite(m.corner_sigma_px);
      });
  return located;
}

[[noreturn]] void RefuseMarkers(bool seen) {
  throw Refused(Reason::kNoScale,
                seen ? "scale: a marker is seen, but not its four sides; keep it uncovered, sharp "
                       "and not overexposed"
                     : "scale: no marker of DICT_4X4_50 is seen; keep it whole in the picture, "
                       "uncovered and with white "
                       "paper around it");
}

// Markers located again with the lens that the first solution found: it bends their sides.
SheetSolution SolveWithLens(const Photo& photo, const SheetProblem& problem, ScaleResult* result) {
  const SheetSolution first = SolveSheet(problem);
  SheetProblem again = problem;
  result->markers = RelocateMarkers(photo.grey(), result->tone, result->markers, first.pose.camera);
  const std::vector<SeenMarker> located = Located(result->markers);
  for (size_t i = 0; i < located.size(); ++i) {
    again.squares[i].corners_px = located[i].corners_px;
  }
  return SolveSheet(again);
}

PlaneMap FromMarkers(const Photo& photo, const ScaleOptions& options, ScaleResult* result) {
  const std::vector<SeenMarker> located = Located(result->markers);
  if (located.empty()) RefuseMarkers(!result->markers.empty());
  SheetProblem problem;
  problem.side_mm = *options.marker_mm;
  problem.knowledge = KnowCamera(photo, options);
  for (const SeenMarker& marker : located) problem.squares.push_back(Observe(marker));
  return SheetMap(SolveWithLens(photo, problem, result),
                  {options.plane_height_mm, photo.grey().cols, photo.grey().rows, "marker"});
}

}  // namespace

ScaleResult FindScale(const Photo& photo, const ScaleOptions& options) {
  CheckOptions(options);
  ScaleResult result;
  result.tone = SrgbToneCurve();
  if (options.length_mm) return result;
  if (options.pixels) result.map = PlaneMap::Uniform(1, 0, "pixels");
  if (options.mm_per_px) result.map = PlaneMap::Uniform(*options.mm_per_px, 0, "mm-per-px");
  if (options.marker_mm) {
    result.markers = FindMarkers(photo.grey(), result.tone, MarkerEffort::kThorough);
    result.map = FromMarkers(photo, options, &result);
  }
  if (options.dpi) result.map = FromDpi(*options.dpi, "dpi");
  if (!result.map && photo.metadata().dpi) {
    result.map = FromDpi(*photo.metadata().dpi, "file-dpi").WithWarnings({"scale_from_file_dpi"});
  }
  if (!result.map) RefuseWithoutScale();
  return result;
}

}  // namespace bladecurve
