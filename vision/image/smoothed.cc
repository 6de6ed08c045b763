// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/image/smoothed.h"

#include <opencv2/imgproc.hpp>

#include "vision/parallel.h"

namespace bladecurve {

cv::Mat Smoothed(const cv::Mat& image, double sigma) {
  cv::Mat smoothed(image.size(), image.type());
  ParallelForBands(image.rows, [&](int first, int last) {
    cv::Mat band = smoothed.rowRange(first, last);  // its neighbours count as well
    cv::GaussianBlur(image.rowRange(first, last), band, {}, sigma);
  });
  return smoothed;
}

}  // namespace bladecurve
