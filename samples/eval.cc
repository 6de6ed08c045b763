// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/blade_file.h"
#include "model/degrees.h"
#include "samples/commands.h"
#include "samples/flag_values.h"
#include "vision/photo/whole_file.h"

namespace bladecurve {
namespace {

constexpr double kMostRows = 1e7;     // rejects a step that was meant to be larger
constexpr double kWholeSteps = 1e-9;  // this near to a whole number of steps, the end is meant

struct EvalCommand {
  std::string blade, theta_deg, x_mm;
  std::string output = "-";
};

// "A:B:STEP" as the numbers A, A + STEP, ..., with B itself where it falls on a step.
std::vector<double> ParseSteps(const std::string& flag, const std::string& text) {
  std::string commas = text;
  for (char& c : commas) c = c == ':' ? ',' : c;
  const std::vector<double> v = ParseNumbers(flag, commas, 3, "A:B:STEP");
  const double steps = (v[1] - v[0]) / v[2];
  if (!(steps >= 0)) {
    throw std::invalid_argument(fmt::format(
        "{}: '{}' never gets from A to B; give A:B:STEP with a STEP that does", flag, text));
  }
  if (steps > kMostRows) {
    throw std::invalid_argument(
        fmt::format("{}: '{}' has more than {} values; give a larger STEP", flag, text, kMostRows));
  }
  const bool ends_at_b = std::abs(steps - std::round(steps)) <= kWholeSteps;
  const auto last = static_cast<std::size_t>(ends_at_b ? std::round(steps) : std::floor(steps));
  std::vector<double> values(last + 1);
  for (std::size_t i = 0; i <= last; ++i) values[i] = v[0] + static_cast<double>(i) * v[2];
  if (ends_at_b) values[last] = v[1];
  return values;
}

std::string EvalCsv(const BladeCurve& curve, double theta_rad, const std::vector<double>& x_mm) {
  std::string csv = "x_mm,phi_mm,phi_x,phi_theta_mm_per_rad,flags\n";
  for (const double x : x_mm) {
    const CurveSample s = curve.Eval(x, theta_rad);
    fmt::format_to(std::back_inserter(csv),
                   "{},{},{},{},{}\n",
                   x,
                   s.phi_mm,
                   s.phi_x,
                   s.phi_theta_mm_per_rad,
                   s.flags);
  }
  return csv;
}

void Print(const std::string& text) { std::cout << text; }

int RunEval(const EvalCommand& command) {
  const double theta_rad = ParseNumber("--theta-deg", command.theta_deg) * kRadPerDeg;
  const std::vector<double> x_mm = ParseSteps("--x-mm", command.x_mm);
  const std::string csv = EvalCsv(ReadBladeFile(command.blade).curve, theta_rad, x_mm);
  if (command.output == "-") {
    Print(csv);
  } else {
    WriteFileWhole(command.output, csv);
  }
  return kExitOk;
}

}  // namespace

void AddEval(CLI::App& app, int* exit_code) {
  const auto command = std::make_shared<EvalCommand>();
  CLI::App* eval = app.add_subcommand("eval", "Print the cutting edge y = phi(x, theta) as CSV");
  eval->add_option("BLADE", command->blade, "a .blade.json or a .so")->required();
  eval->add_option("--theta-deg", command->theta_deg, "opening angle")->required();
  eval->add_option("--x-mm", command->x_mm, "A:B:STEP, distances from the pivot along the axis")
      ->required();
  eval->add_option("-o,--output", command->output, "where to write; - is standard output");
  eval->callback([command, exit_code] { *exit_code = RunEval(*command); });
}

}  // namespace bladecurve
