// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The one file that knows which of OpenCV's two marker interfaces is there.
#include "vision/scale/marker_detector.h"

#include <algorithm>
#include <opencv2/core/version.hpp>
#include <stdexcept>
#include <string>

#define BLADECURVE_OPENCV_AT_LEAST_4_7 \
  (CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7))
#if BLADECURVE_OPENCV_AT_LEAST_4_7
#include <opencv2/objdetect/aruco_detector.hpp>
#else
#include <opencv2/aruco.hpp>
#endif

namespace bladecurve {
namespace {

constexpr int kCellsPerSide = 4;

struct Found {
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
};

// Of two outlines so near to each other, in the perimeter, OpenCV keeps the outer one alone: with
// its own 0.05, the label's on which a marker is printed with a narrow margin, where the ground is
// brighter than the paper.
constexpr double kLeastApart = 0.02;

// OpenCV's own corner refinements are left off: they are worse than lines fitted to the sides by 10
// to 40 times.
#if BLADECURVE_OPENCV_AT_LEAST_4_7

cv::aruco::Dictionary Dictionary() {
  return cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
}

Found Detect(const cv::Mat& grey) {
  Found found;
  cv::aruco::DetectorParameters parameters;
  parameters.cornerRefinementMethod = cv::aruco::CORNER_REFINE_NONE;
  parameters.minMarkerDistanceRate = kLeastApart;
  cv::aruco::ArucoDetector(Dictionary(), parameters).detectMarkers(grey, found.corners, found.ids);
  return found;
}

#else

cv::aruco::Dictionary Dictionary() {
  return *cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
}

Found Detect(const cv::Mat& grey) {
  Found found;
  const cv::Ptr<cv::aruco::DetectorParameters> parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_NONE;
  parameters->minMarkerDistanceRate = kLeastApart;
  cv::aruco::detectMarkers(
      grey, cv::makePtr<cv::aruco::Dictionary>(Dictionary()), found.corners, found.ids, parameters);
  return found;
}

#endif

double Diagonal(const RoughMarker& marker) {
  return (marker.corners_px[2] - marker.corners_px[0]).norm();
}

// Two outlines of one marker, at the inner and the outer side of its border.
bool IsOutlineOfSame(const RoughMarker& a, const RoughMarker& b) {
  constexpr double kApart = 0.1;  // of the diagonal
  return a.id == b.id && (a.corners_px[0] - b.corners_px[0]).norm() < kApart * Diagonal(a) &&
         (a.corners_px[2] - b.corners_px[2]).norm() < kApart * Diagonal(a);
}

}  // namespace

std::vector<RoughMarker> DetectMarkers(const cv::Mat& grey) {
  const Found found = Detect(grey);
  std::vector<RoughMarker> markers;
  for (size_t i = 0; i < found.ids.size(); ++i) {
    RoughMarker marker;
    marker.id = found.ids[i];
    for (size_t c = 0; c < 4; ++c)
      marker.corners_px[c] = {found.corners[i][c].x, found.corners[i][c].y};
    const auto same = std::find_if(markers.begin(), markers.end(), [&](const RoughMarker& other) {
      return IsOutlineOfSame(marker, other);
    });
    if (same == markers.end()) {
      markers.push_back(marker);
    } else if (Diagonal(marker) > Diagonal(*same)) {
      *same = marker;
    }
  }
  return markers;
}

std::array<bool, 16> MarkerCells(int id) {
  if (id < 0 || id >= kDictionarySize) {
    throw std::invalid_argument("MarkerCells: DICT_4X4_50 has no marker " + std::to_string(id));
  }
  const cv::Mat bits = cv::aruco::Dictionary::getBitsFromByteList(
      Dictionary().bytesList.rowRange(id, id + 1), kCellsPerSide);
  std::array<bool, 16> cells{};
  for (size_t i = 0; i < cells.size(); ++i) {
    cells[i] = bits.at<uchar>(static_cast<int>(i) / kCellsPerSide,
                              static_cast<int>(i) % kCellsPerSide) != 0;
  }
  return cells;
}

}  // namespace bladecurve
