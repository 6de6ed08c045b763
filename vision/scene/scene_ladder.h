// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vision/scene/scene.h"
#include "vision/scene/scene_candidate.h"
#include "vision/scene/scene_rungs.h"
#include "vision/scene/scene_view.h"

namespace bladecurve {

// Below this a pair of blades is a chance arrangement: clutter reaches 0.2, scissors seen whole 0.7
// and more.
inline constexpr double kAcceptedQuality = 0.45;

struct LadderResult {
  Candidate best;               // quality 0 if nothing was found
  bool several = false;         // two good pairs in different places
  bool closed = false;          // something looks like closed scissors, in several masks of a rung
  std::vector<Candidate> seen;  // by all rungs, the best among them
  bool climbed = false;         // to the top
};

// Median over the masks that show the same blades well enough, rad: a single one may lose the turn
// where a ring merges with a shadow or a shank is not seen to its end.
[[nodiscard]] double TurnAtJoint(const LadderResult& result);

// The ways in which scissors are looked for in a photograph, the cheap ones first. Outlives none of
// its arguments.
class SceneLadder {
 public:
  // Throws Refused{kTooSmall}.
  SceneLadder(const Photo& photo,
              const std::vector<SeenMarker>& markers,
              const StoredHints& hints,
              StageLog* log);

  // Tries one rung after the other until one gives a consistent pair of blades, or all of them;
  // logs what ran and why. What was looked at before is not looked at again.
  [[nodiscard]] LadderResult Climb(Plan plan);

 private:
  // What the rungs showed in one view, as far as they have been looked at.
  struct Looked {
    SceneView view;
    std::map<std::string, std::vector<Rung>> stages;
    std::optional<ColourPictures> colour;
    std::optional<Outlines> outlines;
  };

  // What is seen in a stage, which is looked at now unless it was before.
  template <typename Look>
  const std::vector<Rung>& See(const std::string& stage,
                               const std::string& why,
                               Looked* looked,
                               const Look& look);
  // With all that was seen.
  [[nodiscard]] LadderResult ClimbNoting(Plan plan, Looked* looked);
  // Fills in what all rungs saw.
  [[nodiscard]] LadderResult ClimbIn(Plan plan, Looked* looked, Rung* all);

  StageLog* log_;
  Looked as_is_, smooth_;
};

// Of all that was seen what other methods than the best one's show best; and what other masks of
// that method do.
[[nodiscard]] LadderResult ByOtherMethods(const LadderResult& result, const std::string& method);
[[nodiscard]] LadderResult ByOtherMasks(const LadderResult& result);

}  // namespace bladecurve
