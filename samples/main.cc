// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "samples/commands.h"
#include "samples/refusal.h"
#include "samples/spelling.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

// The innermost: of `catalog plan` it is plan.
const CLI::App& ChosenCommand(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : ChosenCommand(*chosen.front());
}

std::string CommandLineName(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  const std::string name = app.get_parent() == nullptr ? "bladecurve" : app.get_name();
  return chosen.empty() ? name : name + " " + CommandLineName(*chosen.front());
}

std::vector<std::string> FlagNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> CommandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

// What was typed and not understood, with the nearest thing that would have been.
std::string UnknownArgumentMessage(const CLI::App& app, const std::string& argument) {
  const bool is_flag = argument.starts_with("-");
  const std::string name = argument.substr(0, argument.find('='));
  const std::string nearest =
      NearestName(name, is_flag ? FlagNames(ChosenCommand(app)) : CommandNames(app));
  std::string message = (is_flag ? "unknown flag " : "unknown argument ") + name;
  if (!nearest.empty()) message += "; did you mean " + nearest + "?";
  return message + " (" + CommandLineName(app) + " --help lists all)";
}

std::string WrongUseMessage(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> unknown = app.remaining(true);
  // A flag is never a value here, so an unknown one explains every other complaint.
  const auto flag = std::find_if(unknown.begin(), unknown.end(), [](const std::string& argument) {
    return argument.size() > 1 && argument.starts_with("-");
  });
  if (flag != unknown.end()) return UnknownArgumentMessage(app, *flag);
  if (!unknown.empty()) return UnknownArgumentMessage(app, unknown.front());
  return std::string(error.what()) + " (" + CommandLineName(app) + " --help lists all)";
}

std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

int Complain(const CLI::App& app, const std::string& message, ExitCode exit_code) {
  std::cerr << CommandLineName(app) << ": " << OneLine(message) << '\n';
  return exit_code;
}

void AddCommands(CLI::App& app, int* exit_code) {
  AddFit(app, exit_code);
  AddEval(app, exit_code);
  AddExport(app, exit_code);
  AddCatalog(app, exit_code);
  AddTorque(app, exit_code);
  AddIdentify(app, exit_code);
  AddValidate(app, exit_code);
  AddCard(app, exit_code);
}

// What could not be written is lost: a full disk, a reader that is gone.
int IfWritten(const CLI::App& app, int exit_code) {
  std::cout.flush();
  if (std::cout) return exit_code;
  return Complain(
      app, "cannot write to standard output; is the disk full, or its reader gone?", kExitError);
}

int Run(int argc, char** argv) {
  CLI::App app("From a photograph of scissors to a blade curve that cuts.", "bladecurve");
  app.set_version_flag("--version", "bladecurve " BLADECURVE_VERSION);
  app.require_subcommand(1);
  int exit_code = kExitOk;
  AddCommands(app, &exit_code);
  try {
    app.parse(argc, argv);
    return IfWritten(app, exit_code);
  } catch (const CLI::Success& help) {
    return IfWritten(app, app.exit(help));
  } catch (const CLI::ParseError& error) {
    return Complain(app, WrongUseMessage(app, error), kExitUsage);
  } catch (const Refused& refusal) {
    std::cout << RefusalText(refusal, "") << '\n';
    return IfWritten(app, Complain(app, refusal.what(), kExitRefused));
  } catch (const std::invalid_argument& error) {
    return Complain(app, error.what(), kExitUsage);
  } catch (const std::exception& error) {
    return Complain(app, error.what(), kExitError);
  }
}

}  // namespace
}  // namespace bladecurve

int main(int argc, char** argv) {
  cv::setNumThreads(1);  // photographs and their parts are shared out by ParallelFor alone
  try {
    return bladecurve::Run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "bladecurve: " << error.what() << '\n';
  } catch (...) {
    std::cerr << "bladecurve: stopped by an error of unknown kind\n";
  }
  return bladecurve::kExitError;
}
