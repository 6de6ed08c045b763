// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "model/blade_file.h"
#include "tests/installed_program.h"
#include "tests/model/test_blades.h"
#include "tests/samples/program_run.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

// A random spline in blade.blade.json, in a folder of the test's own.
class EvalAndExport : public testing::Test {
 protected:
  EvalAndExport() { WriteText(folder_ / "blade.blade.json", BladeFileText(blade_)); }

  [[nodiscard]] ProgramRun Run(const std::string& arguments) const {
    std::istringstream words(arguments);
    return RunBladecurve({std::istream_iterator<std::string>(words), {}}, folder_);
  }

  BladeFile blade_ = Blade();
  fs::path folder_ = TestFolder();

 private:
  static BladeFile Blade() {
    std::mt19937 random(1);
    return {"blade", {RandomSpline(random, 3, 4, 0.5), {15, 105, 0, 0.8}}};
  }
};

std::vector<std::vector<double>> RowsOf(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "x_mm,phi_mm,phi_x,phi_theta_mm_per_rad,flags");
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

TEST_F(EvalAndExport, EvalPrintsTheCurveExactly) {
  const ProgramRun answer = Run("eval blade.blade.json --theta-deg 20 --x-mm 10:110:2.5");
  ASSERT_EQ(answer.exit_code, 0) << answer.standard_error;
  const auto rows = RowsOf(answer.standard_output);
  ASSERT_EQ(rows.size(), 41u);
  const double theta_rad = 20 * (std::acos(-1.0) / 180);
  for (const auto& row : rows) {
    const CurveSample s = blade_.curve.Eval(row[0], theta_rad);
    EXPECT_EQ(row[1], s.phi_mm);
    EXPECT_EQ(row[2], s.phi_x);
    EXPECT_EQ(row[3], s.phi_theta_mm_per_rad);
    EXPECT_EQ(row[4], s.flags);
  }
}

TEST_F(EvalAndExport, EvalEndsAtBWhereStepsLeadThere) {
  const auto last = [this](const std::string& steps) {
    const auto rows =
        RowsOf(Run("eval blade.blade.json --theta-deg 5 --x-mm " + steps).standard_output);
    return rows.empty() ? std::nan("") : rows.back()[0];
  };
  EXPECT_EQ(last("20:21:0.1"), 21);
  EXPECT_EQ(last("20:21:0.3"), 20.9);
  EXPECT_EQ(last("12.345678:98.765432:0.864197540"), 98.765432);
  EXPECT_EQ(last("30:30:1"), 30);
  EXPECT_EQ(last("30:20:-2.5"), 20);
  EXPECT_EQ(last("-5:-4:0.5"), -4);
}

TEST_F(EvalAndExport, EvalOfAPluginIsEvalOfItsBlade) {
  if (!IsInstalled("cc")) GTEST_SKIP() << "no C compiler";
  ASSERT_EQ(Run("export blade.blade.json --as so -o blade.so").exit_code, 0);
  const std::string arguments = " --theta-deg 60 --x-mm 0:120:1";  // beyond both domains as well
  EXPECT_EQ(Run("eval blade.so" + arguments).standard_output,
            Run("eval blade.blade.json" + arguments).standard_output);
}

TEST_F(EvalAndExport, ExportGoesRoundWithoutLoss) {
  if (!IsInstalled("cc")) GTEST_SKIP() << "no C compiler";
  ASSERT_EQ(Run("export blade.blade.json --as so").exit_code, 0);
  ASSERT_EQ(Run("export blade.so --as json -o back.blade.json").exit_code, 0);
  EXPECT_EQ(ReadText(folder_ / "back.blade.json"), ReadText(folder_ / "blade.blade.json"));
  EXPECT_EQ(Run("export blade.so --as c -o -").standard_output,
            Run("export blade.blade.json --as c -o -").standard_output);
}

TEST_F(EvalAndExport, ExportNamesItsFilesAfterTheBlade) {
  ASSERT_EQ(Run("export blade.blade.json --as c").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "blade.c"));
  const ProgramRun onto_itself = Run("export blade.blade.json --as json");
  EXPECT_EQ(onto_itself.exit_code, 2);
  EXPECT_NE(onto_itself.standard_error.find("-o"), std::string::npos) << onto_itself.standard_error;
}

struct WrongEvalOrExport {
  std::string arguments;
  int exit_code;
  std::string word;
};

TEST_F(EvalAndExport, WrongUseIsSaidOnOneLine) {
  const std::vector<WrongEvalOrExport> cases = {
      {"eval blade.blade.json --x-mm 1:2:1", 2, "--theta-deg"},
      {"eval blade.blade.json --theta-deg 5", 2, "--x-mm"},
      {"eval --theta-deg 5 --x-mm 1:2:1", 2, "BLADE"},
      {"eval none.json --theta-deg 5 --x-mm 1:2:1", 2, "none.json"},
      {"eval . --theta-deg 5 --x-mm 1:2:1", 2, "folder"},
      {"eval blade.blade.json --theta-deg five --x-mm 1:2:1", 2, "--theta-deg"},
      {"eval blade.blade.json --theta-deg nan --x-mm 1:2:1", 2, "--theta-deg"},
      {"eval blade.blade.json --theta-deg 5 --x-mm 1:2", 2, "A:B:STEP"},
      {"eval blade.blade.json --theta-deg 5 --x-mm 1:2:0", 2, "--x-mm"},
      {"eval blade.blade.json --theta-deg 5 --x-mm 1:2:-1", 2, "--x-mm"},
      {"eval blade.blade.json --theta-deg 5 --x-mm 1:2:1e-300", 2, "--x-mm"},
      {"eval blade.blade.json --theta-deg 5 --x-mm 1:inf:1", 2, "--x-mm"},
      {"export blade.blade.json", 2, "--as"},
      {"export blade.blade.json --as dll", 2, "--as"},
      {"export blade.blade.json --as so -o -", 2, "-o"},
      {"export blade.blade.json --as fmu -o blade.fmu", 1, "not available"},
      {"export blade.blade.json --as c -o no/such/blade.c", 1, "no/such"},
  };
  for (const WrongEvalOrExport& wrong : cases) {
    const ProgramRun answer = Run(wrong.arguments);
    EXPECT_EQ(answer.exit_code, wrong.exit_code)
        << wrong.arguments << ": " << answer.standard_error;
    EXPECT_NE(answer.standard_error.find(wrong.word), std::string::npos)
        << wrong.arguments << ": " << answer.standard_error;
    EXPECT_EQ(answer.standard_error.find('\n'), answer.standard_error.size() - 1)
        << answer.standard_error;
    EXPECT_EQ(answer.standard_output, "") << wrong.arguments;
  }
}

TEST_F(EvalAndExport, ExportWithoutACompilerSaysSo) {
  setenv("CC", "no-such-compiler", 1);
  const ProgramRun answer = Run("export blade.blade.json --as so");
  unsetenv("CC");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_NE(answer.standard_error.find("no-such-compiler"), std::string::npos)
      << answer.standard_error;
  EXPECT_FALSE(fs::exists(folder_ / "blade.so"));
}

}  // namespace
}  // namespace bladecurve
