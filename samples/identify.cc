// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/identify.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "samples/commands.h"
#include "samples/flag_values.h"
#include "samples/identify_record.h"
#include "vision/photo/whole_file.h"

namespace bladecurve {
namespace {

struct IdentifyCommand {
  std::vector<std::string> cuts, empties;
  std::string blade, name = "identified", output = "-";
  double thickness_mm = 0, x_edge_mm = 0, x_end_mm = 0;
  std::optional<double> radius_mm;
  bool quiet = false;
};

// A log given twice would pass for two cuts that agree perfectly.
void RequireDistinct(const char* flag, std::vector<std::string> files) {
  std::sort(files.begin(), files.end());
  const auto twice = std::adjacent_find(files.begin(), files.end());
  if (twice != files.end())
    throw std::invalid_argument(std::string(flag) + ": " + *twice + " is given twice");
}

IdentifyInput InputOf(const IdentifyCommand& command) {
  RequireDistinct("--cut", command.cuts);
  RequireDistinct("--empty", command.empties);
  RequirePositive("--thickness-mm", command.thickness_mm);
  RequirePositive("--x-edge-mm", command.x_edge_mm);
  if (command.radius_mm) RequirePositive("--radius-mm", *command.radius_mm);
  const double radius_mm = command.radius_mm.value_or(std::numeric_limits<double>::quiet_NaN());
  IdentifyInput input{{},
                      {},
                      ReadBladeFile(command.blade),
                      {command.x_edge_mm, command.x_end_mm},
                      command.thickness_mm};
  RequireMillimetres(input.blade);
  for (const std::string& file : command.cuts) input.cuts.push_back(ReadForceLog(file, radius_mm));
  for (const std::string& file : command.empties)
    input.empties.push_back(ReadForceLog(file, radius_mm));
  return input;
}

void Deliver(const IdentifyCommand& command, const std::string& text) {
  if (command.output == "-") {
    std::cout << text;
  } else {
    WriteFileWhole(command.output, text);
  }
}

int RunIdentify(const IdentifyCommand& command) {
  try {
    const IdentifyInput input = InputOf(command);
    const Identification found = IdentifyMaterial(input);
    if (!command.quiet) std::cerr << IdentificationSummary(found);
    Deliver(command, MaterialFileText(found, input, command.name));
    return kExitOk;
  } catch (const LogRefused& refusal) {
    std::cout << LogRefusalText(refusal) << '\n';
    std::cerr << "bladecurve identify: " << refusal.what() << '\n';
    return kExitRefused;
  }
}

}  // namespace

void AddIdentify(CLI::App& app, int* exit_code) {
  const auto command = std::make_shared<IdentifyCommand>();
  CLI::App* sub = app.add_subcommand(
      "identify", "Find toughness and stiffness of a material in logs of its cuts");
  sub->add_option("--cut",
                  command->cuts,
                  "CSV of each cut, one closing a file: theta_deg; force_n or torque_nmm; perhaps "
                  "t_s")
      ->required();
  sub->add_option("--empty", command->empties, "the same of the empty scissors: friction")
      ->required();
  sub->add_option("--blade", command->blade, "NAME.blade.json, or a plugin exported from one")
      ->required();
  sub->add_option("--thickness-mm", command->thickness_mm, "of the plate")->required();
  sub->add_option("--x-edge-mm", command->x_edge_mm, "from the pivot to where the plate began")
      ->required();
  sub->add_option("--x-end-mm", command->x_end_mm, "to where it ended")->required();
  sub->add_option("--radius-mm",
                  command->radius_mm,
                  "from the pivot to the force sensor, if force_n is logged");
  sub->add_option("--name", command->name, "of the material")->capture_default_str();
  sub->add_option("-o,--output",
                  command->output,
                  "material file to write, for torque --material; - is standard output");
  sub->add_flag("--quiet", command->quiet, "no summary");
  sub->callback([command, exit_code] { *exit_code = RunIdentify(*command); });
}

}  // namespace bladecurve
