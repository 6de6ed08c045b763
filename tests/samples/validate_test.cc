// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "samples/csv_text.h"
#include "samples/validation_plot.h"
#include "samples/validation_run.h"
#include "samples/validation_scene.h"
#include "samples/validation_table.h"
#include "tests/samples/program_run.h"
#include "vision/pivot/head_place.h"
#include "vision/render/render.h"

namespace bladecurve {
namespace {

ValidationRow Measured(int number, double error, double sigma) {
  ValidationRow row;
  row.scene = std::to_string(number);
  row.expected = "ok";
  row.outcome = "ok";
  row.ms = 10 + number;
  row.errors[static_cast<std::size_t>(Quantity::kTheta)] = {.size = std::abs(error),
                                                            .stated = {{error, sigma}}};
  return row;
}

ValidationRow Refused(const std::string& expected, const std::string& outcome) {
  ValidationRow row;
  row.expected = expected;
  row.outcome = outcome;
  row.detail = "scene: said \"no\", twice";
  return row;
}

// The line of the table that begins with `start`.
std::string LineOf(const std::string& table, const std::string& start) {
  const std::size_t begin = table.find("\n" + start);
  if (begin == std::string::npos) return "";
  return table.substr(begin + 1, table.find('\n', begin + 1) - begin - 1);
}

TEST(Percentile, IsTheSmallestValueThatEnoughDoNotExceed) {
  EXPECT_EQ(Percentile({4, 1, 3, 2}, 0.5), 2);
  EXPECT_EQ(Percentile({4, 1, 3, 2}, 0.95), 4);
  EXPECT_EQ(Percentile({7}, 0.01), 7);
  EXPECT_EQ(Percentile({std::nan(""), 5}, 1), 5);
  EXPECT_TRUE(std::isnan(Percentile({}, 0.5)));
}

// In whatever order the scenes come; sources that are compiled as one must not lend each other
// theirs.
TEST(ValidationTable, GivesTheMedianAndTheLargestOfTheErrors) {
  const std::vector<ValidationRow> rows = {
      Measured(0, 4, 1), Measured(1, 1, 1), Measured(2, 3, 1), Measured(3, 2, 1)};
  std::istringstream line(LineOf(ValidationTable(rows, false), "theta"));
  std::string name, unit;
  double median = 0, most = 0, largest = 0;
  line >> name >> unit >> median >> most >> largest;
  EXPECT_EQ(median, 2);
  EXPECT_EQ(most, 4);
  EXPECT_EQ(largest, 4);
}

TEST(ValidationTable, CountsAnIntervalAsHeldUpTo196Sigma) {
  const std::vector<ValidationRow> rows = {
      Measured(0, 1.95, 1), Measured(1, -1.95, 1), Measured(2, 1.97, 1), Measured(3, -5, 1)};
  EXPECT_NE(LineOf(ValidationTable(rows, true), "theta").find("50.0 % of 4"), std::string::npos)
      << ValidationTable(rows, true);
}

TEST(ValidationTable, SaysWhatSetsTheScenesApartThatMissTheTruth) {
  std::vector<ValidationRow> rows;
  for (int scene = 0; scene < 100; ++scene) {
    rows.push_back(Measured(scene, scene < 20 ? 3 : 0.5, 1));
    rows.back().warnings = {"scale_four_corners"};
    if (scene < 15) rows.back().warnings.emplace_back("pivot_not_seen");
  }
  const std::string table = ValidationTable(rows, false);
  EXPECT_NE(table.find("theta: of 20 scenes that miss the truth 15 warn pivot_not_seen, of the "
                       "other 80 scenes 0"),
            std::string::npos)
      << table;
}

TEST(ValidationTable, SaysNothingOfIntervalsThatHold) {
  std::vector<ValidationRow> rows;
  for (int scene = 0; scene < 100; ++scene) rows.push_back(Measured(scene, scene < 5 ? 3 : 0.5, 1));
  EXPECT_EQ(ValidationTable(rows, false).find("miss the truth"), std::string::npos);
}

TEST(ValidationTable, TellsRightRefusalsFromWrongOnes) {
  const std::vector<ValidationRow> rows = {Measured(0, 0.1, 1),
                                           Refused("ok", "low_contrast"),
                                           Refused("closed", "closed"),
                                           Refused("closed", "not_scissors"),
                                           [] {
                                             ValidationRow row = Measured(4, 0, 1);
                                             row.expected = "blades_not_visible";
                                             return row;
                                           }()};
  const std::string table = ValidationTable(rows, false);
  EXPECT_NE(table.find("1 ok, 0 review, 1 refused (low_contrast 1)"), std::string::npos) << table;
  EXPECT_NE(
      table.find(
          "1 refused (closed 1), 1 with another reason (not_scissors for closed 1), 1 ACCEPTED"),
      std::string::npos)
      << table;
}

TEST(ValidationCsv, HasOneFieldForEveryHeading) {
  const std::vector<ValidationRow> rows = {Measured(0, 0.5, 0.25), Refused("ok", "blurred")};
  for (const bool with_times : {true, false}) {
    const auto lines = ParseCsv(ValidationCsv(rows, with_times));
    ASSERT_EQ(lines.size(), 3u);
    for (const auto& line : lines) EXPECT_EQ(line.size(), lines.front().size());
    const auto heading = std::find(lines[0].begin(), lines[0].end(), "theta_sigmas");
    ASSERT_NE(heading, lines[0].end());
    EXPECT_EQ(lines[1][static_cast<std::size_t>(heading - lines[0].begin())], "2");
    EXPECT_EQ(lines[2].back(), "scene: said \"no\", twice");
  }
}

TEST(WorkPrecisionSvg, DrawsADotForEveryMeasuredScene) {
  const std::vector<ValidationRow> rows = {
      Measured(0, 0.5, 1), Measured(1, 0.003, 1), Refused("ok", "blurred")};
  const std::string svg = WorkPrecisionSvg(rows);
  std::size_t dots = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1))
    ++dots;
  EXPECT_EQ(dots, 2u);
  EXPECT_NE(svg.find("1 refused though measurable"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(WorkPrecisionSvg, OfNoMeasuredSceneIsEmptyButValid) {
  const std::string svg = WorkPrecisionSvg({Refused("closed", "closed")});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(MakeValidationScene, RefusesEveryTenthSceneForItsOwnReason) {
  for (const Difficulty difficulty :
       {Difficulty::kClean, Difficulty::kStandard, Difficulty::kHard, Difficulty::kSun}) {
    for (int number = 0; number < 60; ++number) {
      const ValidationScene scene = MakeValidationScene(number, 3, difficulty);
      ASSERT_EQ(scene.refuse.has_value(), number % 10 == 9) << number;
      const SceneTruth truth = TruthOf(scene.spec);
      if (!scene.refuse) {
        EXPECT_TRUE(truth.tips_in_frame && scene.spec.with_scissors && truth.theta_rad > 0.1)
            << number;
      } else if (*scene.refuse == Reason::kBladesNotVisible) {
        EXPECT_FALSE(truth.tips_in_frame) << number;
      } else if (*scene.refuse == Reason::kClosed) {
        EXPECT_LT(truth.theta_rad, 0) << number;
      } else {
        EXPECT_FALSE(scene.spec.with_scissors) << number;
      }
    }
  }
}

TEST(MakeValidationScene, CutsATipOffHoweverWideTheBladesOpen) {
  for (int number = 19; number < 1000; number += 30) {
    const ValidationScene scene = MakeValidationScene(number, 21, Difficulty::kHard);
    ASSERT_EQ(scene.refuse, Reason::kBladesNotVisible);
    EXPECT_FALSE(TruthOf(scene.spec).tips_in_frame) << number;
  }
}

// Mean and standard deviation.
std::pair<double, double> MeanAndSpread(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / static_cast<double>(values.size()))};
}

TEST(MakeValidationScene, VariesTheScrewAsTheProgramTakesItToVary) {
  constexpr int kScenes = 2000;
  std::vector<double> height_mm, slot_along, slot_across;
  for (int number = 0; number < kScenes; ++number) {
    const ValidationScene scene = MakeValidationScene(number, 3, Difficulty::kStandard);
    height_mm.push_back(scene.spec.scissors.screw_mm);
    slot_along.push_back(scene.spec.scissors.slot_off.x());
    slot_across.push_back(scene.spec.scissors.slot_off.y());
  }
  const double sigmas = 4 / std::sqrt(kScenes);  // of the mean, and of the spread all the more
  const auto expect = [&](const std::vector<double>& values, double mean, double spread) {
    EXPECT_NEAR(MeanAndSpread(values).first, mean, sigmas * spread);
    EXPECT_NEAR(MeanAndSpread(values).second, spread, sigmas * spread);
  };
  expect(height_mm, kHeadMm, kHeadSigmaMm);
  expect(slot_along, 0, kEndsOffCentre);
  expect(slot_across, 0, kSlotOffCentre);
}

TEST(Validate, GivesTheSameBytesForTheSameSeed) {
  const auto run = [](const std::string& scenes, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "validate", "--scenes", scenes, "--difficulty", "clean", "--no-times", "--csv", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunBladecurve(arguments, TestFolder());
  };
  // One scene in ten is to be refused; errors and reasons are to be as reproducible as the rest.
  const ProgramRun ten = run("10", {});
  ASSERT_EQ(ten.exit_code, 0) << ten.standard_error;
  EXPECT_NE(ten.standard_output.find("\n9,closed,closed,"), std::string::npos)
      << ten.standard_output;
  EXPECT_EQ(run("10", {"--threads", "2"}).standard_output, ten.standard_output);
  const auto rows = ParseCsv(ten.standard_output);
  ASSERT_EQ(rows.size(), 11u) << ten.standard_output;
  const auto other_seed = ParseCsv(run("1", {"--seed", "2"}).standard_output);
  ASSERT_EQ(other_seed.size(), 2u);
  EXPECT_NE(other_seed[1], rows[1]);
}

TEST(Validate, RefusesImpossibleCounts) {
  EXPECT_EQ(RunBladecurve({"validate", "--scenes", "0"}, TestFolder()).exit_code, 2);
  EXPECT_EQ(RunBladecurve({"validate", "--difficulty", "impossible"}, TestFolder()).exit_code, 2);
}

}  // namespace
}  // namespace bladecurve
