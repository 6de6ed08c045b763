// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/image/block_means.h"
#include "vision/image/lab_colour.h"
#include "vision/image/reduced.h"
#include "vision/scale/marker_paper.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kMostEnlarged = 2;  // pictures that are smaller than what is looked at

cv::Rect WholeOrRoi(const Photo& photo, const StoredHints& hints) {
  const cv::Rect whole({0, 0}, photo.grey().size());
  return hints.roi_px ? (*hints.roi_px & whole) : whole;
}

cv::Size SmallSize(const cv::Rect& area_px, int longest) {
  const double side = std::max(area_px.width, area_px.height);
  const double k = std::min(kMostEnlarged, longest / side);
  return {std::max(1, static_cast<int>(std::lround(area_px.width * k))),
          std::max(1, static_cast<int>(std::lround(area_px.height * k)))};
}

cv::Mat Resized(const cv::Mat& image, const cv::Size& size) {
  if (size.width <= image.cols) return Reduced(image, size);
  cv::Mat enlarged;
  cv::resize(image, enlarged, size, 0, 0, cv::INTER_CUBIC);
  return enlarged;
}

void SmoothIfWanted(const SceneView& view, cv::Mat* small) {
  constexpr double kSigmaPx = 1;
  if (view.smooth) cv::GaussianBlur(*small, *small, {0, 0}, kSigmaPx);
}

// The same area in colour, 8 bit.
cv::Mat SmallBgr(const SceneView& view, int longest) {
  const cv::Size full = view.photo.grey().size();
  const double zoom =
      std::max(full.width, full.height) / std::max(view.area_px.width, view.area_px.height);
  const cv::Mat& colour = view.colour->AtLeast(static_cast<int>(std::ceil(longest * zoom)));
  const double k = static_cast<double>(colour.cols) / full.width;
  const cv::Rect2d area(
      view.area_px.x * k, view.area_px.y * k, view.area_px.width * k, view.area_px.height * k);
  cv::Mat small = Resized(colour(cv::Rect(area) & cv::Rect({0, 0}, colour.size())),
                          SmallSize(view.area_px, longest));
  SmoothIfWanted(view, &small);
  return small;
}

}  // namespace

const cv::Mat& DecodedColour::AtLeast(int side) {
  constexpr double kSlack = 2;  // a codec halves as long as that keeps the side
  const int whole = std::max(photo_.grey().cols, photo_.grey().rows);
  if (std::max(bgr_.cols, bgr_.rows) < std::min(side, whole))
    bgr_ = photo_.DecodeColour(side, kSlack);
  return bgr_;
}

SceneView::SceneView(const Photo& photo_in,
                     const std::vector<SeenMarker>& markers_in,
                     const StoredHints& hints_in)
    : photo(photo_in),
      markers(markers_in),
      hints(hints_in),
      area_px(WholeOrRoi(photo_in, hints_in)),
      colour(std::make_shared<DecodedColour>(photo_in)) {}

bool SceneView::KeepsNoise(int longest) const {
  constexpr double kReduced = 1.5;
  return std::max(area_px.width, area_px.height) < kReduced * longest;
}

cv::Mat SceneView::MarkerMask(const ScaledImage& at) const {
  cv::Mat mask;
  if (markers.empty()) return mask;
  mask = cv::Mat::zeros(at.pixels.size(), CV_8UC1);
  for (const SeenMarker& marker : markers) {
    std::vector<cv::Point> polygon;
    for (const Vector2d& corner : PaperOf(marker)) {
      const Vector2d p = at.SmallFromFull(corner);
      polygon.emplace_back(static_cast<int>(std::lround(p.x())),
                           static_cast<int>(std::lround(p.y())));
    }
    cv::fillConvexPoly(mask, polygon, 255);
  }
  return mask;
}

ScaledImage SmallGrey(const SceneView& view, int longest) {
  // From there on a whole factor: many times faster, and as good.
  constexpr int kWholeFrom = 3;
  const cv::Rect& area = view.area_px;
  ScaledImage small;
  small.area_px = view.area_px;
  cv::Mat reduced;
  const int factor = static_cast<int>(
      std::lround(static_cast<double>(std::max(area.width, area.height)) / longest));
  if (factor < kWholeFrom) {
    reduced = Resized(view.photo.grey()(area), SmallSize(view.area_px, longest));
  } else {
    // Whole grey values, as pictures that are small already have: scatter alike.
    BlockMeans(view.photo.grey()(area), factor).convertTo(reduced, CV_8U);
    small.area_px = cv::Rect(area.tl(), reduced.size() * factor);
  }
  SmoothIfWanted(view, &reduced);
  reduced.convertTo(small.pixels, CV_32FC1, 100.0 / 255);
  return small;
}

ColourPictures SmallColour(const SceneView& view, int longest) {
  ColourPictures colour;
  colour.bgr = SmallBgr(view, longest);
  colour.lab =
      std::make_shared<const ScaledImage>(ScaledImage{LabFromBgr(colour.bgr), view.area_px});
  colour.ignore = view.MarkerMask(*colour.lab);
  return colour;
}

}  // namespace bladecurve
