// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "vision/parallel.h"
#include "vision/pivot/screw_refinement.h"
#include "vision/pivot/screw_search.h"
#include "vision/pivot/screw_slot.h"

namespace bladecurve {
namespace {

void Require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("FindScrew: " + what);
}

void Validate(const cv::Mat& grey, const ScrewSearch& search) {
  Require(grey.type() == CV_8UC1 && !grey.empty(), "the picture must be CV_8UC1 and not empty");
  Require(search.guess_px.allFinite(), "guess_px must be finite");
  Require(search.radius_px > 0 && std::isfinite(search.radius_px), "radius_px must be positive");
  Require(search.min_semi_axis_px > 0, "min_semi_axis_px must be positive");
  Require(
      search.max_semi_axis_px >= search.min_semi_axis_px && std::isfinite(search.max_semi_axis_px),
      "max_semi_axis_px must be finite and not below min_semi_axis_px");
}

// Whether both are rims of the same head, but not the same rim.
bool Rivals(const RimEllipse& a, const RimEllipse& b) {
  constexpr double kSameRim = 0.04;  // of the radius, between the centres
  return OfOneHead(a, b) && (a.center - b.center).norm() > kSameRim * a.MeanRadius();
}

// The centre where several rims compete for one head (a bevelled edge, a lit recess round it):
// their mean by the odds that their evidence gives them, and how far they part.
struct WeighedCenter {
  Eigen::Vector2d center;
  Eigen::Matrix2d spread;  // px^2
};

// The best and those that compete with it.
std::vector<const FoundRim*> Competitors(const std::vector<FoundRim>& all) {
  constexpr double kUnlikely = 3;  // less evidence than the best has: odds of 20 to 1
  std::vector<const FoundRim*> rims{&all.front()};
  for (const FoundRim& found : all) {
    const double behind = all.front().preference - found.preference;
    if (behind > kUnlikely) break;
    const bool differs = std::all_of(rims.begin(), rims.end(), [&](const FoundRim* rim) {
      return Rivals(rim->fit.rim, found.fit.rim);
    });
    if (differs) rims.push_back(&found);
  }
  return rims;
}

WeighedCenter WeighCenters(const std::vector<const FoundRim*>& rims,
                           const std::vector<RimFit>& refined) {
  std::vector<double> weights;
  for (const FoundRim* rim : rims)
    weights.push_back(std::exp(rim->preference - rims.front()->preference));
  double total = 0;
  WeighedCenter weighed{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  for (std::size_t i = 0; i < rims.size(); ++i) {
    weighed.center += weights[i] * refined[i].rim.center;
    total += weights[i];
  }
  weighed.center /= total;
  for (std::size_t i = 0; i < rims.size(); ++i) {
    const Eigen::Vector2d off = refined[i].rim.center - weighed.center;
    weighed.spread += weights[i] / total * off * off.transpose();
  }
  return weighed;
}

// What a slot adds to the evidence of a rim: across shanks, grain and cloth hardly ever runs a dark
// bar from end to end of what looks nearly round.
double SlotEvidence(const std::optional<ScrewSlot>& slot) {
  constexpr double kSlotted = 2;
  return slot && slot->ends_seen ? kSlotted : 0;
}

}  // namespace

std::optional<Screw> FindScrew(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const ScrewSearch& search) {
  Validate(grey, search);
  const cv::Rect2d picture(-0.5, -0.5, grey.cols, grey.rows);
  if (!picture.contains({search.guess_px.x(), search.guess_px.y()})) return std::nullopt;
  const std::vector<FoundRim> all = FindRims(grey, search);
  if (all.empty()) return std::nullopt;
  const FoundRim& best = all.front();
  const double lacking = search.least_evidence - best.evidence;
  Screw screw;
  if (lacking > 0) {
    screw.slot = FindSlot(grey, tone, best.fit.rim.center, best.fit.rim.MeanRadius());
    if (lacking > SlotEvidence(screw.slot)) return std::nullopt;
  }
  const std::vector<const FoundRim*> rims = Competitors(all);
  const std::vector<RimFit> refined = ParallelMap(static_cast<int>(rims.size()), [&](int i) {
    return RefineRim(grey, tone, rims[static_cast<std::size_t>(i)]->fit, search.view);
  });
  const RimFit& fit = refined.front();
  const WeighedCenter weighed = WeighCenters(rims, refined);
  screw.center_px = weighed.center;
  screw.covariance_px2 = fit.center_covariance + weighed.spread;
  screw.semi_major_px = fit.rim.SemiAxes()[1];
  screw.semi_minor_px = fit.rim.SemiAxes()[0];
  screw.angle_rad = fit.rim.MajorAngle();
  screw.support = best.fit.support;
  screw.third_support = best.fit.third_support;
  screw.evidence = best.evidence;
  if (lacking <= 0) screw.slot = FindSlot(grey, tone, screw.center_px, fit.rim.MeanRadius());
  return screw;
}

}  // namespace bladecurve
