// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "tests/samples/program_run.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

std::string Quoted(const std::string& argument) {
  std::string quoted = "'";
  for (const char c : argument) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

ProgramRun RunBladecurve(const std::vector<std::string>& arguments,
                         const fs::path& folder,
                         const fs::path& standard_output) {
  const bool kept = standard_output.empty();
  const fs::path out = kept ? folder / "standard_output.txt" : standard_output;
  const fs::path err = folder / "standard_error.txt";
  std::ostringstream command;
  command << "cd " << Quoted(folder.string()) << " && " << Quoted(BLADECURVE_PROGRAM);
  for (const std::string& argument : arguments) command << ' ' << Quoted(argument);
  command << " > " << Quoted(out.string()) << " 2> " << Quoted(err.string());
  const int status = std::system(command.str().c_str());
  ProgramRun run;
  // The shell reports a signal n as 128 + n.
  if (WIFEXITED(status) && WEXITSTATUS(status) < 128) run.exit_code = WEXITSTATUS(status);
  if (kept) run.standard_output = ReadText(out);
  run.standard_error = ReadText(err);
  return run;
}

fs::path SamplePhotos() { return fs::path(BLADECURVE_SOURCE_DIR) / "samples" / "photos"; }

fs::path TestFolder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  for (char& c : name) c = c == '/' ? '_' : c;
  const fs::path folder = fs::path(testing::TempDir()) / "bladecurve" / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string ReadText(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void WriteText(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  ASSERT_TRUE(file.good()) << "cannot write " << path;
}

}  // namespace bladecurve
