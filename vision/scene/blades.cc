// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/blades.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/image/cross.h"
#include "vision/image/nearest_pixel.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

struct GradePart {
  double grade;
  const char* doubt;
};

void Apply(std::initializer_list<GradePart> parts, BladePair* pair) {
  for (const GradePart& part : parts) ApplyGrade(part.grade, part.doubt, pair);
}

// How much the two limbs beside the gap look like blades.
void GradeBlades(BladePair* pair) {
  const BladeContour& a = pair->first;
  const BladeContour& b = pair->second;
  const double longer = std::max(a.length, b.length);
  const double wider = std::max(a.width, b.width);
  Apply({{Grade(std::max(a.roughness, b.roughness), 0.02, 0.08), "an edge is not smooth"},
         {Grade(std::max(a.bend, b.bend), 0.08, 0.22), "a blade is strongly bent"},
         {Grade(wider / std::max(1.0, std::min(a.width, b.width)), 2.5, 5.0),
          "the blades differ in width"}},
        pair);
  if (a.cut_off || b.cut_off) return;  // their ends are out of the picture
  Apply({{Grade(std::max(a.taper, b.taper), 1.0, 1.5), "a blade widens towards its end"},
         {Grade(1 - std::min(a.length, b.length) / longer, 0.25, 0.55),
          "the blades differ in length"}},
        pair);
}

// The ends of the four limbs, as indices into the contour and as points.
struct Ends {
  int tip_first_at = 0, tip_second_at = 0, shank_first_at = 0, shank_second_at = 0;
  Vector2d tip_first, tip_second, shank_first, shank_second;
};

// Clockwise: back, shank of the second blade, first blade, gap, second blade, shank of the first,
// back. std::nullopt where a limb has no length.
std::optional<Ends> FindEnds(const Outline& outline, const Crotches& at) {
  constexpr double kShortest = 8;  // px, of a blade
  const int gap = at.blades, back = at.shanks;
  const Vector2d crotch = outline.At(gap), shank_crotch = outline.At(back);
  const Vector2d axis = (crotch - shank_crotch).normalized();
  Ends ends;
  ends.tip_first_at = LimbEnd(outline, gap, back, Way::kBack, axis);
  ends.tip_second_at = LimbEnd(outline, gap, back, Way::kOn, axis);
  if (std::min(ends.tip_first_at, ends.tip_second_at) < 0) return std::nullopt;
  ends.tip_first = outline.At(ends.tip_first_at);
  ends.tip_second = outline.At(ends.tip_second_at);
  if (std::min((ends.tip_first - crotch).norm(), (ends.tip_second - crotch).norm()) < kShortest)
    return std::nullopt;
  ends.shank_first_at = LimbEnd(outline, back, gap, Way::kBack, -axis);
  ends.shank_second_at = LimbEnd(outline, back, gap, Way::kOn, -axis);
  if (std::min(ends.shank_first_at, ends.shank_second_at) < 0) return std::nullopt;
  ends.shank_first = outline.At(ends.shank_first_at);
  ends.shank_second = outline.At(ends.shank_second_at);
  return ends;
}

// Whether each blade goes on, through the crossing, as the opposite shank.
void GradeLayout(const Ends& ends, BladePair* pair) {
  const Vector2d center = 0.5 * (pair->crotch + *pair->shank_crotch);
  const auto straightness = [&](const Vector2d& tip, const Vector2d& shank) {
    return -(tip - center).normalized().dot((shank - center).normalized());
  };
  const double straight = std::min(straightness(ends.tip_first, ends.shank_first),
                                   straightness(ends.tip_second, ends.shank_second));
  const double blade =
      std::max((ends.tip_first - pair->crotch).norm(), (ends.tip_second - pair->crotch).norm());
  Apply({{Grade(-straight, -0.88, -0.55), "blades and shanks do not line up"},
         {Grade((pair->crotch - *pair->shank_crotch).norm() / blade, 3.0, 5.0),
          "the blades are short against their overlap"}},
        pair);
}

// Whether the rest is what blades hang on.
void GradeShanks(const ShankEnd& shank_first, const ShankEnd& shank_second, BladePair* pair) {
  // A shank that tapers to the frame has no ring beyond it.
  const auto ring = [](const ShankEnd& shank) {
    return shank.cut_off ? 0.9 - 0.3 * Grade(shank.flare, 0.5, 0.7)
                         : 1 - Grade(shank.flare, 1.0, 1.6) * 0.8;
  };
  // What runs out of sight may go on as long as it likes.
  const auto reach = [](const ShankEnd& shank) { return shank.cut_off ? 1e9 : shank.length; };
  const double shorter_shank = std::min(reach(shank_first), reach(shank_second));
  const double blade = std::max(pair->first.length, pair->second.length);
  Apply({{ring(shank_first) * ring(shank_second), "no rings"},
         {0.3 + 0.7 * Grade(-shorter_shank / blade, -0.8, -0.2), "a shank is short"}},
        pair);
}

// Width of the silhouette across `axis` through `center`, and the middle of that width.
std::pair<double, Vector2d> SpanAcross(const cv::Mat& filled,
                                       const Vector2d& center,
                                       const Vector2d& axis) {
  const Vector2d across(-axis.y(), axis.x());
  const auto reach = [&](double sign) {
    double d = 0;
    for (; d < filled.cols + filled.rows; d += 0.5) {
      if (!IsSetAt(filled, center + sign * d * across)) break;
    }
    return d;
  };
  const double up = reach(1);
  const double down = reach(-1);
  return {up + down, center + 0.5 * (up - down) * across};
}

// Where the members cross: the silhouette is narrowest there, between crotch and shank crotch.
void PlacePivot(const cv::Mat& filled, BladePair* pair) {
  const Vector2d back = *pair->shank_crotch;
  const Vector2d overlap = pair->crotch - back;
  const Vector2d axis = overlap.normalized();
  // Joints put their screws a fifth to three fifths of the way; beyond, where a shadow fills the
  // gap between them, the blades taper and are narrower than any waist.
  constexpr double kFrom = 0.1;
  constexpr double kTo = 0.65;
  constexpr int kSteps = 45;
  std::vector<double> widths;
  std::vector<Vector2d> centers;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = kFrom + (kTo - kFrom) * k / kSteps;
    const auto [width, center] = SpanAcross(filled, back + t * overlap, axis);
    widths.push_back(width);
    centers.push_back(center);
  }
  const double narrowest = *std::min_element(widths.begin(), widths.end());
  // The waist is flat where the members cross at a small angle: take the middle of all that is
  // nearly as narrow.
  double sum = 0;
  double spread = 0;
  Vector2d mean = Vector2d::Zero();
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const double weight = std::max(0.0, 1.12 * narrowest + 1 - widths[k]);
    sum += weight;
    mean += weight * centers[k];
  }
  mean /= sum;
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const double weight = std::max(0.0, 1.12 * narrowest + 1 - widths[k]);
    spread += weight * std::pow((centers[k] - mean).dot(axis), 2);
  }
  pair->shank_width = narrowest;
  // On scissors with a known screw the waist is off by 7 % of the overlap, rms; more where a shaped
  // joint moves it away from the middle.
  const double length = overlap.norm(), middle = 0.5 * length, waist = (mean - back).dot(axis);
  const double sigma =
      std::max({0.1 * narrowest, 0.07 * length, std::sqrt(spread / sum), std::abs(waist - middle)});
  constexpr double kUsualSpread = 0.13;  // before any waist is seen
  const double of_waist = 1 / (sigma * sigma), of_usual = std::pow(kUsualSpread * length, -2);
  const double along = (of_waist * waist + of_usual * kUsualPivot * length) / (of_waist + of_usual);
  pair->pivot = mean + (along - waist) * axis;
  pair->pivot_sigma = 1 / std::sqrt(of_waist + of_usual);
}

// The part of a blade's far side that faces the tip: from the tip back to beside the crotch.
std::vector<Vector2d> AheadOf(std::vector<Vector2d> arc,
                              const Vector2d& crotch,
                              const Vector2d& axis) {
  const auto behind = std::find_if(
      arc.begin(), arc.end(), [&](const Vector2d& p) { return (p - crotch).dot(axis) < 0; });
  arc.erase(behind, arc.end());
  return arc;
}

// A shank's outer side from the joint on, of a blade's far side that goes on to the shank's end;
// the second half, where rings begin, left out.
std::vector<Vector2d> ShankBehind(const std::vector<Vector2d>& arc,
                                  const Vector2d& shank_crotch,
                                  const Vector2d& axis) {
  constexpr double kBeforeRing = 0.5;  // of the way to the shank's end
  const double end = (arc.back() - shank_crotch).dot(axis);
  std::vector<Vector2d> side;
  for (const Vector2d& p : arc) {
    const double along = (p - shank_crotch).dot(axis);
    if (along < kBeforeRing * end) break;
    if (along < 0) side.push_back(p);
  }
  return side;
}

void DescribeBlades(const Silhouette& silhouette,
                    const Crotches& at,
                    const Ends& ends,
                    BladePair* pair) {
  const Outline outline(silhouette.contour);
  const Vector2d axis = (pair->crotch - *pair->shank_crotch).normalized();
  std::vector<Vector2d> inner_first = outline.Arc(ends.tip_first_at, at.blades);
  std::reverse(inner_first.begin(), inner_first.end());
  std::vector<Vector2d> outer_first = outline.Arc(ends.shank_second_at, ends.tip_first_at);
  std::reverse(outer_first.begin(), outer_first.end());
  std::vector<Vector2d> outer_second = outline.Arc(ends.tip_second_at, ends.shank_first_at);
  std::vector<Vector2d> shank_first = ShankBehind(outer_second, *pair->shank_crotch, axis);
  std::vector<Vector2d> shank_second = ShankBehind(outer_first, *pair->shank_crotch, axis);
  pair->first = DescribeBlade(
      silhouette, std::move(inner_first), AheadOf(std::move(outer_first), pair->crotch, axis));
  pair->second = DescribeBlade(silhouette,
                               outline.Arc(at.blades, ends.tip_second_at),
                               AheadOf(std::move(outer_second), pair->crotch, axis));
  pair->first.shank = std::move(shank_first);
  pair->second.shank = std::move(shank_second);
}

}  // namespace

double Grade(double value, double good, double bad) {
  return std::clamp((bad - value) / (bad - good), 0.0, 1.0);
}

void ApplyGrade(double grade, const char* doubt, BladePair* pair) {
  pair->quality *= grade;
  if (grade >= pair->worst_grade) return;
  pair->worst_grade = grade;
  pair->doubt = doubt;
}

std::optional<BladePair> FindBladePairAt(const Silhouette& silhouette,
                                         const cv::Mat& hidden,
                                         const Crotches& at) {
  const Outline outline(silhouette.contour);
  const std::optional<Ends> ends = FindEnds(outline, at);
  if (!ends) return std::nullopt;
  const int back = at.shanks;
  BladePair pair;
  pair.quality = 1;
  pair.crotch = outline.At(at.blades);
  pair.shank_crotch = outline.At(back);
  pair.shank_first = ends->shank_first;
  pair.shank_second = ends->shank_second;
  GradeLayout(*ends, &pair);
  if (pair.quality <= 0) return std::nullopt;  // most inlets: they need no closer look
  DescribeBlades(silhouette, at, *ends, &pair);
  GradeBlades(&pair);
  if (pair.quality <= 0) return std::nullopt;
  const std::vector<Vector2d> first = outline.Arc(ends->tip_second_at, back);
  const std::vector<Vector2d> second = outline.Arc(back, ends->tip_first_at);
  const ShankEnd shank_first =
      DescribeShank(silhouette, hidden, first, ends->shank_first, *pair.shank_crotch);
  const ShankEnd shank_second =
      DescribeShank(silhouette, hidden, second, ends->shank_second, *pair.shank_crotch);
  GradeShanks(shank_first, shank_second, &pair);
  pair.shanks_run_out = shank_first.cut_off && shank_second.cut_off;
  if (pair.quality <= 0) return std::nullopt;
  PlacePivot(silhouette.filled, &pair);
  const double wider = std::max(pair.first.width, pair.second.width);
  // Length from the pivot: a shadow may fill the gap and move the crotch, not the pivot.
  const double length =
      std::min((pair.first.tip - pair.pivot).norm(), (pair.second.tip - pair.pivot).norm());
  Apply({{Grade(-pair.shank_width / std::max(1.0, wider), -0.6, -0.25), "the blades do not join"},
         {Grade(wider / length, 0.35, 0.60), "a limb is too wide for a blade"}},
        &pair);
  return pair;
}

std::vector<BladePair> FindBladePairs(const Silhouette& silhouette, const cv::Mat& hidden) {
  constexpr std::size_t kMostInlets = 8;
  const std::vector<Inlet> inlets = DeepestInlets(silhouette.contour, kMostInlets);
  const auto of_gaps = ParallelMap(static_cast<int>(inlets.size()), [&](int gap) {
    const Inlet& front = inlets[static_cast<std::size_t>(gap)];
    std::vector<BladePair> of_gap;
    for (const Inlet& back : inlets) {
      if (&back == &front) continue;
      std::optional<BladePair> pair = FindBladePairAt(silhouette, hidden, {front.far, back.far});
      if (pair) of_gap.push_back(std::move(*pair));
    }
    return of_gap;
  });
  std::vector<BladePair> pairs;
  for (const std::vector<BladePair>& of_gap : of_gaps)
    pairs.insert(pairs.end(), of_gap.begin(), of_gap.end());
  std::sort(pairs.begin(), pairs.end(), [](const BladePair& a, const BladePair& b) {
    return Likelihood(a) > Likelihood(b);
  });
  return pairs;
}

double Likelihood(const BladePair& pair) {
  constexpr double kCutOff = 0.5;
  return (RunsOut(pair) ? kCutOff : 1) * pair.quality;
}

bool RunsOut(const BladePair& pair) { return pair.first.cut_off || pair.second.cut_off; }

double TurnAtJoint(const BladePair& pair) {
  const auto bisector = [&](const Vector2d& a, const Vector2d& b) {
    return ((a - pair.pivot).normalized() + (b - pair.pivot).normalized()).eval();
  };
  const auto shorter = [&](const Vector2d& a, const Vector2d& b) {
    return std::min((a - pair.pivot).norm(), (b - pair.pivot).norm());
  };
  if (shorter(pair.shank_first, pair.shank_second) < shorter(pair.first.tip, pair.second.tip))
    return 0;
  const Vector2d blades = bisector(pair.first.tip, pair.second.tip);
  const Vector2d shanks = -bisector(pair.shank_first, pair.shank_second);
  return std::abs(std::atan2(Cross(shanks, blades), shanks.dot(blades)));
}

}  // namespace bladecurve
