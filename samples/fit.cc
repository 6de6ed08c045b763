// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "samples/analysis.h"
#include "samples/analysis_flags.h"
#include "samples/blade_record.h"
#include "samples/commands.h"
#include "samples/fit_overlay.h"
#include "samples/fit_summary.h"
#include "samples/refusal.h"
#include "vision/photo/png_writer.h"
#include "vision/photo/whole_file.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

struct FitCommand {
  std::vector<std::string> photos;
  AnalysisFlags analysis;
  std::string name, json, overlay, report;
  bool quiet = false, no_times = false;
};

// -o NAME with or without the ending, or a folder; without -o the current folder. In a folder the
// file is named after the first photograph.
std::string OutputName(const FitCommand& command) {
  const std::string stem = fs::path(command.photos.front()).stem().string();
  if (command.name.empty()) return stem;
  if (command.name.ends_with('/') || fs::is_directory(command.name)) {
    return (fs::path(command.name) / stem).string();
  }
  std::string name = command.name;
  for (const std::string_view ending : {".json", ".blade"}) {
    if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  }
  const std::string last = fs::path(name).filename().string();
  if (last.empty() || last == "-") {
    throw std::invalid_argument(
        fmt::format("-o: '{}' is no name for files; standard output takes --json -", command.name));
  }
  return name;
}

bool WritesFiles(const FitCommand& command) { return command.json != "-" || !command.name.empty(); }

bool DrawsOverlays(const FitCommand& command) {
  return WritesFiles(command) || !command.overlay.empty();
}

// NAME.overlay.png, or NAME.1.overlay.png, NAME.2.overlay.png ... for several photographs.
std::vector<fs::path> OverlayPaths(const FitCommand& command, const std::string& name) {
  const fs::path given =
      command.overlay.empty() ? fs::path(name + ".overlay.png") : fs::path(command.overlay);
  if (command.photos.size() == 1) return {given};
  const std::string ending = command.overlay.empty() ? ".overlay.png" : given.extension().string();
  const std::string base = given.string().substr(0, given.string().size() - ending.size());
  std::vector<fs::path> paths;
  for (std::size_t i = 1; i <= command.photos.size(); ++i) {
    paths.emplace_back(fmt::format("{}.{}{}", base, i, ending));
  }
  return paths;
}

// What will be written, in the order in which it is.
struct Outputs {
  std::optional<fs::path> record;
  std::vector<fs::path> overlays;

  [[nodiscard]] std::vector<fs::path> All() const {
    std::vector<fs::path> all = overlays;
    if (record) all.insert(all.begin(), *record);
    return all;
  }
};

Outputs OutputsOf(const FitCommand& command) {
  const std::string name = OutputName(command);
  Outputs outputs;
  if (WritesFiles(command)) outputs.record = name + ".blade.json";
  if (DrawsOverlays(command)) outputs.overlays = OverlayPaths(command, name);
  return outputs;
}

// A photograph that an output would replace is lost for ever.
void RequireOtherThanPhotos(const FitCommand& command, const fs::path& output) {
  std::error_code ignored;
  for (const std::string& photo : command.photos) {
    if (!fs::equivalent(output, photo, ignored)) continue;
    throw std::invalid_argument(
        fmt::format("{} is a photograph to be read; write to another name", output.string()));
  }
}

// Impossible wishes are refused before any work is done.
void RequirePossible(const FitCommand& command) {
  if (!command.json.empty() && command.json != "-") {
    throw std::invalid_argument(
        "--json: takes '-', standard output; -o NAME writes NAME.blade.json");
  }
  if (!command.report.empty()) {
    throw std::invalid_argument("--report: this version writes no report; use --overlay FILE.png");
  }
  if (!command.overlay.empty() && fs::path(command.overlay).extension() != ".png") {
    throw std::invalid_argument(
        fmt::format("--overlay: writes a PNG; '{}' does not end in .png", command.overlay));
  }
  for (const fs::path& output : OutputsOf(command).All()) {
    RequireOtherThanPhotos(command, output);
    RequireWritable(output);
  }
}

void Report(const FitCommand& command,
            const Analysis& analysis,
            const std::vector<fs::path>& written) {
  std::cout << StatusLine(analysis, command.photos.front()) << '\n'
            << FitSummaryText(analysis, command.analysis.units == "px");
  for (const fs::path& path : written) std::cout << "  wrote    " << path.string() << '\n';
}

void Deliver(const FitCommand& command, const Analysis& analysis) {
  const std::string name = fs::path(OutputName(command)).filename().string();
  const std::string record = BladeRecordText(analysis, {name, !command.no_times});
  const Outputs outputs = OutputsOf(command);
  if (outputs.record) WriteFileWhole(*outputs.record, record);
  for (std::size_t i = 0; i < outputs.overlays.size(); ++i)
    WritePng(outputs.overlays[i], DrawFitOverlay(analysis, i));
  if (command.json == "-") {
    std::cout << record;
  } else if (!command.quiet) {
    Report(command, analysis, outputs.All());
  }
}

int RunFit(const FitCommand& command) {
  RequirePossible(command);
  AnalysisSettings settings = SettingsFromFlags(command.analysis);
  settings.measure.keep_photo = DrawsOverlays(command);
  const std::vector<fs::path> photos(command.photos.begin(), command.photos.end());
  try {
    Deliver(command, AnalyzeScissors(photos, settings));
    return kExitOk;
  } catch (const PhotoRefused& refusal) {
    std::cout << RefusalText(refusal, refusal.photo()) << '\n';
    std::cerr << "bladecurve fit: " << refusal.what() << '\n';
    return kExitRefused;
  }
}

}  // namespace

void AddFit(CLI::App& app, int* exit_code) {
  const auto command = std::make_shared<FitCommand>();
  CLI::App* fit =
      app.add_subcommand("fit", "Photographs of one pair of scissors in, blade curve out");
  fit->add_option("PHOTO", command->photos, "The same scissors, at one or several angles")
      ->required();
  AddAnalysisFlags(*fit, &command->analysis);
  fit->add_option("--debug",
                  command->analysis.debug,
                  "Write a picture of every stage into this folder; of several photographs into a "
                  "folder of it each");
  fit->add_option(
      "--threads", command->analysis.threads, "How many photographs, or parts of one, at a time");
  fit->add_option("-o,--output",
                  command->name,
                  "Write NAME.blade.json and NAME.overlay.png (default: the photograph's name)");
  fit->add_option(
      "--json", command->json, "'-': the result on standard output, no files unless -o is given");
  fit->add_option("--overlay", command->overlay, "FILE.png: another place for the overlay picture");
  fit->add_option("--report", command->report, "A page with all figures (not in this version)");
  fit->add_flag("--quiet", command->quiet, "Print nothing but refusals and errors");
  fit->add_flag("--no-times", command->no_times, "Leave times out: same input, same bytes");
  fit->callback([command, exit_code] { *exit_code = RunFit(*command); });
}

}  // namespace bladecurve
