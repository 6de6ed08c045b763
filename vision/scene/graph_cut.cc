// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/graph_cut.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace bladecurve {
namespace {

// A picture without its border, which stands for the ground, and without `further_px` more.
cv::Rect WithinBorder(const cv::Size& size, int further_px = 0) {
  constexpr double kBorder = 0.02;  // of the longest side
  const int wanted_px = cvRound(kBorder * std::max(size.width, size.height));
  const int px = std::clamp(wanted_px + further_px, 1, std::min(size.width, size.height) / 4);
  return {px, px, size.width - 2 * px, size.height - 2 * px};
}

// What is known of each pixel, as cv::grabCut takes it.
cv::Mat Known(const cv::Size& size, const PointedAt& thing) {
  constexpr double kSurely = 0.2;  // of what is likely
  cv::Mat known(size, CV_8UC1, cv::Scalar(cv::GC_BGD));
  known(WithinBorder(size)) = cv::GC_PR_BGD;
  cv::circle(known, thing.place, cvRound(thing.about_px), cv::GC_PR_FGD, cv::FILLED);
  cv::circle(known, thing.place, cvRound(kSurely * thing.about_px), cv::GC_FGD, cv::FILLED);
  return known;
}

}  // namespace

cv::Mat CutOut(const cv::Mat& bgr, const PointedAt& thing) {
  constexpr int kIterations = 6;
  constexpr int kLeastSide = 8;  // px; a strip shows no thing
  if (std::min(bgr.cols, bgr.rows) < kLeastSide) return cv::Mat::zeros(bgr.size(), CV_8UC1);
  cv::Mat lab, of_ground, of_thing, known = Known(bgr.size(), thing);
  cv::cvtColor(bgr, lab, cv::COLOR_BGR2Lab);
  const cv::RNG before = cv::theRNG();
  cv::theRNG() = cv::RNG(1);  // the clusters begin at random
  cv::grabCut(lab, known, {}, of_ground, of_thing, kIterations, cv::GC_INIT_WITH_MASK);
  cv::theRNG() = before;
  const cv::Mat cut = (known & 1) != 0;  // GC_FGD or GC_PR_FGD
  constexpr int kRounded = 3;            // px: at the border the cheapest outline rounds things off
  const cv::Rect within = WithinBorder(bgr.size(), kRounded);
  cv::Mat mask;
  cv::copyMakeBorder(cut(within),
                     mask,
                     within.y,
                     bgr.rows - within.br().y,
                     within.x,
                     bgr.cols - within.br().x,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  return mask;
}

}  // namespace bladecurve
