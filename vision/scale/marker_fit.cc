// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/marker_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "vision/image/blurred_step.h"
#include "vision/image/robust_statistics.h"
#include "vision/scale/marker_least_squares.h"
#include "vision/scale/marker_model.h"
#include "vision/scale/marker_pixels.h"
#include "vision/scale/marker_residuals.h"
#include "vision/scale/straight_band.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr size_t kFewestPixels = 20 * kMarkerUnknowns;

std::array<Vector2d, 4> StraightCorners(const SeenMarker& marker,
                                        const std::optional<Camera>& camera) {
  std::array<Vector2d, 4> corners;
  for (size_t k = 0; k < 4; ++k) corners[k] = Straightened(camera, marker.corners_px[k]);
  return corners;
}

MarkerFrame FrameOf(const std::array<Vector2d, 4>& corners) {
  MarkerFrame frame{Vector2d::Zero(), 0};
  for (size_t k = 0; k < 4; ++k) {
    frame.middle_px += corners[k] / 4;
    frame.cell_px += (corners[(k + 1) % 4] - corners[k]).norm() / (4 * kMarkerCells);
  }
  return frame;
}

// Good to the rounding of single precision, which serves for a start.
Eigen::Matrix<double, kHomography, 1> HomographyFrom(const std::array<Vector2d, 4>& corners,
                                                     const MarkerFrame& frame) {
  std::array<cv::Point2f, 4> places, cells;
  for (size_t k = 0; k < 4; ++k) {
    const Vector2d place = frame.Place(corners[k]), cell = CornerInCells(static_cast<int>(k));
    places[k] = {static_cast<float>(place.x()), static_cast<float>(place.y())};
    cells[k] = {static_cast<float>(cell.x()), static_cast<float>(cell.y())};
  }
  const cv::Matx33d homography = cv::getPerspectiveTransform(places.data(), cells.data());
  return Eigen::Map<const Eigen::Matrix<double, kHomography, 1>>(homography.val);
}

// Paper and ink by the lightest and darkest tenth; paper that is plain white is beyond it.
MarkerVector StartFrom(const std::array<Vector2d, 4>& corners,
                       const MarkerFrame& frame,
                       double blur_px,
                       const std::vector<double>& light) {
  constexpr double kDarkest = 0.1, kLightest = 0.9, kWhite = 0.98, kBeyond = 1.3;
  MarkerVector start = MarkerVector::Zero();
  start.head<kHomography>() = HomographyFrom(corners, frame);
  start[kBlur] = blur_px;
  start[kInk] = SampleQuantile(light, kDarkest);
  const double bright = SampleQuantile(light, kLightest);
  start[kPaper] = bright > kWhite ? kBeyond : bright;
  return start;
}

std::optional<SeenMarker> Placed(const SeenMarker& start,
                                 const MarkerVector& at,
                                 const MarkerMatrix& covariance,
                                 const MarkerFrame& frame,
                                 const std::optional<Camera>& camera) {
  constexpr double kMostBlurs = 2;  // overexposed, a side is seen by its foot alone
  SeenMarker marker = start;
  double variance = 0;
  for (size_t k = 0; k < 4; ++k) {
    const MarkerCorner corner = CornerOf(at, static_cast<int>(k));
    const Vector2d straight = frame.Pixel(corner.place);
    marker.corners_px[k] = camera ? Distorted(*camera, straight) : straight;
    const Eigen::Matrix2d own = corner.jacobian *
                                covariance.topLeftCorner<kHomography, kHomography>() *
                                corner.jacobian.transpose();
    variance += own.trace() * frame.cell_px * frame.cell_px / 8;
    const double moved = (marker.corners_px[k] - start.corners_px[k]).norm();
    if (moved > 1 + kMostBlurs * std::sqrt(TotalBlurVariance(start.blur_px))) return std::nullopt;
  }
  marker.corner_sigma_px = std::sqrt(variance);
  marker.overexposed = at[kPaper] > 1;
  return marker;
}

}  // namespace

std::optional<SeenMarker> FitMarker(const cv::Mat& grey,
                                    const ToneCurve& tone,
                                    const SeenMarker& start,
                                    const std::optional<Camera>& camera) {
  constexpr int kMostLooks = 4;
  const std::array<Vector2d, 4> corners = StraightCorners(start, camera);
  const MarkerFrame frame = FrameOf(corners);
  const cv::Rect box = BoxAbout(start, frame.cell_px, grey.size());
  if (box.empty()) return std::nullopt;
  const LinearPicture picture{grey, tone};
  const InkCells ink = InkCellsOf(start.id);
  const MarkerVector first = StartFrom(corners, frame, start.blur_px, SampleLight(picture, box));
  std::vector<MarkerPixel> pixels =
      PixelsAtBorders(picture, box, frame, MarkerModel(ink, frame, first), camera);
  const auto enough = std::max<size_t>(kFewestPixels, pixels.size() * 4 / 5);
  const MarkerProblem problem{ink, frame, first};
  MarkerVector at = first;
  for (int look = 0; look < kMostLooks && pixels.size() >= enough; ++look) {
    const MarkerMinimum minimum = MinimiseMarker(problem, pixels, at);
    at = minimum.at;
    const MarkerResiduals residuals(pixels, ink, frame, at);
    std::vector<MarkerPixel> uncovered = residuals.Uncovered(pixels);
    if (uncovered.size() == pixels.size()) {
      if (!residuals.Explain(pixels)) return std::nullopt;
      auto marker = Placed(start, at, residuals.Covariance(minimum.information), frame, camera);
      if (marker) marker->tone = residuals.Tone();
      return marker;
    }
    pixels = std::move(uncovered);
  }
  return std::nullopt;
}

}  // namespace bladecurve
