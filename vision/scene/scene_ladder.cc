// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene_ladder.h"

#include <algorithm>
#include <iterator>
#include <opencv2/core.hpp>

#include "vision/image/smoothed.h"
#include "vision/parallel.h"
#include "vision/refused.h"
#include "vision/scene/scene_debug.h"
#include "vision/scene/scene_rungs.h"
#include "vision/scene/silhouette.h"

namespace bladecurve {
namespace {

constexpr int kSmallestSide = 120;  // no blade of such a picture has an edge that could be measured

// Adds what a stage's rungs saw to what is known.
LadderResult Consider(const std::vector<Rung>& stage, Rung* all) {
  for (const Rung& rung : stage) {
    all->candidates.insert(all->candidates.end(), rung.candidates.begin(), rung.candidates.end());
    all->touching.insert(all->touching.end(), rung.touching.begin(), rung.touching.end());
    all->unresolved.insert(all->unresolved.end(), rung.unresolved.begin(), rung.unresolved.end());
    all->closed = std::max(all->closed, rung.closed);
    all->contradicting = std::max(all->contradicting, rung.contradicting);
    all->rings = std::max(all->rings, rung.rings);
  }
  LadderResult result = Choose(all->candidates);
  result.rings = all->rings;
  constexpr int kAgreeing = 3;  // fewer masks may show by chance what looks like that
  result.closed = all->closed >= kAgreeing && all->contradicting < kAcceptedQuality;
  return result;
}

// Where what casts a shadow is consistent, what holds the shadow, too, is not.
void PreferCaster(const std::vector<Rung>& stage, LadderResult* result) {
  if (stage.back().method != "caster") return;
  const LadderResult caster = Choose(stage.back().candidates);
  if (Consistent(caster)) result->best = caster.best;
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
  const auto plainly = [](const cv::Mat& distance) {
    return MaskAbove(Smoothed(distance, kSmooth), kPlainly);
  };
  const cv::Mat coloured = plainly(rungs.back().distance);
  const double share = static_cast<double>(cv::countNonZero(coloured)) /
                       std::max(1, cv::countNonZero(coloured | plainly(rungs.front().distance)));
  if (share < kSome || share > kMost) return rungs;
  const GreyPicture lightness = LightnessOf(colour);
  const cv::Mat things = coloured | plainly(DistanceIn(lightness));
  Rung caster = CasterRung(view, lightness, things, coloured);
  if (!caster.candidates.empty()) rungs.push_back(std::move(caster));
  return rungs;
}

Rung RungWithoutHandles(const SceneView& view, const std::vector<Candidate>& unresolved) {
  Rung rung;
  std::vector<Rung> seen = ParallelMap(static_cast<int>(unresolved.size()), [&](int i) {
    const Candidate& mask = unresolved[static_cast<std::size_t>(i)];
    return SeenWithoutHandles(mask, view.MarkerMask(*mask.at), view.hints);
  });
  for (Rung& mask : seen) Add(std::move(mask), &rung);
  return rung;
}

// The best of the candidates with all of them, if it shows whole blades and so many masks agree on
// it; else nothing.
LadderResult IfEnoughAgree(std::vector<Candidate> candidates, int least) {
  LadderResult result = Choose(candidates);
  if (!ShowsWholeBlades(result) || result.best.agreeing < least) return {};
  result.climbed = true;
  result.seen = std::move(candidates);
  return result;
}

const char* WhyRun(bool full, const char* need) { return full ? "all ways are wanted" : need; }

}  // namespace

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
  if (!ShowsWholeBlades(result)) {
    constexpr int kAgreeing = 2;
    LadderResult parted = IfEnoughAgree(std::move(all.touching), kAgreeing);
    if (ShowsWholeBlades(parted)) {
      log_->Ran("scene-handles", "nothing else shows blades: handles that touch may be parted");
      result = std::move(parted);
    }
  }
  if (!ShowsWholeBlades(result)) {
    LadderResult without = WithoutHandles(all.unresolved);
    if (ShowsWholeBlades(without)) return without;
  }
  result.unresolved = std::move(all.unresolved);
  return result;
}

LadderResult SceneLadder::WithoutHandles(const std::vector<Candidate>& unresolved) {
  constexpr int kAgreeing = 3, kAtPivot = 1;
  LadderResult result = IfEnoughAgree(RungWithoutHandles(as_is_.view, unresolved).candidates,
                                      as_is_.view.hints.pivot_px ? kAtPivot : kAgreeing);
  if (ShowsWholeBlades(result))
    log_->Ran("scene-handles", "nothing else shows blades: handles may lie on something");
  return result;
}

LadderResult SceneLadder::ClimbIn(Plan plan, Looked* looked, Rung* all) {
  const SceneView& view = looked->view;
  const bool full = plan == Plan::kFull;
  const bool points = view.hints.pivot_px.has_value();
  // What runs out of the picture is refused, unless the user points at something else.
  const auto suffices = [&](const LadderResult& seen) {
    return Consistent(seen) && (!points || ShowsWholeBlades(seen));
  };
  const auto see = [&](const char* stage, const std::string& why, const auto& look) {
    return See(stage, why, looked, look);
  };
  const std::vector<Rung>& in_grey =
      see("scene-grey",
          view.smooth ? "again, smoothed: noise may hide the blades" : "the cheapest look",
          [&] { return GreyRungs(view); });
  LadderResult result = Consider(in_grey, all);
  PreferCaster(in_grey, &result);
  const bool grey_suffices = suffices(result);
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
  PreferCaster(by_colour, &in_colour);
  if (grey_suffices && !full) {
    result.several = result.several || in_colour.several;
    result.rings = in_colour.rings;
    return result;
  }
  result = in_colour;
  if (suffices(result) && !full) {
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
  if (ShowsWholeBlades(result) && !result.several && !full) {
    log_->Skipped("scene-regions", "the flood left blades dry");
    return result;
  }
  result = Consider(see("scene-regions",
                        WhyRun(full, "the flood ran into the blades"),
                        [&] { return std::vector{RegionRung(view, *looked->outlines)}; }),
                    all);
  result.climbed = !points;
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
  if (!ShowsWholeBlades(result) && ShowsWholeBlades(in_broad) && Consistent(in_broad)) {
    *all = std::move(broad);
    in_broad.climbed = true;
    return in_broad;
  }
  return points && !view.smooth ? ClimbToCut(plan, std::move(result), looked, all) : result;
}

LadderResult SceneLadder::ClimbToCut(Plan plan, LadderResult result, Looked* looked, Rung* all) {
  const std::vector<Rung>& in_cut =
      See("scene-cut",
          WhyRun(plan == Plan::kFull, "--pivot tells scissors from a patterned ground"),
          looked,
          [&] { return std::vector{CutRung(looked->view, *looked->colour)}; });
  if (ShowsWholeBlades(result)) {
    result = Consider(in_cut, all);
  } else {
    Rung cut;  // by itself: what others make of the pattern is none
    LadderResult by_cut = Consider(in_cut, &cut);
    if (ShowsWholeBlades(by_cut)) {
      *all = std::move(cut);
      result = std::move(by_cut);
    } else {
      std::ranges::move(cut.unresolved, std::back_inserter(all->unresolved));
    }
  }
  result.climbed = true;
  return result;
}

}  // namespace bladecurve
