// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <Eigen/Dense>
#include <cmath>

#include "vision/scale/sheet_pose.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

PlaneMap MapAt(const SheetPose& pose, double height_mm) {
  return PlaneMap::FromGeometry(pose.PlaneAtHeight(height_mm), 0, "");
}

double LogScale(const SheetPose& pose, double height_mm, const Vector2d& place_px) {
  return 0.5 * std::log(std::abs(MapAt(pose, height_mm).JacobianAt(place_px).determinant()));
}

Vector2d FootOf(const SheetPose& pose, const RaisedPoint& raised, double above_mm) {
  const Vector2d place_mm =
      MapAt(pose, raised.plane_height_mm + above_mm).PlaneFromImage(raised.image_px);
  return MapAt(pose, raised.plane_height_mm).ImageFromPlane(place_mm);
}

}  // namespace

double SheetPose::CameraHeightMm() const {
  return -camera_from_sheet.col(2).dot(sheet_in_camera_mm);
}

PlaneGeometry SheetPose::PlaneAtHeight(double height_mm) const {
  Eigen::Matrix3d image_from_plane;
  image_from_plane << camera_from_sheet.leftCols<2>(),
      sheet_in_camera_mm + height_mm * camera_from_sheet.col(2);
  return {(camera.k * image_from_plane).inverse(), camera};
}

double RelativeSigma(const SheetSolution& solution, const LengthPlace& place) {
  double variance = 0;
  for (const Vector2d& px : place.places_px) {
    for (const auto& [plus, minus] : solution.shifted) {
      const double half =
          (LogScale(plus, place.height_mm, px) - LogScale(minus, place.height_mm, px)) /
          (2 * kPoseShift);
      variance += half * half;
    }
    const double by_tilt = LogScale(solution.rival, place.height_mm, px) -
                           LogScale(solution.pose, place.height_mm, px);
    variance += solution.rival_share * (1 - solution.rival_share) * by_tilt * by_tilt;
    const double by_height = LogScale(solution.pose, place.height_mm + place.height_sigma_mm, px) -
                             LogScale(solution.pose, place.height_mm, px);
    variance += by_height * by_height;
  }
  return std::sqrt(variance / static_cast<double>(place.places_px.size()));
}

PlacePx FootOf(const SheetSolution& solution, const RaisedPoint& raised) {
  PlacePx foot{FootOf(solution.pose, raised, raised.above_mm), Eigen::Matrix2d::Zero()};
  const auto add = [&](double weight, const Vector2d& off) {
    foot.covariance_px2 += weight * off * off.transpose();
  };
  for (const auto& [plus, minus] : solution.shifted) {
    add(1,
        (FootOf(plus, raised, raised.above_mm) - FootOf(minus, raised, raised.above_mm)) /
            (2 * kPoseShift));
  }
  add(solution.rival_share * (1 - solution.rival_share),
      FootOf(solution.rival, raised, raised.above_mm) - foot.point_px);
  add(1, FootOf(solution.pose, raised, raised.above_mm + raised.above_sigma_mm) - foot.point_px);
  return foot;
}

}  // namespace bladecurve
