// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/export.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>
#include <vector>

#include "model/plugin_parts.h"
#include "model/prepared_blade.h"

namespace bladecurve {
namespace {

// A double literal that reads back exactly.
std::string Literal(double value) {
  std::array<char, 32> buffer;
  std::string text(buffer.data(),
                   std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

// A string literal; everything but plain characters as octal, which no following digit can extend.
std::string Literal(std::string_view value) {
  std::string text = "\"";
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= ' ' && byte <= '~' && c != '"' && c != '\\' && c != '?';
    std::array<char, 8> octal;
    std::snprintf(octal.data(), octal.size(), "\\%03o", static_cast<unsigned>(byte));
    text += plain ? std::string(1, c) : std::string(octal.data());
  }
  return text + '"';
}

// "static const TYPE NAME[] = {..};" with a line for each value; nothing where there are none.
template <typename Values>
std::string ArrayText(const std::string& declaration, const Values& values) {
  if (values.empty()) return "";
  std::string text = "static const " + declaration + "[] = {\n";
  for (const auto& value : values) text += "  " + Literal(value) + ",\n";
  return text + "};\n\n";
}

// The field's value with its name as a comment, in the order of struct BladeKernel.
std::string Field(std::string_view name, const std::string& value) {
  return "  " + value + ", /* " + std::string(name) + " */\n";
}

std::string KernelText(const BladeKernel& kernel) {
  return "static const BladeKernel kBlade = {\n" + Field("x_min", Literal(kernel.x_min)) +
         Field("x_max", Literal(kernel.x_max)) + Field("theta_min", Literal(kernel.theta_min)) +
         Field("theta_max", Literal(kernel.theta_max)) + Field("a", Literal(kernel.a)) +
         Field("b", Literal(kernel.b)) + Field("gain", Literal(kernel.gain)) +
         Field("is_spline", std::to_string(kernel.is_spline)) +
         Field("degree", std::to_string(kernel.degree)) +
         Field("num_rows", std::to_string(kernel.num_rows)) + Field("rows", "kRows") +
         Field("ends", "kEnds") + Field("chord_offset", Literal(kernel.chord_offset)) +
         Field("chord_slope", Literal(kernel.chord_slope)) +
         Field("slope_min", Literal(kernel.slope_min)) +
         Field("slope_max", Literal(kernel.slope_max)) +
         Field("u_slope_min", Literal(kernel.u_slope_min)) +
         Field("u_slope_max", Literal(kernel.u_slope_max)) +
         Field("near_mm", Literal(kernel.near_mm)) + Field("exact_mm", Literal(kernel.exact_mm)) +
         "};\n\n";
}

std::vector<double> KnownOrMinusOne(const std::vector<double>& errors, std::size_t size) {
  std::vector<double> known(size, -1.0);
  for (std::size_t i = 0; i < errors.size() && i < size; ++i) {
    if (errors[i] >= 0) known[i] = errors[i];
  }
  return known;
}

std::string TableText(const BladeFile& blade) {
  const auto* spline = std::get_if<RigidSpline>(&blade.curve.shape());
  const CurveDomain& domain = blade.curve.domain();
  const double rms = blade.fit_rms_mm >= 0 ? blade.fit_rms_mm : -1.0;
  return "const bladecurve_plugin bladecurve_entry = {\n"
         "  BLADECURVE_PLUGIN_VERSION,\n"
         "  sizeof(bladecurve_plugin),\n" +
         Field("id", Literal(blade.name)) + Field("units", "\"mm,rad\"") +
         Field("source_sha256", Literal(blade.source_sha256)) +
         Field("family", spline ? "\"rigid-spline\"" : "\"tapered-rectangle\"") +
         Field("degree", std::to_string(spline ? spline->degree : 0)) +
         Field("num_knots", std::to_string(spline ? spline->knots_mm.size() : 0)) +
         Field("knots_mm", spline ? "kKnots" : "0") +
         Field("num_parameters", std::to_string(ParameterValues(blade.curve.shape()).size())) +
         "  kParameterNames,\n  kParameters,\n  kStandardErrors,\n" +
         Field("fit_rms_mm", Literal(rms)) + Field("x_min_mm", Literal(domain.x_min_mm)) +
         Field("x_max_mm", Literal(domain.x_max_mm)) +
         Field("theta_min_rad", Literal(domain.theta_min_rad)) +
         Field("theta_max_rad", Literal(domain.theta_max_rad)) +
         "  bladecurve_eval,\n  bladecurve_eval_n,\n  bladecurve_contacts,\n};\n\n";
}

std::string DataText(const BladeFile& blade) {
  const BladeShape& shape = blade.curve.shape();
  const auto prepared = PrepareBlade(shape, blade.curve.domain());
  const auto* spline = std::get_if<RigidSpline>(&shape);
  const std::vector<double> values = ParameterValues(shape);
  return ArrayText("double kRows", prepared->rows) + ArrayText("double kEnds", prepared->ends) +
         KernelText(prepared->kernel) +
         ArrayText("double kKnots", spline ? spline->knots_mm : std::vector<double>()) +
         ArrayText("char* const kParameterNames", ParameterNames(shape)) +
         ArrayText("double kParameters", values) +
         ArrayText("double kStandardErrors",
                   KnownOrMinusOne(blade.standard_errors, values.size())) +
         TableText(blade);
}

// A part without its lines that include other parts: they stand above it.
std::string PartText(const PluginPart& part) {
  std::string text;
  std::string_view rest = part.text;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end == std::string_view::npos ? end : end + 1);
    if (!line.starts_with("#include \"")) text += line;
    rest.remove_prefix(line.size());
  }
  return text + "\n";
}

}  // namespace

std::string PluginSource(const BladeFile& blade) {
  std::string text =
      "/* A blade curve as a C plugin, written by bladecurve export. For the same bits as the\n"
      " * library's: cc -std=c99 -O3 -ffp-contract=off -fPIC -shared FILE.c -o FILE.so -lm */\n\n";
  for (const PluginPart& part : kPluginParts) {
    if (part.name == "plugin_body.c") text += DataText(blade);
    text += PartText(part);
  }
  return text;
}

}  // namespace bladecurve
