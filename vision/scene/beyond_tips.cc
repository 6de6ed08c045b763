// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/beyond_tips.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Where a thing lies as seen from a blade's tip.
struct FromTip {
  double nearest = std::numeric_limits<double>::infinity();    // along the blade
  double farthest = -std::numeric_limits<double>::infinity();  // the same
  double aside = 0;                                            // at most, to either side

  void Add(double along, double across) {
    nearest = std::min(nearest, along);
    farthest = std::max(farthest, along);
    aside = std::max(aside, std::abs(across));
  }
};

// What a mask shows besides one thing: a label for each pixel, 0 for none, and every thing's area.
struct OtherThings {
  cv::Mat labels;  // CV_32SC1
  std::vector<int> area_px;

  OtherThings(const cv::Mat& mask, const Silhouette& one) {
    cv::Mat rest = mask.clone();
    rest.setTo(0, one.filled);
    cv::Mat statistics, centers;
    const int count = cv::connectedComponentsWithStats(rest, labels, statistics, centers);
    for (int label = 0; label < count; ++label)
      area_px.push_back(statistics.at<int>(label, cv::CC_STAT_AREA));
  }

  // All of them.
  [[nodiscard]] std::vector<FromTip> SeenFrom(const Vector2d& tip, const Vector2d& along) const {
    std::vector<FromTip> seen(area_px.size());
    for (int y = 0; y < labels.rows; ++y) {
      const int* label = labels.ptr<int>(y);
      for (int x = 0; x < labels.cols; ++x) {
        if (label[x] == 0) continue;
        const Vector2d from_tip = Vector2d(x, y) - tip;
        seen[static_cast<std::size_t>(label[x])].Add(
            from_tip.dot(along), along.x() * from_tip.y() - along.y() * from_tip.x());
      }
    }
    return seen;
  }
};

// What goes on beyond a tip: the labels of things no wider than a limb's ring, the next of them
// soon beyond it. Empty where they reach no further than specks do.
std::vector<std::size_t> GoingOn(const OtherThings& things,
                                 const BladePair& pair,
                                 const BladeContour& blade) {
  constexpr double kFrom = -0.1, kSoon = 0.5, kAside = 0.4, kLong = 0.35;  // of the length
  constexpr double kSoonWidths = 3, kLeastArea = 0.5;  // of the shanks, of their square
  const double soon = std::max(kSoon * blade.length, kSoonWidths * pair.shank_width);
  const std::vector<FromTip> seen =
      things.SeenFrom(blade.tip, (blade.tip - pair.pivot).normalized());
  std::vector<std::size_t> going_on;
  FromTip all;
  for (std::size_t label = 1; label < seen.size(); ++label) {
    const FromTip& thing = seen[label];
    if (things.area_px[label] <= kLeastArea * pair.shank_width * pair.shank_width) continue;
    if (thing.nearest < kFrom * blade.length || thing.nearest > soon + blade.length ||
        thing.aside > kAside * blade.length)
      continue;
    going_on.push_back(label);
    all.Add(thing.nearest, 0);
    all.Add(thing.farthest, 0);
  }
  const bool goes_on = all.nearest < soon && all.farthest - all.nearest > kLong * blade.length;
  return goes_on ? going_on : std::vector<std::size_t>();
}

}  // namespace

bool BothGoOnBeyondTips(const cv::Mat& mask, const Silhouette& silhouette, const BladePair& pair) {
  const OtherThings things(mask, silhouette);
  const std::vector<std::size_t> first = GoingOn(things, pair, pair.first);
  const std::vector<std::size_t> second = GoingOn(things, pair, pair.second);
  const bool share_one =
      std::find_first_of(first.begin(), first.end(), second.begin(), second.end()) != first.end();
  return !first.empty() && !second.empty() && !share_one;
}

}  // namespace bladecurve
