// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "vision/image/nearest_pixel.h"
#include "vision/image/picture_part.h"
#include "vision/image/tone_curve.h"

namespace bladecurve {

// Linear light (BGR).
[[nodiscard]] inline Eigen::Vector3d LightOf(const cv::Vec3b& bgr, const ToneCurve& tone) {
  return {tone.linear[bgr[0]], tone.linear[bgr[1]], tone.linear[bgr[2]]};
}

// Linear light (BGR) of the pixel nearest to a place of the picture; nothing beyond the part.
// part: CV_8UC3, or CV_8UC1, whose light fills all three channels.
[[nodiscard]] inline std::optional<Eigen::Vector3d> LightAt(const PicturePart& part,
                                                            const ToneCurve& tone,
                                                            const Eigen::Vector2d& at_px) {
  const cv::Point pixel = NearestPixel(at_px) - part.corner_px;
  if (!cv::Rect({}, part.pixels.size()).contains(pixel)) return std::nullopt;
  if (part.pixels.channels() == 1)
    return Eigen::Vector3d::Constant(tone.linear[part.pixels.at<uchar>(pixel)]);
  return LightOf(part.pixels.at<cv::Vec3b>(pixel), tone);
}

}  // namespace bladecurve
