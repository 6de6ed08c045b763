// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/slot_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "vision/image/contour_area.h"
#include "vision/pivot/screw_field.h"
#include "vision/pivot/screw_slot.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// The part of a picture in which slots may lie, reduced to where the smallest head is this large.
ScaledWindow PartOf(const cv::Mat& grey, const ScrewSearch& search) {
  constexpr double kReducedRadiusPx = 8;
  const double scale = std::max(1.0, search.min_semi_axis_px / kReducedRadiusPx);
  ScaledWindow part =
      CutWindow(grey, search.guess_px, search.radius_px + search.max_semi_axis_px, scale);
  part.grey.convertTo(part.grey, CV_8U);
  return part;
}

// What is narrow and darker than its surroundings by that share of their grey value. CV_8UC1, 0 or
// 255.
cv::Mat DarkLines(const cv::Mat& grey, double widest_px, double darker) {
  constexpr int kLeastGrey = 8;
  const int width = 2 * static_cast<int>(std::ceil(0.5 * widest_px)) + 1;
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_ELLIPSE, {width, width});
  cv::Mat closed, dark;
  cv::morphologyEx(grey, closed, cv::MORPH_CLOSE, kernel);
  cv::subtract(closed, grey, dark);
  const cv::Mat least = cv::max(darker * closed, kLeastGrey);
  return dark >= least;
}

// A straight bar: its middle, and half its length.
struct Bar {
  Vector2d middle;
  double half_length = 0;
};

std::optional<Bar> BarOf(const std::vector<cv::Point>& outline) {
  constexpr double kSlender = 2.5, kFilled = 0.6;
  const cv::RotatedRect box = cv::minAreaRect(outline);
  const double length = std::max(box.size.width, box.size.height) + 1;
  const double width = std::min(box.size.width, box.size.height) + 1;
  if (length < kSlender * width) return std::nullopt;
  if (PixelsWithin(outline) < kFilled * length * width) return std::nullopt;
  return Bar{{box.center.x, box.center.y}, 0.5 * length};
}

std::vector<Bar> BarsIn(const cv::Mat& mask) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<Bar> bars;
  for (const std::vector<cv::Point>& outline : outlines) {
    if (const auto bar = BarOf(outline)) bars.push_back(*bar);
  }
  return bars;
}

// As a head about whose rim nothing is known.
Screw HeadOf(const ScrewSlot& slot, double radius_px) {
  constexpr double kUnknown = 10;  // of the radius
  Screw screw;
  screw.center_px = slot.center_px;
  screw.covariance_px2 = std::pow(kUnknown * radius_px, 2) * Eigen::Matrix2d::Identity();
  screw.semi_major_px = screw.semi_minor_px = radius_px;
  screw.slot = slot;
  return screw;
}

// Dark bars as long as heads of the searched sizes are wide, in the photograph's pixels. grey: the
// part of it, or its negative.
std::vector<Bar> BarsAcrossHeads(const cv::Mat& grey,
                                 const ScaledWindow& part,
                                 const ScrewSearch& search) {
  constexpr double kFaint = 0.12, kDeep = 0.35;    // darker; deep slots may touch faint lines
  constexpr double kWidest = 0.35;                 // of the largest head's radius
  constexpr double kShorter = 0.8, kLonger = 1.1;  // than heads are wide
  std::vector<Bar> bars;
  for (const double darker : {kFaint, kDeep}) {
    for (Bar bar :
         BarsIn(DarkLines(grey, kWidest * search.max_semi_axis_px / part.scale, darker))) {
      bar = {part.origin + part.scale * bar.middle, part.scale * bar.half_length};
      if (bar.half_length >= kShorter * search.min_semi_axis_px &&
          bar.half_length <= kLonger * search.max_semi_axis_px &&
          (bar.middle - search.guess_px).norm() <= search.radius_px)
        bars.push_back(bar);
    }
  }
  return bars;
}

// Of a picture in which light is what it was once divided by: a bright bar is as dark there as it
// is brighter than its surroundings, on bright metal too.
ToneCurve Reciprocal(const ToneCurve& tone) {
  constexpr auto kDarkest = static_cast<float>(kDarkestLight);
  ToneCurve reciprocal = tone;
  for (float& light : reciprocal.linear) light = kDarkest / std::max(kDarkest, light);
  return reciprocal;
}

}  // namespace

std::vector<Screw> FindSlottedHeads(const cv::Mat& grey,
                                    const ToneCurve& tone,
                                    const ScrewSearch& search) {
  const ScaledWindow part = PartOf(grey, search);
  std::vector<Screw> heads;
  if (part.grey.empty()) return heads;
  for (const bool bright : {false, true}) {
    const cv::Mat dark_slots = bright ? cv::Mat(~part.grey) : part.grey;
    const ToneCurve slot_tone = bright ? Reciprocal(tone) : tone;
    for (const Bar& bar : BarsAcrossHeads(dark_slots, part, search)) {
      const std::optional<ScrewSlot> slot = FindSlot(grey, slot_tone, bar.middle, bar.half_length);
      if (!slot || !slot->ends_seen) continue;
      heads.push_back(HeadOf(*slot, bar.half_length));
      heads.back().slot->bright = bright;
    }
  }
  return heads;
}

}  // namespace bladecurve
