// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/confirmed_edge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "measured_blades.h"

namespace bladecurve {
namespace {

using testing::Measured;
using testing::SceneWithMarkers;

constexpr double kRivalPx = 25, kSureDoubt = 0.75;

// As if another line beside the edge might be its border.
void GiveRival(double rival_px, LocatedBlade* blade) {
  LocatedEdge& edge = blade->edge;
  edge.rival_px = rival_px;
  edge.rival_sigma_px = 0.5 * std::abs(rival_px);
  edge.common_sigma_px = std::hypot(0.1, edge.rival_sigma_px);
  edge.ambiguity = kSureDoubt;
}

class ConfirmMirroredEdgesTest : public ::testing::Test {
 protected:
  static Measured TakenWithMarkers() {
    static const Measured once(SceneWithMarkers());
    Measured measured = once;
    for (const bool upper : {true, false}) Measured::MakeClear(&measured.Blade(upper));
    return measured;
  }

  void Confirm() { ConfirmMirroredEdges(seen_.View(), seen_.pivot, &seen_.blades); }

  void ExpectStillDoubted(const LocatedBlade& blade) {
    const double before_px = blade.edge.common_sigma_px;
    Confirm();
    EXPECT_EQ(blade.edge.common_sigma_px, before_px);
    EXPECT_EQ(blade.edge.ambiguity, kSureDoubt);
  }

  Measured seen_ = TakenWithMarkers();
};

TEST_F(ConfirmMirroredEdgesTest, ConfirmsTheOneThatTheOtherOneMirrors) {
  for (const bool upper : {true, false}) {
    seen_ = TakenWithMarkers();
    LocatedBlade& blade = seen_.Blade(upper);
    GiveRival(kRivalPx, &blade);
    Confirm();
    EXPECT_NEAR(blade.edge.common_sigma_px, 0.1, 1e-9);
    EXPECT_LT(blade.edge.ambiguity, 0.5);
  }
}

TEST_F(ConfirmMirroredEdgesTest, DoubtsRivalsTooNearToTell) {
  GiveRival(2, &seen_.blades.upper);
  ExpectStillDoubted(seen_.blades.upper);
}

TEST_F(ConfirmMirroredEdgesTest, DoubtsBothWhereBothRivalsMirrorEachOther) {
  GiveRival(kRivalPx, &seen_.blades.upper);
  GiveRival(kRivalPx, &seen_.blades.lower);
  ExpectStillDoubted(seen_.blades.upper);
  EXPECT_EQ(seen_.blades.lower.edge.ambiguity, kSureDoubt);
}

TEST_F(ConfirmMirroredEdgesTest, DoubtsEdgesThatAreNoMirrorImages) {
  seen_.Misplace(&seen_.blades.upper, kRivalPx, Measured::kStrong);
  GiveRival(-kRivalPx, &seen_.blades.upper);
  ExpectStillDoubted(seen_.blades.upper);
}

TEST_F(ConfirmMirroredEdgesTest, DoubtsEdgesMovedToWhereTheyMirrorEachOther) {
  GiveRival(kRivalPx, &seen_.blades.upper);
  seen_.blades.upper.moved = "where the other one puts it";
  ExpectStillDoubted(seen_.blades.upper);
}

TEST_F(ConfirmMirroredEdgesTest, TrustsNoPivotThatTheEdgesThemselvesTell) {
  GiveRival(kRivalPx, &seen_.blades.upper);
  seen_.pivot.source = "geometry";
  ExpectStillDoubted(seen_.blades.upper);
}

TEST_F(ConfirmMirroredEdgesTest, TrustsNoViewOfUnknownTilt) {
  GiveRival(kRivalPx, &seen_.blades.upper);
  seen_.scale.sheet.reset();
  ExpectStillDoubted(seen_.blades.upper);
}

}  // namespace
}  // namespace bladecurve
