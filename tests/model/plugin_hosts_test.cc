// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The examples in samples/hosts call a blade as the library itself evaluates it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "model/export.h"
#include "tests/installed_program.h"
#include "tests/model/test_blades.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

constexpr double kThetaDeg = 17.5;
constexpr double kX_mm = 61.25;

fs::path Hosts() { return fs::path(BLADECURVE_SOURCE_DIR) / "samples" / "hosts"; }

// What a command prints, as numbers between commas.
std::vector<double> NumbersOf(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 256> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe.get())) text += buffer.data();
  std::vector<double> numbers;
  std::istringstream cells(text);
  for (std::string cell; std::getline(cells, cell, ',');) {
    numbers.push_back(std::strtod(cell.c_str(), nullptr));
  }
  return numbers;
}

class PluginHosts : public testing::Test {
 protected:
  void SetUp() override {
    if (!IsInstalled("cc")) GTEST_SKIP() << "no C compiler";
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::path(testing::TempDir()) / ("plugin_hosts_test." + test);
    fs::create_directories(folder_);
    CompilePlugin(PluginSource(blade_), folder_ / "blade.so");
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  [[nodiscard]] std::string Arguments() const {
    std::ostringstream text;
    text << " " << (folder_ / "blade.so").string() << " " << kThetaDeg << " " << kX_mm;
    return text.str();
  }

  void ExpectSame(const std::vector<double>& numbers) const {
    const CurveSample s = blade_.curve.Eval(kX_mm, kThetaDeg * (std::acos(-1.0) / 180));
    const std::vector<double> expected = {
        kX_mm, s.phi_mm, s.phi_x, s.phi_theta_mm_per_rad, static_cast<double>(s.flags)};
    EXPECT_EQ(numbers, expected);
  }

  BladeFile blade_ = Blade();
  fs::path folder_;

 private:
  static BladeFile Blade() {
    std::mt19937 random(1);
    return {"blade", {RandomSpline(random, 3, 4, 0.5), {15, 105, 0, 0.8}}};
  }
};

TEST_F(PluginHosts, CFindsTheTable) {
  const std::string program = (folder_ / "eval_blade").string();
  const std::string build = "cc -std=c99 -Wall -Wextra -Werror -I" BLADECURVE_SOURCE_DIR " " +
                            (Hosts() / "eval_blade.c").string() + " -ldl -o " + program;
  ASSERT_EQ(std::system(build.c_str()), 0) << build;
  ExpectSame(NumbersOf(program + Arguments()));
}

TEST_F(PluginHosts, PythonCallsByName) {
  if (!IsInstalled("python3")) GTEST_SKIP() << "python3 is not installed";
  ExpectSame(NumbersOf("python3 " + (Hosts() / "eval_blade.py").string() + Arguments()));
}

}  // namespace
}  // namespace bladecurve
