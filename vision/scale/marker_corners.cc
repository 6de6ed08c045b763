// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/marker_corners.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "vision/image/reduced.h"
#include "vision/parallel.h"
#include "vision/scale/marker_fit.h"
#include "vision/scale/marker_model.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using Corners = std::array<Vector2d, 4>;
using SquareSides = std::array<StraightEdge, 4>;  // side k from corner k to the next

// How far the lens pushes the middle of a side off its chord, along (-dy, dx).
double Bow(const std::optional<Camera>& camera, const Vector2d& from, const Vector2d& to) {
  if (!camera) return 0;
  const Vector2d middle = 0.5 * (Undistorted(*camera, from) + Undistorted(*camera, to));
  const Vector2d direction = (to - from).normalized();
  const Vector2d off = Distorted(*camera, middle) - 0.5 * (from + to);
  return off.dot(Vector2d(-direction.y(), direction.x()));
}

double ShortestSide(const Corners& corners) {
  double shortest = (corners[0] - corners[3]).norm();
  for (size_t k = 0; k < 3; ++k)
    shortest = std::min(shortest, (corners[k + 1] - corners[k]).norm());
  return shortest;
}

// Rejects things that OpenCV takes for a marker and that are no black square with straight sides on
// paper.
bool LooksPrinted(const SquareSides& sides) {
  constexpr double kMinUsed = 0.5;     // sides half covered say too little
  constexpr double kMaxUneven = 0.35;  // paper beside a marker is about equally bright on all sides
  double low = 1e9, high = 0;
  for (const StraightEdge& side : sides) {
    // Clockwise, the inside lies along (-dy, dx). How far beyond white paper is is hardly seen.
    const double contrast = std::min(-side.contrast, 1.0);
    if (contrast <= 0 || side.used < kMinUsed) return false;
    low = std::min(low, contrast);
    high = std::max(high, contrast);
  }
  return low > kMaxUneven * high;
}

double BrightestSide(const SquareSides& sides) {
  double brightest = 0;
  for (const StraightEdge& side : sides) brightest = std::max(brightest, side.bright);
  return brightest;
}

SeenMarker Unlocated(const RoughMarker& rough) {
  SeenMarker marker;
  marker.id = rough.id;
  marker.corners_px = rough.corners_px;
  return marker;
}

// 1000 to 2000 pixels: markers of 1/30 of the picture keep six pixels a cell.
int QuickReduction(const cv::Mat& grey) {
  return std::max(1, std::max(grey.cols, grey.rows) / 1000);
}

std::vector<SeenMarker> FindAtReduction(const cv::Mat& grey, const ToneCurve& tone, int reduction) {
  cv::Mat small = grey;
  if (reduction > 1) {
    small = Reduced(grey, {std::max(1, grey.cols / reduction), std::max(1, grey.rows / reduction)});
  }
  const Vector2d factor(static_cast<double>(grey.cols) / small.cols,
                        static_cast<double>(grey.rows) / small.rows);
  const Vector2d half(0.5, 0.5);
  const std::vector<RoughMarker> detected = DetectMarkers(small);
  return ParallelMap(static_cast<int>(detected.size()), [&](int i) {
    RoughMarker rough = detected[static_cast<size_t>(i)];
    for (Vector2d& corner : rough.corners_px) corner = (corner + half).cwiseProduct(factor) - half;
    return LocateMarkerCorners(grey, tone, rough, {1.5 * factor.maxCoeff() + 1, std::nullopt});
  });
}

bool AnyLocated(const std::vector<SeenMarker>& markers) {
  return std::any_of(markers.begin(), markers.end(), [](const SeenMarker& m) {
    return std::isfinite(m.corner_sigma_px);
  });
}

// The sides by the pieces of them that the options leave.
std::optional<SquareSides> LocateSides(const cv::Mat& grey,
                                       const ToneCurve& tone,
                                       const Corners& corners_px,
                                       const MarkerCornerOptions& options) {
  const auto located = ParallelMap(
      4, [&](int k) { return LocateStraightEdge(grey, tone, MarkerSide(corners_px, k, options)); });
  SquareSides sides;
  for (size_t k = 0; k < 4; ++k) {
    if (!located[k]) return std::nullopt;
    sides[k] = *located[k];
  }
  return LooksPrinted(sides) ? std::optional(sides) : std::nullopt;
}

SeenMarker CrossSides(const SquareSides& sides,
                      const RoughMarker& rough,
                      const MarkerCornerOptions& options) {
  SeenMarker marker = Unlocated(rough);
  double variance = 0, blur = 0;
  for (size_t k = 0; k < 4; ++k) {
    const EdgeCrossing crossing = Cross(sides[(k + 3) % 4], sides[k]);
    // Lines may cross far from where the marker was seen only if one of them followed something
    // else.
    if ((crossing.point_px - rough.corners_px[k]).norm() > 2 * options.search_px + 2)
      return Unlocated(rough);
    marker.corners_px[k] = crossing.point_px;
    variance += crossing.covariance_px2.trace() / 8;
    blur += sides[k].blur_px / 4;
    marker.overexposed |= sides[k].bright > 1;
  }
  marker.corner_sigma_px = std::sqrt(variance);
  marker.blur_px = blur;
  return marker;
}

}  // namespace

StraightEdgeGuess MarkerSide(const Corners& corners_px,
                             int side,
                             const MarkerCornerOptions& options) {
  const Vector2d& from = corners_px[static_cast<size_t>(side)];
  const Vector2d& to = corners_px[static_cast<size_t>((side + 1) % 4)];
  const double length = (to - from).norm();
  const double cell = ShortestSide(corners_px) / kMarkerCells;
  // Beyond the reach of the corners' blur; of small markers at least 70 % of the side stays.
  constexpr double kBlurReachPx = 4;
  const double trim = std::min(0.15 * length, kBlurReachPx + options.search_px);
  const Vector2d direction = (to - from) / length;
  StraightEdgeGuess guess;
  guess.from_px = from + trim * direction;
  guess.to_px = to - trim * direction;
  guess.search_px = std::min(options.search_px, 0.5 * cell);
  guess.free_px = 0.75 * cell;
  guess.bow_px = Bow(options.camera, guess.from_px, guess.to_px);
  return guess;
}

SeenMarker LocateMarkerCorners(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const RoughMarker& rough,
                               const MarkerCornerOptions& options) {
  constexpr double kBrightest = 3;  // times white; no step says more than that it is overexposed
  const auto sides = LocateSides(grey, tone, rough.corners_px, options);
  if (!sides) return Unlocated(rough);
  const SeenMarker marker = CrossSides(*sides, rough, options);
  if (!std::isfinite(marker.corner_sigma_px)) return marker;
  if (const auto whole = FitMarker(grey, tone, marker, options.camera)) return *whole;
  return BrightestSide(*sides) > kBrightest ? Unlocated(rough) : marker;
}

std::vector<SeenMarker> FindMarkers(const cv::Mat& grey,
                                    const ToneCurve& tone,
                                    MarkerEffort effort) {
  constexpr int kSmallest = 8;  // px across; less holds no marker
  if (std::min(grey.cols, grey.rows) < kSmallest) return {};
  int reduction = QuickReduction(grey);
  std::vector<SeenMarker> markers = FindAtReduction(grey, tone, reduction);
  while (effort == MarkerEffort::kThorough && reduction > 1 && !AnyLocated(markers)) {
    reduction /= 2;
    markers = FindAtReduction(grey, tone, reduction);
  }
  return markers;
}

std::vector<SeenMarker> FindMarkers(const cv::Mat& grey, const ToneCurve& tone) {
  return FindMarkers(grey, tone, MarkerEffort::kThorough);
}

std::vector<SeenMarker> RelocateMarkers(const cv::Mat& grey,
                                        const ToneCurve& tone,
                                        const std::vector<SeenMarker>& markers,
                                        const std::optional<Camera>& camera) {
  constexpr double kNearPx = 1;  // corners located once are that good whatever the tone curve
  return ParallelMap(static_cast<int>(markers.size()), [&](int i) {
    const SeenMarker& marker = markers[static_cast<size_t>(i)];
    if (!std::isfinite(marker.corner_sigma_px)) return marker;
    return LocateMarkerCorners(grey, tone, {marker.id, marker.corners_px}, {kNearPx, camera});
  });
}

}  // namespace bladecurve
