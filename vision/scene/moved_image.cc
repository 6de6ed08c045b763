// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/moved_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/image/disk.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

// Correlations of a at all shifts with b: sum over p of a(p) b(p + shift), by FFT, as often as
// wanted.
class Spectrum {
 public:
  Spectrum() = default;
  Spectrum(const cv::Mat& image, const cv::Size& padded) {
    cv::Mat larger = cv::Mat::zeros(padded, CV_32FC1);
    image.convertTo(larger(cv::Rect({0, 0}, image.size())), CV_32F, 1.0 / 255);
    cv::dft(larger, spectrum_, 0, image.rows);
  }
  [[nodiscard]] cv::Mat CorrelatedWith(const Spectrum& other) const {
    cv::Mat product, sums;
    cv::mulSpectrums(other.spectrum_, spectrum_, product, 0, true);
    cv::idft(product, sums, cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
    return sums;
  }

 private:
  cv::Mat spectrum_;
};

cv::Mat Halved(const cv::Mat& mask) {
  cv::Mat half;
  cv::resize(mask, half, {}, 0.5, 0.5, cv::INTER_AREA);
  return half;
}

// At which the moved image has most in common with `other`, of all that either sets.
cv::Vec2i BestShift(const cv::Mat& thing, const cv::Mat& other) {
  constexpr double kFurthest = 0.15;  // of the picture
  constexpr int kLeastPx = 1;
  const cv::Mat thing_half = Halved(thing), other_half = Halved(other);
  const cv::Size size = thing_half.size();
  const int most = static_cast<int>(kFurthest * std::max(size.width, size.height));
  const cv::Size padded(cv::getOptimalDFTSize(size.width + most),
                        cv::getOptimalDFTSize(size.height + most));
  const auto spectra =
      ParallelMap(2, [&](int i) { return Spectrum(i == 0 ? thing_half : other_half, padded); });
  const Spectrum &of_thing = spectra[0], &of_other = spectra[1];
  const auto correlations =
      ParallelMap(2, [&](int i) { return of_thing.CorrelatedWith(i == 0 ? of_other : of_thing); });
  const cv::Mat &common = correlations[0], &covered = correlations[1];
  const double areas = (cv::sum(thing_half)[0] + cv::sum(other_half)[0]) / 255;
  cv::Vec2i best(0, 0);
  double most_alike = 0;
  for (int y = -most; y <= most; ++y) {
    const int row = (y + padded.height) % padded.height;
    for (int x = -most; x <= most; ++x) {
      if (std::hypot(x, y) <= kLeastPx) continue;
      const int column = (x + padded.width) % padded.width;
      const double both = common.at<float>(row, column);
      const double alike = both / (areas - covered.at<float>(row, column) - both);
      if (alike <= most_alike) continue;
      most_alike = alike;
      best = {2 * x, 2 * y};
    }
  }
  return best;
}

cv::Mat Moved(const cv::Mat& mask, const cv::Vec2i& shift) {
  cv::Mat moved;
  const cv::Matx23d by(1, 0, shift[0], 0, 1, shift[1]);
  cv::warpAffine(mask, moved, by, mask.size(), cv::INTER_NEAREST);
  return moved;
}

double Agreement(const cv::Mat& thing, const cv::Mat& other, const cv::Vec2i& shift) {
  const cv::Mat image = Moved(thing, shift) & ~thing;
  cv::Mat near_image, near_other;
  cv::dilate(image, near_image, Disk(5));
  cv::dilate(other, near_other, Disk(5));
  const int unexplained = cv::countNonZero(other & ~near_image);
  const int missing = cv::countNonZero(image & ~near_other);
  return 1 - static_cast<double>(unexplained + missing) / cv::countNonZero(other | image);
}

}  // namespace

MovedImage BestMovedImage(const cv::Mat& thing, const cv::Mat& other) {
  const cv::Vec2i shift_px = BestShift(thing, other);
  return {shift_px, Agreement(thing, other, shift_px)};
}

}  // namespace bladecurve
