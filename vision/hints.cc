// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/hints.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

[[noreturn]] void Outside(const Photo& photo, const std::string& hint) {
  throw std::invalid_argument("hints: " + hint + " lies outside the picture, which is shown " +
                              std::to_string(photo.displayed_width()) + " px wide and " +
                              std::to_string(photo.displayed_height()) + " px high");
}

Vector2d DirectionInStored(const Photo& photo, ImageDirection direction) {
  Vector2d displayed = Vector2d::Zero();
  switch (direction) {
    case ImageDirection::kRight:
      displayed = {1, 0};
      break;
    case ImageDirection::kLeft:
      displayed = {-1, 0};
      break;
    case ImageDirection::kUp:
      displayed = {0, -1};
      break;
    case ImageDirection::kDown:
      displayed = {0, 1};
      break;
  }
  return photo.StoredFromDisplayed(displayed) - photo.StoredFromDisplayed(Vector2d::Zero());
}

Vector2d PivotInStored(const Photo& photo, const Vector2d& displayed_px) {
  const Vector2d size(photo.displayed_width(), photo.displayed_height());
  if ((displayed_px.array() < -0.5).any() || (displayed_px.array() > size.array() - 0.5).any())
    Outside(photo, "the pivot");
  return photo.StoredFromDisplayed(displayed_px);
}

// What of the region lies in the picture.
cv::Rect RegionInStored(const Photo& photo, const std::array<double, 4>& region) {
  const auto& [x, y, width, height] = region;
  const double left = std::max(0.0, x), top = std::max(0.0, y);
  const double right = std::min(x + width, 1.0 * photo.displayed_width()) - 1;
  const double bottom = std::min(y + height, 1.0 * photo.displayed_height()) - 1;
  if (right < left || bottom < top) Outside(photo, "the region to look at");
  const Vector2d a = photo.StoredFromDisplayed({left, top});
  const Vector2d b = photo.StoredFromDisplayed({right, bottom});
  const Vector2d low = a.cwiseMin(b), high = a.cwiseMax(b);
  return {static_cast<int>(std::floor(low.x())),
          static_cast<int>(std::floor(low.y())),
          static_cast<int>(std::lround(high.x() - low.x())) + 1,
          static_cast<int>(std::lround(high.y() - low.y())) + 1};
}

void RequireWithin(const cv::Rect& region, const Vector2d& pivot_px) {
  const cv::Rect2d reaches(region.x - 0.5, region.y - 0.5, region.width, region.height);
  if (reaches.contains({pivot_px.x(), pivot_px.y()})) return;
  throw std::invalid_argument("hints: the pivot lies outside the region to look at");
}

}  // namespace

StoredHints InStored(const Photo& photo, const SceneHints& hints) {
  StoredHints stored;
  if (hints.pivot_px) stored.pivot_px = PivotInStored(photo, *hints.pivot_px);
  if (hints.tips_toward) stored.tips_direction = DirectionInStored(photo, *hints.tips_toward);
  if (hints.roi_px) stored.roi_px = RegionInStored(photo, *hints.roi_px);
  if (stored.pivot_px && stored.roi_px) RequireWithin(*stored.roi_px, *stored.pivot_px);
  return stored;
}

}  // namespace bladecurve
