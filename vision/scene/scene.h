// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vision/hints.h"
#include "vision/photo/photo.h"
#include "vision/scale/scale.h"
#include "vision/stage_log.h"

namespace bladecurve {

// A blade where scene finding sees it; stored full-resolution pixels, a few off.
struct SceneBlade {
  std::vector<Eigen::Vector2d> inner_px;  // from near the crotch to the tip: the cutting edge
  std::vector<Eigen::Vector2d> outer_px;  // from beside the pivot to the tip, as the mask shows it
  // The side of the blade's own shank that faces as the cutting edge does, from the joint on; may
  // be empty.
  std::vector<Eigen::Vector2d> shank_px;
  Eigen::Vector2d tip_px{0, 0};
  double width_px = 0;  // half way along
};

// The scissors in the picture.
struct Scene {
  SceneBlade left, right;  // seen from the pivot towards the tips, in the stored picture
  Eigen::Vector2d crotch_px{0, 0};
  Eigen::Vector2d shank_crotch_px{0, 0};  // the concavity behind the pivot, between the shanks
  Eigen::Vector2d pivot_px{0, 0};         // where the members cross
  double pivot_sigma_px = 0;
  double shank_width_px = 0;  // of the members where they cross, across each
  double path_sigma_px = 0;   // how far off the paths may be
  double quality = 0;         // 0 to 1
  bool outlined = false;     // by sharp lines alone, which may be those of a bevel or a hard shadow
  bool second_look = false;  // what a likelier mask showed was refused
  std::vector<std::string> warnings;

  // Whether another silhouette may be as likely.
  [[nodiscard]] bool IsDoubtful() const { return quality < 0.75 || outlined || second_look; }
};

class SceneLadder;
struct LadderResult;

// Finds the scissors: in the likeliest mask or, where what that one shows proves to be no blades,
// in others.
class SceneFinder {
 public:
  static constexpr int kLooks = 3;  // a fourth finds hardly more scissors, but other things

  // Climbs the ladder of methods, the cheap ones first, until the geometry is consistent. Throws
  // Refused{kNotScissors, kClosed, kBladesNotVisible, kSeveralScissors, kTooSmall}. The photograph
  // and the log are to outlive it.
  SceneFinder(const Photo& photo,
              const std::vector<SeenMarker>& markers,
              const StoredHints& hints,
              StageLog* log);
  ~SceneFinder();

  // Throws Refused{kNotScissors, kSeveralScissors, kOutOfPlane}.
  [[nodiscard]] Scene Likeliest() const;

  // Looks past what showed the likeliest scene: first at all that the other methods show, then at
  // the other masks of its own, or, if these show no blades, at what handles may hide that lie on
  // something. Throws like the constructor where that shows none.
  void LookAgain();

 private:
  std::vector<SeenMarker> markers_;
  StoredHints hints_;
  StageLog* log_;
  std::unique_ptr<SceneLadder> ladder_;
  std::unique_ptr<const LadderResult> first_, later_;  // what the looks showed; later_ may be empty
  int looks_ = 1;

  [[nodiscard]] const LadderResult& Shown() const { return later_ ? *later_ : *first_; }
};

}  // namespace bladecurve
