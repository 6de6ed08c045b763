// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vision/scene/scene.h"
#include "vision/scene/scene_choice.h"
#include "vision/scene/scene_rungs.h"
#include "vision/scene/scene_view.h"

namespace bladecurve {

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

  // What masks show in which handles may lie on something, these cut off; nothing, quality 0,
  // unless several agree.
  [[nodiscard]] LadderResult WithoutHandles(const std::vector<Candidate>& unresolved);

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
  // From what all other rungs gave to what the user points at.
  [[nodiscard]] LadderResult ClimbToCut(Plan plan, LadderResult result, Looked* looked, Rung* all);

  StageLog* log_;
  Looked as_is_, smooth_;
};

}  // namespace bladecurve
