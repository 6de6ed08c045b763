// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "samples/analysis_flags.h"
#include "samples/catalog_merge.h"
#include "samples/catalog_plan.h"
#include "samples/catalog_run.h"
#include "samples/commands.h"
#include "samples/shard.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

struct CatalogCommand {
  std::string source;  // folder or manifest to plan from
  std::string out;     // folder of the results
  AnalysisFlags analysis;
  std::optional<std::string> shard;
  bool overlays = false;
};

// Without -o: beside the source.
fs::path OutputFolder(const CatalogCommand& command) {
  if (!command.out.empty()) return command.out;
  const fs::path source = fs::absolute(command.source).lexically_normal();
  const fs::path whole = source.has_filename() ? source : source.parent_path();
  return whole.parent_path() / (whole.stem().string() + ".catalog");
}

void Plan(const CatalogCommand& command, const CLI::App& flags) {
  (void)SettingsFromFlags(command.analysis);  // wrong values are said now, not by every row
  if (!fs::exists(command.source)) {
    throw std::invalid_argument(
        fmt::format("{}: there is no such folder or manifest; give one", command.source));
  }
  CatalogPlan plan;
  plan.arguments = GivenArguments(flags);
  plan.instruments = fs::is_directory(command.source) ? InstrumentsInFolder(command.source)
                                                      : InstrumentsInManifest(command.source);
  WritePlan(OutputFolder(command), plan);
}

Shard ChosenShard(const std::optional<std::string>& text) {
  if (text) return ParseShard(*text);
  const auto environment = [](const char* name) -> std::optional<std::string> {
    const char* value = std::getenv(name);
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  };
  return ShardFromEnvironment(environment).value_or(Shard{});
}

void ShowProgressOnATerminal(CatalogRunOptions* options) {
  if (isatty(STDERR_FILENO) == 0) return;
  const auto mutex = std::make_shared<std::mutex>();
  options->progress = [mutex](int done, int all) {
    const std::lock_guard lock(*mutex);
    std::cerr << fmt::format("\r{} of {}{}", done, all, done == all ? "\n" : "") << std::flush;
  };
}

// 0 also where photographs were refused: their rows say so. 1 where something went wrong.
int Run(const fs::path& out, const CatalogCommand& command, const Shard& shard) {
  CatalogRunOptions options;
  options.shard = shard;
  options.num_threads = SettingsFromFlags(command.analysis).num_threads;
  options.overlays = command.overlays;
  ShowProgressOnATerminal(&options);
  const CatalogRunSummary summary = RunCatalog(out, options);
  std::cout << fmt::format("{}: {} measured, {} refused, {} errors, {} done before\n",
                           out.string(),
                           summary.measured,
                           summary.refused,
                           summary.errors,
                           summary.already_done);
  return summary.errors == 0 ? kExitOk : kExitError;
}

void PrintStatus(const fs::path& out) {
  const CatalogStatus status = StatusOfCatalog(out);
  std::cout << fmt::format(
      "{}: {} planned, {} missing\n", out.string(), status.planned, status.missing.size());
  for (const auto& [name, count] : status.by_status)
    std::cout << fmt::format("  {:<10} {}\n", name, count);
  for (const auto& [name, count] : status.by_reason) {
    std::cout << fmt::format("    {:<20} {}\n", name, count);
  }
}

void AddRunFlags(CLI::App& command, CatalogCommand* flags) {
  command.add_option("--shard",
                     flags->shard,
                     "i/N: this share only (default: what the cluster's environment says)");
  command.add_flag("--overlays", flags->overlays, "Write an overlay picture of each photograph");
}

void AddThreadsFlag(CLI::App& command, CatalogCommand* flags) {
  command.add_option("--threads", flags->analysis.threads, "How many instruments at a time");
}

// catalog plan DIR|MANIFEST -o OUT
void AddPlan(CLI::App& catalog) {
  const auto command = std::make_shared<CatalogCommand>();
  CLI::App* plan = catalog.add_subcommand("plan", "Write OUT/manifest.csv and OUT/plan.json");
  plan->add_option("SOURCE", command->source, "Folder of photographs, or a manifest")->required();
  plan->add_option("-o", command->out, "Folder for the results");
  AddAnalysisFlags(*plan, &command->analysis);
  plan->callback([command, plan] {
    Plan(*command, *plan);
    std::cout << fmt::format("planned in {}\n", OutputFolder(*command).string());
  });
}

// catalog run OUT
void AddRun(CLI::App& catalog, int* exit_code) {
  const auto command = std::make_shared<CatalogCommand>();
  CLI::App* run = catalog.add_subcommand("run", "Work through this share of the plan");
  run->add_option("OUT", command->out, "A folder that 'plan' made")->required();
  AddThreadsFlag(*run, command.get());
  AddRunFlags(*run, command.get());
  run->callback([command, exit_code] {
    *exit_code = Run(command->out, *command, ChosenShard(command->shard));
  });
}

// catalog merge OUT and catalog status OUT
void AddMergeAndStatus(CLI::App& catalog) {
  const auto merge_out = std::make_shared<std::string>(),
             status_out = std::make_shared<std::string>();
  CLI::App* merge =
      catalog.add_subcommand("merge", "Join all shards into catalog.jsonl, .csv and .sqlite");
  merge->add_option("OUT", *merge_out, "A folder that 'plan' made")->required();
  merge->callback([merge_out] { MergeCatalog(*merge_out); });
  CLI::App* status = catalog.add_subcommand("status", "How far the work is");
  status->add_option("OUT", *status_out, "A folder that 'plan' made")->required();
  status->callback([status_out] { PrintStatus(*status_out); });
}

// catalog DIR|MANIFEST: plan, run and merge in one go.
int RunWhole(const CatalogCommand& command, const CLI::App& flags) {
  if (command.source.empty()) {
    throw std::invalid_argument(
        "give a folder of photographs, a manifest, or plan, run, merge, status");
  }
  Plan(command, flags);
  const fs::path out = OutputFolder(command);
  const int exit_code = Run(out, command, Shard{});
  MergeCatalog(out);
  std::cout << fmt::format("wrote {}\n", (out / "catalog.csv").string());
  return exit_code;
}

}  // namespace

void AddCatalog(CLI::App& app, int* exit_code) {
  const auto command = std::make_shared<CatalogCommand>();
  CLI::App* catalog = app.add_subcommand("catalog", "Many photographs, one table of results");
  catalog->add_option("SOURCE", command->source, "Folder of photographs, or a manifest");
  catalog->add_option("-o", command->out, "Folder for the results (default: SOURCE.catalog)");
  catalog->add_flag("--overlays", command->overlays, "Write an overlay picture of each photograph");
  AddAnalysisFlags(*catalog, &command->analysis);
  AddThreadsFlag(*catalog, command.get());
  AddPlan(*catalog);
  AddRun(*catalog, exit_code);
  AddMergeAndStatus(*catalog);
  catalog->require_subcommand(0, 1);
  catalog->callback([command, catalog, exit_code] {
    if (catalog->get_subcommands().empty()) *exit_code = RunWhole(*command, *catalog);
  });
}

}  // namespace bladecurve
