// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/fit_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "model/blade_file.h"
#include "model/degrees.h"
#include "samples/blade_record.h"
#include "samples/doubts.h"
#include "samples/fitted_photo.h"

namespace bladecurve {
namespace {

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

// Square root of the parameter's variance; NaN for what was held fixed.
double StandardError(const FamilyFit& fit, const std::string& parameter) {
  const auto found = std::find(fit.parameter_names.begin(), fit.parameter_names.end(), parameter);
  const auto index = static_cast<Eigen::Index>(found - fit.parameter_names.begin());
  if (found == fit.parameter_names.end() || index >= fit.covariance.rows()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::sqrt(fit.covariance(index, index));
}

std::string CoefficientLines(const FamilyFit& fit) {
  const std::vector<std::string> names = ParameterNames(fit.curve.shape());
  const std::vector<double> values = ParameterValues(fit.curve.shape());
  std::string lines;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double error = StandardError(fit, names[i]);
    lines += fmt::format("    {:<8} {:12.6g}", names[i], values[i]);
    lines += std::isnan(error) ? " (held)\n" : fmt::format(" +- {:.2g}\n", error);
  }
  return lines;
}

std::string DoubtLines(const Analysis& analysis) {
  std::string lines;
  for (const std::string& code : Warnings(analysis))
    lines += fmt::format("  doubt    {}: {}\n", code, MeaningOfDoubt(code));
  return lines;
}

std::string CurveLines(const FamilyFit& fit) {
  const auto form = std::visit([](const auto& shape) { return Form(shape); }, fit.curve.shape());
  return fmt::format("  curve    {}\n", form) + CoefficientLines(fit);
}

// Where it was given, what the photograph says as well.
std::string ThetaSource(const PhotoMeasurement& photo) {
  if (photo.theta_source != "given") return photo.theta_source;
  return fmt::format("given; the distal ends say {:.3f} +- {:.3f}",
                     photo.seen_theta_rad * kDegPerRad,
                     photo.seen_theta_sigma_rad * kDegPerRad);
}

// A scale that was given is what it is.
std::string ScaleText(const FittedPhoto& fitted, const PhotoMeasurement& photo, const char* unit) {
  constexpr double kRounding = 1e-9;
  const double sigma = photo.mm_per_px_sigma;
  const std::string error =
      sigma > kRounding * fitted.mm_per_px ? fmt::format(" +- {:.2g}", sigma) : "";
  return fmt::format("{:.6g}{} {}/px ({})", fitted.mm_per_px, error, unit, photo.scale_source);
}

std::string PhotoLines(const PhotoMeasurement& photo, const FittedPose& pose, const char* unit) {
  const FittedPhoto fitted = ApplyPose(photo, pose);
  return fmt::format("  {}\n", photo.file) +
         fmt::format("    theta  {:.3f} +- {:.3f} deg ({})\n",
                     fitted.theta_rad * kDegPerRad,
                     fitted.theta_sigma_rad * kDegPerRad,
                     ThetaSource(photo)) +
         fmt::format("    pivot  {:.2f}, {:.2f} px +- {:.2g} ({})\n",
                     fitted.pivot_px.x(),
                     fitted.pivot_px.y(),
                     fitted.pivot_sigma_px,
                     photo.pivot_source) +
         fmt::format("    scale  {}\n", ScaleText(fitted, photo, unit));
}

const char* OtherFamily(const BladeFit& fit) {
  const bool tapered = std::holds_alternative<TaperedRectangle>(fit.recommended.curve.shape());
  return tapered ? "rigid-spline" : "tapered-rectangle";
}

// Why this family, how far the other one is from it, and what the photographs say themselves.
std::string FamilyLines(const BladeFit& fit, const char* unit) {
  const FamilyDifference& d = fit.difference;
  std::string text = fmt::format("  family   {}\n", fit.why_recommended);
  text += fmt::format("    {} differs by up to {:.2g} {} at the photographed angle{}\n",
                      OtherFamily(fit),
                      d.photographed_mm,
                      unit,
                      fit.poses.size() > 1 ? "s" : "");
  if (d.near_closing_theta_rad > 0) {
    text += fmt::format("    and by {:.2g} {} and {:.0f} % of torque near closing, at {:.3g} deg\n",
                        d.near_closing_mm,
                        unit,
                        100 * d.near_closing_torque,
                        d.near_closing_theta_rad * kDegPerRad);
  }
  if (!std::isnan(fit.gain.gain)) {
    text += fmt::format(
        "    gain of the photographs {:.3f} +- {:.2g} (the paper: 0.5; a rigid turn: about 1)\n",
        fit.gain.gain,
        fit.gain.sigma);
  }
  return text;
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
  std::string text = DoubtLines(analysis) + CurveLines(fit);
  text += fmt::format(
      "  misfit   {:.2g} {} rms, {} of {} points\n", fit.rms_mm, unit, fit.inliers, fit.points);
  text += FamilyLines(analysis.fit, unit);
  for (std::size_t i = 0; i < analysis.photos.size(); ++i) {
    text += PhotoLines(analysis.photos[i], analysis.fit.poses[i], unit);
  }
  return text;
}

}  // namespace bladecurve
