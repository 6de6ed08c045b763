// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "vision/image/tone_curve.h"
#include "vision/photo/photo.h"
#include "vision/scale/plane_map.h"
#include "vision/scale/sheet_pose.h"

namespace bladecurve {

// How well users know a height that they measure with a caliper or a ruler, standard uncertainty.
inline constexpr double kGivenHeightSigmaMm = 0.1;

// What the user said about scale; at most one of the first five.
struct ScaleOptions {
  std::optional<double> mm_per_px;
  std::optional<double> dpi;
  std::optional<double> length_mm;  // pivot to upper distal end; solved once both are known
  std::optional<double> marker_mm;  // side of loose DICT_4X4_50 markers lying anywhere in the plane
  std::optional<std::filesystem::path> card;  // a card description, "default" for the built-in one
  double print_scale = 1.0;  // measured length of the check bar over its nominal 100 mm
  std::optional<double> plane_height_mm;        // of the cutting edge above the printed sheet
  std::optional<std::filesystem::path> camera;  // CALIB.json
  bool pixels = false;                          // --units px: one "mm" is one pixel
};

// Source of a map that takes a pixel for a unit.
inline constexpr const char* kPixelsSource = "pixels";

// The light that a print shows is that which it was read with to the power of `exponent`.
struct ToneSeen {
  double exponent = 1;
  double sigma = std::numeric_limits<double>::infinity();
};

// A printed marker seen in the picture: scene finding leaves it out.
struct SeenMarker {
  int id = 0;
  std::array<Eigen::Vector2d, 4>
      corners_px;  // sub-pixel; printed order, clockwise from the top left
  double corner_sigma_px = std::numeric_limits<double>::quiet_NaN();
  double blur_px = std::numeric_limits<double>::quiet_NaN();  // Gaussian sigma, pixel box apart
  ToneSeen tone;             // of its borders, where all of them are seen
  bool overexposed = false;  // the paper beside it is brighter than white
};

struct ScaleResult {
  std::optional<PlaneMap> map;            // absent only while length_mm waits for the scene
  std::optional<CameraKnowledge> camera;  // without a sheet; of a scan none
  std::optional<SheetSolution> sheet;     // where markers say how the camera stands over it
  double plane_height_mm = 0;             // of the map's plane over the sheet
  std::vector<SeenMarker> markers;
  ToneCurve tone;  // sRGB, with what is uncertain about it
};

// Of the markers' sides, typically: how sharp the photograph is at about the blades' distance.
// Gaussian sigma, px, pixel box apart. std::nullopt without markers.
[[nodiscard]] std::optional<double> PrintBlurPx(const std::vector<SeenMarker>& markers);

// Throws Refused{kNoScale} where nothing says how many mm a pixel is, std::invalid_argument for
// contradictory options.
[[nodiscard]] ScaleResult FindScale(const Photo& photo, const ScaleOptions& options);

// DICT_4X4_50 markers found on a small version of the picture (cheap), corners refined on the full
// one.
[[nodiscard]] std::vector<SeenMarker> FindMarkers(const cv::Mat& grey, const ToneCurve& tone);

}  // namespace bladecurve
