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

// An octave, and where in it rims may be.
struct SearchedOctave {
  std::unique_ptr<const Octave> octave;
  std::vector<RimCandidate> candidates;
};

SearchedOctave Look(const cv::Mat& grey, const ScrewSearch& search, double min_radius_px) {
  auto octave = std::make_unique<const Octave>(grey, search, min_radius_px);
  std::vector<RimCandidate> candidates = octave->Candidates();
  return {std::move(octave), std::move(candidates)};
}

// What is found near the candidates of an octave, best first. What scores less than least_score is
// not looked at: far less than a head beyond doubt, it is no other rim of it.
std::vector<FoundRim> JudgeAll(const SearchedOctave& searched, double* least_score) {
  constexpr double kRivalScore = 0.7;  // of the head's
  constexpr std::size_t kAtOnce = 4;   // whatever the number of cores, so that results are the same
  const std::vector<RimCandidate>& candidates = searched.candidates;
  std::vector<FoundRim> found;
  for (std::size_t first = 0; first < candidates.size(); first += kAtOnce) {
    if (candidates[first].score < *least_score) break;
    const std::size_t count = std::min(kAtOnce, candidates.size() - first);
    const auto rims = ParallelMap(static_cast<int>(count), [&](int i) {
      const RimCandidate& candidate = searched.candidates[first + static_cast<std::size_t>(i)];
      return searched.octave->Judge(candidate.rim);
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (!rims[i]) continue;
      found.push_back(*rims[i]);
      if (rims[i]->evidence > kBeyondDoubt)
        *least_score = std::max(*least_score, kRivalScore * candidates[first + i].score);
    }
  }
  PutBestFirst(found);
  return found;
}

// Whether it is a head of which all of the rim was followed: neither other sizes nor a second look
// would change it.
bool IsUnmistakable(const FoundRim& rim) {
  constexpr double kLeastThird = 0.75;
  return rim.evidence > kUnmistakable && rim.fit.third_support > kLeastThird && !rim.one_sided;
}

// Whether polishing may make a rim better than the best ones of all octaves: than others by its
// evidence, than others of the same head by its preference.
bool MayGain(const FoundRim& rim, const std::vector<FoundRim>& best) {
  constexpr double kPromising = -2;  // evidence from which on a second look may find a head
  constexpr double kMostGain = 15;   // of evidence or preference
  return rim.evidence > kPromising && !IsUnmistakable(rim) &&
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
  const auto look = [&](std::size_t i) { return Look(grey, search, radii[i]); };
  std::vector<SearchedOctave> octaves;
  if (UsableThreads() > 1) {  // all at once take no longer than the first
    octaves = ParallelMap(static_cast<int>(radii.size()),
                          [&](int i) { return look(static_cast<std::size_t>(i)); });
  }
  std::vector<std::vector<FoundRim>> judged;
  std::vector<FoundRim> best;
  double least_score = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (i == octaves.size()) octaves.push_back(look(i));
    judged.push_back(JudgeAll(octaves[i], &least_score));
    if (judged.back().empty()) continue;
    best.push_back(judged.back().front());
    if (IsUnmistakable(best.back())) break;
  }
  const auto rims = ParallelMap(static_cast<int>(judged.size()), [&](int i) {
    const auto octave = static_cast<std::size_t>(i);
    return Polished(*octaves[octave].octave, std::move(judged[octave]), best);
  });
  std::vector<FoundRim> all;
  for (const std::vector<FoundRim>& octave : rims)
    all.insert(all.end(), octave.begin(), octave.end());
  std::erase_if(all, [](const FoundRim& found) { return found.one_sided; });
  PutBestFirst(all);
  return all;
}

}  // namespace bladecurve
