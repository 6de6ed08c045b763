// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_search.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "vision/parallel.h"
#include "vision/pivot/screw_candidates.h"
#include "vision/pivot/screw_octave.h"

namespace bladecurve {
namespace {

// As FindRims returns them.
void PutBestFirst(std::vector<FoundRim>& rims) {
  if (rims.empty()) return;
  const FoundRim most =
      *std::max_element(rims.begin(), rims.end(), [](const FoundRim& a, const FoundRim& b) {
        return a.evidence < b.evidence;
      });
  const auto others = std::stable_partition(rims.begin(), rims.end(), [&](const FoundRim& found) {
    return OfOneHead(most.fit.rim, found.fit.rim);
  });
  const auto is_preferred = [](const FoundRim& a, const FoundRim& b) {
    return a.preference > b.preference;
  };
  std::stable_sort(rims.begin(), others, is_preferred);
  std::stable_sort(others, rims.end(), is_preferred);
  rims.front().evidence = most.evidence;
}

// Smallest radius of each octave. They overlap, as a rim near the end of one is seen better in the
// next.
std::vector<double> OctaveRadii(const ScrewSearch& search) {
  constexpr double kApart = 1.8, kLeastLarger = 1.15;
  std::vector<double> radii{std::max(search.min_semi_axis_px, kLeastSemiAxisPx)};
  while (kLeastLarger * kApart * radii.back() < search.max_semi_axis_px)
    radii.push_back(kApart * radii.back());
  return radii;
}

using Octaves = std::vector<std::unique_ptr<const Octave>>;

// A place in one of the octaves that may be a rim.
struct Suspect {
  std::size_t octave;
  RimCandidate candidate;
};

// Those of the best score first.
std::vector<Suspect> SuspectsIn(const Octaves& octaves) {
  const auto candidates = ParallelMap(static_cast<int>(octaves.size()), [&](int i) {
    return octaves[static_cast<std::size_t>(i)]->Candidates();
  });
  std::vector<Suspect> suspects;
  for (std::size_t i = 0; i < octaves.size(); ++i) {
    for (const RimCandidate& candidate : candidates[i]) suspects.push_back({i, candidate});
  }
  std::stable_sort(suspects.begin(), suspects.end(), [](const Suspect& a, const Suspect& b) {
    return a.candidate.score > b.candidate.score;
  });
  return suspects;
}

// What is found near the candidates, octave by octave. What scores far less than a head beyond
// doubt is no other rim of it.
std::vector<std::vector<FoundRim>> JudgeAll(const Octaves& octaves) {
  constexpr double kRivalScore = 0.7;  // of the head's
  constexpr std::size_t kAtOnce = 4;   // whatever the number of cores, so that results are the same
  const std::vector<Suspect> suspects = SuspectsIn(octaves);
  std::vector<std::vector<FoundRim>> found(octaves.size());
  double least_score = 0;
  for (std::size_t first = 0; first < suspects.size(); first += kAtOnce) {
    if (suspects[first].candidate.score < least_score) break;
    const std::size_t count = std::min(kAtOnce, suspects.size() - first);
    const auto rims = ParallelMap(static_cast<int>(count), [&](int i) {
      const Suspect& suspect = suspects[first + static_cast<std::size_t>(i)];
      return octaves[suspect.octave]->Judge(suspect.candidate.rim);
    });
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [octave, candidate] = suspects[first + i];
      if (!rims[i]) continue;
      found[octave].push_back(*rims[i]);
      if (rims[i]->evidence > kBeyondDoubt)
        least_score = std::max(least_score, kRivalScore * candidate.score);
    }
  }
  return found;
}

// Whether polishing may make a rim better than the best ones of all octaves: than others by its
// evidence, than others of the same head by its preference.
bool MayGain(const FoundRim& rim, const std::vector<FoundRim>& best) {
  constexpr double kPromising = -2;  // evidence from which on a second look may find a head
  constexpr double kMostGain = 15;   // of evidence or preference
  return rim.evidence > kPromising &&
         std::none_of(best.begin(), best.end(), [&](const FoundRim& other) {
           return rim.evidence < other.evidence - kMostGain ||
                  (rim.preference < other.preference - kMostGain &&
                   OfOneHead(other.fit.rim, rim.fit.rim));
         });
}

// The rims of an octave, best first, and the best one polished where that may help. None where it
// is round on one side only: a tip, a corner.
std::vector<FoundRim> Polished(const Octave& octave,
                               std::vector<FoundRim> rims,
                               const std::vector<FoundRim>& best_of_all) {
  if (rims.empty()) return {};
  FoundRim best = rims.front();
  if (MayGain(best, best_of_all)) {
    best = octave.Polish(best);
    rims.push_back(best);
  }
  if (best.one_sided) rims.clear();
  return rims;
}

}  // namespace

bool OfOneHead(const RimEllipse& a, const RimEllipse& b) {
  constexpr double kSameHead = 0.5;  // of the radius, between the centres
  constexpr double kMostLarger = 1.35;
  const double radius = a.MeanRadius(), ratio = b.MeanRadius() / radius;
  return (a.center - b.center).norm() < kSameHead * radius && ratio < kMostLarger &&
         ratio > 1 / kMostLarger;
}

std::vector<FoundRim> FindRims(const cv::Mat& grey, const ScrewSearch& search) {
  const std::vector<double> radii = OctaveRadii(search);
  const Octaves octaves = ParallelMap(static_cast<int>(radii.size()), [&](int i) {
    return std::make_unique<const Octave>(grey, search, radii[static_cast<std::size_t>(i)]);
  });
  std::vector<std::vector<FoundRim>> judged = JudgeAll(octaves);
  std::vector<FoundRim> best;
  for (std::vector<FoundRim>& rims : judged) {
    PutBestFirst(rims);
    if (!rims.empty()) best.push_back(rims.front());
  }
  const auto rims = ParallelMap(static_cast<int>(octaves.size()), [&](int i) {
    const auto octave = static_cast<std::size_t>(i);
    return Polished(*octaves[octave], std::move(judged[octave]), best);
  });
  std::vector<FoundRim> all;
  for (const std::vector<FoundRim>& octave : rims)
    all.insert(all.end(), octave.begin(), octave.end());
  std::erase_if(all, [](const FoundRim& found) { return found.one_sided; });
  PutBestFirst(all);
  return all;
}

}  // namespace bladecurve
