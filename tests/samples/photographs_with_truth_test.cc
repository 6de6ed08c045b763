// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/photographs_with_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "samples/scene_truth.h"
#include "samples/validation_run.h"
#include "tests/samples/program_run.h"
#include "vision/render/render.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

// Text keeps 17 digits; the cubic is solved for.
constexpr double kRoundOff = 1e-9;

SceneSpec TiltedWithMarker() {
  SceneSpec spec;
  spec.camera.tilt_rad = 0.1;
  spec.camera.k1 = -0.01;
  spec.scissors.skew_mm = 0.2;
  spec.markers = {{.id = 3, .size_mm = 25, .center_mm = {-90, 60}}};
  return spec;
}

// A folder with one sample photograph and its truth, changed by `change`.
fs::path FolderWithMayo(const std::function<void(nlohmann::json*)>& change) {
  const fs::path folder = TestFolder();
  fs::copy_file(SamplePhotos() / "mayo.jpg", folder / "mayo.jpg");
  nlohmann::json truth = nlohmann::json::parse(ReadText(SamplePhotos() / "mayo.truth.json"));
  change(&truth);
  WriteText(folder / "mayo.truth.json", truth.dump());
  return folder;
}

std::string Complaint(const fs::path& folder) try {
  (void)PhotographsWithTruth(folder);
  return "";
} catch (const std::invalid_argument& error) {
  return error.what();
}

TEST(PhotographsWithTruth, ReadWhatSceneTruthJsonWrites) {
  const SceneTruth truth = TruthOf(TiltedWithMarker());
  const fs::path folder = TestFolder();
  WriteText(folder / "a.png", "");
  WriteText(folder / "a.truth.json", SceneTruthJson(truth, "a.png", "refuse").dump());
  const auto photographs = PhotographsWithTruth(folder);
  ASSERT_EQ(photographs.size(), 1u);
  const PhotographWithTruth& read = photographs.front();
  EXPECT_EQ(read.photo, folder / "a.png");
  EXPECT_TRUE(read.to_refuse);
  EXPECT_TRUE(read.camera_known);
  EXPECT_TRUE(read.truth.camera.k.isApprox(truth.camera.k));
  EXPECT_EQ(read.truth.camera.k1, truth.camera.k1);
  EXPECT_NEAR(read.truth.theta_rad, truth.theta_rad, kRoundOff);
  EXPECT_EQ(read.truth.pivot_px, truth.pivot_px);
  EXPECT_EQ(read.truth.screw_px, truth.screw_px);
  EXPECT_EQ(read.truth.mm_per_px, truth.mm_per_px);
  EXPECT_EQ(read.truth.edge_height_mm, truth.edge_height_mm);
  ASSERT_EQ(read.truth.markers.size(), 1u);
  EXPECT_EQ(read.truth.markers.front().size_mm, 25);
  for (const auto& [edge, expected] :
       {std::pair(read.truth.upper, truth.upper), std::pair(read.truth.lower, truth.lower)}) {
    EXPECT_EQ(edge.px, expected.px);
    EXPECT_EQ(edge.free_from_mm, expected.free_from_mm);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(edge.shape.bernstein_mm[i], expected.shape.bernstein_mm[i], kRoundOff);
  }
}

TEST(PhotographsWithTruth, SayWhichFileLacksWhat) {
  const std::string missing =
      Complaint(FolderWithMayo([](nlohmann::json* truth) { truth->at("pivot").erase("px"); }));
  EXPECT_NE(missing.find("mayo.truth.json"), std::string::npos) << missing;
  EXPECT_NE(missing.find("'px'"), std::string::npos) << missing;
}

TEST(PhotographsWithTruth, OfAnotherSchemaAreNamed) {
  const std::string other =
      Complaint(FolderWithMayo([](nlohmann::json* truth) { (*truth)["schema"] = "other/2"; }));
  EXPECT_NE(other.find("scissors-heldout/1"), std::string::npos) << other;
}

TEST(PhotographsWithTruth, NeedAPhotographBesideEveryTruth) {
  const fs::path folder = FolderWithMayo([](nlohmann::json*) {});
  fs::remove(folder / "mayo.jpg");
  EXPECT_NE(Complaint(folder).find("neither a .jpg nor a .png"), std::string::npos);
}

TEST(PhotographsWithTruth, NeedATruth) {
  EXPECT_NE(Complaint(TestFolder()).find("holds no NAME.truth.json"), std::string::npos);
}

TEST(ValidatePhotograph, SeesByHowMuchAnEdgeLiesFromTheTruth) {
  constexpr double kShiftPx = 2;  // of the upper blade's true edge, down
  const fs::path folder = FolderWithMayo([](nlohmann::json* truth) {
    for (nlohmann::json& point : truth->at("edge_upper").at("px"))
      point[1] = point[1].get<double>() + kShiftPx;
  });
  const PhotographWithTruth mayo = PhotographsWithTruth(folder).front();
  const Eigen::Vector2d chord = mayo.truth.upper.px.back() - mayo.truth.upper.px.front();
  const double across_px = kShiftPx * std::abs(chord.normalized().x());
  const ValidationRow row = ValidatePhotograph(mayo, folder);
  ASSERT_TRUE(row.measured()) << row.outcome << row.detail;
  EXPECT_EQ(row.scene, "mayo");
  constexpr double kErrorPx = 0.1;
  EXPECT_NEAR(row.Of(Quantity::kUpperEdge).size, across_px, kErrorPx);
  EXPECT_LT(row.Of(Quantity::kLowerEdge).size, kErrorPx);
}

TEST(Validate, OfAFolderMeasuresWhatIsInItAndCountsRightRefusals) {
  const ProgramRun run = RunBladecurve(
      {"validate", "--photographs", SamplePhotos().string(), "--no-times"}, TestFolder());
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_NE(run.standard_output.find("5 scenes\n"), std::string::npos) << run.standard_output;
  EXPECT_NE(run.standard_output.find("can be measured: 4 ok, 0 review, 0 refused\n"),
            std::string::npos)
      << run.standard_output;
  EXPECT_NE(
      run.standard_output.find("must be refused: 1 refused (closed 1), 0 with another reason"),
      std::string::npos)
      << run.standard_output;
}

TEST(Validate, TakesScenesOrPhotographsNotBoth) {
  const ProgramRun run = RunBladecurve(
      {"validate", "--photographs", SamplePhotos().string(), "--scenes", "3"}, TestFolder());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.standard_error.find("--scenes excludes --photographs"), std::string::npos)
      << run.standard_error;
}

}  // namespace
}  // namespace bladecurve
