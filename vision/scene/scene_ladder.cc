// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene_ladder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>

#include "vision/image/nearest_pixel.h"
#include "vision/image/robust_statistics.h"
#include "vision/image/smoothed.h"
#include "vision/parallel.h"
#include "vision/refused.h"
#include "vision/scene/scene_debug.h"
#include "vision/scene/scene_rungs.h"
#include "vision/scene/silhouette.h"

namespace bladecurve {
namespace {

constexpr int kSmallestSide = 120;  // no blade of such a picture has an edge that could be measured

// Likelihood first; among thresholds that see the same blades the one whose contour lies on the
// strongest transition.
double Merit(const Candidate& c) {
  return Likelihood(c.pair) *
         std::sqrt(std::min(c.agreeing, 4) * c.strength * SizeOf(c.pair) * c.at->full_px_per_px());
}

// What could be accepted first, however many masks agree on what could not.
bool Better(const Candidate& a, const Candidate& b) {
  const bool a_usable = a.pair.quality >= kAcceptedQuality;
  const bool b_usable = b.pair.quality >= kAcceptedQuality;
  return a_usable != b_usable ? a_usable : Merit(a) > Merit(b);
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

// Whether `c` shows a second pair of scissors beside the best: as good a one elsewhere, or a
// poorer one that is a thing of its own, and no texture. Beside a whole one that is beyond doubt,
// one whose blades run out of the picture is not meant; lines of a cutting mat that cross at the
// picture's border look like that.
bool IsSecondPair(const Candidate& c, const Candidate& best) {
  constexpr double kLikely = 0.3, kBeyondDoubt = 0.85;  // quality
  constexpr double kSmallest = 0.4, kFaintest = 0.2;    // of the best
  const double apart_px =
      (c.at->FullFromSmall(c.pair.pivot) - best.at->FullFromSmall(best.pair.pivot)).norm();
  if (apart_px <= FullSize(best) || ShareTip(c, best)) return false;
  if (best.pair.quality > kSurelyScissors && RunsOut(c.pair) && !RunsOut(best.pair)) return false;
  const bool seen_alike =
      c.pair.quality > kSurelyScissors && c.agreeing >= 2 && c.method == best.method;
  if (best.pair.quality > kSurelyScissors && (seen_alike || IsOftenSeen(c))) return true;
  const bool comparable =
      FullSize(c) > kSmallest * FullSize(best) && c.strength > kFaintest * best.strength;
  const bool likely = c.pair.quality > (c.agreeing >= 2 ? kLikely : kBeyondDoubt);
  return comparable && likely && StandsApart(c, best);
}

// Whether the mask shows another thing that is no sheet, label or ruler, which fill their outlines:
// another instrument, perhaps not all of it.
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

LadderResult Choose(const std::vector<Candidate>& candidates) {
  LadderResult result;
  const Candidate* best = nullptr;
  for (const Candidate& c : candidates) {
    if (best == nullptr || Better(c, *best)) best = &c;
  }
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

// Several thresholds must agree; fewer where the outline is as sharp as the lens allows.
bool Consistent(const LadderResult& result) {
  constexpr double kSurelySharp = 0.8;
  const int enough = result.best.sharpness >= kSurelySharp ? 2 : 3;
  return result.best.pair.quality >= 0.9 && result.best.agreeing >= enough;
}

// Adds what a stage's rungs saw to what is known.
LadderResult Consider(const std::vector<Rung>& stage, Rung* all) {
  for (const Rung& rung : stage) {
    all->candidates.insert(all->candidates.end(), rung.candidates.begin(), rung.candidates.end());
    all->closed = std::max(all->closed, rung.closed);
  }
  LadderResult result = Choose(all->candidates);
  constexpr int kAgreeing = 3;  // fewer masks may show by chance what looks like that
  result.closed = all->closed >= kAgreeing;
  return result;
}

// Where what casts a shadow is consistent, what holds the shadow, too, is not.
void PreferCaster(const std::vector<Rung>& stage, std::size_t others, LadderResult* result) {
  if (stage.size() <= others) return;
  const LadderResult caster = Choose(stage.back().candidates);
  if (Consistent(caster)) result->best = caster.best;
}

// Whether blades were found that could be measured.
bool ShowsWholeBlades(const LadderResult& result) {
  const BladePair& pair = result.best.pair;
  return pair.quality >= kAcceptedQuality && !RunsOut(pair);
}

// What the best candidate is seen in, as far as it hangs together; without one that could be
// accepted, all that is plainly no background.
cv::Mat ThingsIn(const Rung& rung) {
  constexpr double kPlainly = 4, kSmooth = 0.8;
  const Candidate best = Choose(rung.candidates).best;
  if (best.pair.quality < kAcceptedQuality)
    return MaskAbove(Smoothed(rung.distance, kSmooth), kPlainly);
  const std::vector<Silhouette> things = FindSilhouettes(best.mask, 4);
  const Silhouette* own = ThingAt(things, best.pair.pivot);
  return own == nullptr ? best.mask : best.mask & own->filled;
}

// What grey shows, and what of it is no cast shadow if it shows one.
std::vector<Rung> GreyRungs(const SceneView& view) {
  const GreyPicture grey = GreyOnGround(view);
  std::vector rungs{GreyRung(view, grey)};
  const cv::Mat things = ThingsIn(rungs.front());
  Rung caster = CasterRung(view, grey, things, cv::Mat::zeros(things.size(), CV_8UC1));
  if (!caster.candidates.empty()) rungs.push_back(std::move(caster));
  return rungs;
}

// What colour shows, what a shadow does not do, and, where only some of the things are coloured,
// what of the others is no cast shadow.
std::vector<Rung> ColourRungs(const SceneView& view, const ColourPictures& colour) {
  constexpr double kPlainly = 8, kSmooth = 0.8;
  constexpr double kSome = 0.1, kMost = 0.9;  // of the things
  std::vector<Rung> rungs = ParallelMap(2, [&](int rung) {
    return rung == 0 ? ColourRung(view, colour) : ShadowBlindRung(view, colour);
  });
  const GreyPicture lightness = LightnessOf(colour);
  const cv::Mat coloured = MaskAbove(Smoothed(rungs.back().distance, kSmooth), kPlainly);
  const cv::Mat things = coloured | MaskAbove(Smoothed(DistanceIn(lightness), kSmooth), kPlainly);
  const double share =
      static_cast<double>(cv::countNonZero(coloured)) / std::max(1, cv::countNonZero(things));
  if (share < kSome || share > kMost) return rungs;
  Rung caster = CasterRung(view, lightness, things, coloured);
  if (!caster.candidates.empty()) rungs.push_back(std::move(caster));
  return rungs;
}

const char* WhyRun(bool full, const char* need) { return full ? "all ways are wanted" : need; }

// What the candidates that are kept show best.
template <typename IsKept>
LadderResult Keeping(const LadderResult& result, const IsKept& is_kept) {
  std::vector<Candidate> kept;
  std::copy_if(result.seen.begin(), result.seen.end(), std::back_inserter(kept), is_kept);
  LadderResult next = Choose(kept);
  next.closed = result.closed;
  next.seen = std::move(kept);
  return next;
}

}  // namespace

double TurnAtJoint(const LadderResult& result) {
  std::vector<double> turns;
  for (const Candidate& c : result.seen) {
    if (c.pair.quality >= kAcceptedQuality && SameBlades(c, result.best))
      turns.push_back(TurnAtJoint(c.pair));
  }
  return Median(turns);
}

SceneLadder::SceneLadder(const Photo& photo,
                         const std::vector<SeenMarker>& markers,
                         const StoredHints& hints,
                         StageLog* log)
    : log_(log), as_is_{{photo, markers, hints}, {}, {}, {}}, smooth_(as_is_) {
  smooth_.view.smooth = true;
  if (std::min(as_is_.view.area_px.width, as_is_.view.area_px.height) < kSmallestSide) {
    throw Refused(Reason::kTooSmall,
                  std::string("scene: ") + (hints.roi_px ? "--roi" : "the picture") +
                      " is less than " + std::to_string(kSmallestSide) + " px high or wide; " +
                      (hints.roi_px ? "give a larger one" : "use a larger photograph"));
  }
}

LadderResult SceneLadder::Climb(Plan plan) {
  const LadderResult result = ClimbNoting(plan, &as_is_);
  if (ShowsWholeBlades(result) || result.closed || !as_is_.view.KeepsNoise(kSmallSide))
    return result;
  LadderResult in_smooth = ClimbNoting(plan, &smooth_);
  if (!ShowsWholeBlades(in_smooth)) return result;
  in_smooth.climbed = true;
  return in_smooth;
}

template <typename Look>
const std::vector<Rung>& SceneLadder::See(const std::string& stage,
                                          const std::string& why,
                                          Looked* looked,
                                          const Look& look) {
  const auto before = looked->stages.find(stage);
  if (before != looked->stages.end()) {
    log_->Skipped(stage, "was looked at before");
    return before->second;
  }
  const std::vector<Rung>& seen = looked->stages.emplace(stage, look()).first->second;
  for (const Rung& rung : seen)
    log_->Picture("rung-" + rung.method, [&] { return DrawRung(rung); });
  log_->Ran(stage, why);
  return seen;
}

LadderResult SceneLadder::ClimbNoting(Plan plan, Looked* looked) {
  Rung all;
  LadderResult result = ClimbIn(plan, looked, &all);
  result.seen = std::move(all.candidates);
  return result;
}

LadderResult SceneLadder::ClimbIn(Plan plan, Looked* looked, Rung* all) {
  const SceneView& view = looked->view;
  const bool full = plan == Plan::kFull;
  const auto see = [&](const char* stage, const std::string& why, const auto& look) {
    return See(stage, why, looked, look);
  };
  const std::vector<Rung>& in_grey =
      see("scene-grey",
          view.smooth ? "again, smoothed: noise may hide the blades" : "the cheapest look",
          [&] { return GreyRungs(view); });
  LadderResult result = Consider(in_grey, all);
  PreferCaster(in_grey, 1, &result);
  const bool grey_suffices = Consistent(result);
  if (grey_suffices && !full && !ShowsAnother(result.best)) {
    log_->Skipped("scene-colour", "grey gave a consistent scene");
    return result;
  }
  const std::vector<Rung>& by_colour =
      see("scene-colour",
          WhyRun(full,
                 grey_suffices ? "another thing lies beside the scissors"
                               : "grey did not separate the blades"),
          [&] { return ColourRungs(view, looked->colour.emplace(SmallColour(view, kSmallSide))); });
  LadderResult in_colour = Consider(by_colour, all);
  PreferCaster(by_colour, 2, &in_colour);
  if (grey_suffices && !full) {
    result.several = result.several || in_colour.several;
    return result;
  }
  result = in_colour;
  if (Consistent(result) && !full) {
    log_->Skipped("scene-flood", "colour gave a consistent scene");
    return result;
  }
  result = Consider(see("scene-flood",
                        WhyRun(full, "no threshold separates the blades"),
                        [&] {
                          looked->outlines = OutlinesIn(view);
                          return std::vector{FloodRung(view, *looked->outlines)};
                        }),
                    all);
  if (ShowsWholeBlades(result) && !full) {
    log_->Skipped("scene-regions", "the flood left blades dry");
    return result;
  }
  result = Consider(see("scene-regions",
                        WhyRun(full, "the flood ran into the blades"),
                        [&] { return std::vector{RegionRung(view, *looked->outlines)}; }),
                    all);
  result.climbed = true;
  if (ShowsWholeBlades(result) && !full) {
    log_->Skipped("scene-broad", "the regions show blades");
    return result;
  }
  Rung broad;  // by itself: what lines make look like blades is none
  LadderResult in_broad =
      Consider(see("scene-broad",
                   WhyRun(full, "lines may cross the ground"),
                   [&] {
                     const cv::Mat& without_shadows = by_colour[1].distance;
                     return std::vector{BroadRung(view, *looked->colour, without_shadows)};
                   }),
               &broad);
  // Without the slender parts, shanks are left that look like blades, but not like whole scissors.
  if (ShowsWholeBlades(result) || !ShowsWholeBlades(in_broad) || !Consistent(in_broad))
    return result;
  *all = std::move(broad);
  in_broad.climbed = true;
  return in_broad;
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
