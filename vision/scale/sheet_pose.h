// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "vision/scale/camera.h"
#include "vision/scale/known_camera.h"
#include "vision/scale/plane_map.h"

namespace bladecurve {

// A square marker on the sheet. Corners in printed order, clockwise from the top left.
struct SquareObservation {
  std::array<Eigen::Vector2d, 4> corners_px;
  double sigma_px = 0;  // of a corner, each way
  std::optional<std::array<Eigen::Vector2d, 4>>
      corners_mm;  // y up; absent: lies anywhere on the sheet
};

struct SheetProblem {
  std::vector<SquareObservation> squares;  // at least one; corners_mm of all or of none
  double side_mm = 0;
  double spread_sigma_mm =
      0;  // ink and tone may move all sides outwards alike; told apart by known corners_mm only
  CameraKnowledge knowledge;
};

// The camera over the sheet. Sheet frame: mm, x right, y up, z towards the camera, sheet at z = 0.
struct SheetPose {
  Camera camera;
  Eigen::Matrix3d camera_from_sheet;   // rotation
  Eigen::Vector3d sheet_in_camera_mm;  // origin of the sheet frame

  [[nodiscard]] double CameraHeightMm() const;
  // Image to mm in the plane parallel to the sheet and height_mm above it.
  [[nodiscard]] PlaneGeometry PlaneAtHeight(double height_mm) const;
};

// Share of a standard deviation by which poses are moved to see what lengths do: small, so that
// they stay linear even where the focal length is hardly known.
inline constexpr double kPoseShift = 0.05;

struct SheetSolution {
  SheetPose pose;
  // The pose moved by plus and minus kPoseShift standard deviations along each principal axis of
  // its covariance.
  std::vector<std::pair<SheetPose, SheetPose>> shifted;
  SheetPose rival;                    // the sheet tilted the other way, solved for as well
  double rival_share = 0;             // its probability, given the corners
  std::vector<double> square_rms_px;  // of each square's corners, in the problem's order
  double rms_px = 0;                  // of the corners' coordinates
  double reduced_chi2 = 1;            // 1: corners scatter as they should; NaN without surplus
  int surplus = 0;                    // observations beyond unknowns: at 0 a low rms proves nothing
  double log_focal_sigma = 0;         // what the corners leave of it
};

// Least squares over all corners, with camera and lens within what is known of them. Throws
// Refused{kNoScale} if the corners fit no camera.
[[nodiscard]] SheetSolution SolveSheet(const SheetProblem& problem);

// Where and in which plane lengths are measured.
struct LengthPlace {
  std::vector<Eigen::Vector2d> places_px;
  double height_mm = 0, height_sigma_mm = 0;
};

// Relative standard uncertainty of lengths, rms over the places: corners, tilt, focal length, lens
// and height.
[[nodiscard]] double RelativeSigma(const SheetSolution& solution, const LengthPlace& place);

// A point seen above a plane parallel to the sheet.
struct RaisedPoint {
  Eigen::Vector2d image_px;
  double plane_height_mm = 0;               // of the plane over the sheet
  double above_mm = 0, above_sigma_mm = 0;  // of the point over the plane
};

// A place in the picture and how well it is known.
struct PlacePx {
  Eigen::Vector2d point_px;
  Eigen::Matrix2d covariance_px2;
};

// Where the plane's point below `raised` is imaged. Seen at a slant the two lie apart; the
// covariance holds what height and pose leave uncertain of that, not that of image_px.
[[nodiscard]] PlacePx FootOf(const SheetSolution& solution, const RaisedPoint& raised);

}  // namespace bladecurve
