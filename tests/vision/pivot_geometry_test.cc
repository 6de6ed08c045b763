// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/pivot_geometry.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/degree.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLength = 300;  // px, pivot to tips
const Vector2d kPivot(400, 350);

// Straight edges whose ends open by theta about the pivot, towards +x; each, continued, passes the
// pivot at overlap * kLength on the other blade's side.
EdgePair Edges(double theta_rad, double overlap) {
  EdgePair edges;
  const double inclination = std::asin(overlap);
  for (const double side : {-1.0, 1.0}) {  // left seen towards the tips: up in the picture
    const double to_end = side * 0.5 * theta_rad, along = to_end + side * inclination;
    const Vector2d end = kPivot + kLength * Vector2d(std::cos(to_end), std::sin(to_end));
    const Vector2d direction(std::cos(along), std::sin(along));
    std::vector<Vector2d>& edge = side < 0 ? edges.left_px : edges.right_px;
    const double crossing = side * (end - kPivot).y() / (side * direction.y());
    for (double back = 0.97 * crossing; back >= 0; back -= 1)
      edge.push_back(end - back * direction);
  }
  return edges;
}

Scene SceneWithWaistAt(double behind_tips_px, double sigma_px, double quality) {
  Scene scene;
  scene.pivot_px = kPivot + Vector2d(kLength - behind_tips_px, 0);
  scene.pivot_sigma_px = sigma_px;
  scene.quality = quality;
  return scene;
}

double AlongError(const Estimate& behind, const EdgeMirror& mirror) {
  return (mirror.point_px - behind.value * mirror.direction - kPivot).dot(mirror.direction);
}

TEST(EdgeOverlap, IsWhatTheEdgesPassThePivotBy) {
  constexpr double kClose = 1e-3;
  for (const double overlap : {0.0, 0.06, 0.12}) {
    const EdgePair edges = Edges(30 * kDegree, overlap);
    EXPECT_NEAR(EdgeOverlap(edges, kPivot), overlap, kClose);
    EXPECT_NEAR(EdgeAsymmetry(edges, kPivot), 0, kClose);
  }
}

TEST(EdgeAsymmetry, ChangesByTwiceThePivotsShareAside) {
  constexpr double kClose = 0.005;
  const EdgePair edges = Edges(20 * kDegree, 0.08);
  const Vector2d aside = kPivot + Vector2d(0, 0.1 * kLength);
  const double cosine = std::cos(10 * kDegree + std::asin(0.08));
  EXPECT_NEAR(EdgeAsymmetry(edges, aside), -0.2 * cosine, kClose);
  EXPECT_NEAR(EdgeOverlap(edges, aside), 0.08, kClose);
}

// Both towards the left by a parabola that begins `from` of the length off the pivot and is
// highest, `bow` of the length, half way to the tips.
EdgePair Bent(EdgePair edges, double bow, double from) {
  for (std::vector<Vector2d>* edge : {&edges.left_px, &edges.right_px}) {
    for (Vector2d& p : *edge) {
      const double along = (p - kPivot).norm() / kLength;
      const double share = (along - from) / (1 - from);
      p.y() -= 4 * bow * share * (1 - share) * kLength;
    }
  }
  return edges;
}

// A sheet under a camera that is tilted about a line at 40 degrees to the blades' axis.
ScaleResult TiltedView(double tilt_rad) {
  SheetSolution sheet;
  sheet.pose.camera = CentredCamera(1500, 800, 700);
  sheet.pose.camera_from_sheet =
      Eigen::AngleAxisd(tilt_rad, Vector3d(std::cos(40 * kDegree), std::sin(40 * kDegree), 0))
          .toRotationMatrix() *
      Vector3d(1, -1, -1).asDiagonal();
  sheet.pose.sheet_in_camera_mm = {0, 0, 500};
  ScaleResult scale;
  scale.map = PlaneMap::FromGeometry(sheet.pose.PlaneAtHeight(0), 0, "marker");
  scale.sheet = sheet;
  return scale;
}

TEST(SeenFromAbove, MirroredEdgesAreAlikeFromEverySide) {
  constexpr double kClose = 1e-3, kOverlap = 0.1;
  const EdgePair edges = Edges(60 * kDegree, kOverlap);  // taken for mm, y down
  for (const double tilt : {0.0, 15 * kDegree, 30 * kDegree}) {
    const ScaleResult scale = TiltedView(tilt);
    const auto image = [&](const Vector2d& p) {
      return scale.map->ImageFromPlane(0.2 * Vector2d(p.x() - 500, 350 - p.y()));
    };
    EdgePair seen;
    for (const Vector2d& p : edges.left_px) seen.left_px.push_back(image(p));
    for (const Vector2d& p : edges.right_px) seen.right_px.push_back(image(p));
    const Vector2d pivot_px = image(kPivot);
    const EdgePair from_above = SeenFromAbove(scale, seen, pivot_px);
    EXPECT_NEAR(EdgeAsymmetry(from_above, pivot_px), 0, kClose) << tilt;
    EXPECT_NEAR(EdgeOverlap(from_above, pivot_px), kOverlap, kClose) << tilt;
    EXPECT_LT(EdgeUnlikeness(from_above, pivot_px), kClose) << tilt;
    EXPECT_EQ(AreSuspect(EdgeAsymmetry(seen, pivot_px)), tilt > 20 * kDegree);
  }
  EXPECT_EQ(SeenFromAbove({}, edges, kPivot).left_px, edges.left_px);  // the view is not known
}

TEST(AreBentToOneSide, SeesParabolasFromTheHeels) {
  const EdgePair edges = Edges(30 * kDegree, 0.08);
  EXPECT_FALSE(AreBentToOneSide(edges, kPivot));
  for (const double bow : {0.01, -0.01, 0.03, -0.03}) {
    for (const double from : {0.0, 0.12, 0.25})
      EXPECT_TRUE(AreBentToOneSide(Bent(edges, bow, from), kPivot)) << bow << " " << from;
  }
}

// The outline of a blade with a soft shadow is bent as well.
TEST(AreBentToOneSide, SeesNoneInAnOutline) {
  EdgePair bent = Bent(Edges(30 * kDegree, 0.08), 0.03, 0.12);
  ASSERT_TRUE(AreBentToOneSide(bent, kPivot));
  bent.traced = true;
  EXPECT_FALSE(AreBentToOneSide(bent, kPivot));
}

// However roughly they were located, if they are bent by far more.
TEST(AreBentToOneSide, SeesLargeBowsOfRoughEdges) {
  constexpr double kRough = 0.004, kWaves = 9;  // of the length
  const auto roughened = [&](EdgePair edges) {
    for (Vector2d& p : edges.left_px)
      p.y() += kRough * kLength * std::sin(kWaves * (p - kPivot).norm() / kLength);
    return edges;
  };
  const EdgePair edges = Edges(30 * kDegree, 0.08);
  EXPECT_FALSE(AreBentToOneSide(roughened(edges), kPivot));
  EXPECT_FALSE(AreBentToOneSide(roughened(Bent(edges, 0.01, 0.12)), kPivot));
  EXPECT_TRUE(AreBentToOneSide(roughened(Bent(edges, 0.06, 0.12)), kPivot));
}

// As lines of shadows and bevels are: aside by as much everywhere, or the more the further from the
// tip, or only on a part.
TEST(AreBentToOneSide, SeesNoneWhereOneEdgeIsAnotherLine) {
  const EdgePair edges = Edges(30 * kDegree, 0.08);
  const auto aside = [&](const auto& offset) {
    EdgePair other = edges;
    for (Vector2d& p : other.left_px)
      p.y() += kLength * offset(1 - (p - kPivot).norm() / kLength);  // of the way back to the pivot
    return AreBentToOneSide(other, kPivot);
  };
  EXPECT_FALSE(aside([](double) { return 0.02; }));
  EXPECT_FALSE(aside([](double back) { return 0.04 * back; }));
  EXPECT_FALSE(aside([](double back) { return 0.1 * back * back; }));
  EXPECT_FALSE(aside([](double back) { return back < 0.3 ? 0.02 : 0; }));
}

TEST(EdgeUnlikeness, TellsABowFromAPivotAsideAndASlantedView) {
  constexpr double kAlike = 0.001, kBow = 0.06, kFrom = 0.12, kSlant = 0.1;
  const EdgePair edges = Edges(30 * kDegree, 0.08);
  EXPECT_LT(EdgeUnlikeness(edges, kPivot), kAlike);
  EXPECT_LT(EdgeUnlikeness(edges, kPivot + Vector2d(0, 0.05 * kLength)), kAlike);
  EdgePair slanted = edges, bowed = edges;
  for (std::vector<Vector2d>* edge : {&slanted.left_px, &slanted.right_px}) {
    for (Vector2d& p : *edge) p += kSlant * Vector2d((p - kPivot).y(), 0);
  }
  EXPECT_LT(EdgeUnlikeness(slanted, kPivot), kAlike);
  bowed.left_px = Bent(edges, kBow, kFrom).left_px;
  const double seen = (1 - (edges.left_px.front() - kPivot).norm() / kLength) / (1 - kFrom);
  const double parabola = 4 * kBow * seen * seen / std::sqrt(180.0);  // about its best line
  EXPECT_NEAR(EdgeUnlikeness(bowed, kPivot), parabola, 0.1 * parabola);
  bowed.left_px.resize(10);
  EXPECT_TRUE(std::isnan(EdgeUnlikeness(bowed, kPivot)));
}

TEST(MirrorOf, FindsWhereTheEdgesCrossAndTheirLine) {
  constexpr double kClose = 0.02;  // px
  const EdgeMirror mirror = MirrorOf(Edges(30 * kDegree, 0.08));
  EXPECT_NEAR(mirror.direction.x(), 1, 1e-6);
  EXPECT_NEAR(mirror.point_px.y(), kPivot.y(), kClose);
  const double sine = std::sin(15 * kDegree + std::asin(0.08));
  EXPECT_NEAR(mirror.sine, sine, 1e-4);
  EXPECT_NEAR(mirror.point_px.x() - kPivot.x(), 0.08 * kLength / sine, kClose);
}

TEST(BehindByGeometry, KeepsAWaistThatAgreesWithTheEdges) {
  const EdgeMirror mirror = MirrorOf(Edges(30 * kDegree, 0.09));
  const Scene scene = SceneWithWaistAt(kLength - 2, 4, 1);
  const Estimate behind = BehindByGeometry(scene, mirror);
  EXPECT_NEAR(AlongError(behind, mirror), 2, 0.1);
  EXPECT_NEAR(behind.sigma, BehindByWaist(scene, mirror).sigma, 0.1);
}

// The waist a tenth of the length off either way: the edges know better, and the estimate says how
// well.
TEST(BehindByGeometry, IsDrawnWhereScissorsEdgesOverlap) {
  for (const double off : {-0.1, 0.1}) {
    const EdgeMirror mirror = MirrorOf(Edges(50 * kDegree, 0.09));
    const Scene scene = SceneWithWaistAt((1 - off) * kLength, 0.06 * kLength, 1);
    const Estimate behind = BehindByGeometry(scene, mirror);
    EXPECT_LT(std::abs(AlongError(behind, mirror)), 0.06 * kLength);
    EXPECT_LT(std::abs(AlongError(behind, mirror)), 2.5 * behind.sigma);
    EXPECT_LT(behind.sigma, BehindByWaist(scene, mirror).sigma);
  }
}

TEST(BehindByGeometry, StaysWithTheWaistWhereEdgesOpenTooLittleToTell) {
  const EdgeMirror mirror = MirrorOf(Edges(2 * kDegree, 0.01));
  const Scene scene = SceneWithWaistAt(0.8 * kLength, 10, 1);
  EXPECT_EQ(BehindByGeometry(scene, mirror).value, BehindByWaist(scene, mirror).value);
}

TEST(BehindByWaist, KnowsLessWhereTheSilhouetteIsInDoubt) {
  const EdgeMirror mirror = MirrorOf(Edges(30 * kDegree, 0.09));
  const double sure = BehindByWaist(SceneWithWaistAt(kLength, 5, 1), mirror).sigma;
  const double doubtful = BehindByWaist(SceneWithWaistAt(kLength, 5, 0.6), mirror).sigma;
  EXPECT_GT(doubtful, sure + 0.15 * kLength);
}

}  // namespace
}  // namespace bladecurve
