// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/warnings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "measured_blades.h"

namespace bladecurve {
namespace {

using testing::Measured;
using testing::SceneWithMarkers;

bool Warns(const Measured& measured, const char* doubt) {
  const std::vector<std::string> warnings = WarningsOf(
      measured.scene, measured.scale, *measured.scale.map, measured.pivot, measured.blades);
  return std::find(warnings.begin(), warnings.end(), doubt) != warnings.end();
}

TEST(WarningsOf, DoubtsAPivotThatIsNotSeenOrHardlySeen) {
  Measured measured{SceneWithMarkers()};
  Screw screw;
  screw.center_px = measured.truth.screw_px;
  screw.covariance_px2.setIdentity();
  screw.evidence = kFaintHead + 1;
  screw.third_support = 0.9;
  measured.pivot.screw = screw;
  EXPECT_FALSE(Warns(measured, "pivot_faint"));
  measured.pivot.screw->evidence = kFaintHead - 1;
  EXPECT_TRUE(Warns(measured, "pivot_faint"));
  EXPECT_FALSE(Warns(measured, "pivot_not_seen"));
  measured.pivot.screw->slot = ScrewSlot{screw.center_px, screw.covariance_px2, true};
  EXPECT_FALSE(Warns(measured, "pivot_faint"));
  measured.pivot.screw->third_support = 0.4;
  EXPECT_FALSE(Warns(measured, "pivot_faint")) << "the slot tells where it is";
  measured.pivot.screw->slot.reset();
  measured.pivot.screw->evidence = kFaintHead + 1;
  EXPECT_TRUE(Warns(measured, "pivot_faint"));
  measured.pivot.screw.reset();
  measured.pivot.source = "geometry";
  EXPECT_TRUE(Warns(measured, "pivot_not_seen"));
  measured.pivot.source = "hint";
  EXPECT_FALSE(Warns(measured, "pivot_off_screw"));
  measured.pivot.off_screw = true;
  EXPECT_TRUE(Warns(measured, "pivot_off_screw"));
}

TEST(WarningsOf, DoubtsAnUpperEdgeThatIsKnownToMoreThanAPixelOnly) {
  Measured measured{SceneWithMarkers()};
  EXPECT_FALSE(Warns(measured, "upper_edge_vague"));
  measured.blades.upper.edge.common_sigma_px = 1.1;
  EXPECT_TRUE(Warns(measured, "upper_edge_vague"));
  measured.blades.upper.edge.common_sigma_px = 0;
  for (LocatedEdgePoint& p : measured.blades.upper.used) p.sigma_px = 1.1;
  EXPECT_TRUE(Warns(measured, "upper_edge_vague"));
}

TEST(WarningsOf, DoubtsAnUpperEdgeBesideABladeThatIsPlainWhite) {
  Measured measured{SceneWithMarkers()};
  LocatedEdge& edge = measured.blades.upper.edge;
  const auto set_contrast = [&](double contrast) {
    for (LocatedEdgePoint& point : edge.points) point.contrast = contrast;
  };
  for (LocatedEdgePoint& point : measured.blades.upper.used) point.sigma_px = 0.05;
  edge.common_sigma_px = 0.4;
  set_contrast(-0.8);
  EXPECT_FALSE(Warns(measured, "upper_edge_overexposed"));
  edge.overexposed = 0.5;
  EXPECT_TRUE(Warns(measured, "upper_edge_overexposed"));
  set_contrast(0.8);
  EXPECT_FALSE(Warns(measured, "upper_edge_overexposed")) << "on a light table the ground is white";
  set_contrast(-0.8);
  edge.common_sigma_px = 0.1;
  EXPECT_FALSE(Warns(measured, "upper_edge_overexposed")) << "the other edge tells the blur";
}

TEST(WarningsOf, DoubtsBladesThatAMarkersPaperReaches) {
  Measured measured{SceneWithMarkers()};
  EXPECT_FALSE(Warns(measured, "marker_near_blade"));
  SeenMarker& marker = measured.scale.markers.front();
  const auto lay_at = [&](const Eigen::Vector2d& center_px, double side_px) {
    const double half = side_px / 2;
    marker.corners_px = {center_px + Eigen::Vector2d(-half, -half),
                         center_px + Eigen::Vector2d(half, -half),
                         center_px + Eigen::Vector2d(half, half),
                         center_px + Eigen::Vector2d(-half, half)};
  };
  constexpr double kSidePx = 100, kReachPx = 0.8 * kSidePx;
  const Eigen::Vector2d tip_px = measured.blades.lower.end.point_px;
  lay_at(tip_px + Eigen::Vector2d(kReachPx + 2, 0), kSidePx);
  EXPECT_FALSE(Warns(measured, "marker_near_blade")) << "beside its paper";
  lay_at(tip_px + Eigen::Vector2d(kReachPx - 2, 0), kSidePx);
  EXPECT_TRUE(Warns(measured, "marker_near_blade")) << "a tip on its paper";
  const std::vector<LocatedEdgePoint>& edge = measured.blades.upper.used;
  lay_at(edge[edge.size() / 2].point_px, kSidePx);
  EXPECT_TRUE(Warns(measured, "marker_near_blade")) << "an edge on its paper";
  lay_at(edge[edge.size() / 2].point_px, 2);
  EXPECT_FALSE(Warns(measured, "marker_near_blade")) << "hardly any of it";
}

TEST(WarningsOf, DoubtsEdgesThatAreAmbiguousOrUnlike) {
  Measured measured{SceneWithMarkers()};
  measured.blades.upper.edge.ambiguity = measured.blades.lower.edge.ambiguity = 0.4;
  EXPECT_FALSE(Warns(measured, "lower_edge_ambiguous"));
  EXPECT_FALSE(Warns(measured, "blades_asymmetric"));
  measured.blades.lower.edge.ambiguity = 0.6;
  EXPECT_TRUE(Warns(measured, "lower_edge_ambiguous"));
  EXPECT_FALSE(Warns(measured, "upper_edge_ambiguous"));
  measured.pivot.asymmetry = 0.03;
  EXPECT_TRUE(Warns(measured, "blades_asymmetric"));
  measured.scale.sheet.reset();
  measured.pivot.source = "hint";  // known to some pixels
  EXPECT_FALSE(Warns(measured, "blades_asymmetric"));
  measured.pivot.source = "screw";
  EXPECT_TRUE(Warns(measured, "blades_asymmetric")) << "the view is slanted, or an edge is wrong";
  measured.pivot.asymmetry = 0.009;
  EXPECT_FALSE(Warns(measured, "blades_asymmetric"));
  measured.blades.edges_part = true;
  EXPECT_TRUE(Warns(measured, "blades_asymmetric"));
  EXPECT_FALSE(Warns(measured, "blades_bent"));
  measured.pivot.bent = true;
  EXPECT_TRUE(Warns(measured, "blades_bent"));
}

// A bevel may be as bright as the ground on part of the way; then another line goes on.
TEST(WarningsOf, DoubtsAnEdgeThatALongStretchStraysFrom) {
  Measured measured{SceneWithMarkers()};
  measured.blades.upper.edge.ambiguity = 0;
  std::vector<LocatedEdgePoint>& points = measured.blades.upper.edge.points;
  const auto share = [&](double part) {
    return static_cast<std::size_t>(part * static_cast<double>(points.size()));
  };
  for (std::size_t i = 0; i < share(0.25); ++i) points[i].inlier = false;
  EXPECT_FALSE(Warns(measured, "upper_edge_ambiguous"));
  for (std::size_t i = 0; i < share(0.35); ++i) points[i].inlier = false;
  EXPECT_TRUE(Warns(measured, "upper_edge_ambiguous"));
  for (std::size_t i = 0; i < share(0.35); i += 10) points[i].inlier = true;
  EXPECT_FALSE(Warns(measured, "upper_edge_ambiguous")) << "here and there is no other line";
}

}  // namespace
}  // namespace bladecurve
