// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vision/scene/scene_candidate.h"

namespace bladecurve {

struct LadderResult {
  Candidate best;               // quality 0 if nothing was found
  bool several = false;         // two good pairs in different places
  int rings = 0;                // finger rings that are seen
  bool closed = false;          // something looks like closed scissors, in several masks of a rung
  std::vector<Candidate> seen;  // by all rungs, the best among them
  std::vector<Candidate> unresolved;  // masks in which handles may lie on something
  bool climbed = false;               // to the top
};

// The best of the candidates, and whether they show a second pair.
[[nodiscard]] LadderResult Choose(const std::vector<Candidate>& candidates);

// Several thresholds must agree; fewer where the outline is as sharp as the lens allows.
[[nodiscard]] bool Consistent(const LadderResult& result);

// Whether blades were found that could be measured.
[[nodiscard]] bool ShowsWholeBlades(const LadderResult& result);

// Whether another pair is seen whose blades run out of the picture: it is not meant.
[[nodiscard]] bool ShowsOneCutOff(const LadderResult& result);

// Whether the mask shows another thing that is no sheet, label or ruler, which fill their outlines:
// another instrument, perhaps not all of it.
[[nodiscard]] bool ShowsAnother(const Candidate& best);

// Median over the masks that show the same blades well enough, rad: a single one may lose the turn
// where a ring merges with a shadow or a shank is not seen to its end.
[[nodiscard]] double TurnAtJoint(const LadderResult& result);

// Of all that was seen what other methods than the best one's show best; and what other masks of
// that method do.
[[nodiscard]] LadderResult ByOtherMethods(const LadderResult& result, const std::string& method);
[[nodiscard]] LadderResult ByOtherMasks(const LadderResult& result);

}  // namespace bladecurve
