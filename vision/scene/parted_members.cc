// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/parted_members.h"

#include <algorithm>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

namespace bladecurve {
namespace {

// A part of the mask, seen along its length.
struct Part {
  cv::Point2d direction;           // towards what casts a shadow on it
  std::vector<cv::Point> section;  // at that end
  cv::Point2d middle;              // of the section
  double section_px = 0;           // along
};

Part SeenAlong(const std::vector<cv::Point>& places, const cv::Mat& to_main) {
  cv::Mat coordinates;
  cv::Mat(places).reshape(1).convertTo(coordinates, CV_64F);
  const cv::PCA pca(coordinates, cv::noArray(), cv::PCA::DATA_AS_ROW);
  const auto& axis = pca.eigenvectors;
  cv::Point2d direction(axis.at<double>(0, 0), axis.at<double>(0, 1));
  const auto along = [&](const cv::Point& p) { return direction.dot(cv::Point2d(p)); };
  const auto by_along = [&](const cv::Point& p, const cv::Point& q) { return along(p) < along(q); };
  auto [first, last] = std::minmax_element(places.begin(), places.end(), by_along);
  if (to_main.at<float>(*first) < to_main.at<float>(*last)) {
    direction = -direction;
    std::swap(first, last);
  }
  const double length = along(*last) - along(*first) + 1;
  const double width = static_cast<double>(places.size()) / length;
  constexpr double kSection = 4;  // widths; a shadow cuts off the end obliquely
  Part part{direction, {}, {}, kSection * width};
  std::copy_if(places.begin(), places.end(), std::back_inserter(part.section), [&](const auto& p) {
    return along(p) > along(*last) - part.section_px;
  });
  const cv::Scalar middle = cv::mean(part.section);
  part.middle = {middle[0], middle[1]};
  return part;
}

// How far the middle of the part's end is from `main`, in its direction; 0 if that is further than
// `most`.
int StepsTo(const cv::Mat& main, const Part& part, double most) {
  for (int steps = 1; steps < most; ++steps) {
    const cv::Point at = part.middle + steps * part.direction;
    if (!cv::Rect({0, 0}, main.size()).contains(at)) return 0;
    if (main.at<uchar>(at) != 0) return steps;
  }
  return 0;
}

}  // namespace

void JoinPartedMembers(const cv::Vec2i& shift_px, cv::Mat* mask) {
  constexpr double kLeast = 0.02;   // of the mask; less is no part
  constexpr double kObliquely = 5;  // of the shift: how far a shadow covers a member
  cv::Mat labels, stats, centers;
  const int count = cv::connectedComponentsWithStats(*mask, labels, stats, centers);
  const auto area = [&](int label) { return stats.at<int>(label, cv::CC_STAT_AREA); };
  const double least = kLeast * cv::countNonZero(*mask);
  std::vector<int> parts;
  for (int label = 1; label < count; ++label) {
    if (area(label) > least) parts.push_back(label);
  }
  if (parts.size() < 2) return;
  std::sort(parts.begin(), parts.end(), [&](int a, int b) { return area(a) > area(b); });
  const cv::Mat main = labels == parts.front();
  cv::Mat to_main;
  cv::distanceTransform(~main, to_main, cv::DIST_L2, cv::DIST_MASK_3);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    std::vector<cv::Point> places;
    cv::findNonZero(labels == parts[i], places);
    const Part part = SeenAlong(places, to_main);
    const int steps = StepsTo(main, part, kObliquely * cv::norm(shift_px));
    if (steps == 0) continue;
    const cv::Point all_of_it((steps + part.section_px / 2) * part.direction);
    std::vector<cv::Point> ends = part.section, hull;
    for (const cv::Point& p : part.section) ends.push_back(p + all_of_it);
    cv::convexHull(ends, hull);
    cv::fillConvexPoly(*mask, hull, 255);
  }
}

}  // namespace bladecurve
