// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/pivot/screw.h"
#include "vision/pivot/screw_candidates.h"
#include "vision/pivot/screw_evidence.h"
#include "vision/pivot/screw_field.h"
#include "vision/pivot/screw_steepest.h"

namespace bladecurve {

// All that may be the rim of a head in one octave of sizes, from min_radius_px up. In pixels of the
// picture.
class Octave {
 public:
  Octave(const cv::Mat& grey, const ScrewSearch& search, double min_radius_px);

  // Where rims may be, best first.
  [[nodiscard]] std::vector<RimCandidate> Candidates() const;

  // The rim near a start, and what speaks for it. std::nullopt if there is none that the search
  // admits.
  [[nodiscard]] std::optional<FoundRim> Judge(const RimEllipse& start_px) const;

  // The fit may have stopped at a rim that shares only an arc with the head's: starts on all sides
  // of it decide.
  [[nodiscard]] FoundRim Polish(const FoundRim& found) const;

 private:
  // In pixels of the fine window, these two and what Rate takes.
  [[nodiscard]] std::optional<RimFit> FitNear(const RimEllipse& start) const;
  [[nodiscard]] SteepestCircle SteepestNear(const RimEllipse& rim) const;

  // What speaks for a rim; so does the steepest circle hereabouts if it is the rim.
  [[nodiscard]] std::optional<FoundRim> Rate(const RimFit& fit,
                                             const SteepestCircle& hereabouts) const;

  ScrewSearch search_;
  ScaledWindow coarse_, fine_;
  RimField field_;
  cv::Mat smooth_;  // fine_
};

}  // namespace bladecurve
