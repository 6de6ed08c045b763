// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "samples/json_arrays.h"
#include "tests/samples/program_run.h"

// Every photograph in samples/photos against the truth that its renderer wrote beside it.
namespace bladecurve {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Json = nlohmann::json;

// What a user would call right at a glance, and a tenth of what scripts with Otsu thresholds are
// off.
constexpr double kEdgeTolerancePx = 0.5;
constexpr double kPivotTolerancePx = 1.5;
constexpr double kThetaToleranceRad = 0.25 * std::numbers::pi / 180;
constexpr double kScaleTolerance = 0.003;

std::vector<std::string> SampleNames() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(SamplePhotos())) {
    if (entry.path().extension() == ".jpg") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// Distance of a point from a polyline.
double Distance(const Vector2d& point, const std::vector<Vector2d>& line) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vector2d along = line[i + 1] - line[i];
    const double share = std::clamp((point - line[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (line[i] + share * along - point).norm());
  }
  return nearest;
}

double EdgeRmsPx(const Json& photo, const Json& truth) {
  std::vector<Vector2d> line;
  for (const Json& point : truth["edge_upper"]["px"]) line.push_back(PointOf(point));
  double sum = 0;
  for (const Json& point : photo["upper_edge_px"])
    sum += std::pow(Distance(PointOf(point), line), 2);
  return std::sqrt(sum / static_cast<double>(photo["upper_edge_px"].size()));
}

// The camera that the renderer used, as --camera wants it.
void WriteCamera(const fs::path& path, const Json& truth) {
  const Json& camera = truth["camera"];
  const Json k1 = camera.value("distortion", Json::object()).value("k1", Json(0.0));
  const Json record = {{"width", truth["image"]["width"]},
                       {"height", truth["image"]["height"]},
                       {"K", camera["K"]},
                       {"dist", {k1, 0, 0, 0}}};
  WriteText(path, record.dump());
}

ProgramRun FitSample(const std::string& name, const Json& truth) {
  const fs::path folder = TestFolder();
  WriteCamera(folder / "camera.json", truth);
  return RunBladecurve({"fit",
                        (SamplePhotos() / (name + ".jpg")).string(),
                        "--json",
                        "-",
                        "--marker-mm",
                        truth["marker"]["size_mm"].dump(),
                        "--plane-height-mm",
                        truth["edge_upper"]["z_world_mm"].dump(),
                        "--camera",
                        "camera.json"},
                       folder);
}

// Where the screw was not seen the result says so, and its sigmas are the promise: four of them.
double Allowed(double tolerance, const Json& record, const char* sigma_key) {
  const Json& warnings = record["warnings"];
  const bool unseen =
      std::find(warnings.begin(), warnings.end(), "pivot_not_seen") != warnings.end();
  return unseen ? tolerance + 4 * record["photos"][0][sigma_key].get<double>() : tolerance;
}

class SamplePhotograph : public testing::TestWithParam<std::string> {};

TEST_P(SamplePhotograph, AgreesWithItsTruth) {
  const Json truth = Json::parse(ReadText(SamplePhotos() / (GetParam() + ".truth.json")));
  const ProgramRun run = FitSample(GetParam(), truth);
  if (truth["expect"] == "refuse") {
    EXPECT_EQ(run.exit_code, 3) << run.standard_error;
    return;
  }
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  const Json record = Json::parse(run.standard_output);
  const Json& photo = record["photos"][0];
  EXPECT_LT(EdgeRmsPx(photo, truth), kEdgeTolerancePx);
  // Seen obliquely the screw's head lies off the axis; anywhere between the two is right.
  const std::vector<Vector2d> pivot = {PointOf(truth["pivot"]["px"]),
                                       PointOf(truth["pivot"]["screw_top_center_px"])};
  EXPECT_LT(Distance(PointOf(photo["pivot_px"]), pivot),
            Allowed(kPivotTolerancePx, record, "pivot_sigma_px"));
  EXPECT_NEAR(photo["theta_rad"].get<double>(),
              truth["theta_deg"].get<double>() * std::numbers::pi / 180,
              Allowed(kThetaToleranceRad, record, "theta_sigma_rad"));
  const double mm_per_px = truth["scale"]["mm_per_px_edge_plane"]["at_pivot_along_axis"];
  EXPECT_NEAR(photo["mm_per_px"].get<double>(),
              mm_per_px,
              Allowed(kScaleTolerance * mm_per_px, record, "mm_per_px_sigma"));
}

INSTANTIATE_TEST_SUITE_P(Samples,
                         SamplePhotograph,
                         testing::ValuesIn(SampleNames()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace bladecurve
