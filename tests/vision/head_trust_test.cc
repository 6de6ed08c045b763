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

// A head of unusual size, where the blades alone put the pivot so many standard deviations off.
bool IsSure(bool slotted, double sigmas_off) {
  constexpr double kSigmaPx = 10;
  Screw screw{};
  screw.center_px = kTrustedHead;
  screw.covariance_px2 = 0.01 * Eigen::Matrix2d::Identity();
  screw.semi_major_px = screw.semi_minor_px = 30;
  screw.evidence = 0.5 * (kFaintHead + kUnmistakable);
  screw.third_support = 0.5;
  if (slotted) {
    screw.slot.emplace();
    screw.slot->center_px = kTrustedHead;
    screw.slot->covariance_px2 = screw.covariance_px2;
    screw.slot->ends_seen = true;
  }
  ScaleResult scale;
  scale.map = PlaneMap::Uniform(0.1, 0, "mm-per-px");
  Scene scene;
  scene.shank_width_px = 50;
  const PlacePx by_geometry{kTrustedHead + Vector2d(sigmas_off * kSigmaPx, 0),
                            kSigmaPx * kSigmaPx * Eigen::Matrix2d::Identity()};
  const EdgePair edges = UnlikeEdges();
  const HeadSearch known{cv::Mat(), scale, scene, edges, by_geometry, std::nullopt};
  return IsSureOfUnusualSize(screw, known);
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
  EXPECT_TRUE(IsSure(false, 0.5));
  EXPECT_FALSE(IsSure(false, 2)) << "a joint's own outline is round, too";
}

TEST(IsSureOfUnusualSize, ASlotSpeaksForOneThatLiesFurtherOff) {
  EXPECT_TRUE(IsSure(true, 2));
  EXPECT_FALSE(IsSure(true, 7));
}

}  // namespace
}  // namespace bladecurve
