// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/doubts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

// The codes that the libraries' sources raise: strings on lines that warn.
std::set<std::string> CodesRaised() {
  static const std::regex kCode("\"([a-z]+(_[a-z]+)+)\"");
  std::set<std::string> codes;
  for (const char* folder : {"vision", "curvefit"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(BLADECURVE_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".cc") continue;
      std::ifstream source(entry.path());
      for (std::string line; std::getline(source, line);) {
        if (line.find("warn") == std::string::npos && line.find("Warn") == std::string::npos)
          continue;
        for (std::sregex_iterator at(line.begin(), line.end(), kCode), end; at != end; ++at)
          codes.insert((*at)[1]);
      }
    }
  }
  return codes;
}

TEST(MeaningOfDoubt, ExplainsEveryWarning) {
  const std::set<std::string> codes = CodesRaised();
  EXPECT_GE(codes.size(), 21U) << "warnings are raised in another way: look for them there";
  for (const std::string& code : codes) EXPECT_NO_THROW((void)MeaningOfDoubt(code)) << code;
}

TEST(MeaningOfDoubt, KnowsNoOthers) {
  EXPECT_THROW((void)MeaningOfDoubt("upper_edge_dubious"), std::invalid_argument);
}

}  // namespace
}  // namespace bladecurve
