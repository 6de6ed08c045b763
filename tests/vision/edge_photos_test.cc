// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Edges of photographs with known truth, from guesses that are several pixels off. The photographs
// lie beside the project; without them there is nothing to test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "vision/edge/edge.h"
#include "vision/edge_images.h"
#include "vision/measure.h"
#include "vision/photo/photo.h"
#include "vision/photographs_beside.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using Json = nlohmann::json;
namespace fs = std::filesystem;

struct TrueEdge {
  std::string name;
  fs::path photo;
  std::vector<Vector2d> px;
  Vector2d towards_gap;       // from the middle of the edge
  double tolerance_px = 0.5;  // rms
};

// The free part of a rendered edge, or the whole of an annotated one.
std::vector<Vector2d> PointsOf(const Json& truth, const std::string& side) {
  std::vector<Vector2d> points;
  if (truth.contains("schema")) {
    const Json& edge = truth.at("edge_" + side);
    const double low = edge.at("free_u_range_mm").at(0), high = edge.at("free_u_range_mm").at(1);
    for (size_t i = 0; i < edge.at("px").size(); ++i) {
      const double u = edge.at("blade_mm").at(i).at(0);
      if (u >= low && u <= high)
        points.emplace_back(edge.at("px").at(i).at(0), edge.at("px").at(i).at(1));
    }
    return points;
  }
  for (const Json& point : truth.at(side + "_edge_px"))
    points.emplace_back(point.at(0), point.at(1));
  return points;
}

double ToleranceOf(const Json& truth, const std::string& side) {
  if (truth.contains("schema")) return 0.5;
  const char* key = side == "upper" ? "edge_sigma_px" : "lower_edge_sigma_px";
  return 1 + 2 * truth.value(key, 1.0);
}

std::vector<TrueEdge> EdgesIn(const fs::path& folder, const std::string& side) {
  std::vector<TrueEdge> edges;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().string().ends_with(".truth.json")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const Json truth = Json::parse(std::ifstream(file));
    if (truth.value("expect", "ok") == "refuse") continue;
    const std::vector<Vector2d> other = PointsOf(truth, side == "upper" ? "lower" : "upper");
    TrueEdge edge;
    edge.name = file.stem().stem().string() + " " + side;
    const Json& image = truth.at("image");
    edge.photo =
        file.parent_path() / (image.is_string() ? image : image.at("file")).get<std::string>();
    edge.px = PointsOf(truth, side);
    edge.towards_gap = other[other.size() / 2] - edge.px[edge.px.size() / 2];
    edge.tolerance_px = ToleranceOf(truth, side);
    edges.push_back(edge);
  }
  return edges;
}

double LengthOf(const std::vector<Vector2d>& line) {
  double length = 0;
  for (size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

Vector2d PointAt(const std::vector<Vector2d>& line, double along) {
  for (size_t i = 1; i < line.size(); ++i) {
    const double step = (line[i] - line[i - 1]).norm();
    if (along <= step || i + 1 == line.size())
      return line[i - 1] + (line[i] - line[i - 1]) * (along / step);
    along -= step;
  }
  return line.back();
}

// A guess that wanders about the truth by 1 to 5 px, turned a little and cut at its ends.
EdgeGuess Perturbed(const TrueEdge& edge, testing::Gaussian& random) {
  constexpr double kSpacing = 4;
  const double length = LengthOf(edge.px), amplitude = 1 + 4 * random.Uniform();
  const double bias = (random.Uniform() - 0.5) * amplitude, turn = (random.Uniform() - 0.5) * 0.02;
  const double phase = 2 * std::numbers::pi * random.Uniform(),
               wave = length * (0.4 + 0.6 * random.Uniform());
  const double first = 0.08 * length * random.Uniform(),
               last = length * (1 - 0.05 * random.Uniform());
  EdgeGuess guess;
  for (double along = first; along <= last; along += kSpacing) {
    const Vector2d tangent =
        (PointAt(edge.px, std::min(along + 5, length)) - PointAt(edge.px, std::max(along - 5, 0.0)))
            .normalized();
    const Vector2d left(tangent.y(), -tangent.x());
    const double offset = bias +
                          0.6 * amplitude * std::sin(phase + 2 * std::numbers::pi * along / wave) +
                          turn * (along - 0.5 * length);
    guess.path_px.push_back(PointAt(edge.px, along) +
                            std::clamp(offset, -amplitude, amplitude) * left);
    if (guess.path_px.size() == 1) guess.blade_on_left = left.dot(edge.towards_gap) < 0;
  }
  return guess;
}

double DistanceTo(const std::vector<Vector2d>& line, const Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 1; i < line.size(); ++i) {
    const Vector2d along = line[i] - line[i - 1];
    const double t = std::clamp((point - line[i - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (point - line[i - 1] - t * along).norm());
  }
  return nearest;
}

double RmsDistance(const LocatedEdge& found, const std::vector<Vector2d>& truth) {
  double squares = 0, count = 0;
  for (const LocatedEdgePoint& point : found.points) {
    if (!point.inlier) continue;
    squares += std::pow(DistanceTo(truth, point.point_px), 2);
    ++count;
  }
  return std::sqrt(squares / std::max(count, 1.0));
}

// Share of the tries on all edges that end within tolerance; every try is printed. A refusal is no
// success.
double ShareWithinTolerance(const std::vector<TrueEdge>& edges) {
  constexpr int kTries = 3;
  double good = 0, tries = 0;
  for (const TrueEdge& edge : edges) {
    const Photo photo = Photo::Load(edge.photo);
    testing::Gaussian random(1000);
    std::printf("%-42s tolerance %.2f px, rms", edge.name.c_str(), edge.tolerance_px);
    for (int i = 0; i < kTries; ++i, ++tries) {
      try {
        const double rms = RmsDistance(
            LocateEdge(photo.grey(), SrgbToneCurve(), Perturbed(edge, random)), edge.px);
        good += rms <= edge.tolerance_px;
        std::printf(" %.2f", rms);
      } catch (const Refused& refused) {
        std::printf(" %s", std::string(ReasonCode(refused.reason())).c_str());
      }
    }
    std::printf("\n");
  }
  return good / std::max(tries, 1.0);
}

// rms distance of the upper edge from the truth, the whole photograph being measured: with both
// blades seen, glare and dark bands are settled that one edge in grey alone leaves open.
double MeasuredRms(const TrueEdge& edge) {
  MeasureOptions options;
  options.scale.mm_per_px = 1;
  const PhotoMeasurement photo = MeasurePhoto(edge.photo, options);
  double squares = 0;
  for (const Vector2d& point : photo.upper_edge_px)
    squares += std::pow(DistanceTo(edge.px, point), 2);
  return std::sqrt(squares / static_cast<double>(photo.upper_edge_px.size()));
}

class EdgePhotos : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(folder_)) GTEST_SKIP() << "no photographs at " << folder_;
  }
  const fs::path folder_ = FolderBeside();
};

// One scene in eight has a blade that is overexposed by far; its bloom is no edge.
TEST_F(EdgePhotos, UpperEdgesOfRenderedScenesAreFound) {
  EXPECT_GE(ShareWithinTolerance(EdgesIn(folder_ / "rendered", "upper")), 0.8);
}

// One may fail, as one in eight of those held back may.
TEST_F(EdgePhotos, BothBladesTogetherSettleGlareAndShadows) {
  const std::vector<TrueEdge> edges = EdgesIn(folder_ / "rendered", "upper");
  double good = 0;
  for (const TrueEdge& edge : edges) {
    try {
      const double rms = MeasuredRms(edge);
      std::printf("%-42s rms %.2f px\n", edge.name.c_str(), rms);
      good += rms <= edge.tolerance_px;
    } catch (const Refused& refused) {
      std::printf("%-42s %s\n", edge.name.c_str(), refused.what());
    }
  }
  EXPECT_GE(good + 1, static_cast<double>(edges.size()));
}

// The lower edges lie in the shadow of the blade: some are as bright as it.
TEST_F(EdgePhotos, MostLowerEdgesOfRenderedScenesAreFound) {
  EXPECT_GE(ShareWithinTolerance(EdgesIn(folder_ / "rendered", "lower")), 0.6);
}

TEST_F(EdgePhotos, UpperEdgesOfRealPhotographsAreFound) {
  EXPECT_GE(ShareWithinTolerance(EdgesIn(folder_ / "real", "upper")), 0.9);
}

TEST_F(EdgePhotos, LowerEdgesOfRealPhotographsAreFound) {
  EXPECT_GE(ShareWithinTolerance(EdgesIn(folder_ / "real", "lower")), 0.8);
}

}  // namespace
}  // namespace bladecurve
