// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "model/export.h"
#include "model/scratch_folder.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

constexpr int kNoSuchProgram = 127;  // as shells have it

// $CC may hold flags: "ccache gcc -m64".
std::vector<std::string> Compiler() {
  const char* cc = std::getenv("CC");
  std::istringstream words(cc ? cc : "");
  std::vector<std::string> compiler{std::istream_iterator<std::string>(words), {}};
  if (compiler.empty()) compiler.emplace_back("cc");
  return compiler;
}

// Becomes the program, with its messages in a file; exit code 127 if there is no such program.
[[noreturn]] void BecomeProgram(char* const* arguments, const fs::path& messages) noexcept {
  const int file = open(messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  execvp(arguments[0], arguments);
  _exit(kNoSuchProgram);
}

// Runs a program found on the PATH; its exit code.
int Run(std::vector<std::string> words, const fs::path& messages) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) {
    throw std::runtime_error(std::string("export: cannot start a program: ") +
                             std::strerror(errno) + "; free some memory");
  }
  if (child == 0) BecomeProgram(arguments.data(), messages);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

std::string FirstLine(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line.empty() ? "no message" : line;
}

void WriteText(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file)
    throw std::runtime_error("export: cannot write " + path.string() + "; is the disk full?");
}

// By way of a neighbour, so that a reader never sees half a library.
void PutInPlace(const fs::path& from, const fs::path& to) {
  const fs::path neighbour = to.string() + "." + std::to_string(getpid()) + ".part";
  std::error_code error;
  fs::copy_file(from, neighbour, fs::copy_options::overwrite_existing, error);
  if (!error) fs::rename(neighbour, to, error);
  if (error) {
    throw std::runtime_error("export: cannot write " + to.string() + ": " + error.message() +
                             "; give a folder that exists and is writable");
  }
}

}  // namespace

void CompilePlugin(const std::string& source, const fs::path& library) {
  const ScratchFolder scratch("export");
  const fs::path text = scratch.path() / "blade.c";
  const fs::path built = scratch.path() / "blade.so";
  const fs::path messages = scratch.path() / "messages";
  WriteText(text, source);
  std::vector<std::string> words = Compiler();
  const std::string compiler = words.front();
  for (const char* word : {"-std=c99", "-O3", "-ffp-contract=off", "-fPIC", "-shared", "-o"}) {
    words.emplace_back(word);
  }
  words.insert(words.end(), {built.string(), text.string(), "-lm"});
  const int code = Run(words, messages);
  if (code == kNoSuchProgram) {
    throw std::runtime_error("export: there is no C compiler \"" + compiler +
                             "\"; install one or name it in CC, or use --as c and compile that");
  }
  if (code != 0) {
    throw std::runtime_error("export: " + compiler + " failed: " + FirstLine(messages) +
                             "; name another C compiler in CC");
  }
  PutInPlace(built, library);
}

}  // namespace bladecurve
