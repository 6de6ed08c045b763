// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/blade_file.h"

namespace bladecurve {
namespace {

// JSON knows neither NaN nor Inf.
std::string Text(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

// Broken UTF-8, which a plugin's name may hold, is replaced.
std::string Text(const std::string& value) {
  return nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

template <typename Values>
std::string ListText(const Values& values) {
  std::string text = "[";
  for (const auto& value : values) {
    if (text.size() > 1) text += ',';
    text += Text(value);
  }
  return text + "]";
}

std::string CurveText(const TaperedRectangle& shape) {
  return R"({"family":"tapered-rectangle","a_mm":)" + Text(shape.a_mm) + ",\"b\":" + Text(shape.b) +
         ",\"gain\":" + Text(shape.gain) + "}";
}

std::string CurveText(const RigidSpline& shape) {
  return R"({"family":"rigid-spline","degree":)" + std::to_string(shape.degree) +
         ",\"knots_mm\":" + ListText(shape.knots_mm) +
         ",\"coefficients_mm\":" + ListText(shape.coefficients_mm) + "}";
}

std::string DomainText(const CurveDomain& domain) {
  return "{\"x_mm\":" + ListText(std::array{domain.x_min_mm, domain.x_max_mm}) +
         ",\"theta_rad\":" + ListText(std::array{domain.theta_min_rad, domain.theta_max_rad}) + "}";
}

std::string CovarianceText(const BladeFile& blade, const std::vector<std::string>& names) {
  std::string rows;
  for (auto row = blade.covariance.begin(); row != blade.covariance.end();
       row += static_cast<std::ptrdiff_t>(names.size())) {
    if (!rows.empty()) rows += ',';
    rows += ListText(std::vector<double>(row, row + static_cast<std::ptrdiff_t>(names.size())));
  }
  return "{\"parameters\":" + ListText(names) + ",\"matrix\":[" + rows + "]}";
}

// Of the parameters whose standard error is known; empty if there are none.
std::string StandardErrorsText(const BladeFile& blade, const std::vector<std::string>& names) {
  std::string members;
  for (std::size_t i = 0; i < blade.standard_errors.size(); ++i) {
    if (!std::isfinite(blade.standard_errors[i])) continue;
    if (!members.empty()) members += ',';
    members += Text(names[i]) + ":" + Text(blade.standard_errors[i]);
  }
  return members.empty() ? "" : "{" + members + "}";
}

}  // namespace

std::string BladeFileText(const BladeFile& blade) {
  const std::vector<std::string> names = ParameterNames(blade.curve.shape());
  const std::string errors = StandardErrorsText(blade, names);
  std::string text = "{\n\"format\": \"bladecurve/1\"";
  const auto add = [&text](const char* key, const std::string& value) {
    text += std::string(",\n\"") + key + "\": " + value;
  };
  add("name", Text(blade.name));
  add("status", Text(blade.status));
  add("warnings", ListText(blade.warnings));
  if (blade.in_pixels) add("units", Text(std::string("px")));
  add("curve", std::visit([](const auto& s) { return CurveText(s); }, blade.curve.shape()));
  add("domain", DomainText(blade.curve.domain()));
  if (!blade.covariance.empty()) {
    add("covariance", CovarianceText(blade, names));
  } else if (!errors.empty()) {
    add("standard_errors", errors);
  }
  if (std::isfinite(blade.fit_rms_mm)) add("fit", "{\"rms_mm\":" + Text(blade.fit_rms_mm) + "}");
  return text + "\n}\n";
}

}  // namespace bladecurve
