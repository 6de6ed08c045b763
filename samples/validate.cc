// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/scratch_folder.h"
#include "samples/commands.h"
#include "samples/validate_blade.h"
#include "samples/validation_plot.h"
#include "samples/validation_run.h"
#include "samples/validation_scene.h"
#include "samples/validation_table.h"
#include "vision/parallel.h"
#include "vision/photo/whole_file.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

struct ValidateCommand {
  int scenes = 50;
  std::uint64_t seed = 1;
  std::string difficulty = "standard", blade, photographs, csv, plot;
  int threads = 1;
  bool quiet = false, no_times = false;
};

const std::map<std::string, Difficulty>& Difficulties() {
  static const std::map<std::string, Difficulty> difficulties = {
      {"clean", Difficulty::kClean},
      {"standard", Difficulty::kStandard},
      {"hard", Difficulty::kHard},
      {"sun", Difficulty::kSun}};
  return difficulties;
}

// On a terminal only.
void ShowProgress(int done, int of) {
  if (isatty(STDERR_FILENO) == 0) return;
  std::cerr << "\r" << done << " of " << of << " scenes" << (done == of ? "\n" : "") << std::flush;
}

// Of `count` scenes, several at a time.
std::vector<ValidationRow> RunAll(const ValidateCommand& command,
                                  int count,
                                  const std::function<ValidationRow(int)>& validate) {
  std::vector<ValidationRow> rows(static_cast<std::size_t>(count));
  std::atomic<int> done = 0;
  ParallelFor(count, command.threads, [&](int number) {
    rows[static_cast<std::size_t>(number)] = validate(number);
    const int so_far = ++done;
    if (!command.quiet) ShowProgress(so_far, count);
  });
  return rows;
}

std::vector<ValidationRow> Run(const ValidateCommand& command) {
  const ScratchFolder folder("validate");
  if (!command.photographs.empty()) {
    const std::vector<PhotographWithTruth> photographs = PhotographsWithTruth(command.photographs);
    return RunAll(command, static_cast<int>(photographs.size()), [&](int number) {
      return ValidatePhotograph(photographs[static_cast<std::size_t>(number)], folder.path());
    });
  }
  const Difficulty difficulty = Difficulties().at(command.difficulty);
  return RunAll(command, command.scenes, [&](int number) {
    return ValidateScene(MakeValidationScene(number, command.seed, difficulty), folder.path());
  });
}

// Before scenes are rendered for minutes whose results nobody could read.
void RequirePossible(const ValidateCommand& command) {
  if (!command.plot.empty() && fs::path(command.plot).extension() != ".svg")
    throw std::invalid_argument("--plot: " + command.plot + " does not end in .svg");
  if (!command.csv.empty() && command.csv != "-") RequireWritable(command.csv);
  if (!command.plot.empty()) RequireWritable(command.plot);
}

int RunValidate(const ValidateCommand& command) {
  if (!command.blade.empty()) {
    std::cout << CompareBladeWithPhotographs(command.blade);
    return kExitOk;
  }
  RequirePossible(command);
  const std::vector<ValidationRow> rows = Run(command);
  if (command.csv == "-") {
    std::cout << ValidationCsv(rows, !command.no_times);
  } else {
    if (!command.csv.empty()) WriteFileWhole(command.csv, ValidationCsv(rows, !command.no_times));
    std::cout << ValidationTable(rows, !command.no_times);
  }
  if (!command.plot.empty()) WriteFileWhole(command.plot, WorkPrecisionSvg(rows));
  return kExitOk;
}

}  // namespace

void AddValidate(CLI::App& app, int* exit_code) {
  const auto command = std::make_shared<ValidateCommand>();
  CLI::App* sub = app.add_subcommand(
      "validate", "Render photographs with known truth, measure them, and compare");
  CLI::Option* blade =
      sub->add_option("BLADE",
                      command->blade,
                      "Draw this .blade.json into its own photographs instead, and compare");
  sub->add_option("--scenes", command->scenes, "How many; every tenth one must be refused")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  sub->add_option("--seed", command->seed, "Of the series of scenes")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
  sub->add_option("--difficulty",
                  command->difficulty,
                  "Which range scenes are drawn from: clean, standard, hard or sun")
      ->check(CLI::IsMember(Difficulties()))
      ->capture_default_str();
  CLI::Option* photographs =
      sub->add_option("--photographs",
                      command->photographs,
                      "Instead of rendering, those of this folder that have NAME.truth.json "
                      "beside them")
          ->check(CLI::ExistingDirectory);
  sub->add_option("--csv", command->csv, "One line a scene; '-': standard output, no table");
  sub->add_option("--plot", command->plot, "Work-precision plot, FILE.svg");
  sub->add_option("--threads", command->threads, "Scenes at a time; more disturb the times")
      ->check(CLI::Range(1, 1024));
  sub->add_flag("--quiet", command->quiet, "No progress");
  sub->add_flag("--no-times", command->no_times, "Leave times out: same seed, same bytes");
  for (const char* of_scenes :
       {"--scenes", "--seed", "--difficulty", "--csv", "--plot", "--threads", "--no-times"})
    blade->excludes(sub->get_option(of_scenes));
  blade->excludes(photographs);
  for (const char* of_drawing : {"--scenes", "--seed", "--difficulty"})
    photographs->excludes(sub->get_option(of_drawing));
  sub->callback([command, exit_code] { *exit_code = RunValidate(*command); });
}

}  // namespace bladecurve
