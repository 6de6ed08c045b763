// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The one file that knows which of OpenCV's two marker interfaces is there.
#include "vision/marker_detector.h"

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

constexpr int kDictionarySize = 50, kCellsPerSide = 4;

struct Found {
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
};

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
  cv::aruco::detectMarkers(
      grey, cv::makePtr<cv::aruco::Dictionary>(Dictionary()), found.corners, found.ids, parameters);
  return found;
}

#endif

}  // namespace

std::vector<RoughMarker> DetectMarkers(const cv::Mat& grey) {
  const Found found = Detect(grey);
  std::vector<RoughMarker> markers(found.ids.size());
  for (size_t i = 0; i < markers.size(); ++i) {
    markers[i].id = found.ids[i];
    for (size_t c = 0; c < 4; ++c)
      markers[i].corners_px[c] = {found.corners[i][c].x, found.corners[i][c].y};
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
