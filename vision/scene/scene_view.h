// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/image/nearest_pixel.h"
#include "vision/photo/photo.h"
#include "vision/scale/scale.h"
#include "vision/scene/scene.h"

namespace bladecurve {

// A small version of the photograph, or of a part of it.
struct ScaledImage {
  cv::Mat pixels;    // CV_32FC1 (lightness, 0 to 100) or CV_32FC3 (Lab)
  cv::Rect area_px;  // of the photograph

  // Lab, or lightness and zeros, of the nearest pixel; the border repeats.
  [[nodiscard]] Eigen::Vector3d ColourAt(const Eigen::Vector2d& p) const {
    const cv::Point nearest = NearestPixel(p);
    const int x = std::clamp(nearest.x, 0, pixels.cols - 1);
    const float* pixel =
        pixels.ptr<float>(std::clamp(nearest.y, 0, pixels.rows - 1)) + x * pixels.channels();
    if (pixels.channels() == 1) return {*pixel, 0, 0};
    return {pixel[0], pixel[1], pixel[2]};
  }
  [[nodiscard]] double full_px_per_px() const {
    return static_cast<double>(area_px.width) / pixels.cols;
  }
  [[nodiscard]] Eigen::Vector2d FullFromSmall(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d origin(area_px.x, area_px.y);
    return (p + Eigen::Vector2d(0.5, 0.5)) * full_px_per_px() + origin - Eigen::Vector2d(0.5, 0.5);
  }
  [[nodiscard]] Eigen::Vector2d SmallFromFull(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d origin(area_px.x, area_px.y);
    return (p + Eigen::Vector2d(0.5, 0.5) - origin) / full_px_per_px() - Eigen::Vector2d(0.5, 0.5);
  }
};

// A photograph in colour, decoded as small as whoever asked first needs it, and anew only for those
// who need it larger.
class DecodedColour {
 public:
  explicit DecodedColour(const Photo& photo) : photo_(photo) {}

  // BGR, CV_8UC3, the longest side not below `side` px if the photograph's is not.
  [[nodiscard]] const cv::Mat& AtLeast(int side);

 private:
  const Photo& photo_;
  cv::Mat bgr_;
};

// What scene finding looks at: the photograph, or the part of it that the user points at.
struct SceneView {
  const Photo& photo;
  const std::vector<SeenMarker>& markers;
  const StoredHints& hints;
  cv::Rect area_px;
  std::shared_ptr<DecodedColour> colour;
  // Small pictures are smoothed: those that are hardly reduced keep all noise of the photograph.
  bool smooth = false;

  SceneView(const Photo& photo, const std::vector<SeenMarker>& markers, const StoredHints& hints);

  // Whether pictures of `longest` px keep most of the noise.
  [[nodiscard]] bool KeepsNoise(int longest) const;

  // Non-zero on the printed markers and their white margins, which are not scissors; empty if there
  // are none.
  [[nodiscard]] cv::Mat MarkerMask(const ScaledImage& at) const;
};

// Lightness, longest side about `longest` px; a few px of the border may be left out.
[[nodiscard]] ScaledImage SmallGrey(const SceneView& view, int longest);

struct ColourPictures {
  cv::Mat bgr;  // CV_8UC3
  std::shared_ptr<const ScaledImage> lab;
  cv::Mat ignore;  // the markers
};
[[nodiscard]] ColourPictures SmallColour(const SceneView& view, int longest);

}  // namespace bladecurve
