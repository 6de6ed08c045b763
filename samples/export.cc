// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/export.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

#include "samples/commands.h"
#include "vision/photo/sha256.h"
#include "vision/photo/whole_file.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

struct ExportCommand {
  std::string blade, as, output;
};

std::string Bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// A plugin knows the hash of the .blade.json it came from; that of a .blade.json is its own.
BladeFile ReadWithHash(const fs::path& path) {
  BladeFile blade = ReadBladeFile(path);
  if (path.extension() == ".json") blade.source_sha256 = Sha256Hex(Bytes(path));
  return blade;
}

// dir/mayo.blade.json becomes mayo.c, mayo.so or mayo.blade.json in the current folder.
fs::path DefaultOutput(const fs::path& blade, const std::string& as) {
  fs::path name = blade.filename().stem();
  if (name.extension() == ".blade") name = name.stem();
  return name.string() + (as == "json" ? ".blade.json" : "." + as);
}

fs::path OutputOf(const ExportCommand& command) {
  fs::path output =
      command.output.empty() ? DefaultOutput(command.blade, command.as) : fs::path(command.output);
  std::error_code ignored;
  if (fs::equivalent(output, command.blade, ignored)) {
    throw std::invalid_argument(
        fmt::format("-o: {} is the blade itself; give another name", output.string()));
  }
  return output;
}

void WriteText(const ExportCommand& command, const std::string& text) {
  if (command.output == "-") {
    std::cout << text;
    return;
  }
  WriteFileWhole(OutputOf(command), text);
}

int RunExport(const ExportCommand& command) {
  const BladeFile blade = ReadWithHash(command.blade);
  if (command.as != "json") RequireMillimetres(blade);
  if (command.as == "json") {
    WriteText(command, BladeFileText(blade));
  } else if (command.as == "c") {
    WriteText(command, PluginSource(blade));
  } else if (command.as == "so") {
    if (command.output == "-") {
      throw std::invalid_argument("-o: a shared library cannot go to standard output; name a file");
    }
    CompilePlugin(PluginSource(blade), OutputOf(command));
  } else {
    throw std::runtime_error(
        "--as fmu: not available in this version; use --as c or so, which any host can call");
  }
  return kExitOk;
}

}  // namespace

void AddExport(CLI::App& app, int* exit_code) {
  const auto command = std::make_shared<ExportCommand>();
  CLI::App* subcommand =
      app.add_subcommand("export", "Write a blade as JSON, C source or a shared library");
  subcommand->add_option("BLADE", command->blade, "a .blade.json or a .so")->required();
  subcommand->add_option("--as", command->as, "c, so, fmu or json")
      ->required()
      ->check(CLI::IsMember({"c", "so", "fmu", "json"}));
  subcommand->add_option(
      "-o,--output", command->output, "where to write; - is standard output; default: NAME.c, ...");
  subcommand->callback([command, exit_code] { *exit_code = RunExport(*command); });
}

}  // namespace bladecurve
