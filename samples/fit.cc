// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "samples/analysis.h"
#include "samples/analysis_flags.h"
#include "samples/blade_record.h"
#include "samples/commands.h"
#include "samples/fit_overlay.h"
#include "samples/fit_summary.h"
#include "samples/output_files.h"
#include "samples/refusal.h"
#include "vision/photo/png_writer.h"

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
  const std::string ending = ".blade.json";
  const bool ends = command.name.ends_with(ending);
  return ends ? command.name.substr(0, command.name.size() - ending.size()) : command.name;
}

bool WritesFiles(const FitCommand& command) { return command.json != "-" || !command.name.empty(); }

bool DrawsOverlays(const FitCommand& command) {
  return WritesFiles(command) || !command.overlay.empty();
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

void WriteOverlays(const Analysis& analysis, const std::vector<fs::path>& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i) WritePng(paths[i], DrawFitOverlay(analysis, i));
}

void Report(const FitCommand& command,
            const Analysis& analysis,
            const std::vector<fs::path>& written) {
  std::cout << StatusLine(analysis, command.photos.front()) << '\n'
            << FitSummaryText(analysis, command.analysis.units == "px");
  for (const fs::path& path : written) std::cout << "  wrote    " << path.string() << '\n';
}

void Deliver(const FitCommand& command, const Analysis& analysis) {
  const std::string name = OutputName(command);
  const std::string record =
      BladeRecordText(analysis, {fs::path(name).filename().string(), !command.no_times});
  std::vector<fs::path> written;
  if (WritesFiles(command)) {
    written.emplace_back(name + ".blade.json");
    WriteFileWhole(written.back(), record);
  }
  if (DrawsOverlays(command)) {
    const std::vector<fs::path> overlays = OverlayPaths(command, name);
    WriteOverlays(analysis, overlays);
    written.insert(written.end(), overlays.begin(), overlays.end());
  }
  if (command.json == "-") {
    std::cout << record;
  } else if (!command.quiet) {
    Report(command, analysis, written);
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
  fit->add_option("-o",
                  command->name,
                  "Write NAME.blade.json and NAME.overlay.png (default: the photograph's name)");
  fit->add_option(
      "--json", command->json, "'-': the result on standard output, no files unless -o is given");
  fit->add_option("--overlay", command->overlay, "Another place for the overlay picture");
  fit->add_option("--report", command->report, "A page with all figures (not in this version)");
  fit->add_flag("--quiet", command->quiet, "Print nothing but refusals and errors");
  fit->add_flag("--no-times", command->no_times, "Leave times out: same input, same bytes");
  fit->callback([command, exit_code] { *exit_code = RunFit(*command); });
}

}  // namespace bladecurve
