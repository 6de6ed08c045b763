// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/image/reduced.h"

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "vision/parallel.h"

namespace bladecurve {

cv::Mat Reduced(const cv::Mat& image, const cv::Size& size) {
  constexpr int kWorthAThread = 100;  // rows
  const int alike = std::gcd(image.rows, size.height);
  const int bands = std::min(alike, std::max(1, size.height / kWorthAThread));
  cv::Mat reduced(size, image.type());
  ParallelFor(bands, [&](int band) {
    const auto rows = [&](const cv::Mat& of) {
      const int step = of.rows / alike;
      return of.rowRange(band * alike / bands * step, (band + 1) * alike / bands * step);
    };
    cv::Mat into = rows(reduced);
    cv::resize(rows(image), into, into.size(), 0, 0, cv::INTER_AREA);
  });
  return reduced;
}

}  // namespace bladecurve
