// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {
class App;
}

namespace bladecurve {

// Exit codes of the program.
enum ExitCode : int { kExitOk = 0, kExitError = 1, kExitUsage = 2, kExitRefused = 3 };

// Each adds its sub-command to `app`; the sub-command's callback does the work and stores the exit
// code in *exit_code. std::invalid_argument thrown from a callback becomes kExitUsage, Refused
// kExitRefused, anything else kExitError (main.cc).
void AddFit(CLI::App& app, int* exit_code);
void AddEval(CLI::App& app, int* exit_code);
void AddExport(CLI::App& app, int* exit_code);
void AddTorque(CLI::App& app, int* exit_code);
void AddIdentify(CLI::App& app, int* exit_code);
void AddCatalog(CLI::App& app, int* exit_code);
void AddValidate(CLI::App& app, int* exit_code);
void AddCard(CLI::App& app, int* exit_code);

}  // namespace bladecurve
