// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The command line of `bladecurve identify`, from logs to a material that `torque` reads.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "model/blade_file.h"
#include "tests/model/cutting_scenes.h"
#include "tests/model/logged_cuts.h"
#include "tests/samples/program_run.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

using Json = nlohmann::json;

constexpr const char* kPlate =
    " --blade small.blade.json --thickness-mm 0.1 --x-edge-mm 45 --x-end-mm 68";
constexpr const char* kLogs = "identify --cut cut0.csv cut1.csv --empty empty0.csv empty1.csv";

// Two logged cuts of paper, two empty runs, and the blade with a covariance.
class IdentifyCommand : public testing::Test {
 protected:
  IdentifyCommand() {
    BladeFile blade{"small", SmallMetzenbaum()};
    blade.covariance = {1e-4, 0, 0, 0, 1e-8, 0, 0, 0, 0};
    WriteText(folder_ / "small.blade.json", BladeFileText(blade));
    std::mt19937 random(1);
    for (const std::string i : {"0", "1"}) {
      WriteText(folder_ / ("cut" + i + ".csv"),
                LogOfCut({}, SmallMetzenbaum(), PaperMaterials()[0], {45, 68}, random));
      WriteText(folder_ / ("empty" + i + ".csv"), LogOfEmptyRun({}, random));
    }
  }

  [[nodiscard]] ProgramRun Run(const std::string& arguments) const {
    std::istringstream words(arguments);
    return RunBladecurve({std::istream_iterator<std::string>(words), {}}, folder_);
  }

  fs::path folder_ = TestFolder();
};

TEST_F(IdentifyCommand, WritesAMaterialThatTorqueReads) {
  const ProgramRun run =
      Run(kLogs + std::string(kPlate) + " --radius-mm 98 --name sheet -o m.json");
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_EQ(run.standard_output, "");
  const Json material = Json::parse(ReadText(folder_ / "m.json"));
  EXPECT_EQ(material["name"], "sheet");
  EXPECT_EQ(material["identified"]["doubts"], Json::array());
  constexpr double kToughnessError = 0.02, kStiffnessError = 0.05;  // what is promised
  EXPECT_NEAR(material["toughness_kj_per_m2"].get<double>() / 4.9, 1, kToughnessError);
  EXPECT_NEAR(material["stiffness_n_per_mm"].get<double>() / 5, 1, kStiffnessError);
  for (const char* value : {"toughness_kj_per_m2", "stiffness_n_per_mm"}) {
    const Json& known = material["identified"][value];
    EXPECT_GT(known["standard_deviation"].get<double>(), 0);
    EXPECT_GT(known["uncertainty"].get<double>(), known["uncertainty_from_blade"].get<double>());
  }
  const ProgramRun cut =
      Run("torque small.blade.json --material m.json --motion cut0.csv --radius-mm 98");
  EXPECT_EQ(cut.exit_code, 0) << cut.standard_error;
  EXPECT_NE(cut.standard_error.find("through sheet"), std::string::npos) << cut.standard_error;
}

TEST_F(IdentifyCommand, PrintsTheSameBytesAgain) {
  const std::string arguments = kLogs + std::string(kPlate) + " --radius-mm 98";
  const ProgramRun first = Run(arguments), second = Run(arguments + " --quiet");
  EXPECT_EQ(first.standard_output, second.standard_output);
  EXPECT_NE(first.standard_error, "");
  EXPECT_EQ(second.standard_error, "");
}

TEST_F(IdentifyCommand, SaysWhatOneCutCannotTell) {
  const ProgramRun run =
      Run("identify --cut cut0.csv --empty empty0.csv" + std::string(kPlate) + " --radius-mm 98");
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  const Json material = Json::parse(run.standard_output);
  EXPECT_TRUE(material["identified"]["stiffness_n_per_mm"]["uncertainty"].is_null());
  EXPECT_EQ(material["identified"]["doubts"], (Json{"one_cut", "one_empty_run"}));
  EXPECT_NE(run.standard_error.find("doubt one_cut"), std::string::npos) << run.standard_error;
}

// A refusal: code 3, one JSON object with a reason on standard output, one line for a person.
TEST_F(IdentifyCommand, LogsThatWillNotDoAreNamedAndRefused) {
  const std::string good = ReadText(folder_ / "cut0.csv");
  WriteText(folder_ / "short.csv", good.substr(0, good.find("\n0.05")));
  WriteText(folder_ / "word.csv", good + "9,1,oops\n");
  WriteText(folder_ / "cells.csv", good + "9,1\n");
  WriteText(folder_ / "late.csv", good + "0,1,2\n");
  const std::string end = std::to_string(1 + std::count(good.begin(), good.end(), '\n'));
  struct Case {
    std::string file, reason, words;
  };
  for (const Case& c : {Case{"short.csv", "too_short", "short.csv: 25 rows"},
                        {"word.csv", "unreadable", "word.csv:" + end + ": force_n is \"oops\""},
                        {"cells.csv", "unreadable", "cells.csv:" + end + ": 2 cells"},
                        {"late.csv", "unsorted", "late.csv:" + end + ": t_s"},
                        {"none.csv", "unreadable", "none.csv: cannot be read"},
                        {"empty0.csv", "no_cut", "empty0.csv: no cut"}}) {
    const ProgramRun run = Run("identify --cut " + c.file + " --empty empty0.csv empty1.csv" +
                               kPlate + " --radius-mm 98 -o never.json");
    EXPECT_EQ(run.exit_code, 3) << run.standard_error;
    const Json refusal = Json::parse(run.standard_output);
    EXPECT_EQ(refusal["status"], "refused");
    EXPECT_EQ(refusal["reason"], c.reason) << run.standard_error;
    EXPECT_NE(refusal["detail"].get<std::string>().find(c.words), std::string::npos) << refusal;
    EXPECT_NE(run.standard_error.find(c.words), std::string::npos) << run.standard_error;
    EXPECT_FALSE(fs::exists(folder_ / "never.json"));
  }
}

TEST_F(IdentifyCommand, WrongUseIsSaidOnOneLine) {
  const std::string plate = kPlate;
  struct Case {
    std::string arguments, word;
  };
  for (const Case& c : {Case{"identify" + plate, "--cut"},
                        {"identify --cut cut0.csv" + plate, "--empty"},
                        {kLogs + plate, "--radius-mm"},
                        {kLogs + plate + " --radius-mm 0", "--radius-mm"},
                        {kLogs + std::string(" cut.csv --empty cut.csv cut.csv") + plate, "twice"},
                        {kLogs + plate + " --radius-mm 98 --tickness-mm 1", "--thickness-mm?"},
                        {kLogs + std::string(" --blade small.blade.json --thickness-mm 0 "
                                             "--x-edge-mm 45 --x-end-mm 68 --radius-mm 98"),
                         "--thickness-mm"},
                        {kLogs + std::string(" --blade small.blade.json --thickness-mm 0.1 "
                                             "--x-edge-mm 45 --x-end-mm 5 --radius-mm 98"),
                         "x_end"},
                        {kLogs + std::string(" --blade no.blade.json --thickness-mm 0.1 "
                                             "--x-edge-mm 45 --x-end-mm 68 --radius-mm 98"),
                         "no.blade.json"}}) {
    const ProgramRun run = Run(c.arguments);
    EXPECT_EQ(run.exit_code, 2) << c.arguments << ": " << run.standard_error;
    EXPECT_NE(run.standard_error.find(c.word), std::string::npos) << run.standard_error;
    EXPECT_EQ(run.standard_error.find('\n'), run.standard_error.size() - 1) << run.standard_error;
    EXPECT_EQ(run.standard_output, "") << c.arguments;
  }
}

}  // namespace
}  // namespace bladecurve
