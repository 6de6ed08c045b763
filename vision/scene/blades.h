// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "vision/scene/limbs.h"
#include "vision/scene/silhouette.h"

namespace bladecurve {

// Two blades with the gap between them, as the silhouette's concavities show them.
struct BladePair {
  BladeContour first,
      second;  // clockwise from the crotch as the mask is seen: `first` comes before it
  Eigen::Vector2d crotch{0, 0};
  std::optional<Eigen::Vector2d> shank_crotch;  // the concavity opposite, between the shanks
  Eigen::Vector2d shank_first, shank_second;    // the shanks' ends
  bool shanks_run_out = false;                  // both, of the picture
  Eigen::Vector2d pivot{0, 0};                  // centre of the overlap: where the members cross
  double pivot_sigma = 0;
  double shank_width = 0;  // of the members near the pivot
  double quality = 0;      // 0 to 1: how much this looks like a pair of blades
  double worst_grade = 1;  // of the parts that make up the quality
  std::string doubt;       // what lowered the quality most
};

// Where Mayo, Metzenbaum and iris scissors have their screw, of the way from the shanks' crotch to
// the blades'.
inline constexpr double kUsualPivot = 0.45;

// Falls from 1 at `good` to 0 at `bad`.
[[nodiscard]] double Grade(double value, double good, double bad);

// Lowers a pair's quality to so much of it, and says why if nothing lowered it more.
void ApplyGrade(double grade, const char* doubt, BladePair* pair);

// The two concavities on the axis of the scissors, as indices into the contour.
struct Crotches {
  int blades = 0, shanks = 0;
};

// The pair with its crotches there; std::nullopt where there is nothing like it. `hidden` (CV_8UC1,
// may be empty) is non-zero where something covers what goes on: a shank that ends there is cut
// off, not short.
[[nodiscard]] std::optional<BladePair> FindBladePairAt(const Silhouette& silhouette,
                                                       const cv::Mat& hidden,
                                                       const Crotches& at);

// All gaps of the silhouette that might lie between two blades, the likeliest first; empty if none
// does. `hidden` as above.
[[nodiscard]] std::vector<BladePair> FindBladePairs(const Silhouette& silhouette,
                                                    const cv::Mat& hidden);

// Of a pair against others of the same silhouette or photograph: its quality, less where a blade
// runs out of the picture. Shanks without their rings look like such blades; whole blades at the
// other end of them are the likelier reading.
[[nodiscard]] double Likelihood(const BladePair& pair);

// Whether a blade runs out of the picture.
[[nodiscard]] bool RunsOut(const BladePair& pair);

// Between the bisector of the blades and that of the shanks, rad. 0.15 at most if they lie in line,
// for handles of unlike size and shanks that the frame cuts; 0.4 to 0.7 where the blades are set at
// an angle, as those of Lister's scissors. 0 where a shank is seen for less than a blade's length.
[[nodiscard]] double TurnAtJoint(const BladePair& pair);

}  // namespace bladecurve
