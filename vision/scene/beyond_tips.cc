// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/beyond_tips.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/image/contour_area.h"
#include "vision/image/cross.h"

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

using OuterContour = std::vector<cv::Point>;

// The outer outlines of what a mask shows besides one thing, without specks.
std::vector<OuterContour> OtherThings(const cv::Mat& mask, const Silhouette& one, double least_px) {
  cv::Mat rest = mask.clone();
  rest.setTo(0, one.filled);
  std::vector<OuterContour> outlines;
  if (cv::countNonZero(rest) <= least_px) return outlines;
  cv::findContours(rest, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::erase_if(outlines,
                [&](const OuterContour& outline) { return PixelsWithin(outline) <= least_px; });
  return outlines;
}

FromTip SeenFrom(const Vector2d& tip, const Vector2d& along, const OuterContour& outline) {
  FromTip seen;
  for (const cv::Point& p : outline) {
    const Vector2d from_tip = Vector2d(p.x, p.y) - tip;
    seen.Add(from_tip.dot(along), Cross(along, from_tip));
  }
  return seen;
}

// What goes on beyond a tip: which things, no wider than a limb's ring, the next of them soon
// beyond it. Empty where they reach no further than specks do.
std::vector<std::size_t> GoingOn(const std::vector<OuterContour>& things,
                                 const BladePair& pair,
                                 const BladeContour& blade) {
  constexpr double kFrom = -0.1, kSoon = 0.5, kAside = 0.4, kLong = 0.35;  // of the length
  constexpr double kSoonWidths = 3;                                        // of the shanks
  const double soon = std::max(kSoon * blade.length, kSoonWidths * pair.shank_width);
  const Vector2d along = (blade.tip - pair.pivot).normalized();
  std::vector<std::size_t> going_on;
  FromTip all;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const FromTip thing = SeenFrom(blade.tip, along, things[i]);
    if (thing.nearest < kFrom * blade.length || thing.nearest > soon + blade.length ||
        thing.aside > kAside * blade.length)
      continue;
    going_on.push_back(i);
    all.Add(thing.nearest, 0);
    all.Add(thing.farthest, 0);
  }
  const bool goes_on = all.nearest < soon && all.farthest - all.nearest > kLong * blade.length;
  return goes_on ? going_on : std::vector<std::size_t>();
}

}  // namespace

bool GoOnBeyondTips(const cv::Mat& mask, const Silhouette& silhouette, const BladePair& pair) {
  constexpr double kLeastArea = 0.5;  // of the shanks' width, squared
  const std::vector<OuterContour> things =
      OtherThings(mask, silhouette, kLeastArea * pair.shank_width * pair.shank_width);
  const std::vector<std::size_t> first = GoingOn(things, pair, pair.first);
  const std::vector<std::size_t> second = GoingOn(things, pair, pair.second);
  const auto is_shank = [&](const BladeContour& limb, const std::vector<std::size_t>& going_on) {
    return pair.shanks_run_out && limb.taper > kTapers && !going_on.empty();
  };
  if (is_shank(pair.first, first) || is_shank(pair.second, second)) return true;
  const bool share_one =
      std::find_first_of(first.begin(), first.end(), second.begin(), second.end()) != first.end();
  return !first.empty() && !second.empty() && !share_one;
}

}  // namespace bladecurve
