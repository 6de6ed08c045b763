// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "vision/image/tone_curve.h"

namespace bladecurve {

// What the slot of a screw says of its head's centre: it runs through it, and is cut from rim to
// rim. Independent of the rim, where a chamfer that is bright on one side and dark on the other, or
// a recess, may lead a fit astray.
struct ScrewSlot {
  Eigen::Vector2d center_px{0, 0};
  Eigen::Matrix2d covariance_px2;  // much larger along the slot than across it
  bool ends_seen = false;          // both, at the rim
  bool bright = false;             // mirrors the light, as borders of nuts and streaks may
  bool alone = false;  // no rim shows about it, nor do the edges quite mirror each other
};

// How far off the centre slots are cut, standard, of the head's radius: across, and along, where
// light at the two ends differs as well.
inline constexpr double kSlotOffCentre = 0.025, kEndsOffCentre = 0.05;

// The head of the screw or rivet about which the blades turn, as an ellipse.
struct Screw {
  Eigen::Vector2d center_px{0, 0};
  Eigen::Matrix2d covariance_px2;  // of the centre of what is seen of the rim
  double semi_major_px = 0, semi_minor_px = 0;
  double angle_rad = 0;      // of the major axis, from +x towards +y (down)
  double support = 0;        // share of the rim that is seen, 0 to 1
  double third_support = 0;  // the same of that third of the rim where it is least
  // ln of the odds of a head by the rim alone; at least ScrewSearch::least_evidence, or less by
  // what a slot adds.
  double evidence = 0;
  std::optional<ScrewSlot> slot;  // if the head has one
};

// Evidence of a head that nothing else looks like; of one that need not be looked for any further;
// of one that shadows and facets of joints do not reach; and below which nothing is a head.
inline constexpr double kUnmistakable = 25, kBeyondDoubt = 15, kFaintHead = 10, kFaintestHead = 3.5;

// Whether it may be one of those: they show no slot, or what may be one and nothing else.
[[nodiscard]] inline bool IsFaint(const Screw& screw) {
  return screw.evidence < kFaintHead && (!screw.slot || screw.slot->alone);
}

// Whether so much of the rim looks otherwise than the rest that a reflection within the head may
// have been followed there.
[[nodiscard]] inline bool IsPartlySeen(const Screw& screw) {
  constexpr double kLeastThird = 0.45;
  return screw.third_support < kLeastThird && !screw.slot;
}

// Whether either makes it a head that is to be doubted.
[[nodiscard]] inline bool IsHardlySeen(const Screw& screw) {
  return IsFaint(screw) || IsPartlySeen(screw);
}

// Heads are judged at a radius from this to twice as much: larger ones show more grain than rim.
// Smaller ones as they are seen, or magnified.
inline constexpr double kJudgedRadiusPx = 14;

struct ScrewSearch {
  Eigen::Vector2d guess_px{0, 0};  // where geometry puts the pivot
  double radius_px = 0;         // how far from there the centre may lie; time grows as its square
  double min_semi_axis_px = 3;  // size of the head, from the width of the shank
  double max_semi_axis_px = 0;
  // d image / d plane of the head, of any scale, where it is known how obliquely that is seen: a
  // round head shows as an ellipse of known shape.
  std::optional<Eigen::Matrix2d> view;
  // Below, nothing is returned. Where no head is seen, shank edges, grain, cloth and lettering
  // reach it in one of twenty joints, so that below kFaintHead something else must speak for a
  // head. Blade tips are round, too; they must not be within the radius.
  double least_evidence = kFaintestHead;
  // Rims of which a third does not show at all count, too: light from one side leaves no more of
  // some. Tips and corners look like them.
  bool half_lit = false;
  // Heads of less than kJudgedRadiusPx are judged up to twice as large: more of a rim shows then
  // beside a slot that is as wide as the blur, and more that is none looks like one.
  bool magnified = false;
  // Rims are looked for twice as large as usual: the line of a flush head, a pixel or two wide, is
  // lost where large heads are looked at as small as others. Takes eight times as long.
  bool fine_rims = false;
};

// The screw's rim found and fitted to sub-pixel; std::nullopt where none is visible with
// confidence. Heads of less than 3.5 px are never accepted: specks look alike. Throws
// std::invalid_argument for a picture that is not CV_8UC1, or sizes or a radius that are not
// positive and finite.
[[nodiscard]] std::optional<Screw> FindScrew(const cv::Mat& grey,
                                             const ToneCurve& tone,
                                             const ScrewSearch& search);

}  // namespace bladecurve
