// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bladecurve {

struct ProgramRun {
  int exit_code = -1;  // -1: killed by a signal
  std::string standard_output, standard_error;
};

// Runs the program `bladecurve` with these arguments in `folder` and waits for it. Its standard
// output goes to `standard_output` instead of into the result, if that is given.
[[nodiscard]] ProgramRun RunBladecurve(const std::vector<std::string>& arguments,
                                       const std::filesystem::path& folder,
                                       const std::filesystem::path& standard_output = {});

// The photographs that come with the source.
[[nodiscard]] std::filesystem::path SamplePhotos();

// An empty folder of the running test's own.
[[nodiscard]] std::filesystem::path TestFolder();

[[nodiscard]] std::string ReadText(const std::filesystem::path& path);
void WriteText(const std::filesystem::path& path, const std::string& text);

}  // namespace bladecurve
