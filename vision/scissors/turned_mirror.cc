// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/turned_mirror.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "vision/image/bilinear.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

using Eigen::Array3d;
using Eigen::Vector2d;

// Light, and red and blue over green; in grey levels.
Array3d LightAndColours(const BladeView& view, const Vector2d& at) {
  const PicturePart& colours = view.Colours();
  const Vector2d inside = at - Vector2d(colours.corner_px.x, colours.corner_px.y);
  const auto level = [&](int channel) {
    return Bilinear<cv::Vec3b>(colours.pixels, inside, [channel](const cv::Vec3b& bgr) {
      return static_cast<double>(bgr[channel]);
    });
  };
  const double green = level(1);
  return {Bilinear<uchar>(view.grey(), at), level(2) - green, level(0) - green};
}

// By how much they are more beyond a point of an edge than within the blade.
Array3d StepAt(const BladeView& view, const LocatedEdgePoint& point) {
  constexpr int kTaps = 3;  // px, to either side
  Array3d step = Array3d::Zero();
  for (int tap = 1; tap <= kTaps; ++tap) {
    step += LightAndColours(view, point.trend_px + tap * point.normal) -
            LightAndColours(view, point.trend_px - tap * point.normal);
  }
  return step / kTaps;
}

// How much of an edge shows steps of one sign, -1 to 1.
Array3d SignedShare(const BladeView& view, const std::vector<LocatedEdgePoint>& edge) {
  constexpr double kPlain = 5;  // grey levels
  Array3d sum = Array3d::Zero();
  for (const LocatedEdgePoint& point : edge) sum += (StepAt(view, point) / kPlain).tanh();
  return sum / static_cast<double>(edge.size());
}

std::vector<LocatedEdgePoint> SomeOf(const std::vector<LocatedEdgePoint>& edge) {
  constexpr std::size_t kEnough = 200;
  std::vector<LocatedEdgePoint> some;
  for (std::size_t i = 0; i < edge.size(); i += 1 + edge.size() / kEnough) some.push_back(edge[i]);
  return some;
}

// Turns at which a line is seen along the whole edge.
struct SeenLine {
  double place = 0;    // their middle
  bool rises = false;  // light does, going outwards, and no colour changes
};

// From the first turn on.
std::vector<SeenLine> LinesSeen(const std::vector<Array3d>& shares) {
  constexpr double kSeen = 0.75;
  std::vector<SeenLine> lines;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    double sum = 0, moment = 0, light = 0, colour = 0;
    for (; i < shares.size() && shares[i].abs().maxCoeff() >= kSeen; ++i) {
      const double weight = shares[i].abs().maxCoeff();
      sum += weight;
      moment += weight * static_cast<double>(i);
      light += shares[i][0];
      colour = std::max(colour, shares[i].tail<2>().abs().maxCoeff());
    }
    if (sum > 0) lines.push_back({moment / sum, light > 0 && colour < kSeen});
  }
  return lines;
}

}  // namespace

std::optional<MirrorLine> FindTurnedMirror(const BladeView& view,
                                           const LocatedBlade& other,
                                           const MirrorLine& line) {
  constexpr double kStepPx = 1, kMostRad = 10 * std::numbers::pi / 180;
  const std::vector<LocatedEdgePoint> edge = SomeOf(other.used);
  const Vector2d pivot_px = line.map.ImageFromPlane(line.pivot);
  const double step_rad = kStepPx / (edge.back().trend_px - pivot_px).norm();
  const int most = static_cast<int>(kMostRad / step_rad);  // to either side
  const auto turned = [&](double steps) { return line.TurnedBy(steps * step_rad); };
  const LocatedEdgePoint end = line.Reflected(edge.back());
  const Vector2d onwards = turned(1).Reflected(edge.back()).trend_px - end.trend_px;
  const double inwards = onwards.dot(end.normal) < 0 ? 1 : -1;
  const std::vector<Array3d> shares = ParallelMap(2 * most + 1, [&](int i) {
    return SignedShare(view, turned(inwards * (i - most)).Reflected(edge));
  });
  const std::vector<SeenLine> lines = LinesSeen(shares);
  if (lines.empty() || (lines.front().rises && lines.size() > 1)) return std::nullopt;
  return turned(inwards * (lines.front().place - most));
}

}  // namespace bladecurve
