// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/image/cross.h"
#include "vision/parallel.h"
#include "vision/refused.h"
#include "vision/scene/beyond_tips.h"
#include "vision/scene/blades.h"
#include "vision/scene/catches.h"
#include "vision/scene/limb_count.h"
#include "vision/scene/lost_joint.h"
#include "vision/scene/scene_debug.h"
#include "vision/scene/scene_ladder.h"
#include "vision/scene/scene_trace.h"
#include "vision/scene/silhouette.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// A line through the part of a traced edge that is clear of the crotch: point and unit direction.
struct FittedLine {
  Vector2d point, direction;
};

FittedLine LineThrough(const std::vector<Vector2d>& path, double from_share, double to_share) {
  const auto first = static_cast<std::size_t>(from_share * static_cast<double>(path.size() - 1));
  const auto last =
      std::max(first + 2, static_cast<std::size_t>(to_share * static_cast<double>(path.size())));
  Vector2d mean = Vector2d::Zero();
  const std::size_t end = std::min(last, path.size());
  for (std::size_t i = first; i < end; ++i) mean += path[i];
  mean /= static_cast<double>(end - first);
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (std::size_t i = first; i < end; ++i)
    scatter += (path[i] - mean) * (path[i] - mean).transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(scatter);
  Vector2d direction = eigen.eigenvectors().col(1);
  if (direction.dot(path.back() - path.front()) < 0) direction = -direction;
  return {mean, direction};
}

// The mask may have filled the gap near the crotch (a shadow) or opened it too far: the straight
// parts of the two edges, run backwards, say where the blades really cross.
Vector2d CrossingOfEdges(const std::vector<Vector2d>& a,
                         const std::vector<Vector2d>& b,
                         const Vector2d& crotch) {
  constexpr double kFrom = 0.12;  // clear of the filled part
  constexpr double kTo = 0.45;    // before a curved blade bends away
  const FittedLine p = LineThrough(a, kFrom, kTo);
  const FittedLine q = LineThrough(b, kFrom, kTo);
  const double sine = Cross(p.direction, q.direction);
  if (std::abs(sine) < 0.02) return crotch;  // nearly parallel: the crossing is anywhere
  const Vector2d crossing = p.point + Cross(q.point - p.point, q.direction) / sine * p.direction;
  const double length = (a.back() - crotch).norm();
  return (crossing - crotch).norm() < 0.6 * length ? crossing : crotch;
}

// The path from the crossing on: a straight run to where the traced edge is clear of the crotch,
// then the traced edge.
std::vector<Vector2d> StartAt(const Vector2d& crossing, const std::vector<Vector2d>& path) {
  const double length = (path.back() - crossing).norm();
  const FittedLine line = LineThrough(path, 0.12, 0.45);
  std::vector<Vector2d> out;
  const auto clear = std::find_if(path.begin(), path.end(), [&](const Vector2d& p) {
    return (p - path.front()).norm() > 0.1 * length &&
           (p - crossing).dot(line.direction) > 0.1 * length;
  });
  if (clear == path.end()) return path;
  out.push_back(crossing);
  out.insert(out.end(), clear, path.end());
  return Resample(out, 1.0);
}

SceneBlade ToSceneBlade(const ScaledImage& at,
                        const BladeContour& blade,
                        const std::vector<Vector2d>& inner) {
  SceneBlade out;
  for (const Vector2d& p : inner) out.inner_px.push_back(at.FullFromSmall(p));
  for (const Vector2d& p : blade.outer) out.outer_px.push_back(at.FullFromSmall(p));
  for (const Vector2d& p : blade.shank) out.shank_px.push_back(at.FullFromSmall(p));
  std::reverse(out.outer_px.begin(), out.outer_px.end());
  out.tip_px = at.FullFromSmall(blade.tip);
  out.width_px = blade.width * at.full_px_per_px();
  return out;
}

std::vector<Vector2d> TraceInner(const cv::Mat& image, const BladeContour& blade, int inside) {
  TraceRange range;
  range.inwards = std::clamp(
      0.3 * blade.width, 2.0, 12.0);  // a soft shadow may fill a third of the blade's width
  range.outwards = 2.0;
  return TraceStrongestEdge(image, blade.inner, inside, range);
}

// The waist runs across the axis, hence obliquely across the members that cross there.
double WidthOfMembers(const BladePair& pair) {
  const Vector2d first = (pair.first.tip - pair.pivot).normalized();
  const Vector2d second = (pair.second.tip - pair.pivot).normalized();
  const double cos_half_opening = 0.5 * (first + second).norm();
  return pair.shank_width * cos_half_opening;
}

// For a joint that goes on to `end_px`: the pivot is where joints that long have it, and may yet be
// where the silhouette put it.
void ExtendJoint(const Vector2d& end_px, Scene* scene) {
  constexpr double kSpread = 0.2;  // of the joint
  const Vector2d joint_px = scene->crotch_px - end_px, before_px = scene->pivot_px;
  scene->shank_crotch_px = end_px;
  scene->pivot_px = end_px + kUsualPivot * joint_px;
  scene->pivot_sigma_px =
      std::hypot(scene->pivot_sigma_px,
                 std::max(kSpread * joint_px.norm(), 0.5 * (scene->pivot_px - before_px).norm()));
}

Scene SceneFrom(const Candidate& found) {
  const BladePair& pair = found.pair;
  const ScaledImage& at = *found.at;
  // `first` runs clockwise before the crotch (y down): seen towards the tips it is the left blade,
  // and going outwards along its inner edge the metal lies to the left; for `second` to the right.
  const auto traces = ParallelMap(2, [&](int blade) {
    return blade == 0 ? TraceInner(at.pixels, pair.first, +1)
                      : TraceInner(at.pixels, pair.second, -1);
  });
  std::vector<Vector2d> left = traces[0], right = traces[1];
  const Vector2d crossing = CrossingOfEdges(left, right, pair.crotch);
  left = StartAt(crossing, left);
  right = StartAt(crossing, right);
  Scene scene;
  scene.left = ToSceneBlade(at, pair.first, left);
  scene.right = ToSceneBlade(at, pair.second, right);
  scene.crotch_px = at.FullFromSmall(crossing);
  scene.shank_crotch_px = at.FullFromSmall(*pair.shank_crotch);
  scene.pivot_px = at.FullFromSmall(pair.pivot);
  scene.pivot_sigma_px = pair.pivot_sigma * at.full_px_per_px();
  scene.shank_width_px = WidthOfMembers(pair) * at.full_px_per_px();
  scene.path_sigma_px = at.full_px_per_px();
  scene.quality = pair.quality;
  scene.outlined = found.outlined;
  if (const auto end = EndOfLostJoint(found)) ExtendJoint(at.FullFromSmall(*end), &scene);
  return scene;
}

// Hints are obeyed; where nothing fits them, they may be at fault as well as the picture.
std::string WhatHintsSay(const StoredHints& hints) {
  std::string names;
  const auto add = [&](bool given, const char* name) {
    if (given) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  add(hints.roi_px.has_value(), "--roi");
  add(hints.pivot_px.has_value(), "--pivot");
  add(hints.tips_direction.has_value(), "--tips-toward");
  return names.empty() ? "" : "; or it is otherwise than said: check " + names;
}

// What may rescue a picture, but for what was given.
std::string HowToPoint(const StoredHints& hints) {
  if (hints.pivot_px) return "";
  if (hints.roi_px) return ", or say where the screw is: --pivot X,Y";
  return ", or point at them: --pivot X,Y or --roi X,Y,W,H";
}

std::string WhatMarkersDo(const std::vector<SeenMarker>& markers) {
  if (markers.empty()) return "";
  return "; the paper of markers is left out: lay them a marker's width away from the blades";
}

const char* WhereLooked(const StoredHints& hints) { return hints.roi_px ? "--roi" : "the picture"; }

// Whether more finger rings are seen than a pair of scissors has: clamps have them, too. Not where
// the user points at one of several, nor where the others are of a pair that is not meant.
bool ShowsRingsOfOthers(const LadderResult& ladder, const StoredHints& hints) {
  constexpr int kOfOnePair = 2;
  const bool points = hints.pivot_px || hints.tips_direction;
  return !points && ladder.rings > kOfOnePair && !ShowsOneCutOff(ladder);
}

void RefuseUnlessUsable(const LadderResult& ladder,
                        const std::vector<SeenMarker>& markers,
                        const StoredHints& hints) {
  if (ladder.best.pair.quality < kAcceptedQuality && ladder.closed) {
    throw Refused(
        Reason::kClosed,
        "scene: the scissors are closed, or the gap between the blades looks like the "
        "blades; open them by 5 to 90 degrees so that both cutting edges are free; if they "
        "are open, expose less, or use another ground or softer light");
  }
  if (ladder.best.pair.quality < kAcceptedQuality) {
    const std::string nearest = ladder.best.pair.doubt.empty()
                                    ? ""
                                    : "; the nearest thing fails because " + ladder.best.pair.doubt;
    throw Refused(Reason::kNotScissors,
                  "scene: no pair of open blades found" + nearest +
                      "; show the scissors open and whole on a plain ground" + HowToPoint(hints) +
                      WhatMarkersDo(markers) + WhatHintsSay(hints));
  }
  const BladePair& pair = ladder.best.pair;
  if (RunsOut(pair)) {
    throw Refused(Reason::kBladesNotVisible,
                  std::string("scene: a blade runs out of ") + WhereLooked(hints) +
                      "; both tips must be inside it" +
                      (hints.pivot_px ? ""
                                      : "; if they are, on a ground with a pattern, say where the "
                                        "screw is: --pivot X,Y"));
  }
  const double taper = std::min(pair.first.taper, pair.second.taper);
  if (pair.shanks_run_out && taper > kTapers && !hints.tips_direction) {
    throw Refused(Reason::kBladesNotVisible,
                  "scene: what stays in the picture does not taper as blades do; if these are the "
                  "shanks, take a picture with both tips inside the frame; if they are the blades, "
                  "say where their tips point: --tips-toward left, right, up or down");
  }
  if (ladder.several || ShowsRingsOfOthers(ladder, hints)) {
    throw Refused(Reason::kSeveralScissors,
                  std::string("scene: more than one pair of scissors, or another instrument with "
                              "finger rings, in ") +
                      WhereLooked(hints) + "; choose one with a " +
                      (hints.roi_px ? "smaller " : "") + "--roi X,Y,W,H");
  }
}

// Instruments whose limbs look like those of scissors, and blades that one view does not show.
void RefuseOtherInstruments(const LadderResult& ladder, const StoredHints& hints) {
  constexpr int kThings = 6;
  constexpr double kAngled = 0.3;  // rad
  if (hints.pivot_px) return;
  const Candidate& found = ladder.best;
  const std::vector<Silhouette> things = FindSilhouettes(found.mask, kThings);
  const Silhouette* own = ThingAt(things, found.pair.pivot);
  if (own != nullptr && CountLimbsAhead(own->filled, found.pair) > 2) {
    throw Refused(Reason::kSeveralScissors,
                  "scene: more than two blades cross at one place, or hard shadows that look like "
                  "more; part the instruments, use softer light, or say where the screw is: "
                  "--pivot X,Y");
  }
  if (own != nullptr && GoOnBeyondTips(found.mask, *own, found.pair)) {
    throw Refused(Reason::kBladesNotVisible,
                  "scene: what was taken for two blades goes on beyond their tips, as shanks do to "
                  "their rings; both blades must be inside " +
                      std::string(WhereLooked(hints)) +
                      "; if these are the blades, say where the screw is: --pivot X,Y");
  }
  if (TurnAtJoint(ladder) > kAngled) {
    throw Refused(Reason::kOutOfPlane,
                  "scene: the blades are set at an angle to the shanks, as those of bandage "
                  "scissors are; if they lie flat, say where the screw is: --pivot X,Y");
  }
  if (own != nullptr && ShanksCarryCatches(own->filled, found.pair)) {
    throw Refused(Reason::kNotScissors,
                  "scene: both shanks carry a catch, as those of clamps and needle holders do, "
                  "which do not cut; if these are scissors, say where the screw is: --pivot X,Y");
  }
}

}  // namespace

SceneFinder::SceneFinder(const Photo& photo,
                         const std::vector<SeenMarker>& markers,
                         const StoredHints& hints,
                         StageLog* log)
    : markers_(markers),
      hints_(hints),
      log_(log),
      ladder_(std::make_unique<SceneLadder>(photo, markers_, hints_, log)),
      first_(std::make_unique<LadderResult>(ladder_->Climb(log->plan()))) {
  RefuseUnlessUsable(*first_, markers_, hints_);
}

SceneFinder::~SceneFinder() = default;

Scene SceneFinder::Likeliest() const {
  RefuseOtherInstruments(Shown(), hints_);
  Scene scene = SceneFrom(Shown().best);
  scene.second_look = looks_ > 1;
  if (hints_.pivot_px) {
    scene.pivot_px = *hints_.pivot_px;
    scene.pivot_sigma_px = 1;
  }
  if (scene.IsDoubtful()) scene.warnings.push_back("scene_doubtful");
  log_->Ran("trace", "edges followed on the small picture");
  log_->Picture("scene", [&] { return DrawScene(Shown().best, scene); });
  return scene;
}

void SceneFinder::LookAgain() {
  const auto by_other_methods = [&](const LadderResult& all) {
    return ByOtherMethods(all, first_->best.method);
  };
  if (++looks_ > 2) {
    LadderResult by_masks = ByOtherMasks(*first_);
    if (!ShowsWholeBlades(by_masks)) by_masks = ladder_->WithoutHandles(Shown().unresolved);
    later_ = std::make_unique<LadderResult>(std::move(by_masks));
  } else if (first_->climbed) {
    later_ = std::make_unique<LadderResult>(by_other_methods(*first_));
  } else {
    later_ = std::make_unique<LadderResult>(by_other_methods(ladder_->Climb(Plan::kFull)));
  }
  RefuseUnlessUsable(Shown(), markers_, hints_);
}

}  // namespace bladecurve
