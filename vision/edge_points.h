// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace bladecurve {

// One located point of a cutting edge.
struct EdgePoint {
  Eigen::Vector2d point_mm;  // in the frame of its EdgePoints
  Eigen::Vector2d normal;    // unit; points out of the blade, into the gap
  double sigma_mm = 0;       // standard uncertainty along the normal, of this point by itself
};

// A point that is seen with different certainty in different directions.
struct LocatedPoint {
  Eigen::Vector2d point_mm = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_mm2 = Eigen::Matrix2d::Zero();
};

// What one photograph says about a pair of scissors: all that the curve fit needs of it.
//
// Frame: mm in the plane of the cutting edges; right-handed as the viewer sees it; origin at the
// pivot as vision estimates it, +x along the symmetry line towards the tips, +y up when +x is
// right. The fit refines that pose, so "estimates" suffice; the pivot is therefore near (0, 0).
struct EdgePoints {
  std::string photo;  // the file's name, for messages
  std::vector<EdgePoint>
      upper;  // cutting edge of the upper blade, from the crotch to its distal end
  std::vector<EdgePoint> lower;  // the same of the lower blade; may be empty
  LocatedPoint pivot;            // the screw, or the pivot inferred from rigid geometry
  // Distal ends: where the edge begins to round off into the tip; uncertain by themselves, what
  // they share with the edges' points (common_offset_sigma_mm) left out.
  LocatedPoint upper_end, lower_end;
  double theta_rad =
      std::numeric_limits<double>::quiet_NaN();  // opening angle; from the distal ends, or given
  double theta_sigma_rad =
      std::numeric_limits<double>::quiet_NaN();  // NaN: not known; taken for half a degree
  bool theta_given = false;  // the user said it (--theta-deg): then it is an observation of its own
  // Beside theta_sigma_rad: by how much an unknown slant of the camera turns the blades apart, each
  // with all its points.
  double view_theta_sigma_rad = 0;
  double scale_relative_sigma = 0;   // standard uncertainty of mm per pixel, relative
  double correlation_length_mm = 0;  // neighbouring points closer than this are not independent
  double common_offset_sigma_mm =
      0;  // an offset along the normals that all points and ends share (tone curve, bevel)
};

}  // namespace bladecurve
