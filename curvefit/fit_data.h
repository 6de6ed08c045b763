// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vision/edge_points.h"

namespace bladecurve {

// One cutting edge of one photograph, without a unit: lengths are divided by FitData::length_mm and
// counted from the observed pivot. Ordered along the blade.
struct EdgeSamples {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> weights;  // 1/sigma of each, correlation of neighbours included
  std::vector<int> indices;     // of the point in its EdgePoints; -1 for the mean of several
  double inflation = 1;         // sigma of a point was multiplied by this, for the correlation
  [[nodiscard]] bool empty() const { return points.empty(); }
  [[nodiscard]] int size() const { return static_cast<int>(points.size()); }
  // Independent samples that the edge is worth.
  [[nodiscard]] double effective() const { return size() / (inflation * inflation); }
};

// Pose of one photograph: pivot x, y; direction of the upper and of the lower blade's frame, rad;
// relative error of scale; offset of the edges along their normals. An array, because Ceres takes
// one.
enum PoseIndex { kPivotX, kPivotY, kUpperAngle, kLowerAngle, kScale, kOffset, kPoseSize };
using Pose = std::array<double, kPoseSize>;

// What one photograph says, whitened and without a unit.
struct PhotoData {
  std::string name;
  Eigen::Vector2d origin_mm;  // the observed pivot, in the frame of the EdgePoints
  EdgeSamples upper, lower;
  Eigen::Matrix2d pivot_whitener;  // times a difference of positions: unit variance
  Eigen::Vector2d upper_end;
  Eigen::Matrix2d upper_end_whitener;
  std::optional<Eigen::Vector2d> lower_end;
  Eigen::Vector2d upper_end_out, lower_end_out;  // unit, across the edges there, out of the blades
  Eigen::Matrix2d lower_end_root;                // times its transpose: the covariance
  std::optional<double> theta;                   // rad; observed by other means than the ends
  double theta_weight = 0;
  bool theta_given = false;
  double view_theta_sigma = 0;  // rad; of theta, where it is not given
  double scale_weight = 0, offset_weight = 0;
  Pose start{};

  [[nodiscard]] double ObservedTheta() const;  // by the ends' rays, or by other means
};

struct FitData {
  double length_mm = 1;  // unit of length: pivot to upper distal end, mean of the photographs
  std::vector<PhotoData> photos;
  [[nodiscard]] bool theta_given() const;
};

// Checks, centres, scales and whitens. Throws Refused: kFitFailed for numbers that are not finite
// or sigmas that are not positive, kEdgeTooShort for an edge of less than three different points.
[[nodiscard]] FitData PrepareFitData(const std::vector<EdgePoints>& photos);

// Takes points of a photograph into the frame of its upper blade, or into the mirrored one of its
// lower blade.
class BladeFrame {
 public:
  BladeFrame(const Pose& pose, bool is_upper);
  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& point) const;

 private:
  Eigen::Matrix2d turn_;
  Eigen::Vector2d shift_;
};

// The same edge, as means of at most `max_points` groups of neighbours.
[[nodiscard]] EdgeSamples Thinned(const EdgeSamples& edge, int max_points);

}  // namespace bladecurve
