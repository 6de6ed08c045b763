// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "vision/image/picture_part.h"

namespace bladecurve {

inline constexpr double kMmPerInch = 25.4;

// What a file says beside its pixels.
struct PhotoMetadata {
  std::string format;                     // "jpeg", "png", "tiff", "heic"
  int orientation = 1;                    // EXIF, of Photo's pixels: 1, 3, 6 or 8
  std::optional<double> dpi;              // only if the file states a physical unit
  std::optional<double> focal_length_px;  // from EXIF: 35 mm equivalent, or focal plane resolution
};

// A decoded photograph. Pixels stay as stored (turning 12 MP costs more than finding the scissors);
// coordinates that leave vision/ are turned by DisplayedFromStored instead. Only what a file stores
// as a mirror image is mirrored back: markers are read, and a left blade is one, from one side.
class Photo {
 public:
  // Throws Refused{kUnreadable} naming file, cause and remedy.
  [[nodiscard]] static Photo Load(const std::filesystem::path& path);

  [[nodiscard]] const cv::Mat& grey() const { return grey_; }  // CV_8UC1, encoded (not linear) luma
  // BGR, CV_8UC3, stored orientation, longest side at most max_side; decoded on demand, as small as
  // will do. Up to `slack` times that, >= 1, where that saves reducing it, and down to `least`
  // times that, <= 1, if the file gives it so.
  [[nodiscard]] cv::Mat DecodeColour(int max_side, double slack = 1, double least = 1) const;
  // At least that part of it in colour, BGR, CV_8UC3, in full size; of JPEG files in little more
  // time than it takes to read them up to its end.
  [[nodiscard]] PicturePart DecodeColourPart(const cv::Rect& part_px) const;
  // The topmost rows, a share of all in (0, 1], as large as the file gives them from max_side on;
  // of JPEG and PNG files in as little of the time.
  [[nodiscard]] cv::Mat DecodeTopColour(double share, int max_side) const;
  // Of the file's bytes, lower-case hex; made when asked for.
  [[nodiscard]] std::string Sha256() const;
  [[nodiscard]] const PhotoMetadata& metadata() const { return metadata_; }

  // Both as a viewer sees the picture; stored <-> displayed pixel coordinates.
  [[nodiscard]] int displayed_width() const;
  [[nodiscard]] int displayed_height() const;
  [[nodiscard]] Eigen::Vector2d DisplayedFromStored(const Eigen::Vector2d& stored_px) const;
  [[nodiscard]] Eigen::Vector2d StoredFromDisplayed(const Eigen::Vector2d& displayed_px) const;

 private:
  [[nodiscard]] cv::Mat Unmirrored(const cv::Mat& pixels) const;
  // From the file's columns to the photograph's, and back.
  [[nodiscard]] cv::Rect Unmirrored(const cv::Rect& area_px) const;

  cv::Mat grey_;
  PhotoMetadata metadata_;
  bool mirrored_ = false;  // the file's pixels are
  std::string bytes_;      // the file
};

}  // namespace bladecurve
