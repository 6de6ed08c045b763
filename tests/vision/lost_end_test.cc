// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/lost_end.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "measured_blades.h"

namespace bladecurve {
namespace {

using testing::BareSheet;
using testing::FarFrom;
using testing::Measured;
using testing::SceneWithMarkers;

// As if from there on a line so far aside had been followed.
void LoseEnd(bool upper, Measured* measured) {
  constexpr double kSeen = 0.6, kAsidePx = 12;
  LocatedBlade& blade = measured->Blade(upper);
  std::vector<LocatedEdgePoint>& points = blade.edge.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].inlier &= static_cast<double>(i) < kSeen * static_cast<double>(points.size());
  measured->Shift(&blade, [](double share) { return share < kSeen ? 0 : -kAsidePx; });
}

double UsedLength(const LocatedBlade& blade) {
  return (blade.used.back().point_px - blade.used.front().point_px).norm();
}

TEST(FindLostEnds, FollowsAnEdgeOnAsTheOtherOneGoes) {
  constexpr double kClosePx = 0.2, kSame = 0.01;
  for (const bool upper : {true, false}) {
    Measured measured{SceneWithMarkers()};
    const double length_px = UsedLength(measured.Blade(upper));
    LoseEnd(upper, &measured);
    ASSERT_LT(UsedLength(measured.Blade(upper)), 0.7 * length_px);
    FindLostEnds(measured.View(), &measured.blades);
    EXPECT_NEAR(UsedLength(measured.Blade(upper)), length_px, kSame * length_px) << upper;
    EXPECT_LT(FarFrom(measured.TrueEdge(upper), measured.Blade(upper).used), kClosePx) << upper;
  }
}

TEST(FindLostEnds, KeepsTheDoubtThatARivalMakes) {
  constexpr double kAmbiguity = 0.4, kRivalPx = 7;
  Measured measured{SceneWithMarkers()};
  measured.blades.upper.edge.ambiguity = kAmbiguity;
  measured.blades.upper.edge.rival_px = kRivalPx;
  LoseEnd(true, &measured);
  const std::size_t before = measured.blades.upper.used.size();
  FindLostEnds(measured.View(), &measured.blades);
  EXPECT_GT(measured.blades.upper.used.size(), before);
  EXPECT_DOUBLE_EQ(measured.blades.upper.edge.ambiguity, kAmbiguity);
  EXPECT_DOUBLE_EQ(measured.blades.upper.edge.rival_px, kRivalPx);
}

// As of a curved blade, which does not go on quite as the other one does.
TEST(FindLostEnds, TakesTheTipThatIsSeenWhereTheEdgeIsMuchVaguer) {
  constexpr double kClosePx = 2, kFarSurer = 0.05;
  for (const bool arc_seen : {false, true}) {
    Measured measured{SceneWithMarkers()};
    LocatedBlade& blade = measured.blades.upper;
    LoseEnd(true, &measured);
    for (LocatedEdgePoint& p : blade.edge.points) p.sigma_px *= kFarSurer;
    blade.edge.common_sigma_px = 0;
    blade.end.point_px = blade.used.back().point_px;
    blade.end.arc_seen = arc_seen;
    const std::vector<Eigen::Vector2d> before = TrendOf(blade.edge);
    FindLostEnds(measured.View(), &measured.blades);
    EXPECT_EQ(TrendOf(blade.edge), before);
    const double off_px = (blade.end.point_px - measured.truth.upper.px.back()).norm();
    EXPECT_EQ(off_px < kClosePx, !arc_seen) << off_px;
  }
}

TEST(FindLostEnds, LeavesWhatTheOtherOneCannotTell) {
  const auto unchanged = [](const char* why, const auto& spoil) {
    Measured measured{SceneWithMarkers()};
    LoseEnd(true, &measured);
    spoil(&measured);
    const std::size_t before = measured.blades.upper.used.size();
    FindLostEnds(measured.View(), &measured.blades);
    EXPECT_EQ(measured.blades.upper.used.size(), before) << why;
  };
  unchanged("lost as well", [](Measured* measured) { LoseEnd(false, measured); });
  unchanged("in doubt", [](Measured* measured) { measured->blades.lower.edge.ambiguity = 1; });
  unchanged("nothing seen where it should go on",
            [](Measured* measured) { measured->photo = Measured::PhotoOf(BareSheet()); });
}

// Where a part of an edge is known from the other one alone, and the tip is not seen.
TEST(TrimToFree, DoubtsTheEndByAFifthOfWhatIsLost) {
  constexpr double kShare = 0.2, kAbout = 0.05;
  Measured measured{SceneWithMarkers()};
  LocatedBlade& blade = measured.blades.upper;
  measured.photo = Measured::PhotoOf(BareSheet());
  TrimToFree(measured.View(), &blade);
  const double seen_sigma_px = blade.end.along_sigma_px;
  const std::vector<Eigen::Vector2d> whole = TrendOf(blade.edge);
  LoseEnd(true, &measured);
  const std::size_t seen = static_cast<std::size_t>(std::count_if(
      blade.edge.points.begin(), blade.edge.points.end(), [](const auto& p) { return p.inlier; }));
  TrimToFree(
      measured.View(), &blade, {whole.begin() + static_cast<std::ptrdiff_t>(seen), whole.end()});
  const double lost_px = (whole.back() - whole[seen]).norm();
  EXPECT_NEAR(blade.end.along_sigma_px / std::hypot(seen_sigma_px, kShare * lost_px), 1, kAbout);
}

}  // namespace
}  // namespace bladecurve
