// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/fit_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <variant>

#include "samples/blade_record.h"
#include "samples/fitted_photo.h"

namespace bladecurve {
namespace {

constexpr double kDegPerRad = 180 / std::numbers::pi;

std::vector<double> Values(const TaperedRectangle& shape) {
  return {shape.a_mm, shape.b, shape.gain};
}
std::vector<double> Values(const RigidSpline& shape) { return shape.coefficients_mm; }

std::string Form(const TaperedRectangle&) {
  return "tapered-rectangle, phi = a + x (b + gain tan(theta/2))";
}
std::string Form(const RigidSpline& shape) {
  return fmt::format("rigid-spline of degree {}, {} coefficients over u = {:.2f} .. {:.2f}",
                     shape.degree,
                     shape.coefficients_mm.size(),
                     shape.knots_mm.front(),
                     shape.knots_mm.back());
}

// Coefficients by name with the square root of their variance; what was held fixed has none.
std::string CoefficientLines(const FamilyFit& fit) {
  const auto values =
      std::visit([](const auto& shape) { return Values(shape); }, fit.curve.shape());
  std::string lines;
  for (std::size_t i = 0; i < fit.parameter_names.size() && i < values.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double variance = k < fit.covariance.rows() ? fit.covariance(k, k) : 0;
    lines += fmt::format(
        "    {:<8} {:12.6g} +- {:.2g}\n", fit.parameter_names[i], values[i], std::sqrt(variance));
  }
  return lines;
}

std::string CurveLines(const FamilyFit& fit) {
  const auto form = std::visit([](const auto& shape) { return Form(shape); }, fit.curve.shape());
  return fmt::format("  curve    {}\n", form) + CoefficientLines(fit);
}

std::string PhotoLines(const PhotoMeasurement& photo, const FittedPose& pose, const char* unit) {
  const FittedPhoto fitted = ApplyPose(photo, pose);
  return fmt::format("  {}\n", photo.file) +
         fmt::format("    theta  {:.3f} +- {:.3f} deg ({})\n",
                     fitted.theta_rad * kDegPerRad,
                     fitted.theta_sigma_rad * kDegPerRad,
                     photo.theta_source) +
         fmt::format("    pivot  {:.2f}, {:.2f} px +- {:.2g} ({})\n",
                     fitted.pivot_px.x(),
                     fitted.pivot_px.y(),
                     fitted.pivot_sigma_px,
                     photo.pivot_source) +
         fmt::format("    scale  {:.6g} {}/px ({})\n", photo.mm_per_px, unit, photo.scale_source);
}

}  // namespace

std::string StatusLine(const Analysis& analysis, const std::string& name) {
  const std::vector<std::string> warnings = Warnings(analysis);
  if (warnings.empty()) return name + ": ok";
  return fmt::format("{}: review: {}", name, fmt::join(warnings, ", "));
}

std::string FitSummaryText(const Analysis& analysis, bool pixels) {
  const char* unit = pixels ? "px" : "mm";
  const FamilyFit& fit = analysis.fit.recommended;
  std::string text = CurveLines(fit);
  text += fmt::format(
      "  misfit   {:.2g} {} rms, {} of {} points\n", fit.rms_mm, unit, fit.inliers, fit.points);
  for (std::size_t i = 0; i < analysis.photos.size(); ++i) {
    text += PhotoLines(analysis.photos[i], analysis.fit.poses[i], unit);
  }
  return text;
}

}  // namespace bladecurve
