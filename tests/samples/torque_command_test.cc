// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The command line of `bladecurve torque`.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "model/blade_file.h"
#include "model/number_table.h"
#include "model/torque.h"
#include "tests/installed_program.h"
#include "tests/model/cutting_scenes.h"
#include "tests/samples/program_run.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

// The paper's small scissors in small.blade.json and a curved blade in curved.blade.json.
class TorqueCommand : public testing::Test {
 protected:
  TorqueCommand() {
    WriteText(folder_ / "small.blade.json", BladeFileText({"small", SmallMetzenbaum()}));
    WriteText(folder_ / "curved.blade.json", BladeFileText({"curved", CurvedBlade()}));
  }

  [[nodiscard]] ProgramRun Run(const std::string& arguments) const {
    std::istringstream words("torque " + arguments);
    return RunBladecurve({std::istream_iterator<std::string>(words), {}}, folder_);
  }

  [[nodiscard]] NumberTable Csv(const std::string& arguments) const {
    const ProgramRun run = Run(arguments + " --csv - --quiet");
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    EXPECT_EQ(run.standard_error, "");
    return ParseNumberTable(run.standard_output, "torque.csv");
  }

  fs::path folder_ = TestFolder();
};

constexpr const char* kCut =
    "small.blade.json --material paper --close-deg 28:4 --x-edge-mm 45 --x-end-mm 68";

TEST_F(TorqueCommand, PrintsWhatTheModelSays) {
  const NumberTable csv = Csv(std::string(kCut) + " --radius-mm 98");
  TorqueModel model(SmallMetzenbaum(), PaperMaterials()[0], {45, 68});
  ASSERT_EQ(csv.num_rows(), 8001u);
  for (std::size_t i = 0; i < csv.num_rows(); ++i) {
    const TorqueSample sample =
        model.Step(csv.Get("theta_deg")[i] * std::numbers::pi / 180, 0, 1e-3);
    EXPECT_EQ(csv.Get("torque_nmm")[i], sample.torque_nmm) << i;
    EXPECT_EQ(csv.Get("x_c_mm")[i], sample.x_c_mm) << i;
    EXPECT_EQ(csv.Get("force_n")[i], sample.torque_nmm / 98) << i;
  }
}

TEST_F(TorqueCommand, OfAPluginIsTorqueOfItsBladeByteForByte) {
  if (!IsInstalled("cc")) GTEST_SKIP() << "no C compiler";
  for (const std::string blade : {"small", "curved"}) {
    const ProgramRun exported = RunBladecurve(
        {"export", blade + ".blade.json", "--as", "so", "-o", blade + ".so"}, folder_);
    ASSERT_EQ(exported.exit_code, 0) << exported.standard_error;
    for (const std::string policy : {"constant", "criterion"}) {
      const std::string cut = " --material cloth --close-deg 28:10:20:1 --csv - --policy " + policy;
      const ProgramRun of_json = Run(blade + ".blade.json" + cut), of_so = Run(blade + ".so" + cut);
      EXPECT_EQ(of_json.exit_code, 0) << of_json.standard_error;
      EXPECT_GT(of_json.standard_output.size(), 1000u);
      EXPECT_EQ(of_json.standard_output, of_so.standard_output) << blade << ", " << policy;
      EXPECT_EQ(of_json.standard_error, of_so.standard_error) << blade << ", " << policy;
    }
  }
}

TEST_F(TorqueCommand, AddsTheFrictionOfTheDirection) {
  WriteText(folder_ / "friction.csv", "theta_deg,closing_n,opening_n\n0,2,-1\n40,1,-0.5\n");
  const std::string cut = "small.blade.json --material paper --close-deg 28:20:24 --radius-mm 98";
  const NumberTable plain = Csv(cut), rubbing = Csv(cut + " --friction friction.csv");
  const std::vector<double>& theta_deg = rubbing.Get("theta_deg");
  for (std::size_t i = 1; i < rubbing.num_rows(); ++i) {
    const double closing_n = 2 - theta_deg[i] / 40, opening_n = -1 + theta_deg[i] / 80;
    const double friction_n = theta_deg[i] < theta_deg[i - 1] ? closing_n : opening_n;
    constexpr double kRounding = 1e-12;
    EXPECT_NEAR(rubbing.Get("friction_n")[i], friction_n, kRounding) << i;
    EXPECT_NEAR(rubbing.Get("force_n")[i] - plain.Get("force_n")[i], friction_n, kRounding) << i;
    EXPECT_EQ(rubbing.Get("torque_nmm")[i], plain.Get("torque_nmm")[i]) << i;
  }
}

TEST_F(TorqueCommand, ReplaysAMotionBesideWhatWasMeasured) {
  // Measured: what the model says, 0.25 N more while it cuts.
  TorqueModel model(SmallMetzenbaum(), PaperMaterials()[0], {45, 68});
  std::string motion = "t_s,theta_deg,pivot_mm,force_n\n";
  int cutting = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double theta_deg = 28 - 0.011 * i, pivot_mm = i > 1000 ? 0.002 * (i - 1000) : 0;
    const TorqueSample sample = model.Step(theta_deg * kDegree, pivot_mm, 1e-3);
    const bool cuts = sample.phase == Phase::kCutting;
    cutting += cuts;
    for (const double value : {1e-3 * i, theta_deg, pivot_mm}) motion += NumberText(value) + ",";
    motion += NumberText(sample.torque_nmm / 98 + (cuts ? 0.25 : 0)) + "\n";
  }
  WriteText(folder_ / "motion.csv", motion);
  const ProgramRun run =
      Run("small.blade.json --material paper --motion motion.csv --x-edge-mm 45 --x-end-mm 68 "
          "--radius-mm 98 --csv -");
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  const NumberTable csv = ParseNumberTable(run.standard_output, "torque.csv");
  ASSERT_EQ(csv.num_rows(), 2001u);
  EXPECT_EQ(csv.Get("pivot_mm").back(), 2);
  constexpr double kRounding = 1e-9;
  for (std::size_t i = 0; i < csv.num_rows(); ++i) {
    const double excess_n = csv.Get("measured_n")[i] - csv.Get("force_n")[i];
    EXPECT_NEAR(excess_n * (excess_n - 0.25), 0, kRounding) << i;
  }
  const std::string line =
      "cutting       mean -0.25, rms 0.25, " + std::to_string(cutting) + " samples\n";
  EXPECT_NE(run.standard_error.find(line), std::string::npos) << run.standard_error;
}

TEST_F(TorqueCommand, FluctuatesOnlyWhenAskedAndAsSeeded) {
  const auto torque = [this](const std::string& flags) {
    return Csv(std::string(kCut) + flags).Get("torque_nmm");
  };
  const std::vector<double> smooth = torque(""), rough = torque(" --rupture-mm 0.4 --seed 5");
  EXPECT_EQ(smooth, torque(" --seed 5 --rupture-spread 0.1"));
  EXPECT_EQ(rough, torque(" --rupture-mm 0.4 --seed 5"));
  EXPECT_NE(rough, smooth);
  EXPECT_NE(rough, torque(" --rupture-mm 0.4 --seed 6"));
}

TEST_F(TorqueCommand, RunsInRealTimeAndReportsIt) {
  const ProgramRun run =
      Run("small.blade.json --material paper --close-deg 28:4 --rate-deg-per-s 100 --rate-hz 1000 "
          "--radius-mm 98 --realtime --csv -");
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  for (const char* word :
       {"241 ticks at 1000 Hz", "missed deadlines", "compute", "period", "p99.9", "N/mm"}) {
    EXPECT_NE(run.standard_error.find(word), std::string::npos) << word << run.standard_error;
  }
  // The hand follows the motion it wants, held back by its damping and the plate.
  const NumberTable csv = ParseNumberTable(run.standard_output, "torque.csv");
  ASSERT_EQ(csv.num_rows(), 241u);
  EXPECT_NEAR(csv.Get("theta_deg").front(), 28, 1e-9);
  EXPECT_LT(csv.Get("theta_deg").back(), 10);
}

TEST_F(TorqueCommand, FrictionHoldsTheHandBackInRealTime) {
  WriteText(folder_ / "friction.csv", "theta_deg,closing_n\n0,4\n40,4\n");
  const std::string run =
      "small.blade.json --material paper --close-deg 28:4 --rate-deg-per-s 200 --radius-mm 98 "
      "--realtime";
  const double free_deg = Csv(run).Get("theta_deg").back();
  const double held_deg = Csv(run + " --friction friction.csv").Get("theta_deg").back();
  // The hand's spring of 0.5 N/mm lags by 4 N of friction over 98 mm of handle.
  EXPECT_NEAR((held_deg - free_deg) * kDegree, 4 / 0.5 / 98, 0.5 * kDegree);
}

TEST_F(TorqueCommand, PlotsAsPng) {
  ASSERT_EQ(Run(std::string(kCut) + " --quiet --plot cut.png").exit_code, 0);
  const std::string png = ReadText(folder_ / "cut.png");
  EXPECT_TRUE(png.starts_with("\x89PNG\r\n"));
  EXPECT_GT(png.size(), 10000u);
}

TEST_F(TorqueCommand, PlotsAsSvg) {
  ASSERT_EQ(Run(std::string(kCut) + " --quiet --plot cut.svg").exit_code, 0);
  const std::string svg = ReadText(folder_ / "cut.svg");
  EXPECT_TRUE(svg.starts_with("<svg ")) << svg.substr(0, 40);
  for (const char* word : {"deformation", "cutting", "through", "</svg>"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
}

struct WrongTorque {
  std::string arguments, word;
};

TEST_F(TorqueCommand, WrongUseIsSaidOnOneLine) {
  WriteText(folder_ / "corrupt.blade.json", "{\"format\":\"bladecurve/1\",\"name\":\"x\",\"cur");
  WriteText(folder_ / "material.json", "{\"format\":\"bladecurve-material/1\",\"name\":\"x\"}");
  WriteText(folder_ / "motion.csv", "t_s,theta_deg\n0,20\n1,oops\n");
  WriteText(folder_ / "order.csv", "t_s,theta_deg\n0,20\n2,19\n1,18\n");
  WriteText(folder_ / "corrupt.so", std::string("\x7f") + "ELF nothing");
  const std::string cut = "small.blade.json --material paper ";
  const std::vector<WrongTorque> cases = {
      {"", "BLADE"},
      {"small.blade.json --close-deg 28:4", "--material"},
      {cut, "--close-deg"},
      {cut + "--close-deg 28:4 --motion motion.csv", "--close-deg"},
      {cut + "--close-deg 28", "--close-deg"},
      {cut + "--close-deg 28:x", "--close-deg"},
      {cut + "--clsoe-deg 28:4", "did you mean --close-deg?"},
      {cut + "--close-deg 28:4 --rate-hz 0", "--rate-hz"},
      {cut + "--close-deg 28:4 --rate-hz 1e12", "--rate-hz"},
      {cut + "--close-deg 28:4 --radius-mm -1", "--radius-mm"},
      {cut + "--close-deg 28:4 --policy none", "--policy"},
      {cut + "--close-deg 28:4 --x-edge-mm 60 --x-end-mm 50", "x_end"},
      {cut + "--close-deg 28:4 --rupture-mm -1", "rupture"},
      {cut + "--close-deg 28:4 --rupture-mm 1 --rupture-spread 2", "spread"},
      {cut + "--close-deg 28:4 --plot cut.gif", "--plot"},
      {cut + "--close-deg 28:4 --realtime", "--radius-mm"},
      {cut + "--motion order.csv --radius-mm 98 --realtime", "--close-deg"},
      {cut + "--close-deg 28:4 --radius-mm 98 --realtime --seconds -1", "--seconds"},
      {cut + "--motion motion.csv", "motion.csv:3"},
      {cut + "--motion order.csv", "order.csv:4"},
      {cut + "--motion none.csv", "none.csv"},
      {cut + "--close-deg 28:4 --friction motion.csv", "motion.csv:3"},
      {"small.blade.json --material papre --close-deg 28:4", "did you mean paper?"},
      {"small.blade.json --material material.json --close-deg 28:4", "material.json: toughness"},
      {"none.blade.json --material paper --close-deg 28:4", "none.blade.json"},
      {"corrupt.blade.json --material paper --close-deg 28:4", "corrupt.blade.json"},
      {"corrupt.so --material paper --close-deg 28:4", "corrupt.so"},
  };
  for (const WrongTorque& wrong : cases) {
    const ProgramRun run = Run(wrong.arguments);
    EXPECT_EQ(run.exit_code, 2) << wrong.arguments << ": " << run.standard_error;
    EXPECT_NE(run.standard_error.find(wrong.word), std::string::npos)
        << wrong.arguments << ": " << run.standard_error;
    EXPECT_EQ(run.standard_error.find('\n'), run.standard_error.size() - 1) << run.standard_error;
    EXPECT_EQ(run.standard_output, "") << wrong.arguments;
  }
}

}  // namespace
}  // namespace bladecurve
