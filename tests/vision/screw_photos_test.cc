// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Screws of photographs with known truth, from guesses off by up to a third of the shank's width.
// The photographs lie beside the project; without them there is nothing to test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "vision/photo/photo.h"
#include "vision/photographs_beside.h"
#include "vision/pivot/screw.h"
#include "vision/screw_images.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using Json = nlohmann::json;
namespace fs = std::filesystem;

const fs::path kPhotos = FolderBeside();

struct PhotoOfScrew {
  std::string name;
  fs::path file;
  Vector2d center_px;
  double sigma_px = 1;        // of the annotation, or of what the light does to a rendered rim
  double shank_width_px = 0;  // where the screw sits
  bool visible = true;
};

// Read by eye from the annotated photographs: their truth files do not state it. A negative width:
// no screw to be seen.
double ShankWidth(const std::string& name) {
  static const std::vector<std::pair<std::string, double>> widths = {{"A01", 44},
                                                                     {"A10", 62},
                                                                     {"A12", 60},
                                                                     {"A13", 77},
                                                                     {"A16", 234},
                                                                     {"A17", 36},
                                                                     {"A26", 24},
                                                                     {"A27", 25},
                                                                     {"A02", -50},
                                                                     {"A18", -40},
                                                                     {"A24", -18},
                                                                     {"B06", -14},
                                                                     {"W_9", -16}};
  for (const auto& [prefix, width] : widths) {
    if (name.rfind(prefix, 0) == 0) return width;
  }
  return 0;
}

Vector2d PointFrom(const Json& pair) {
  return {pair.at(0).get<double>(), pair.at(1).get<double>()};
}

std::optional<PhotoOfScrew> ReadTruth(const fs::path& truth_file) {
  const Json truth = Json::parse(std::ifstream(truth_file));
  PhotoOfScrew photo;
  if (truth.contains("schema")) {
    const Json& pivot = truth.at("pivot");
    photo.file = truth_file.parent_path() / truth.at("image").at("file").get<std::string>();
    photo.center_px = PointFrom(pivot.at("screw_top_center_px"));
    const double radius = pivot.at("screw_rim_check").at("radius_px");
    photo.sigma_px = 0.07 * radius;     // light from one side on a bevelled rim
    photo.shank_width_px = 4 * radius;  // as drawn by that renderer
  } else {
    photo.file = truth_file.parent_path() / truth.at("image").get<std::string>();
    photo.center_px = PointFrom(truth.at("pivot_px"));
    photo.sigma_px = truth.at("pivot_sigma_px");
    const double width = ShankWidth(photo.file.filename().string());
    if (width == 0) return std::nullopt;
    photo.shank_width_px = std::abs(width);
    photo.visible = width > 0;
  }
  photo.name = photo.file.filename().string();
  return photo;
}

std::vector<PhotoOfScrew> AllPhotos() {
  std::vector<PhotoOfScrew> photos;
  for (const char* folder : {"real", "rendered"}) {
    if (!fs::is_directory(kPhotos / folder)) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(kPhotos / folder)) {
      if (entry.path().extension() != ".json") continue;
      if (const std::optional<PhotoOfScrew> photo = ReadTruth(entry.path()))
        photos.push_back(*photo);
    }
  }
  std::sort(
      photos.begin(), photos.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return photos;
}

ScrewSearch SearchAt(const PhotoOfScrew& photo, const Vector2d& guess, Draws& draws) {
  const double width = photo.shank_width_px * draws.Uniform(0.85, 1.15);
  ScrewSearch search;
  search.guess_px = guess;
  search.radius_px = 0.4 * width;
  search.min_semi_axis_px = 0.10 * width;
  search.max_semi_axis_px = 0.45 * width;
  return search;
}

Vector2d Around(const Vector2d& center, double least, double most, Draws& draws) {
  const double angle = draws.Uniform(0, 2 * std::numbers::pi);
  return center + draws.Uniform(least, most) * Vector2d(std::cos(angle), std::sin(angle));
}

// Three sigma of the annotation, or what a partly lit rim of this size leaves open.
double Tolerance(const PhotoOfScrew& photo) { return std::max(2.5, 3 * photo.sigma_px); }

TEST(FindScrewInPhotographs, FindsWhatIsVisibleAndNothingElse) {
  const std::vector<PhotoOfScrew> photos = AllPhotos();
  if (photos.empty()) GTEST_SKIP() << "no photographs at " << kPhotos;
  constexpr int kDraws = 10;
  int right = 0, visible = 0;
  for (const PhotoOfScrew& photo : photos) {
    const cv::Mat grey = Photo::Load(photo.file).grey();
    Draws draws(5);
    int found = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const Vector2d guess = Around(photo.center_px, 0, 0.3 * photo.shank_width_px, draws);
      const std::optional<Screw> screw =
          FindScrew(grey, SrgbToneCurve(), SearchAt(photo, guess, draws));
      if (!screw) continue;
      ++found;
      EXPECT_LT((screw->center_px - photo.center_px).norm(), Tolerance(photo))
          << photo.name << " guess " << guess.transpose() << " evidence " << screw->evidence;
    }
    if (!photo.visible) continue;
    right += found;
    visible += kDraws;
    EXPECT_GE(found, kDraws * 3 / 10) << photo.name;  // every visible screw, not only on average
  }
  EXPECT_GE(right, visible * 85 / 100) << "of " << visible;
}

TEST(FindScrewInPhotographs, FindsNothingElsewhereOnScissorsAndGround) {
  const std::vector<PhotoOfScrew> photos = AllPhotos();
  if (photos.empty()) GTEST_SKIP() << "no photographs at " << kPhotos;
  constexpr int kDraws = 10;
  int found = 0, tried = 0;
  for (const PhotoOfScrew& photo : photos) {
    const cv::Mat grey = Photo::Load(photo.file).grey();
    Draws draws(6);
    for (int draw = 0; draw < kDraws; ++draw) {
      const double width = photo.shank_width_px;
      const Vector2d guess = Around(photo.center_px, 1.1 * width, 4 * width, draws);
      if (guess.x() < 0 || guess.y() < 0 || guess.x() >= grey.cols || guess.y() >= grey.rows)
        continue;
      ++tried;
      const std::optional<Screw> screw =
          FindScrew(grey, SrgbToneCurve(), SearchAt(photo, guess, draws));
      if (screw) ++found;
    }
  }
  EXPECT_GE(tried, 100);
  EXPECT_LE(found, tried / 50);  // a round tip or a printed mark now and then
}

}  // namespace
}  // namespace bladecurve
