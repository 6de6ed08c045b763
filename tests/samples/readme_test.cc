// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "tests/samples/program_run.h"

namespace bladecurve {
namespace {

const std::filesystem::path kRoot = BLADECURVE_SOURCE_DIR;

TEST(Readme, ShowsTheExampleThatIsCompiled) {
  const std::string source = ReadText(kRoot / "samples/measure_and_cut.cc");
  const std::size_t begin = source.find("#include");
  ASSERT_NE(begin, std::string::npos);
  const std::string readme = ReadText(kRoot / "README.md");
  EXPECT_NE(readme.find("```cpp\n" + source.substr(begin) + "```"), std::string::npos);
}

TEST(Readme, NamesOnlyFilesThatExist) {
  const std::string readme = ReadText(kRoot / "README.md");
  const std::regex link("\\]\\(([^)#:]+)\\)");
  int links = 0;
  for (std::sregex_iterator it(readme.begin(), readme.end(), link), end; it != end; ++it, ++links) {
    EXPECT_TRUE(std::filesystem::exists(kRoot / (*it)[1].str())) << (*it)[1];
  }
  EXPECT_GT(links, 0);
}

TEST(Readme, NamesOnlyCommandsThatTheProgramHas) {
  const std::string readme = ReadText(kRoot / "README.md");
  const std::regex command("\n    bladecurve ([a-z]+)");
  for (std::sregex_iterator it(readme.begin(), readme.end(), command), end; it != end; ++it) {
    const ProgramRun run = RunBladecurve({(*it)[1].str(), "--help"}, TestFolder());
    EXPECT_EQ(run.exit_code, 0) << (*it)[1];
  }
}

}  // namespace
}  // namespace bladecurve
