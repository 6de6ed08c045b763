// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/silhouette.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "vision/image/disk.h"
#include "vision/image/nearest_pixel.h"

namespace bladecurve {

cv::Mat MaskAbove(const cv::Mat& distance, double threshold) {
  cv::Mat mask = distance > threshold;
  const cv::Mat cross = Disk(3);
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cross);
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, cross);
  return mask;
}

std::vector<Silhouette> FindSilhouettes(const cv::Mat& mask, int most) {
  // Scissors that span less of the picture give too few pixels along the blade to be measured.
  constexpr double kShortestShare = 0.12;
  const double shortest = kShortestShare * std::max(mask.cols, mask.rows);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<Silhouette> found;
  for (auto& contour : contours) {
    const cv::Rect box = cv::boundingRect(contour);
    if (std::max(box.width, box.height) < shortest) continue;
    Silhouette s;
    s.area_px = cv::contourArea(contour);
    // findContours runs counter-clockwise on the screen for outer borders; the rest wants
    // clockwise.
    if (cv::contourArea(contour, true) < 0) std::reverse(contour.begin(), contour.end());
    s.contour = std::move(contour);
    found.push_back(std::move(s));
  }
  std::sort(found.begin(), found.end(), [](const Silhouette& a, const Silhouette& b) {
    return a.area_px > b.area_px;
  });
  if (static_cast<int>(found.size()) > most) found.resize(static_cast<std::size_t>(most));
  for (Silhouette& s : found) {
    s.filled = cv::Mat::zeros(mask.size(), CV_8UC1);
    cv::drawContours(s.filled, std::vector<std::vector<cv::Point>>{s.contour}, 0, 255, cv::FILLED);
  }
  return found;
}

const Silhouette* ThingAt(const std::vector<Silhouette>& things, const Eigen::Vector2d& at_px) {
  const auto found = std::find_if(things.begin(), things.end(), [&](const Silhouette& thing) {
    return IsSetAt(thing.filled, at_px);
  });
  return found == things.end() ? nullptr : &*found;
}

}  // namespace bladecurve
