// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/distal_end.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "vision/parallel.h"
#include "vision/scissors/followed_step.h"
#include "vision/scissors/tip_arc.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr int kSmooth = 4;  // a cubic: cutting edges bend no more than that over their length
constexpr double kProximalFrom = 0.06;  // the crotch may still be blurred there
constexpr double kEarliest = 0.70;      // tips round off in the last third at most

// The edge in the frame of its chord: position along it in [0, 1] of its length, offset across it
// in px, towards the blade.
struct ChordFrame {
  std::vector<double> along, across_px;
  double length_px = 0;
};

ChordFrame InChordFrame(const std::vector<Vector2d>& edge) {
  ChordFrame frame;
  const Vector2d origin = edge.front();
  const Vector2d axis = AlongChord(edge);
  const Vector2d normal(-axis.y(), axis.x());
  frame.length_px = (edge.back() - origin).dot(axis);
  for (const Vector2d& p : edge) {
    frame.along.push_back((p - origin).dot(axis) / frame.length_px);
    frame.across_px.push_back((p - origin).dot(normal));
  }
  return frame;
}

// Least squares of a cubic plus a bend k max(0, t - t0)^2 that sets in at t0: the tip's rounding.
struct BendFit {
  double squares = 0;
  double bend_px = 0;  // k
};

BendFit FitBend(const ChordFrame& edge, double t0) {
  Eigen::Matrix<double, kSmooth + 1, kSmooth + 1> normal;
  Eigen::Matrix<double, kSmooth + 1, 1> right;
  normal.setZero();
  right.setZero();
  double sum = 0;
  Eigen::Matrix<double, kSmooth + 1, 1> row;
  for (std::size_t i = 0; i < edge.along.size(); ++i) {
    const double t = edge.along[i];
    if (t < kProximalFrom) continue;
    const double d = std::max(0.0, t - t0);
    const double s = 2 * t - 1;
    row << 1, s, s * s, s * s * s, d * d;
    normal += row * row.transpose();
    right += row * edge.across_px[i];
    sum += edge.across_px[i] * edge.across_px[i];
  }
  normal.diagonal().array() += 1e-12 * normal.trace();  // without points beyond t0 there is no bend
  const Eigen::Matrix<double, kSmooth + 1, 1> c = normal.ldlt().solve(right);
  return {std::max(0.0, sum - c.dot(right)), c[kSmooth]};
}

// Where the edge leaves its smooth course.
DistalEnd FindBend(const std::vector<Vector2d>& edge, double sigma_px) {
  const ChordFrame frame = InChordFrame(edge);
  const double last = frame.along.back();
  const double step = std::max(0.25, frame.length_px / 1000) / frame.length_px;
  const BendFit straight = FitBend(frame, 2 * last);
  double best_t = last;
  double best = straight.squares;
  std::vector<double> places;
  std::vector<double> squares;
  for (double t = kEarliest; t < last; t += step) {
    const BendFit fit = FitBend(frame, t);
    places.push_back(t);
    squares.push_back(fit.squares);
    // A tip's radius is a fraction of the blade's width; a bend wider than a fifth of the length is
    // the edge's own curve.
    const double radius =
        frame.length_px / std::max(1e-9, 2 * std::abs(fit.bend_px) / frame.length_px);
    if (fit.squares < best && radius < 0.2 * frame.length_px) {
      best = fit.squares;
      best_t = t;
    }
  }
  // Neighbouring points are correlated: an improvement of that many squared sigmas may be chance.
  constexpr double kChance = 12;
  const double scatter = std::max(sigma_px, std::sqrt(best / static_cast<double>(edge.size())));
  if (straight.squares - best < kChance * scatter * scatter) best_t = last;
  double low = best_t;
  double high = best_t;
  for (std::size_t k = 0; k < squares.size(); ++k) {
    if (squares[k] > best + kChance * scatter * scatter) continue;
    low = std::min(low, places[k]);
    high = std::max(high, places[k]);
  }
  DistalEnd end;
  const auto after =
      std::find_if(frame.along.begin(), frame.along.end(), [&](double t) { return t >= best_t; });
  end.index = static_cast<std::size_t>(after - frame.along.begin());
  end.point_px = edge[std::min(end.index, edge.size() - 1)];
  end.along_sigma_px = std::max(0.5, 0.3 * (high - low) * frame.length_px);
  return end;
}

constexpr int kSomeLines = 8;

// So many lines do not end on an arc by chance, nor do fewer on one that is as round as tips are.
bool IsCertain(const TipCap& cap) {
  constexpr int kMany = 12;        // lines
  constexpr double kRound = 0.15;  // px of scatter
  return cap.seen >= kMany || (cap.seen >= kSomeLines && cap.scatter_px < kRound);
}

// Nor do some on one across which light changes as much as across the edge.
bool IsPlain(const TipCap& cap, double edge_step) {
  constexpr double kAsMuch = 0.7;  // of the edge's step
  return cap.seen >= kSomeLines && std::abs(cap.step) > kAsMuch * std::abs(edge_step);
}

// Where the tip's arc leaves the edge.
DistalEnd EndAtCap(const std::vector<Vector2d>& edge, const TipCap& cap, double along_sigma_px) {
  const Vector2d along = AlongChord(edge);
  const auto beyond = std::find_if(
      edge.begin(), edge.end(), [&](const Vector2d& p) { return (p - cap.end_px).dot(along) > 0; });
  return {cap.end_px, static_cast<std::size_t>(beyond - edge.begin()), along_sigma_px};
}

// `edge_step` as from FollowStep: an arc across which the picture steps the other way is rather
// that of a shadow.
DistalEnd EndAtSeenCap(const std::vector<Vector2d>& edge, const TipCap& cap, double edge_step) {
  // The arc's start is known to a few tenths of its radius: real tips are not quite round.
  DistalEnd end =
      EndAtCap(edge, cap, std::hypot(0.5, std::hypot(cap.scatter_px, 0.25 * cap.radius_px)));
  end.arc_seen = true;
  end.certain = IsCertain(cap) || IsPlain(cap, edge_step);
  end.evidence = cap.step * edge_step < 0 && !cap.in_shadow ? 0 : cap.Evidence();
  return end;
}

// How far before the presumed tip the edge is lost.
double LostBeforeTip(const std::vector<Vector2d>& edge, const Vector2d& tip_px) {
  return (tip_px - edge.back()).dot(AlongChord(edge));
}

// The end by the edge's own course or by what tips usually are, where no arc is seen.
DistalEnd EndWithoutCap(const std::vector<Vector2d>& edge,
                        const EndSearch& search,
                        const std::optional<Vector2d>& step_end_px) {
  const TipCap usual = UsualTipCap(edge, search.tip);
  const double usual_sigma_px = std::hypot(usual.radius_px, 0.5 * search.tip.reach_px);
  const DistalEnd bend = FindBend(edge, search.edge_sigma_px);
  // Far before the presumed tip, or where the step across the edge goes on far beyond it, a bend is
  // no tip.
  constexpr double kFar = 3;  // standard uncertainties of where tips usually begin
  const auto is_far_before = [&](const Vector2d& place_px) {
    return (place_px - bend.point_px).dot(AlongChord(edge)) > kFar * usual_sigma_px;
  };
  const bool goes_on = is_far_before(usual.end_px) || (step_end_px && is_far_before(*step_end_px));
  if (!goes_on && bend.along_sigma_px < usual_sigma_px) return bend;
  const double unseen_px = std::max(0.0, LostBeforeTip(edge, search.tip.tip_px));
  return EndAtCap(edge, usual, std::hypot(usual_sigma_px, 0.5 * unseen_px));
}

// Whether light changes so much less across an arc than across the edge that it is texture's. Where
// the edge does not stand out, texture's are faint arcs of few lines.
bool IsFaint(const TipCap& cap, double edge_step) {
  constexpr double kFaint = 0.15;    // slender tips reach 0.2
  constexpr double kFaintGrey = 12;  // twice what stands out from noise
  if (edge_step == 0) return std::abs(cap.step) < kFaintGrey && !IsCertain(cap);
  return std::abs(cap.step) < kFaint * std::abs(edge_step);
}

// Whether light changes across an arc as it does across the edge, and the arc is that of a tip.
bool IsLikeEdge(const TipCap& cap, double edge_step) {
  constexpr double kLeast = 0.7, kMost = 1.4;  // of the edge's step
  constexpr double kRound = 0.45;              // px of scatter
  constexpr double kSharp = 0.55;              // shadows end more softly
  const double share = cap.step / edge_step;
  return share > kLeast && share < kMost && cap.scatter_px < kRound && cap.sharpness > kSharp;
}

// The arc at another place than the presumed tip, if it is clear.
std::optional<TipCap> ClearCapAt(const Vector2d& place_px,
                                 const cv::Mat& grey,
                                 const std::vector<Vector2d>& edge,
                                 TipSearch search) {
  constexpr double kClearArc = 1;  // px of scatter
  search.tip_px = place_px;
  const std::optional<TipCap> cap = FitTipCap(grey, edge, search);
  return cap && cap->scatter_px < kClearArc ? cap : std::nullopt;
}

// An arc elsewhere than at the presumed tip, where the step across the edge ends: grain or a shadow
// may have been taken for metal, or a part of the blade for background.
std::optional<TipCap> FindRivalCap(const cv::Mat& grey,
                                   const std::vector<Vector2d>& edge,
                                   const TipSearch& presumed,
                                   const std::optional<Vector2d>& step_end_px) {
  if (!step_end_px || (*step_end_px - presumed.tip_px).norm() < presumed.reach_px)
    return std::nullopt;
  return ClearCapAt(*step_end_px, grey, edge, presumed);
}

// Whether the step across the edge goes on far beyond an arc, and not along its shadow: that is no
// tip's.
bool GoesOnBeyond(const TipCap& cap,
                  const std::vector<Vector2d>& edge,
                  const TipSearch& presumed,
                  const std::optional<Vector2d>& step_end_px) {
  constexpr double kFar = 1.5;  // times as far as the presumed tip may be off
  return step_end_px && !cap.in_shadow &&
         (*step_end_px - cap.end_px).dot(AlongChord(edge)) > kFar * presumed.reach_px;
}

// Arcs before the presumed tip, up to a blade's width, at which the picture steps as it does across
// the edge, and as sharply as asked: the presumed tip may be that of the blade's shadow.
std::vector<DistalEnd> EndsBefore(const cv::Mat& grey,
                                  const std::vector<Vector2d>& edge,
                                  const TipSearch& presumed,
                                  double edge_step,
                                  double least_sharpness) {
  const Vector2d along = AlongChord(edge);
  const auto places = static_cast<int>(std::ceil(presumed.blade_width_px / presumed.reach_px));
  const auto caps = ParallelMap(places, [&](int i) {
    const double back_px = (i + 1) * presumed.reach_px;
    return ClearCapAt(presumed.tip_px - back_px * along, grey, edge, presumed);
  });
  std::vector<DistalEnd> ends;
  for (const std::optional<TipCap>& cap : caps) {
    if (cap && cap->step * edge_step > 0 && cap->sharpness > least_sharpness)
      ends.push_back(EndAtSeenCap(edge, *cap, edge_step));
  }
  return ends;
}

// What denies that the blade ends where the step across its edge does, before the presumed tip: of
// a bright one, an arc at that tip at which light falls; of a dark one, that no arc like its edge
// is seen where the step ends.
bool IsDenied(const FollowedStep& followed,
              const std::optional<TipCap>& at_tip,
              const std::optional<TipCap>& at_step_end) {
  if (followed.step < 0) return at_tip && at_tip->step < 0;
  return !at_step_end || !IsLikeEdge(*at_step_end, followed.step);
}

// The ends of a blade that ends at a place before the presumed tip, which is that of its shadow.
DistalEnds EndsBeforeShadow(const cv::Mat& grey,
                            std::vector<Vector2d> edge,
                            EndSearch search,
                            const Vector2d& place_px) {
  const Vector2d along = AlongChord(edge);
  while (edge.size() > kFewestEdgePoints && (edge.back() - place_px).dot(along) > 0)
    edge.pop_back();
  search.tip.tip_px = place_px;
  return FindDistalEnds(grey, edge, search);
}

}  // namespace

DistalEnds FindDistalEnds(const cv::Mat& grey,
                          const std::vector<Vector2d>& edge,
                          const EndSearch& search) {
  constexpr double kClearArc = 2;                // px of scatter that is still a rounded end
  constexpr double kSoft = 0.5, kSharper = 1.4;  // of an arc; times as sharp
  if (edge.size() < kFewestEdgePoints) {
    const double length = edge.size() < 2 ? 1 : (edge.back() - edge.front()).norm();
    return {{edge.empty() ? Vector2d::Zero() : edge.back(), edge.size(), length}, {}};
  }
  std::optional<TipCap> cap;
  FollowedStep followed;
  ParallelFor(2, [&](int part) {
    if (part == 0) {
      cap = FitTipCap(grey, edge, search.tip);
    } else {
      followed = FollowStep(grey, edge, search.tip);
    }
  });
  const std::optional<TipCap> rival = FindRivalCap(grey, edge, search.tip, followed.end_px);
  if (followed.blade_ends && !IsDenied(followed, cap, rival))
    return EndsBeforeShadow(grey, edge, search, *followed.end_px);
  const bool clear = cap && cap->scatter_px < kClearArc && !IsFaint(*cap, followed.step);
  const auto and_rival = [&](std::vector<DistalEnd> ends) {
    if (rival) ends.push_back(EndAtSeenCap(edge, *rival, followed.step));
    return ends;
  };
  const auto before = [&](double least_sharpness) {
    return EndsBefore(grey, edge, search.tip, followed.step, least_sharpness);
  };
  if (clear && !rival && GoesOnBeyond(*cap, edge, search.tip, followed.end_px)) {
    EndSearch further = search;
    further.tip.tip_px = *followed.end_px;
    return {EndWithoutCap(edge, further, followed.end_px),
            {EndAtSeenCap(edge, *cap, followed.step)}};
  }
  if (clear) {
    const DistalEnd end = EndAtSeenCap(edge, *cap, followed.step);
    if (end.evidence == 0) return {end, and_rival(before(0))};
    // A soft arc may be a pale shadow's; the blade's own before it is sharp then.
    if (cap->sharpness < kSoft) return {end, and_rival(before(kSharper * cap->sharpness))};
    return {end, and_rival({})};
  }
  // Beyond the presumed tip there is blade as far as the step goes on; before it, a bevel may just
  // mirror the background.
  const bool beyond = rival && (rival->end_px - search.tip.tip_px).dot(AlongChord(edge)) > 0;
  if (rival && (beyond || IsCertain(*rival)))
    return {EndAtSeenCap(edge, *rival, followed.step), {}};
  return {EndWithoutCap(edge, search, followed.end_px), and_rival(before(0))};
}

}  // namespace bladecurve
