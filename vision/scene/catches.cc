// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/catches.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/image/nearest_pixel.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// A shank from where it parts from the other one to its end; `inwards`, a unit vector across it,
// points to the other one.
struct Shank {
  Vector2d from, to, inwards;
};

Shank ShankTo(const Vector2d& end, const Vector2d& other_end, const Vector2d& crotch) {
  const Vector2d along = (end - crotch).normalized();
  const Vector2d across(-along.y(), along.x());
  return {crotch, end, (other_end - end).dot(across) > 0 ? across : -across};
}

Shank OuterSideOf(const Shank& shank) { return {shank.from, shank.to, -shank.inwards}; }

// Where a shank begins and ends across its line at a share of its length, px inwards of it: the run
// that lies beside `last` the longest way, or nearest to it; `last` again if there is none.
Run FollowTo(const cv::Mat& filled, const Shank& shank, double share, const Run& last) {
  const Vector2d line = shank.to - shank.from;
  const std::vector<Run> runs =
      RunsAcross(filled, shank.from + share * line, shank.inwards, kLimbReach * line.norm());
  const auto beside = [&](const Run& run) {
    return std::min(run.to, last.to) - std::max(run.from, last.from);
  };
  const auto best = std::max_element(
      runs.begin(), runs.end(), [&](auto& a, auto& b) { return beside(a) < beside(b); });
  return best == runs.end() ? last : *best;
}

// The highest rise of a shank's inner side, its outer side being straight there.
struct Rise {
  double height_px = 0;
  double along_px = 0;  // from where the shanks part
  double width_px = 0;  // of the shank
};

// How much a shank's inner side leaves the line to its end in a step, typically over first..last.
double SlopeOf(const std::vector<Run>& sides, int first, int last) {
  constexpr int kSpan = 12;  // steps; longer than a catch
  const auto inner = [&](int k) { return sides[static_cast<std::size_t>(k)].to; };
  std::vector<double> slopes;
  for (int k = first; k + kSpan <= last; ++k)
    slopes.push_back((inner(k + kSpan) - inner(k)) / kSpan);
  return Median(std::move(slopes));
}

// The first step at which a shank is much wider than before to its outer side, as where a ring
// begins; the number of steps if there is none.
int RingBegins(const std::vector<Run>& sides, int first, double width_px, double slope) {
  constexpr int kSpan = 3;        // steps
  constexpr double kWider = 0.6;  // of the width
  const int steps = static_cast<int>(sides.size());
  for (int k = first; k < steps; ++k) {
    const auto outer = [&](int i) { return sides[static_cast<std::size_t>(i)].from; };
    if (outer(k) - outer(k - kSpan) < kSpan * slope - kWider * width_px) return k;
  }
  return steps;
}

// cut: the frame cuts the ring, so that the line to the shank's end leaves the shank and the corner
// at which the ring begins rises above that line; a catch rises above the shank's own, too, and
// before the ring.
Rise HighestRise(const cv::Mat& filled, const Shank& shank, bool cut) {
  constexpr double kStep = 0.01, kFirst = 0.25;  // of the length
  constexpr int kSteps = 63;                     // rings lie beyond
  constexpr int kShankFrom = 5, kShankTo = 35;   // steps
  constexpr int kReach = 10;          // steps; so far on either side of it a catch has ended
  constexpr double kNarrowest = 2;    // px, of a shank
  constexpr double kStraight = 0.35;  // of the width; a broken ring's rim goes to that side, too
  constexpr double kSlimmer = 0.5;    // of the rise, beyond it; a grip stays as wide and bends away
  std::vector<Run> sides;
  std::vector<double> widths;
  for (int k = 0; k < kSteps; ++k) {
    const Run last = sides.empty() ? Run{} : sides.back();
    sides.push_back(FollowTo(filled, shank, kFirst + kStep * k, last));
    if (k >= kShankFrom && k < kShankTo) widths.push_back(sides.back().Length());
  }
  const double width = std::max(kNarrowest, Median(std::move(widths)));
  const double slope = cut ? SlopeOf(sides, kShankFrom, kShankTo) : 0;
  const int end = cut ? RingBegins(sides, kShankTo, width, slope) : kSteps;
  const auto nearer = [](const Run& a, const Run& b) { return a.to < b.to; };
  const auto slimmer = [](const Run& a, const Run& b) { return a.Length() < b.Length(); };
  Rise highest;
  highest.width_px = width;
  for (int k = kReach; k + kReach < end; ++k) {
    const auto at = sides.begin() + k;
    const auto before = std::min_element(at - kReach, at, nearer);
    const auto after = std::min_element(at + 1, at + kReach + 1, nearer);
    const auto base = [&](const auto& beside) {
      return beside->to + std::max(0.0, slope * static_cast<double>(at - beside));
    };
    const double rise = at->to - std::max(base(before), base(after));
    const double bulge = (std::min(before->from, after->from) - at->from) / width;
    const auto slim = std::min_element(at + 1, at + kReach + 1, slimmer);
    const bool ends = at->Length() - slim->Length() > kSlimmer * rise;
    if (bulge < kStraight && ends && rise > highest.height_px) {
      highest.height_px = rise;
      highest.along_px = (kFirst + kStep * k) * (shank.to - shank.from).norm();
    }
  }
  return highest;
}

}  // namespace

bool ShanksCarryCatches(const cv::Mat& filled, const BladePair& pair) {
  constexpr double kHigh = 0.5;  // of the shanks' width; ragged masks of scissors reach 0.4
  constexpr double kPlainlyHigh = 1.2;
  constexpr double kAlike = 0.1, kPlainlyAlike = 0.2;  // of how far they lie from the crotch
  if (!pair.shank_crotch) return false;
  const Shank first_shank = ShankTo(pair.shank_first, pair.shank_second, *pair.shank_crotch);
  const Shank second_shank = ShankTo(pair.shank_second, pair.shank_first, *pair.shank_crotch);
  const auto rise_on = [&](const Shank& shank) {
    return HighestRise(filled, shank, pair.shanks_run_out);
  };
  const Rise first = rise_on(first_shank), second = rise_on(second_shank);
  const double inside_px = std::min(first.height_px, second.height_px);
  // The shanks of a pair are as wide; a shadow beside one of them is not its own.
  const double width_px = std::min(first.width_px, second.width_px);
  const double unlike =
      std::abs(first.along_px - second.along_px) / std::max({first.along_px, second.along_px, 1.0});
  const double most_unlike = inside_px > kPlainlyHigh * width_px ? kPlainlyAlike : kAlike;
  if (inside_px <= kHigh * width_px || unlike >= most_unlike) return false;
  // What clings to the outer sides as well, as of veined marble, is no part of the instrument; but
  // rings that the frame cuts begin there.
  return pair.shanks_run_out || inside_px > std::max(rise_on(OuterSideOf(first_shank)).height_px,
                                                     rise_on(OuterSideOf(second_shank)).height_px);
}

}  // namespace bladecurve
