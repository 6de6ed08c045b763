// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/head_trust.h"

#include <gtest/gtest.h>

#include "measured_blades.h"
#include "vision/pivot/head_search.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

const Vector2d kTrustedHead(200, 300);

// Blades that no slant of the view makes mirror each other about the head.
EdgePair UnlikeEdges() {
  EdgePair edges;
  for (double ahead = 60; ahead <= 200; ahead += 1) {
    edges.left_px.emplace_back(kTrustedHead + Vector2d(ahead, -0.3 * ahead));
    edges.right_px.emplace_back(kTrustedHead + Vector2d(ahead, 0.3 * ahead - 15));
  }
  return edges;
}

Screw HeadThere(double evidence, bool slotted) {
  Screw screw{};
  screw.center_px = kTrustedHead;
  screw.covariance_px2 = 0.01 * Eigen::Matrix2d::Identity();
  screw.semi_major_px = screw.semi_minor_px = 30;
  screw.evidence = evidence;
  screw.third_support = 0.5;
  if (slotted) {
    screw.slot.emplace();
    screw.slot->center_px = kTrustedHead;
    screw.slot->covariance_px2 = screw.covariance_px2;
    screw.slot->ends_seen = true;
  }
  return screw;
}

// A joint about a head, of which the silhouette puts the pivot there.
Scene JointAbout(const Vector2d& pivot_px, double sigma_px) {
  Scene scene;
  scene.shank_width_px = 50;
  scene.crotch_px = kTrustedHead + Vector2d(80, 0);
  scene.shank_crotch_px = kTrustedHead - Vector2d(80, 0);
  scene.pivot_px = pivot_px;
  scene.pivot_sigma_px = sigma_px;
  return scene;
}

ScaleResult UnknownView() {
  ScaleResult scale;
  scale.map = PlaneMap::Uniform(0.1, 0, "mm-per-px");
  return scale;
}

// A faint head, as far from where the blades put the pivot as an edge that is wrong puts it, and so
// far across from where the silhouette does.
bool IsCredibleFaint(bool slotted, double off_silhouette_px) {
  const ScaleResult scale = UnknownView();
  const Scene scene = JointAbout(kTrustedHead + Vector2d(10, off_silhouette_px), 15);
  const PlacePx by_geometry{kTrustedHead + Vector2d(10, 40),
                            Vector2d(15 * 15, 5 * 5).asDiagonal().toDenseMatrix()};
  const EdgePair edges = UnlikeEdges();
  const HeadSearch known{cv::Mat(), scale, scene, edges, by_geometry, std::nullopt};
  return IsCredibleThere(HeadThere(4.5, slotted), known);
}

TEST(IsCredibleThere, AsksTheSilhouetteWhereAnEdgeMayBeWrong) {
  EXPECT_TRUE(IsCredibleFaint(true, 0));
  EXPECT_TRUE(IsCredibleFaint(true, 5));
  EXPECT_FALSE(IsCredibleFaint(true, 20));
  EXPECT_FALSE(IsCredibleFaint(false, 0)) << "arcs lie there as well";
}

// What little shows of a head, along the joint so many px from where the blades put the pivot, and
// from where the silhouette does, both known to 10 px.
bool LiesFarFromBoth(double off_blades_px,
                     double off_silhouette_px,
                     double evidence = 8,
                     bool slotted = false) {
  constexpr double kSigmaPx = 10;
  const ScaleResult scale = UnknownView();
  const Scene scene = JointAbout(kTrustedHead + Vector2d(off_silhouette_px, 0), kSigmaPx);
  const PlacePx by_geometry{kTrustedHead + Vector2d(off_blades_px, 0),
                            kSigmaPx * kSigmaPx * Eigen::Matrix2d::Identity()};
  const EdgePair edges;
  return LiesAstray(HeadThere(evidence, slotted),
                    {cv::Mat(), scale, scene, edges, by_geometry, std::nullopt});
}

TEST(LiesAstray, FarFromWhereBladesAndSilhouettePutThePivot) {
  EXPECT_TRUE(LiesFarFromBoth(30, 30));
  EXPECT_FALSE(LiesFarFromBoth(30, 10)) << "an edge may be wrong";
  EXPECT_FALSE(LiesFarFromBoth(10, 30)) << "so may the silhouette";
  EXPECT_FALSE(LiesFarFromBoth(30, 30, kUnmistakable)) << "all of it shows";
  EXPECT_FALSE(LiesFarFromBoth(30, 30, 8, true)) << "the slot shows";
}

TEST(IsTooFlat, WhereTheViewIsKnownAndTheHeadIsNotUnmistakable) {
  const Scene scene = JointAbout(kTrustedHead, 10);
  const EdgePair edges;
  const auto is_too_flat = [&](const ScaleResult& scale, double evidence, double flatness) {
    Screw head = HeadThere(evidence, false);
    head.semi_minor_px = flatness * head.semi_major_px;
    return IsTooFlat(head, {cv::Mat(), scale, scene, edges, {}, std::nullopt});
  };
  ScaleResult over_sheet = UnknownView();
  over_sheet.sheet.emplace();
  EXPECT_TRUE(is_too_flat(over_sheet, kBeyondDoubt, 0.8));
  EXPECT_FALSE(is_too_flat(over_sheet, kBeyondDoubt, 0.9));
  EXPECT_FALSE(is_too_flat(over_sheet, 2 * kUnmistakable, 0.8));
  EXPECT_FALSE(is_too_flat(UnknownView(), kBeyondDoubt, 0.8)) << "a slant flattens it";
}

// Whether a head is trusted for which the blades alone put the pivot so many standard deviations
// off.
bool IsSure(bool (*is_sure)(const Screw&, const HeadSearch&), bool slotted, double sigmas_off) {
  constexpr double kSigmaPx = 10;
  const Screw screw = HeadThere(0.5 * (kFaintHead + kUnmistakable), slotted);
  const ScaleResult scale = UnknownView();
  Scene scene;
  scene.shank_width_px = 50;
  const PlacePx by_geometry{kTrustedHead + Vector2d(sigmas_off * kSigmaPx, 0),
                            kSigmaPx * kSigmaPx * Eigen::Matrix2d::Identity()};
  const EdgePair edges = UnlikeEdges();
  const HeadSearch known{cv::Mat(), scale, scene, edges, by_geometry, std::nullopt};
  return is_sure(screw, known);
}

// Whether blades of which one was taken for too far aside mirror each other about a head that is
// known to a few px only.
bool MirrorNearFaintHead(double aside_px, double evidence) {
  constexpr double kSigmaPx = 5;
  testing::Measured measured{testing::SceneWithMarkers()};
  measured.Misplace(&measured.blades.upper, aside_px);
  Screw screw{};
  screw.center_px = measured.truth.screw_px;
  screw.covariance_px2 = kSigmaPx * kSigmaPx * Eigen::Matrix2d::Identity();
  screw.semi_major_px = screw.semi_minor_px = 10;
  screw.evidence = evidence;
  const EdgePair edges = PairOf(measured.blades.upper, measured.blades.lower);
  return MirrorNear(
      screw, {measured.photo.grey(), measured.scale, measured.scene, edges, {}, std::nullopt});
}

TEST(MirrorNear, ThatAHeadMayLieAsideThatHardlyShowsExcusesNoEdgesThatAreUnlike) {
  EXPECT_TRUE(MirrorNearFaintHead(0, kFaintestHead));
  EXPECT_TRUE(MirrorNearFaintHead(3, kFaintestHead)) << "suspect, no more";
  EXPECT_FALSE(MirrorNearFaintHead(6, kFaintestHead));
  EXPECT_TRUE(MirrorNearFaintHead(6, kFaintHead)) << "more of it shows";
}

TEST(IsSureOfUnusualSize, TakesItWhereTheBladesPutThePivot) {
  EXPECT_TRUE(IsSure(IsSureOfUnusualSize, false, 0.5));
  EXPECT_FALSE(IsSure(IsSureOfUnusualSize, false, 2)) << "a joint's own outline is round, too";
}

TEST(IsSureOfUnusualSize, ASlotSpeaksForOneThatLiesFurtherOff) {
  EXPECT_TRUE(IsSure(IsSureOfUnusualSize, true, 2));
  EXPECT_FALSE(IsSure(IsSureOfUnusualSize, true, 7));
}

// About it the edges are no mirror images: one of them may be wrong, as on blades too bright to
// see.
TEST(IsSureHalfLit, ASlotSpeaksForOneNearWhereTheBladesPutThePivot) {
  EXPECT_TRUE(IsSure(IsSureHalfLit, true, 1.5));
  EXPECT_FALSE(IsSure(IsSureHalfLit, true, 2.5));
  EXPECT_FALSE(IsSure(IsSureHalfLit, false, 1.5)) << "glints are arcs, too";
}

}  // namespace
}  // namespace bladecurve
