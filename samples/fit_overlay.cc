// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/fit_overlay.h"

#include <filesystem>
#include <stdexcept>

#include "samples/blade_record.h"
#include "samples/fit_summary.h"
#include "samples/fitted_photo.h"
#include "vision/overlay/overlay.h"
#include "vision/scale/scale.h"

namespace bladecurve {

cv::Mat DrawFitOverlay(const Analysis& analysis, std::size_t index) {
  const PhotoMeasurement& photo = analysis.photos[index];
  if (!photo.photo) throw std::invalid_argument("DrawFitOverlay: the photograph was not kept");
  const FittedPhoto fitted = ApplyPose(photo, analysis.fit.poses[index]);
  Overlay overlay;
  overlay.upper_edge_px = photo.upper_edge_px;
  overlay.fitted_edge_px = FittedEdgePx(photo, fitted, analysis.fit.recommended.curve);
  overlay.lower_edge_px = photo.lower_edge_px;
  overlay.upper_end_px = photo.upper_end_px;
  overlay.lower_end_px = photo.lower_end_px;
  overlay.pivot_px = fitted.pivot_px;
  overlay.pivot_sigma_px = fitted.pivot_sigma_px;
  overlay.axis_px = fitted.axis_px;
  overlay.theta_rad = fitted.theta_rad;
  overlay.theta_sigma_rad = fitted.theta_sigma_rad;
  overlay.unit_per_px = fitted.mm_per_px;
  overlay.unit = photo.scale_source == kPixelsSource ? "px" : "mm";
  overlay.title = StatusLine(analysis, std::filesystem::path(photo.file).filename().string());
  overlay.doubtful = Status(analysis) != "ok";
  return DrawOverlay(*photo.photo, overlay);
}

}  // namespace bladecurve
