// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/sheet_scale.h"

#include <algorithm>
#include <cmath>

namespace bladecurve {
namespace {

// Standard uncertainties of what is known beforehand.
constexpr double kCalibratedFocal = 0.002,
                 kCalibratedK1 = 0.002;  // a careful calibration, refocused since
constexpr double kExifFocal =
    0.03;  // whole millimetres of some 28, and the crop that stabilisation takes
constexpr double kUnknownFocal =
    0.6;  // 0.65 to 2.2 times the long side covers phones to short telephoto lenses
constexpr double kUnknownFocalPerSide = 1.2;
constexpr double kUnknownK1 = 0.02;  // cameras correct their lenses to half a percent at the corner

constexpr double kGivenHeightMm = 0.1;    // of a height measured with a caliper or a ruler
constexpr double kUnknownHeightMm = 2.0;  // cutting edges lie 0.5 to 4 mm above the table

std::vector<Eigen::Vector2d> InnerGrid(int width, int height) {
  std::vector<Eigen::Vector2d> places;
  for (const double y : {0.25, 0.5, 0.75}) {
    for (const double x : {0.25, 0.5, 0.75}) places.emplace_back(x * width, y * height);
  }
  return places;
}

std::vector<std::string> Warnings(const SheetSolution& solution, const SheetMapOptions& options) {
  // Nearer than this, a blade 2 mm above the sheet looks 0.8 % larger than what lies on it.
  constexpr double kNearMm = 250;
  // A sheet bowed by 1 mm moves corners by some pixels; tone and paper stay below a third of a
  // pixel.
  constexpr double kBentPx = 0.5, kBentChi2 = 4;
  constexpr double kFocalKnown = 0.15;
  std::vector<std::string> warnings;
  const bool focal_known = solution.log_focal_sigma < kFocalKnown;
  if (solution.surplus <= 0) warnings.emplace_back("scale_four_corners");
  if (solution.rms_px > kBentPx && solution.reduced_chi2 > kBentChi2)
    warnings.emplace_back("sheet_bent");
  if (focal_known && solution.pose.CameraHeightMm() < kNearMm) warnings.emplace_back("camera_near");
  if (!focal_known && options.plane_height_mm.value_or(0) != 0)
    warnings.emplace_back("camera_unknown");
  return warnings;
}

}  // namespace

CameraKnowledge KnowCamera(const Photo& photo, const ScaleOptions& options) {
  const int width = photo.grey().cols, height = photo.grey().rows;
  if (options.camera)
    return {ReadCamera(*options.camera, width, height), kCalibratedFocal, kCalibratedK1};
  const std::optional<double> exif = photo.metadata().focal_length_px;
  if (exif) return {CentredCamera(*exif, width, height), kExifFocal, kUnknownK1};
  const double guess = kUnknownFocalPerSide * std::max(width, height);
  return {CentredCamera(guess, width, height), kUnknownFocal, kUnknownK1};
}

PlaneMap SheetMap(const SheetSolution& solution, const SheetMapOptions& options) {
  const double height_mm = options.plane_height_mm.value_or(0);
  const LengthPlace place{InnerGrid(options.width, options.height),
                          height_mm,
                          options.plane_height_mm ? kGivenHeightMm : kUnknownHeightMm};
  return PlaneMap::FromGeometry(
             solution.pose.PlaneAtHeight(height_mm), RelativeSigma(solution, place), options.source)
      .WithWarnings(Warnings(solution, options));
}

}  // namespace bladecurve
