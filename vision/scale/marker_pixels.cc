// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/marker_pixels.h"

#include <algorithm>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr size_t kMostPixels = 6000;  // leave 0.006 px at a noise of 2 grey values

double LightAt(const LinearPicture& picture, int x, int y) {
  return picture.tone.linear[picture.grey.at<uchar>(y, x)];
}

// Takes this share of what it is asked about, as evenly as the golden ratio spreads it.
class Thinning {
 public:
  explicit Thinning(double share) : share_(share) {}

  bool Takes() {
    constexpr double kGolden = 0.6180339887498949;
    turn_ += kGolden;
    if (turn_ >= 1) turn_ -= 1;
    return turn_ < share_;
  }

 private:
  double share_, turn_ = 0;
};

}  // namespace

Vector2d Straightened(const std::optional<Camera>& camera, const Vector2d& image_px) {
  return camera ? Undistorted(*camera, image_px) : image_px;
}

cv::Rect BoxAbout(const SeenMarker& marker, double cell_px, const cv::Size& picture) {
  Vector2d low = marker.corners_px[0], high = low;
  for (const Vector2d& corner : marker.corners_px) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const Vector2d from = low.array() - cell_px, to = high.array() + cell_px;
  return cv::Rect(cv::Point(static_cast<int>(from.x()), static_cast<int>(from.y())),
                  cv::Point(static_cast<int>(to.x()) + 2, static_cast<int>(to.y()) + 2)) &
         cv::Rect({0, 0}, picture);
}

std::vector<MarkerPixel> PixelsAtBorders(const LinearPicture& picture,
                                         const cv::Rect& box,
                                         const MarkerFrame& frame,
                                         const MarkerModel& model,
                                         const std::optional<Camera>& camera) {
  constexpr double kSigmas = 2.5;
  constexpr double kBorders = 48;  // sides of cells; about half of them have ink on one side alone
  constexpr double kSure = 0.7;    // of the way to the next line: tilted, cells are not alike
  constexpr int kMostRowsApart = 2;
  const double reach_px = kSigmas * model.total_blur_px(), reach = reach_px / frame.cell_px;
  const double share = static_cast<double>(kMostPixels) / (kBorders * frame.cell_px * 2 * reach_px);
  // Of large markers whole rows are left out, as long as several cross each border.
  const int rows_apart = std::clamp(static_cast<int>(1 / share), 1, kMostRowsApart);
  Thinning thinning(rows_apart * share);
  std::vector<MarkerPixel> pixels;
  for (int y = box.y; y < box.y + box.height; y += rows_apart) {
    for (int x = box.x; x < box.x + box.width; ++x) {
      const Vector2d place = frame.Place(Straightened(camera, Vector2d(x, y)));
      const Vector2d cells = model.InCells(place);
      const double beyond = CellsToLine(cells) - reach;
      if (beyond > 0) {
        x += static_cast<int>(kSure * beyond * frame.cell_px);
      } else if (model.IsNearBorder(cells, reach) && thinning.Takes()) {
        pixels.push_back({place, LightAt(picture, x, y), MarkerModel::CellOf(cells)});
      }
    }
  }
  return pixels;
}

std::vector<double> SampleLight(const LinearPicture& picture, const cv::Rect& box) {
  constexpr double kSamples = 1000;
  Thinning thinning(kSamples / box.area());
  std::vector<double> light;
  for (int y = box.y; y < box.y + box.height; ++y) {
    for (int x = box.x; x < box.x + box.width; ++x) {
      if (thinning.Takes()) light.push_back(LightAt(picture, x, y));
    }
  }
  return light;
}

}  // namespace bladecurve
