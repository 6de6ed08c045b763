// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "vision/scene/blades.h"
#include "vision/scene/scene_view.h"

namespace bladecurve {

// Below this a pair of blades is a chance arrangement: clutter reaches 0.2, scissors seen whole 0.7
// and more.
inline constexpr double kAcceptedQuality = 0.45;

// A pair of blades that some rung of the ladder found.
struct Candidate {
  BladePair pair;
  std::shared_ptr<const ScaledImage> at;
  cv::Mat mask;
  // "grey", "caster", "colour", "shadow-blind", "flood", "regions", "broad", "cut"
  std::string method;
  double threshold = 0;
  bool outlined = false;   // the mask ends at sharp borders, of which a soft shadow has none
  bool patterned = false;  // the ground is taken to be, so that anything may lie between the blades
  double strength =
      0;  // mean transition across the inner edges: the right threshold has the strongest
  double sharpness = 0;  // of the softer inner edge: 1 for a step, 0.3 for a soft shadow
  int agreeing = 0;      // thresholds of the same rung that found the same blades
};

// Length of the longer blade, px of the small picture.
[[nodiscard]] double SizeOf(const BladePair& pair);

[[nodiscard]] bool SameBlades(const Candidate& a, const Candidate& b);

// What one rung of the ladder saw.
struct Rung {
  std::string method;  // as of its candidates
  std::vector<Candidate> candidates;
  // What else things show if their handles touch. A blade beside its shadow looks so, too.
  std::vector<Candidate> touching;
  std::vector<Candidate> unresolved;  // masks in which no pair is likely, without pairs
  int closed = 0;                     // masks in which something looks like closed scissors
  double contradicting = 0;           // quality of the likeliest pair that hints speak against
  int rings = 0;                      // finger rings, in the mask that shows most of them
  cv::Mat distance;  // from the background, or how sharply it is walled in; CV_32FC1
};

// What one mask shows and does not contradict the hints; `like` gives picture, method and
// threshold. `hidden` as for FindBladePairs.
[[nodiscard]] Rung SeenIn(const cv::Mat& mask,
                          const Candidate& like,
                          const cv::Mat& hidden,
                          const StoredHints& hints);

// What an unresolved mask shows if handles are left out (covered_handles.h). What is left tells
// little: doubtful.
[[nodiscard]] Rung SeenWithoutHandles(const Candidate& unresolved,
                                      const cv::Mat& hidden,
                                      const StoredHints& hints);

// Adds what another mask of the same rung shows, and counts anew which candidates agree.
void Add(Rung seen, Rung* rung);

}  // namespace bladecurve
