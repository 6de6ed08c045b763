// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene_debug.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace bladecurve {
namespace {

constexpr double kZoom = 2;

cv::Point At(const Eigen::Vector2d& p) {
  return {static_cast<int>(kZoom * (p.x() + 0.5)), static_cast<int>(kZoom * (p.y() + 0.5))};
}

cv::Mat Viewable(const cv::Mat& pixels) {
  cv::Mat bgr;
  if (pixels.channels() == 3) {
    cv::cvtColor(pixels, bgr, cv::COLOR_Lab2BGR);
    bgr.convertTo(bgr, CV_8UC3, 255);
  } else {
    pixels.convertTo(bgr, CV_8UC1, 255.0 / 100);
    cv::cvtColor(bgr, bgr, cv::COLOR_GRAY2BGR);
  }
  return bgr;
}

void DrawPath(const std::vector<Eigen::Vector2d>& path,
              const ScaledImage* at,
              const cv::Scalar& colour,
              cv::Mat* picture) {
  std::vector<cv::Point> points;
  for (const Eigen::Vector2d& p : path)
    points.push_back(At(at != nullptr ? at->SmallFromFull(p) : p));
  cv::polylines(*picture, points, false, colour, 1, cv::LINE_AA);
}

// Distances up to `kMost` as grey values, the logarithm so that faint blades show.
cv::Mat ViewableDistance(const cv::Mat& distance) {
  constexpr double kMost = 128;
  cv::Mat logarithm;
  cv::log(distance + 1, logarithm);
  cv::Mat grey;
  logarithm.convertTo(grey, CV_8UC1, 200 / std::log(1 + kMost));
  return grey;
}

}  // namespace

cv::Mat DrawRung(const Rung& rung) {
  cv::Mat picture;
  cv::cvtColor(ViewableDistance(rung.distance), picture, cv::COLOR_GRAY2BGR);
  cv::resize(picture, picture, {}, kZoom, kZoom, cv::INTER_NEAREST);
  int line = 0;
  for (const Candidate& c : rung.candidates) {
    const double bright = 60 + 195 * c.pair.quality;
    DrawPath(c.pair.first.inner, nullptr, {0, 0, bright}, &picture);
    DrawPath(c.pair.second.inner, nullptr, {0, bright, 0}, &picture);
    cv::circle(picture, At(c.pair.pivot), 3, {0, bright, bright}, 1, cv::LINE_AA);
    const std::string label = "threshold " + std::to_string(c.threshold).substr(0, 4) +
                              " quality " + std::to_string(c.pair.quality).substr(0, 4) +
                              " strength " + std::to_string(c.strength).substr(0, 4) +
                              " sharpness " + std::to_string(c.sharpness).substr(0, 4) + " " +
                              c.pair.doubt;
    cv::putText(picture,
                label,
                {10, 20 * ++line},
                cv::FONT_HERSHEY_SIMPLEX,
                0.5,
                {bright, bright, bright},
                1,
                cv::LINE_AA);
  }
  return picture;
}

cv::Mat DrawScene(const Candidate& found, const Scene& scene) {
  cv::Mat picture;
  cv::Mat mask;
  cv::resize(Viewable(found.at->pixels), picture, {}, kZoom, kZoom, cv::INTER_NEAREST);
  cv::cvtColor(found.mask / 2, mask, cv::COLOR_GRAY2BGR);
  cv::resize(mask, mask, {}, kZoom, kZoom, cv::INTER_NEAREST);
  const BladePair& pair = found.pair;
  DrawPath(pair.first.inner, nullptr, {0, 0, 255}, &mask);
  DrawPath(pair.second.inner, nullptr, {0, 255, 0}, &mask);
  DrawPath(scene.left.inner_px, found.at.get(), {0, 0, 255}, &picture);
  DrawPath(scene.right.inner_px, found.at.get(), {0, 255, 0}, &picture);
  for (cv::Mat* where : {&picture, &mask}) {
    cv::circle(*where, At(pair.crotch), 4, {255, 255, 0}, 1, cv::LINE_AA);
    if (pair.shank_crotch)
      cv::circle(*where, At(*pair.shank_crotch), 4, {0, 128, 255}, 1, cv::LINE_AA);
    cv::circle(*where, At(pair.first.tip), 5, {255, 0, 255}, 1, cv::LINE_AA);
    cv::circle(*where, At(pair.second.tip), 5, {255, 0, 255}, 1, cv::LINE_AA);
    cv::circle(*where,
               At(pair.pivot),
               static_cast<int>(kZoom * pair.pivot_sigma) + 2,
               {0, 255, 255},
               1,
               cv::LINE_AA);
  }
  const std::string label = found.method + " threshold " +
                            std::to_string(found.threshold).substr(0, 4) + " quality " +
                            std::to_string(pair.quality).substr(0, 4) + " " + pair.doubt;
  cv::putText(
      mask, label, {10, 24}, cv::FONT_HERSHEY_SIMPLEX, 0.6, {255, 255, 255}, 1, cv::LINE_AA);
  cv::hconcat(picture, mask, picture);
  return picture;
}

}  // namespace bladecurve
