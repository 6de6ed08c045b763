// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/mirrored_trace.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "measured_blades.h"
#include "tests/degree.h"
#include "vision/scissors/turned_mirror.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using testing::BareSheet;
using testing::BrightenedAlongUpperEdge;
using testing::FarFrom;
using testing::Grained;
using testing::kBevelPx;
using testing::Measured;
using testing::SceneWithMarkers;
using testing::WithMirroringBevel;

// In `picture` of the scene, the upper edge having been taken for the bevel's inner border.
struct Found {
  bool any = false;
  double off_px = 0;
};

Found FindIn(const SceneSpec& spec, const cv::Mat& picture, double bevel_px = kBevelPx) {
  Measured measured{spec};
  measured.Misplace(&measured.blades.upper, -bevel_px);
  measured.photo = Measured::PhotoOf(picture);
  const LocatedBlade& lower = measured.blades.lower;
  const auto trace =
      FindMirroredTrace(measured.View(),
                        measured.blades.upper,
                        lower,
                        LineBetween(measured.View(), measured.pivot, measured.blades),
                        bevel_px);
  if (!trace) return {};
  std::vector<LocatedEdgePoint> points = lower.used;
  for (LocatedEdgePoint& p : points) p = trace->line.Reflected(p);
  return {true, FarFrom(measured.truth.upper, points)};
}

TEST(FindMirroredTrace, FindsTheBorderOfABevelThatMirrorsTheGround) {
  constexpr double kClosePx = 0.4;
  const SceneSpec spec = SceneWithMarkers();
  const Found found = FindIn(spec, WithMirroringBevel(spec));
  EXPECT_TRUE(found.any);
  EXPECT_LT(found.off_px, kClosePx);
}

// As dark as the shadow at its foot, which gets lighter from there on: no step, but a kink.
TEST(FindMirroredTrace, FindsTheBorderOfABevelAsDarkAsTheShadowBesideIt) {
  constexpr double kClosePx = 0.6, kShadowPx = 12, kDark = 60;
  const SceneSpec spec = SceneWithMarkers();
  const auto light = [](double depth, double) {
    return -kDark * std::min(1.0, 1 + depth / kShadowPx);
  };
  const Found found =
      FindIn(spec, Grained(BrightenedAlongUpperEdge(spec, -kShadowPx, kBevelPx, light)));
  EXPECT_TRUE(found.any);
  EXPECT_LT(found.off_px, kClosePx);
}

TEST(FindMirroredTrace, FindsTheBorderOfANarrowBevel) {
  constexpr double kClosePx = 0.7, kNarrowPx = 3, kDarker = 6;
  const SceneSpec spec = SceneWithMarkers();
  const auto light = [](double, double) { return -kDarker; };
  const Found found =
      FindIn(spec, Grained(BrightenedAlongUpperEdge(spec, 0, kNarrowPx, light)), kNarrowPx);
  EXPECT_TRUE(found.any);
  EXPECT_LT(found.off_px, kClosePx);
}

TEST(FindMirroredTrace, FindsNoneOnABareSheet) {
  EXPECT_FALSE(FindIn(SceneWithMarkers(), BareSheet()).any);
}

// A step along a course, darker on the far side of its normals, or of another colour.
void DrawStep(const std::vector<LocatedEdgePoint>& course,
              cv::Mat* picture,
              const cv::Vec3b& bgr = {90, 90, 90},
              double depth_px = 12) {
  constexpr double kStepPx = 0.5;
  for (std::size_t i = 1; i < course.size(); ++i) {
    const Vector2d along = course[i].trend_px - course[i - 1].trend_px;
    for (double t = 0; t < 1; t += kStepPx / along.norm()) {
      for (double depth = 0; depth < depth_px; depth += kStepPx) {
        const Vector2d at = course[i - 1].trend_px + t * along - depth * course[i].normal;
        picture->at<cv::Vec3b>(cv::Point(static_cast<int>(std::lround(at.x())),
                                         static_cast<int>(std::lround(at.y())))) = bgr;
      }
    }
  }
}

// An edge mirrored at the line turned.
std::vector<LocatedEdgePoint> MirroredAtTurned(const MirrorLine& line,
                                               const LocatedBlade& blade,
                                               double turn_rad) {
  return line.TurnedBy(2 * turn_rad).Reflected(blade.used);
}

// The sign of turns that bring the mirror image nearer to the edge itself.
double TowardsItself(const MirrorLine& line, const LocatedBlade& blade) {
  const auto off_px = [&](double turn_rad) {
    return (MirroredAtTurned(line, blade, turn_rad).back().trend_px - blade.used.back().trend_px)
        .norm();
  };
  return off_px(0.1) < off_px(-0.1) ? 1 : -1;
}

TEST(FindMirroredTrace, TakesNoLineOnTheOtherBlade) {
  constexpr double kBeyondRad = 0.06;
  const Measured measured{SceneWithMarkers()};
  const LocatedBlade &upper = measured.blades.upper, &lower = measured.blades.lower;
  const MirrorLine line = LineBetween(measured.View(), measured.pivot, measured.blades);
  const Vector2d end = lower.used.back().trend_px, pivot_px = line.map.ImageFromPlane(line.pivot);
  const double opening_rad = measured.truth.theta_rad;
  const double difference_px = opening_rad * (end - pivot_px).norm();
  const auto finds = [&](double turn_rad) {
    cv::Mat picture = BareSheet();
    DrawStep(MirroredAtTurned(line, lower, TowardsItself(line, lower) * turn_rad), &picture);
    Measured seen{SceneWithMarkers()};
    seen.photo = Measured::PhotoOf(picture);
    return FindMirroredTrace(seen.View(), upper, lower, line, difference_px).has_value();
  };
  EXPECT_TRUE(finds(0.25 * opening_rad));  // halfway between the edges
  EXPECT_FALSE(finds(0.5 * (opening_rad + kBeyondRad)));
}

// A line beside an upper edge that is where it belongs: so far outwards of its end, less nearer to
// the pivot, over those shares of the blade from the crotch on, in a picture brightened by so much.
// Of the edge, that share was not found.
struct LineBeside {
  double off_px = 0;
  double from = 0, to = 1;
  double brighter = 0;
  double edge_lost_to = 0;
};

void KeepShares(double from, double to, std::vector<LocatedEdgePoint>* points) {
  const auto place = [count = static_cast<double>(points->size())](double share) {
    return std::lround(share * count);
  };
  points->erase(points->begin() + place(to), points->end());
  points->erase(points->begin(), points->begin() + place(from));
}

// Whether it is taken.
bool Takes(const LineBeside& drawn) {
  constexpr double kDifferencePx = 6;
  Measured measured{SceneWithMarkers()};
  LocatedBlade& upper = measured.blades.upper;
  const LocatedBlade& lower = measured.blades.lower;
  const MirrorLine line = LineBetween(measured.View(), measured.pivot, measured.blades);
  const double reach_px = (upper.used.back().trend_px - measured.pivot.point_px).norm();
  const double turn_rad = TowardsItself(line, lower) * 0.5 * drawn.off_px / reach_px;
  std::vector<LocatedEdgePoint> course = MirroredAtTurned(line, lower, turn_rad);
  KeepShares(drawn.from, drawn.to, &course);
  cv::Mat picture = BareSheet();
  DrawStep(course, &picture);
  picture += cv::Scalar::all(drawn.brighter);
  measured.photo = Measured::PhotoOf(picture);
  KeepShares(drawn.edge_lost_to, 1, &upper.used);
  return FindMirroredTrace(measured.View(), upper, lower, line, kDifferencePx).has_value();
}

TEST(FindMirroredTrace, TakesNoLineThatLeavesTheEdgesEnd) {
  EXPECT_TRUE(Takes({.off_px = 9}));
  EXPECT_FALSE(Takes({.off_px = 14}));
}

// White as the picture can store, light may do anything.
TEST(FindMirroredTrace, TakesNoLineInOverexposedLight) {
  constexpr double kWhitens = 100;
  EXPECT_FALSE(Takes({.off_px = 9, .brighter = kWhitens}));
}

// Where nothing was found of the upper edge, its own line may be what is seen.
TEST(FindMirroredTrace, TakesNoLineWhereTheInnerEdgeWasNotFound) {
  constexpr double kTo = 0.75;
  EXPECT_TRUE(Takes({.off_px = 9, .to = kTo}));
  EXPECT_FALSE(Takes({.off_px = 9, .to = kTo, .edge_lost_to = kTo}));
}

TEST(FindMirroredTrace, NeedsNoneNearTheCrotch) { EXPECT_TRUE(Takes({.off_px = 9, .from = 0.5})); }

// What FindTurnedMirror makes of a bare sheet on which the upper edge's mirror image was drawn,
// turned by some angles, the outermost first: how far from the first one it finds the lower edge.
struct DrawnTurn {
  double inwards_rad = 0;
  cv::Vec3b bgr{90, 90, 90};
};

std::optional<double> OffFirst(const std::vector<DrawnTurn>& drawn) {
  constexpr double kDeepPx = 80;
  Measured measured{SceneWithMarkers()};
  const LocatedBlade& upper = measured.blades.upper;
  const MirrorLine line = LineBetween(measured.View(), measured.pivot, measured.blades);
  cv::Mat picture = BareSheet();
  const auto course = [&](const DrawnTurn& turn) {
    return MirroredAtTurned(line, upper, -0.5 * TowardsItself(line, upper) * turn.inwards_rad);
  };
  for (const DrawnTurn& turn : drawn) DrawStep(course(turn), &picture, turn.bgr, kDeepPx);
  measured.photo = Measured::PhotoOf(picture);
  const auto found = FindTurnedMirror(measured.View(), upper, line);
  if (!found) return std::nullopt;
  const Vector2d end = found->Reflected(upper.used.back().trend_px);
  return (end - course(drawn.front()).back().trend_px).norm();
}

TEST(FindTurnedMirror, FindsTheOtherEdgesMirrorImageSomeDegreesOff) {
  constexpr double kClosePx = 1;
  for (const double inwards_rad : {-4 * kDegree, 0.0, 6 * kDegree}) {
    const auto off_px = OffFirst({{inwards_rad}});
    ASSERT_TRUE(off_px) << inwards_rad;
    EXPECT_LT(*off_px, kClosePx) << inwards_rad;
  }
}

// Light may rise at a shadow's border, or where the blade ends and a bevel begins within it.
TEST(FindTurnedMirror, TakesTheOuterOneOfTwoUnlessItMayBeAShadows) {
  constexpr double kClosePx = 1;
  const cv::Vec3b orange{40, 90, 160}, darker{50, 50, 50};
  EXPECT_FALSE(OffFirst({{-2 * kDegree}, {4 * kDegree, darker}}));
  const auto off_px = OffFirst({{-2 * kDegree, orange}, {4 * kDegree, darker}});
  ASSERT_TRUE(off_px);
  EXPECT_LT(*off_px, kClosePx);
}

TEST(FindTurnedMirror, FindsNoneOnABareSheet) {
  const Measured seen{SceneWithMarkers()};
  Measured bare{SceneWithMarkers()};
  bare.photo = Measured::PhotoOf(BareSheet());
  const MirrorLine line = LineBetween(seen.View(), seen.pivot, seen.blades);
  EXPECT_TRUE(FindTurnedMirror(seen.View(), seen.blades.upper, line));
  EXPECT_FALSE(FindTurnedMirror(bare.View(), bare.blades.upper, line));
}

}  // namespace
}  // namespace bladecurve
