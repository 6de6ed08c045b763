// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/consistency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "vision/refused.h"
#include "vision/scissors/edge_doubt.h"

namespace bladecurve {
namespace {

constexpr double kLength = 300;  // px, pivot to tips

ScaleResult TiltKnown() {
  ScaleResult scale;
  scale.sheet.emplace();
  return scale;
}

Pivot PivotSeen(double asymmetry) {
  Pivot pivot;
  pivot.point_px.setZero();
  pivot.covariance_px2.setIdentity();
  pivot.source = "screw";
  pivot.asymmetry = asymmetry;
  pivot.overlap = 0.09;
  return pivot;
}

// The upper blade on the left.
Blades BladesWithRivals(double upper_px, double lower_px) {
  Blades blades;
  blades.upper.on_left = true;
  blades.lower.on_left = false;
  blades.upper.end.point_px = {kLength, -80};
  blades.lower.end.point_px = {kLength, 80};
  blades.upper.edge.rival_px = upper_px;
  blades.lower.edge.rival_px = lower_px;
  return blades;
}

Reason ReasonFor(const Pivot& pivot, const Blades& blades = BladesWithRivals(0, 0)) {
  try {
    RefuseInconsistent(pivot, blades);
  } catch (const Refused& refused) {
    return refused.reason();
  }
  return Reason::kFitFailed;  // stands for none
}

TEST(RefuseInconsistent, SaysWhatIsWrong) {
  EXPECT_EQ(ReasonFor(PivotSeen(0.05)), Reason::kFitFailed);
  EXPECT_EQ(ReasonFor(PivotSeen(0.25)), Reason::kOutOfPlane);
  EXPECT_EQ(ReasonFor(PivotSeen(-0.25)), Reason::kOutOfPlane);
  Pivot jaws = PivotSeen(0);
  jaws.overlap = 0.01;
  EXPECT_EQ(ReasonFor(jaws), Reason::kNotScissors);
  jaws.overlap = 0.02;
  EXPECT_EQ(ReasonFor(jaws), Reason::kNotScissors);
  jaws.overlap = 0.035;
  EXPECT_EQ(ReasonFor(jaws), Reason::kFitFailed) << "slender scissors";
  jaws.overlap = 0.01;
  jaws.overlap_sigma = 0.05;  // it may be scissors after all
  EXPECT_EQ(ReasonFor(jaws), Reason::kFitFailed);
  Pivot vague = PivotSeen(0);
  vague.covariance_px2 *= 0.2 * kLength * 0.2 * kLength;
  EXPECT_EQ(ReasonFor(vague), Reason::kFitFailed);
  vague.source = "geometry";
  EXPECT_EQ(ReasonFor(vague), Reason::kAmbiguousPivot);
}

TEST(RefuseInconsistent, AsksForNoPivotThatIsGiven) {
  for (const char* source : {"screw", "hint"}) {
    Pivot jaws = PivotSeen(0);
    jaws.overlap = 0.01;
    jaws.source = source;
    try {
      RefuseInconsistent(jaws, BladesWithRivals(0, 0));
      FAIL() << source;
    } catch (const Refused& refused) {
      const std::string what = refused.what();
      EXPECT_EQ(what.find("say where") != std::string::npos, jaws.source == "screw");
      EXPECT_NE(what.find("use another background"), std::string::npos) << "edges are not clear";
    }
  }
}

TEST(RefuseInconsistent, RefusesJawsForGoodWhereAllIsSeen) {
  const auto for_good = [](double evidence, double ambiguity) {
    Pivot jaws = PivotSeen(0);
    jaws.overlap = 0.01;
    jaws.screw.emplace().evidence = evidence;
    Blades blades = BladesWithRivals(0, 0);
    blades.lower.edge.ambiguity = ambiguity;
    try {
      RefuseInconsistent(jaws, blades);
    } catch (const RefusedForGood& refused) {
      return refused.reason() == Reason::kNotScissors;
    } catch (const Refused&) {
    }
    return false;
  };
  EXPECT_TRUE(for_good(2 * kUnmistakable, 0.1));
  EXPECT_FALSE(for_good(0.5 * kUnmistakable, 0.1)) << "it may be another screw";
  EXPECT_FALSE(for_good(2 * kUnmistakable, 0.8)) << "it may be another edge";
}

TEST(RefuseInconsistent, TakesNoWhiteBladeOnWhiteForAnAngledOneOrAJaw) {
  Blades white = BladesWithRivals(0, 0);
  white.lower.edge.overexposed = 0.9;
  EXPECT_EQ(ReasonFor(PivotSeen(0.25), white), Reason::kOutOfPlane) << "its edge is clear";
  white.lower.edge.ambiguity = 0.75;
  EXPECT_EQ(ReasonFor(PivotSeen(0.25), white), Reason::kLowContrast);
  EXPECT_EQ(ReasonFor(PivotSeen(0.05), white), Reason::kFitFailed);
  Pivot jaws = PivotSeen(0);
  jaws.overlap = 0.01;
  EXPECT_EQ(ReasonFor(jaws, white), Reason::kLowContrast);
}

TEST(PartedByPivotPx, IsTwiceWhatThePivotMayLieAsideOfTheLineBetweenTheBlades) {
  constexpr double kSigmaPx = 3;
  Pivot pivot = PivotSeen(0);
  const Blades blades = BladesWithRivals(0, 0);  // their line runs along x
  pivot.covariance_px2 = Eigen::Vector2d(kSigmaPx * kSigmaPx, 0).asDiagonal();
  EXPECT_NEAR(PartedByPivotPx(pivot, blades), 0, 1e-9);
  pivot.covariance_px2 = Eigen::Vector2d(0, kSigmaPx * kSigmaPx).asDiagonal();
  EXPECT_NEAR(PartedByPivotPx(pivot, blades), 2 * kSigmaPx, 1e-9);
}

template <typename Check>
bool Refuses(Reason reason, const Check& check) {
  try {
    check();
  } catch (const Refused& refused) {
    return refused.reason() == reason;
  }
  return false;
}

TEST(RefuseClosed, SpeaksUpWhereTheEndsLieOnEachOtherOrTheWrongWayRound) {
  const auto is_closed = [](double upper_y, double lower_y) {
    Blades blades = BladesWithRivals(0, 0);
    blades.upper.end.point_px.y() = upper_y;
    blades.lower.end.point_px.y() = lower_y;
    return Refuses(Reason::kClosed, [&] { RefuseClosed(PivotSeen(0), blades); });
  };
  constexpr double kHalf5DegreesPx = 0.0436 * kLength;
  EXPECT_FALSE(is_closed(-kHalf5DegreesPx, kHalf5DegreesPx));
  EXPECT_FALSE(is_closed(-kLength, kLength));
  EXPECT_TRUE(is_closed(0, 2));
  EXPECT_TRUE(is_closed(kHalf5DegreesPx, -kHalf5DegreesPx));
}

TEST(RefuseContestedHead, SpeaksUpWhereAFaintHeadLiesFarFromWhereTheBladesPutThePivot) {
  const ScaleResult tilt_unknown;
  Pivot pivot = PivotSeen(0);
  pivot.off_geometry = 4;
  EXPECT_NO_THROW(RefuseContestedHead(pivot, tilt_unknown)) << "a hint";
  Screw screw;
  screw.center_px.setZero();
  screw.covariance_px2.setIdentity();
  screw.evidence = 5;
  pivot.screw = screw;
  EXPECT_THROW(RefuseContestedHead(pivot, tilt_unknown), Refused);
  pivot.off_geometry = 2;
  EXPECT_NO_THROW(RefuseContestedHead(pivot, tilt_unknown));
  pivot.off_geometry = 4;
  pivot.screw->evidence = 9;
  EXPECT_NO_THROW(RefuseContestedHead(pivot, tilt_unknown)) << "clearly seen";
}

TEST(RefuseContestedHead, LeavesOneAboutWhichEdgesSeenFromAKnownSideMirrorEachOther) {
  const ScaleResult tilt_known = TiltKnown();
  Pivot pivot = PivotSeen(0.005);
  pivot.off_geometry = 4;
  pivot.screw.emplace().evidence = 5;
  EXPECT_NO_THROW(RefuseContestedHead(pivot, tilt_known));
  EXPECT_THROW(RefuseContestedHead(pivot, {}), Refused);
  pivot.asymmetry = 0.02;
  EXPECT_THROW(RefuseContestedHead(pivot, tilt_known), Refused);
  pivot.asymmetry = 0;
  pivot.bent = true;  // no mirror images
  EXPECT_THROW(RefuseContestedHead(pivot, tilt_known), Refused);
}

TEST(RefusePivotOffJoint, SpeaksUpWhereThePivotLiesBeyondACrotch) {
  Scene scene;
  scene.shank_crotch_px = {100, 100};
  scene.crotch_px = {160, 180};  // 100 px away
  const auto is_refused = [&](double share, double sigma_px, const char* source) {
    Pivot pivot = PivotSeen(0);
    pivot.source = source;
    pivot.point_px = scene.shank_crotch_px + share * (scene.crotch_px - scene.shank_crotch_px);
    pivot.covariance_px2 = sigma_px * sigma_px * Eigen::Matrix2d::Identity();
    return Refuses(Reason::kAmbiguousPivot, [&] { RefusePivotOffJoint(scene, pivot); });
  };
  for (const char* source : {"screw", "geometry"}) {
    EXPECT_FALSE(is_refused(0.2, 1, source)) << source;
    EXPECT_FALSE(is_refused(0.9, 1, source)) << source;
    EXPECT_TRUE(is_refused(-0.3, 1, source)) << source;
    EXPECT_TRUE(is_refused(1.3, 1, source)) << source;
    EXPECT_FALSE(is_refused(1.3, 15, source)) << source << ", but how far is uncertain";
  }
  EXPECT_FALSE(is_refused(1.3, 1, "hint"));
}

TEST(RefuseUnconfirmedScene, NeedsAPivotThatIsSeenAboutWhichTheEdgesMirrorEachOther) {
  Scene plain, doubtful, outlined;
  plain.quality = 0.9;
  doubtful.quality = 0.5;
  outlined.quality = 0.9;
  outlined.outlined = true;
  Pivot inferred = PivotSeen(0);
  inferred.source = "geometry";
  EXPECT_NO_THROW(RefuseUnconfirmedScene(plain, {}, inferred));
  Scene fair = plain;
  fair.quality = 0.78;
  const auto reason = [&](const Scene& scene) {
    try {
      RefuseUnconfirmedScene(scene, {}, inferred);
    } catch (const Refused& refused) {
      return refused.reason();
    }
    return Reason::kFitFailed;  // stands for none
  };
  EXPECT_EQ(reason(fair), Reason::kAmbiguousPivot);
  EXPECT_NO_THROW(RefuseUnconfirmedScene(fair, {}, PivotSeen(-0.1)));
  EXPECT_EQ(reason(doubtful), Reason::kLowContrast);
  EXPECT_THROW(RefuseUnconfirmedScene(doubtful, {}, PivotSeen(-0.1)), Refused);
  EXPECT_NO_THROW(RefuseUnconfirmedScene(doubtful, {}, PivotSeen(-0.05)));
  const ScaleResult tilt_known = TiltKnown();
  EXPECT_THROW(RefuseUnconfirmedScene(doubtful, tilt_known, PivotSeen(-0.05)), Refused);
  EXPECT_NO_THROW(RefuseUnconfirmedScene(doubtful, tilt_known, PivotSeen(-0.01)));
  EXPECT_THROW(RefuseUnconfirmedScene(outlined, {}, inferred), Refused);
  EXPECT_THROW(RefuseUnconfirmedScene(outlined, {}, PivotSeen(-0.1)), Refused);
  EXPECT_NO_THROW(RefuseUnconfirmedScene(outlined, {}, PivotSeen(0.05)));
}

TEST(RefuseUnconfirmedScene, AsksForNoHintThatIsGiven) {
  Scene doubtful;
  doubtful.quality = 0.5;
  for (const std::string source : {"screw", "hint"}) {
    Pivot pivot = PivotSeen(-0.1);
    pivot.source = source;
    try {
      RefuseUnconfirmedScene(doubtful, {}, pivot);
      ADD_FAILURE() << source;
    } catch (const Refused& refused) {
      const bool asks = std::string(refused.what()).find("--pivot X,Y") != std::string::npos;
      EXPECT_EQ(asks, source == "screw") << refused.what();
    }
  }
}

TEST(RefuseUnconfirmedScene, AsksMoreOfASecondLook) {
  Scene again;
  again.quality = 0.95;
  again.second_look = true;
  Pivot inferred = PivotSeen(0), plain = PivotSeen(0), faint = PivotSeen(0);
  inferred.source = "geometry";
  plain.screw.emplace().evidence = kFaintHead + 1;
  faint.screw.emplace().evidence = kFaintHead - 1;
  EXPECT_NO_THROW(RefuseUnconfirmedScene(again, {}, plain));
  EXPECT_THROW(RefuseUnconfirmedScene(again, {}, faint), Refused);
  EXPECT_THROW(RefuseUnconfirmedScene(again, {}, inferred), Refused);
  EXPECT_THROW(RefuseUnconfirmedScene(again, {}, PivotSeen(0.1)), Refused);
  plain.unlikeness = 0.02;
  EXPECT_THROW(RefuseUnconfirmedScene(again, {}, plain), Refused);
  again.second_look = false;
  EXPECT_NO_THROW(RefuseUnconfirmedScene(again, {}, faint));
}

TEST(RefuseUnconfirmedScene, AsksMoreOfBladesBentToOneSide) {
  Scene plain, doubtful;
  plain.quality = 0.95;
  doubtful.quality = 0.5;
  Pivot bent = PivotSeen(0);
  bent.bent = true;
  Screw& head = bent.screw.emplace();
  head.evidence = kUnmistakable;
  head.third_support = 1;
  Pivot partly = bent, faint = bent, given = bent;
  partly.screw->third_support = 0.1;
  faint.screw->evidence = kFaintHead - 1;
  given.screw.reset();
  given.source = "hint";
  EXPECT_NO_THROW(RefuseUnconfirmedScene(doubtful, {}, bent));
  EXPECT_THROW(RefuseUnconfirmedScene(doubtful, {}, partly), Refused);
  EXPECT_THROW(RefuseUnconfirmedScene(doubtful, {}, faint), Refused);
  EXPECT_NO_THROW(RefuseUnconfirmedScene(doubtful, {}, given));
  EXPECT_NO_THROW(RefuseUnconfirmedScene(plain, {}, faint));
}

TEST(DoubtLaterLook, TakesAHundredthOfTheBladesIntoAccount) {
  const Blades found = BladesWithRivals(0, 0);
  const Pivot pivot = PivotSeen(0);
  Scene scene;
  Blades first = found;
  DoubtLaterLook(scene, pivot, &first);
  EXPECT_EQ(first.upper.edge.common_sigma_px, found.upper.edge.common_sigma_px);
  scene.second_look = true;
  Blades again = found;
  DoubtLaterLook(scene, pivot, &again);
  const double length_px = (found.upper.end.point_px - pivot.point_px).norm();
  ASSERT_GT(length_px, 0);
  EXPECT_NEAR(again.upper.edge.common_sigma_px, 0.01 * length_px, 1e-3 * length_px);
  EXPECT_EQ(again.lower.edge.common_sigma_px, again.upper.edge.common_sigma_px);
  Pivot bent = pivot;
  bent.bent = true;  // no edge confirms the other
  Blades of_bent = found;
  DoubtLaterLook(scene, bent, &of_bent);
  EXPECT_NEAR(of_bent.upper.edge.common_sigma_px, 0.03 * length_px, 1e-3 * length_px);
}

TEST(RefuseUnlikeEdges, SpeaksUpWhereTheTiltIsKnownAndTheScrewSeen) {
  const ScaleResult tilt_known = TiltKnown(), tilt_unknown;
  const Blades blades = BladesWithRivals(0, 0);
  const Pivot unlike = PivotSeen(0.05);
  EXPECT_THROW(RefuseUnlikeEdges(unlike, tilt_known, blades), Refused);
  EXPECT_NO_THROW(RefuseUnlikeEdges(unlike, tilt_unknown, blades));
  EXPECT_NO_THROW(RefuseUnlikeEdges(PivotSeen(0.01), tilt_known, blades));
  Pivot given = unlike;
  given.source = "hint";
  EXPECT_NO_THROW(RefuseUnlikeEdges(given, tilt_known, blades));
  Pivot vague = unlike;
  vague.covariance_px2 *= 0.015 * kLength * 0.015 * kLength;
  EXPECT_NO_THROW(RefuseUnlikeEdges(vague, tilt_known, blades));
}

TEST(IsFalseHead, AFaintOneAboutWhichClearEdgesAreNoMirrorImages) {
  const ScaleResult tilt_known = TiltKnown(), tilt_unknown;
  const Blades clear = BladesWithRivals(0, 0);
  Pivot faint = PivotSeen(0.05);
  faint.screw.emplace();
  faint.screw->evidence = kFaintHead - 1;
  EXPECT_TRUE(IsFalseHead(faint, tilt_known, clear));
  EXPECT_FALSE(IsFalseHead(faint, tilt_unknown, clear));
  Blades vague = clear;
  vague.lower.edge.common_sigma_px = 5;  // then it may be the edge that is wrong
  EXPECT_FALSE(IsFalseHead(faint, tilt_known, vague));
  vague = clear;
  vague.upper.edge.ambiguity = 0.9;
  EXPECT_FALSE(IsFalseHead(faint, tilt_known, vague));
  Pivot alike = faint;
  alike.asymmetry = 0.02;
  EXPECT_FALSE(IsFalseHead(alike, tilt_known, clear));
  Pivot plain = faint;
  plain.screw->evidence = kFaintHead + 1;
  EXPECT_FALSE(IsFalseHead(plain, tilt_known, clear));
  EXPECT_THROW(RefuseUnlikeEdges(plain, tilt_known, clear), Refused);
  Pivot slotted = faint;
  slotted.screw->slot.emplace();
  EXPECT_FALSE(IsFalseHead(slotted, tilt_known, clear));
}

// The left edge passes the pivot by 9 px less than the right one: so it would if its border were
// the transition 9 px further out, or the right one's 9 px further in.
TEST(DoubtUnlikeEdges, DoubtsTheEdgeWhoseOtherTransitionWouldMakeThemAlike) {
  const Pivot pivot = PivotSeen(-0.03);
  Blades upper = BladesWithRivals(9, 9);
  DoubtUnlikeEdges(pivot, TiltKnown(), &upper);
  EXPECT_GT(upper.upper.edge.ambiguity, 0.5);
  EXPECT_GT(upper.upper.edge.common_sigma_px, 5);
  EXPECT_EQ(upper.lower.edge.ambiguity, 0);
  Blades lower = BladesWithRivals(-9, -9);
  DoubtUnlikeEdges(pivot, TiltKnown(), &lower);
  EXPECT_EQ(lower.upper.edge.ambiguity, 0);
  EXPECT_GT(lower.lower.edge.ambiguity, 0.5);
}

TEST(DoubtUnlikeEdges, LeavesEdgesThatAreAlikeOrThatNothingWouldMakeSo) {
  for (const auto& [asymmetry, rival_px] : {std::pair(0.005, -9.0), std::pair(-0.08, 9.0)}) {
    Blades blades = BladesWithRivals(rival_px, 0);
    DoubtUnlikeEdges(PivotSeen(asymmetry), TiltKnown(), &blades);
    EXPECT_EQ(blades.upper.edge.ambiguity, 0) << asymmetry;
  }
  Blades unseen = BladesWithRivals(9, 0);
  Pivot pivot = PivotSeen(-0.03);
  pivot.source = "geometry";  // then it lies where the edges are alike
  DoubtUnlikeEdges(pivot, TiltKnown(), &unseen);
  EXPECT_EQ(unseen.upper.edge.ambiguity, 0);
}

// Edges that are unlike by less are doubted where they may be, with markers if the pivot accounts
// for no half of it.
TEST(DoubtUnlikeEdges, DoubtsWhatIsLessUnlikeUnlessThePivotAccountsForIt) {
  constexpr double kSurePx = 0.5, kVaguePx = 1.5;
  const auto doubted = [](const ScaleResult& scale, double pivot_sigma_px, double rival_px) {
    Pivot pivot = PivotSeen(-0.015);  // 4.5 px
    pivot.covariance_px2 *= pivot_sigma_px * pivot_sigma_px;
    Blades blades = BladesWithRivals(rival_px, 0);
    DoubtUnlikeEdges(pivot, scale, &blades);
    EXPECT_EQ(blades.upper.edge.ambiguity > 0.5, blades.upper.edge.common_sigma_px > 2.5);
    return blades.upper.edge.ambiguity > 0.5;
  };
  EXPECT_TRUE(doubted({}, kVaguePx, 4.5));
  EXPECT_FALSE(doubted({}, kVaguePx, 1)) << "the rival would hardly make them more alike";
  EXPECT_TRUE(doubted(TiltKnown(), kSurePx, 4.5));
  EXPECT_FALSE(doubted(TiltKnown(), kVaguePx, 4.5));
}

TEST(DoubtUnlikeEdges, DoubtsBothByATenthOfHowUnlikeTheyPass) {
  constexpr double kAsymmetry = 0.05, kShare = 0.1, kKnownPx = 0.5;
  const double off_px = kShare * kAsymmetry * kLength;
  Blades blades = BladesWithRivals(0, 0);
  blades.upper.edge.common_sigma_px = kKnownPx;
  DoubtUnlikeEdges(PivotSeen(kAsymmetry), TiltKnown(), &blades);
  EXPECT_NEAR(blades.upper.edge.common_sigma_px, std::hypot(kKnownPx, off_px), 0.05 * off_px);
  EXPECT_NEAR(blades.lower.edge.common_sigma_px, off_px, 0.05 * off_px);
  Blades alike = BladesWithRivals(0, 0);
  DoubtUnlikeEdges(PivotSeen(0.01), TiltKnown(), &alike);
  EXPECT_EQ(alike.upper.edge.common_sigma_px, 0);
}

TEST(DoubtSofterEdge, DoubtsTheSofterByAsMuchAndAFifth) {
  constexpr double kSharpPx = 0.5, kSofterPx = 1, kKnownPx = 0.2, kPerSofter = 1.2;
  for (const bool upper : {true, false}) {
    Blades blades = BladesWithRivals(0, 0);
    LocatedEdge& soft = (upper ? blades.upper : blades.lower).edge;
    LocatedEdge& sharp = (upper ? blades.lower : blades.upper).edge;
    soft.common_sigma_px = sharp.common_sigma_px = kKnownPx;
    sharp.blur_px = kSharpPx;
    soft.blur_px = kSharpPx + kSofterPx;
    DoubtSofterEdge(&blades);
    EXPECT_NEAR(soft.common_sigma_px, std::hypot(kKnownPx, kPerSofter * kSofterPx), 1e-9);
    EXPECT_EQ(sharp.common_sigma_px, kKnownPx);
  }
}

TEST(DoubtSofterEdge, LeavesEdgesOfWhichOneDoesNotTellItsBlur) {
  Blades blades = BladesWithRivals(0, 0);
  blades.upper.edge.blur_px = std::numeric_limits<double>::quiet_NaN();
  blades.lower.edge.blur_px = 1;
  DoubtSofterEdge(&blades);
  EXPECT_EQ(blades.upper.edge.common_sigma_px, 0);
  EXPECT_EQ(blades.lower.edge.common_sigma_px, 0);
}

// A curve along x that goes over to another one so far beside it from a share of its length on, and
// is known to a tenth of a pixel.
LocatedBlade BladeThatChangesLines(double beside_px, double from_share) {
  constexpr int kPoints = 250;
  constexpr double kBow = 20, kOver = 0.1;  // px; share of the length over which it goes over
  LocatedBlade blade;
  for (int i = 0; i < kPoints; ++i) {
    const double share = static_cast<double>(i) / kPoints;
    const double over = std::clamp((share - from_share) / kOver, 0.0, 1.0);
    LocatedEdgePoint point;
    point.point_px = {i, kBow * share * share * share + beside_px * over};
    point.trend_px = point.point_px;
    point.normal = {0, 1};
    point.sigma_px = 0.1;
    blade.used.push_back(point);
  }
  blade.edge.points = blade.used;
  return blade;
}

// What becomes of blades of which one changes lines: the ambiguity of it, or 2 if it is refused.
double AmbiguityIfKinked(bool upper, double beside_px, double from_share) {
  Blades blades = BladesWithRivals(0, 0);
  blades.upper = blades.lower = BladeThatChangesLines(0, 0);
  LocatedBlade& kinked = upper ? blades.upper : blades.lower;
  kinked = BladeThatChangesLines(beside_px, from_share);
  try {
    DoubtKinkedEdges(&blades);
  } catch (const Refused& refused) {
    EXPECT_EQ(refused.reason(), Reason::kLowContrast);
    return 2;
  }
  EXPECT_EQ((upper ? blades.lower : blades.upper).edge.ambiguity, 0);
  return kinked.edge.ambiguity;
}

TEST(DoubtKinkedEdges, DoubtsEdgesThatChangeLinesPartOfTheWay) {
  for (const bool upper : {true, false}) {
    EXPECT_EQ(AmbiguityIfKinked(upper, 0, 0.5), 0) << "a bow is none";
    EXPECT_EQ(AmbiguityIfKinked(upper, 0.3, 0.5), 0);
    EXPECT_GT(AmbiguityIfKinked(upper, 4, 0.75), 0.5);
    EXPECT_LE(AmbiguityIfKinked(upper, 4, 0.75), 1);
  }
  EXPECT_EQ(AmbiguityIfKinked(true, -30, 0.75), 2);
  EXPECT_LE(AmbiguityIfKinked(false, -30, 0.75), 1) << "the upper edge is measured without it";
}

TEST(DoubtKinkedEdges, TrustsVagueEdgesToBeAsVagueAsTheySay) {
  Blades blades = BladesWithRivals(0, 0);
  blades.upper = BladeThatChangesLines(0, 0);
  blades.lower = BladeThatChangesLines(4, 0.75);
  blades.lower.edge.common_sigma_px = 5;
  DoubtKinkedEdges(&blades);
  EXPECT_EQ(blades.lower.edge.ambiguity, 0);
}

TEST(DoubtUnlikePrint, DoubtsWhatNoLensShows) {
  ScaleResult scale;
  scale.markers.resize(3);
  for (SeenMarker& marker : scale.markers) marker.blur_px = 1.0;
  Blades blades = BladesWithRivals(0, 0);
  blades.upper.edge.blur_px = 0.5;
  blades.lower.edge.blur_px = 0.9;
  Blades freely = blades;
  DoubtUnlikePrint(scale, &blades);
  EXPECT_GT(blades.upper.edge.ambiguity, 0.5);
  EXPECT_GE(blades.upper.edge.common_sigma_px, 1);
  EXPECT_EQ(blades.lower.edge.ambiguity, 0);
  DoubtUnlikePrint(ScaleResult{}, &freely);
  EXPECT_EQ(freely.upper.edge.ambiguity, 0) << "without print nobody knows";
}

TEST(DoubtUnlikePrint, TrustsEdgesTheLessTheLessTheyLookLikePrint) {
  ScaleResult scale;
  scale.markers.resize(1);
  scale.markers[0].blur_px = 1.0;
  const auto sigma_px = [&](double unbound_blur_px) {
    Blades blades = BladesWithRivals(0, 0);
    blades.upper.edge.common_sigma_px = 0.05;
    blades.upper.edge.blur_px = 1;
    blades.upper.edge.unbound_blur_px = unbound_blur_px;
    DoubtUnlikePrint(scale, &blades);
    return blades.upper.edge.common_sigma_px;
  };
  EXPECT_DOUBLE_EQ(sigma_px(1.0), 0.05);
  EXPECT_NEAR(sigma_px(1.2), 0.15, 0.05) << "shadows soften";
  EXPECT_NEAR(sigma_px(0.8), 0.3, 0.05) << "narrow shadows sharpen, and move edges more";
  EXPECT_DOUBLE_EQ(sigma_px(std::numeric_limits<double>::quiet_NaN()), 0.05) << "in colours";
}

}  // namespace
}  // namespace bladecurve
