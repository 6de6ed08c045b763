// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/plugin_file.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "model/blade_plugin.h"

namespace bladecurve {
namespace {

constexpr int kMostNumbers = 1'000'000;  // rejects counts that are no counts
constexpr double kSameRelative =
    1e-9;  // other machines round otherwise; a stale curve is far beyond
constexpr unsigned kFirstVersionSize = sizeof(bladecurve_plugin);

struct CloseLibrary {
  void operator()(void* library) const noexcept { dlclose(library); }
};
using Library = std::unique_ptr<void, CloseLibrary>;

Library Load(const std::filesystem::path& path) {
  Library library(dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL));
  if (!library) {
    const char* why = dlerror();
    throw std::invalid_argument(std::string("cannot be loaded (") +
                                (why ? why : "no reason given") +
                                "); export it again on this machine");
  }
  return library;
}

const bladecurve_plugin& Table(const Library& library) {
  const auto* table =
      static_cast<const bladecurve_plugin*>(dlsym(library.get(), "bladecurve_entry"));
  if (!table) {
    throw std::invalid_argument(
        "has no symbol bladecurve_entry, so it is no blade; make one by bladecurve export --as so");
  }
  if (table->version < BLADECURVE_PLUGIN_VERSION || table->size < kFirstVersionSize) {
    throw std::invalid_argument("its table has version " + std::to_string(table->version) +
                                " and " + std::to_string(table->size) +
                                " bytes, which this program cannot read; export it again");
  }
  return *table;
}

void Require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("its table is broken: " + what + "; export it again");
}

std::vector<double> Numbers(const double* values, int count, const std::string& name) {
  Require(count >= 0 && count <= kMostNumbers && (values || count == 0), "the count of " + name);
  return {values, values + count};
}

BladeShape Shape(const bladecurve_plugin& table) {
  const std::string_view family = table.family ? table.family : "";
  std::vector<double> parameters = Numbers(table.parameters, table.num_parameters, "parameters");
  if (family == "rigid-spline") {
    return RigidSpline{table.degree, Numbers(table.knots_mm, table.num_knots, "knots"), parameters};
  }
  Require(family == "tapered-rectangle", "the family \"" + std::string(family) + "\" is not known");
  Require(parameters.size() == 3, "a tapered rectangle has three parameters");
  return TaperedRectangle{parameters[0], parameters[1], parameters[2]};
}

bool Same(double a, double b) {
  return std::abs(a - b) <= kSameRelative * (1 + std::abs(a) + std::abs(b));
}

// A grid over the domain and a step beyond it.
void CheckValues(const bladecurve_plugin& table, const BladeCurve& curve) {
  const CurveDomain& domain = curve.domain();
  constexpr int kSteps = 8;
  for (int i = -1; i <= kSteps + 1; ++i) {
    for (int j = -1; j <= kSteps + 1; ++j) {
      const double x = domain.x_min_mm + (domain.x_max_mm - domain.x_min_mm) * i / kSteps;
      const double theta =
          domain.theta_min_rad + (domain.theta_max_rad - domain.theta_min_rad) * j / kSteps;
      bladecurve_sample given = {};
      table.eval(x, theta, &given);
      const CurveSample own = curve.Eval(x, theta);
      Require(Same(given.phi_mm, own.phi_mm) && Same(given.phi_x, own.phi_x) &&
                  Same(given.phi_theta_mm_per_rad, own.phi_theta_mm_per_rad),
              "its values are not those of the curve it declares");
    }
  }
}

std::vector<double> KnownOrNan(std::vector<double> values) {
  for (double& value : values) {
    if (!(value >= 0)) value = std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

}  // namespace

BladeFile ReadPluginFile(const std::filesystem::path& path) {
  const Library library = Load(path);
  const bladecurve_plugin& table = Table(library);
  Require(table.id && table.eval, "no name or no eval");
  const BladeCurve curve(
      Shape(table), {table.x_min_mm, table.x_max_mm, table.theta_min_rad, table.theta_max_rad});
  CheckValues(table, curve);
  BladeFile blade = {table.id, curve};
  blade.standard_errors =
      KnownOrNan(Numbers(table.standard_errors, table.num_parameters, "standard errors"));
  blade.fit_rms_mm = KnownOrNan({table.fit_rms_mm}).front();
  blade.source_sha256 = table.source_sha256 ? table.source_sha256 : "";
  return blade;
}

}  // namespace bladecurve
