// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene_choice.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <ranges>
#include <utility>

#include "vision/image/nearest_pixel.h"
#include "vision/image/robust_statistics.h"
#include "vision/scene/silhouette.h"

namespace bladecurve {
namespace {

// Likelihood first; among thresholds that see the same blades the one whose contour lies on the
// strongest transition. `agreeing`: masks that see them.
double Merit(const Candidate& c, int agreeing) {
  return Likelihood(c.pair) *
         std::sqrt(std::min(agreeing, 4) * c.strength * SizeOf(c.pair) * c.at->full_px_per_px());
}

// Masks that show the same blades: of the rung that found them, and of others where they are
// likely.
int AgreeingInAll(const Candidate& c, const std::vector<Candidate>& candidates) {
  constexpr double kLikely = 0.3;  // quality
  const auto agrees = [&](const Candidate& other) {
    return other.method != c.method && other.pair.quality > kLikely && SameBlades(c, other);
  };
  return c.agreeing + static_cast<int>(std::ranges::count_if(candidates, agrees));
}

// Of some candidates the one of most merit, what could be accepted first, however many masks agree
// on what could not. nullptr if there is none.
template <typename Candidates, typename MeritOf>
const Candidate* BestOf(Candidates&& candidates, const MeritOf& merit) {
  const auto rank = [&](const Candidate& c) {
    return std::pair(c.pair.quality >= kAcceptedQuality, merit(c));
  };
  const auto best = std::ranges::max_element(candidates, {}, rank);
  return best == std::ranges::end(candidates) ? nullptr : &*best;
}

// The blades that all masks together show best, in the mask that shows them best.
const Candidate* BestOf(const std::vector<Candidate>& candidates) {
  const Candidate* best = BestOf(
      candidates, [&](const Candidate& c) { return Merit(c, AgreeingInAll(c, candidates)); });
  if (best == nullptr) return nullptr;
  const auto same = [&](const Candidate& c) { return SameBlades(c, *best); };
  return BestOf(candidates | std::views::filter(same),
                [](const Candidate& c) { return Merit(c, c.agreeing); });
}

// How well a mask's contour follows the blades' edges: on a strong transition, and smoothly.
double Fidelity(const Candidate& c) {
  constexpr double kRough = 0.015;  // of the length; a contour that changes lines half way has it
  const double roughness = std::max(c.pair.first.roughness, c.pair.second.roughness) / kRough;
  return c.strength / (1 + roughness * roughness);
}

constexpr double kSurelyScissors = 0.8;  // quality

// A pair that is small, or partly out of the picture, but shows in many masks: no shank does.
bool IsOftenSeen(const Candidate& c) {
  constexpr double kLikely = 0.3;
  constexpr int kMasks = 6;
  return c.pair.quality > kLikely && c.agreeing >= kMasks;
}

double FullSize(const Candidate& c) { return SizeOf(c.pair) * c.at->full_px_per_px(); }

// Whether the mask of `c` shows it as another thing than the one that `best` is part of.
bool StandsApart(const Candidate& c, const Candidate& best) {
  const Eigen::Vector2d& own_tip = c.pair.first.tip;
  if (!IsSetAt(c.mask, own_tip)) return false;
  cv::Mat others = c.mask.clone();
  cv::floodFill(others, NearestPixel(own_tip), 0);
  bool shown = false;
  for (const Eigen::Vector2d& part : {best.pair.pivot, best.pair.first.tip, best.pair.second.tip}) {
    const Eigen::Vector2d place = c.at->SmallFromFull(best.at->FullFromSmall(part));
    if (IsSetAt(c.mask, place) && !IsSetAt(others, place)) return false;
    shown = shown || IsSetAt(others, place);
  }
  return shown;
}

// Whether two pairs end in the same blade, as those of the same scissors do whose joint one mask
// shows elsewhere.
bool ShareTip(const Candidate& a, const Candidate& b) {
  constexpr double kNear = 0.25;  // of the size
  const auto near = [&](const Eigen::Vector2d& tip, const Eigen::Vector2d& other) {
    return (a.at->FullFromSmall(tip) - b.at->FullFromSmall(other)).norm() < kNear * FullSize(b);
  };
  return near(a.pair.first.tip, b.pair.first.tip) || near(a.pair.second.tip, b.pair.second.tip);
}

bool LieApart(const Candidate& c, const Candidate& best) {
  const double apart_px =
      (c.at->FullFromSmall(c.pair.pivot) - best.at->FullFromSmall(best.pair.pivot)).norm();
  return apart_px > FullSize(best) && !ShareTip(c, best);
}

// Whether `c` shows a second pair of scissors beside the best: as good a one elsewhere, or a
// poorer one that is a thing of its own, and no texture. Beside a whole one that is beyond doubt,
// one whose blades run out of the picture is not meant; lines of a cutting mat that cross at the
// picture's border look like that.
bool IsSecondPair(const Candidate& c, const Candidate& best) {
  constexpr double kLikely = 0.3, kBeyondDoubt = 0.85;  // quality
  constexpr double kSmallest = 0.4, kFaintest = 0.2;    // of the best
  if (!LieApart(c, best)) return false;
  if (best.pair.quality > kSurelyScissors && RunsOut(c.pair) && !RunsOut(best.pair)) return false;
  const bool seen_alike =
      c.pair.quality > kSurelyScissors && c.agreeing >= 2 && c.method == best.method;
  if (best.pair.quality > kSurelyScissors && (seen_alike || IsOftenSeen(c))) return true;
  const bool comparable =
      FullSize(c) > kSmallest * FullSize(best) && c.strength > kFaintest * best.strength;
  const bool likely = c.pair.quality > (c.agreeing >= 2 ? kLikely : kBeyondDoubt);
  return comparable && likely && StandsApart(c, best);
}

// What the candidates that are kept show best.
template <typename IsKept>
LadderResult Keeping(const LadderResult& result, const IsKept& is_kept) {
  std::vector<Candidate> kept;
  std::copy_if(result.seen.begin(), result.seen.end(), std::back_inserter(kept), is_kept);
  LadderResult next = Choose(kept);
  next.closed = result.closed;
  next.rings = result.rings;
  next.seen = std::move(kept);
  next.unresolved = result.unresolved;
  return next;
}

}  // namespace

LadderResult Choose(const std::vector<Candidate>& candidates) {
  LadderResult result;
  const Candidate* best = BestOf(candidates);
  if (best == nullptr) return result;
  const Candidate* truest = best;
  for (const Candidate& c : candidates) {
    const bool as_good = c.pair.quality > 0.95 * best->pair.quality && SameBlades(c, *best);
    if (as_good && Fidelity(c) > Fidelity(*truest)) truest = &c;
    result.several = result.several || IsSecondPair(c, *best);
  }
  result.best = *truest;
  return result;
}

bool Consistent(const LadderResult& result) {
  constexpr double kSurelySharp = 0.8;
  const int enough = result.best.sharpness >= kSurelySharp ? 2 : 3;
  return result.best.pair.quality >= 0.9 && result.best.agreeing >= enough;
}

bool ShowsWholeBlades(const LadderResult& result) {
  const BladePair& pair = result.best.pair;
  return pair.quality >= kAcceptedQuality && !RunsOut(pair);
}

bool ShowsOneCutOff(const LadderResult& result) {
  return std::any_of(result.seen.begin(), result.seen.end(), [&](const Candidate& c) {
    return c.pair.quality >= kAcceptedQuality && RunsOut(c.pair) && LieApart(c, result.best);
  });
}

bool ShowsAnother(const Candidate& best) {
  constexpr int kThings = 6;
  constexpr double kLeastArea = 0.1;  // of the scissors'
  constexpr double kFilled = 0.6;     // share of its convex hull
  const std::vector<Silhouette> things = FindSilhouettes(best.mask, kThings);
  const Silhouette* own = ThingAt(things, best.pair.pivot);
  if (own == nullptr) return false;
  return std::any_of(things.begin(), things.end(), [&](const Silhouette& thing) {
    if (&thing == own || thing.area_px < kLeastArea * own->area_px) return false;
    std::vector<cv::Point> hull;
    cv::convexHull(thing.contour, hull);
    return thing.area_px < kFilled * cv::contourArea(hull);
  });
}

double TurnAtJoint(const LadderResult& result) {
  std::vector<double> turns;
  for (const Candidate& c : result.seen) {
    if (c.pair.quality >= kAcceptedQuality && SameBlades(c, result.best))
      turns.push_back(TurnAtJoint(c.pair));
  }
  return Median(turns);
}

LadderResult ByOtherMethods(const LadderResult& result, const std::string& method) {
  return Keeping(result, [&](const Candidate& c) { return c.method != method; });
}

LadderResult ByOtherMasks(const LadderResult& result) {
  const Candidate& best = result.best;
  return Keeping(result, [&](const Candidate& c) {
    return c.method == best.method && c.mask.data != best.mask.data;
  });
}

}  // namespace bladecurve
