// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/torque_step.h"

#include <algorithm>
#include <cmath>

namespace bladecurve {
namespace {

// Strides along the path, so short that a level has at most one maximum within one.
constexpr double kLongestTurn_rad = 0.005;  // also what the work audit needs for 1e-9
constexpr double kLongestMove_mm = 1.0;
constexpr double kMostStrides = 256;
// Evaluations of phi a step may take; an ordinary one takes one to three.
constexpr int kMostEvaluations = 2000;
// Changes of mode within one step.
constexpr int kMostLegs = 16;

}  // namespace

TorqueStep::TorqueStep(const BladeCurve& blade,
                       const Material& material,
                       double plate_end_mm,
                       const TorqueOptions& options,
                       const MotionPath& path,
                       TorqueState& state,
                       EventLog& log) noexcept
    : blade_(blade),
      material_(material),
      plate_end_mm_(plate_end_mm),
      options_(options),
      path_(path),
      dtheta_rad_(path.theta_end_rad - path.theta_rad),
      dpivot_mm_(path.pivot_end_mm - path.pivot_mm),
      strides_(std::clamp(std::max(std::abs(dtheta_rad_) / kLongestTurn_rad,
                                   std::abs(dpivot_mm_) / kLongestMove_mm),
                          1.0,
                          kMostStrides)),
      state_(state),
      log_(log) {}

void TorqueStep::Run() noexcept {
  if (!state_.started) return RunFirstSample();
  leg_start_delta_mm_ = state_.tip.delta_mm;
  double s = 0;
  for (int leg = 0; leg < kMostLegs && s < 1; ++leg) s = RunLeg(s);
  if (s < 1) {
    flags_ |= kTorqueSearchShort;
    state_.tip = TipOfCrack(state_.crack_mm, 1);
  }
  Report();
}

void TorqueStep::RunFirstSample() noexcept {
  state_.started = true;
  state_.tip = TipOfCrack(state_.crack_mm, 1);
  if (state_.tip.delta_mm > 0) Log(TorqueEventKind::kContact, {1, state_.tip}, 0, 0);
  if (CuttingLevel(state_.tip, material_).value >= 0) {
    StartCutting(1);
    if (GrowthLevel(state_.tip).value > 0 && !SnapOutwards(1)) state_.mode = CutMode::kStuck;
  }
  Report();
}

double TorqueStep::RunLeg(double s) noexcept {
  switch (state_.mode) {
    case CutMode::kElastic:
      return ElasticLeg(s);
    case CutMode::kCutting:
      return CuttingLeg(s);
    case CutMode::kResting:
      return RestingLeg(s);
    case CutMode::kStuck:
      return StuckLeg();
    case CutMode::kThrough:
      break;
  }
  state_.tip = TipOfCrack(state_.crack_mm, 1);  // through: only the pivot still moves
  return 1;
}

double TorqueStep::ThetaAt(double s) const noexcept {
  return s == 1 ? path_.theta_end_rad : path_.theta_rad + s * dtheta_rad_;
}

double TorqueStep::PivotAt(double s) const noexcept {
  return s == 1 ? path_.pivot_end_mm : path_.pivot_mm + s * dpivot_mm_;
}

CrackTip TorqueStep::TipAt(double x_mm, double s) noexcept {
  ++evaluations_;
  return EvalCrackTip(blade_, material_, x_mm, ThetaAt(s));
}

CrackTip TorqueStep::TipOfCrack(double crack_mm, double s) noexcept {
  return TipAt(crack_mm - PivotAt(s), s);
}

// The end of the next stride: short in angle, in pivot motion and in motion of the crack tip.
double TorqueStep::NextStop(double s, double tip_speed_mm) noexcept {
  if (evaluations_ > kMostEvaluations) {
    flags_ |= kTorqueSearchShort;
    return 1;
  }
  const double strides =
      std::clamp(std::abs(tip_speed_mm) / kLongestMove_mm, strides_, kMostStrides);
  const double next = s + 1 / strides;
  constexpr double kSliver = 1e-9;  // of the path: joined to the stride before
  return next > 1 - kSliver ? 1 : next;
}

// Zero while the crack grows, positive where it has yet to.
Level TorqueStep::GrowthLevel(const CrackTip& tip) const noexcept {
  if (options_.delta_policy == DeltaPolicy::kCriterion) return CuttingLevel(tip, material_);
  return {tip.delta_mm - state_.delta_c_mm, -tip.edge.phi_x, -tip.edge.phi_theta_mm_per_rad};
}

// Of a level, over s, with the crack at rest in the plate.
Rate TorqueStep::AlongPath(const Level& level) const noexcept {
  return {level.value, level.dtheta * dtheta_rad_ - level.dx * dpivot_mm_};
}

// dx/ds of the growing crack, from the pivot.
double TorqueStep::TipSpeed(const CrackTip& tip) const noexcept {
  const Level level = GrowthLevel(tip);
  return level.dx < 0 ? -level.dtheta * dtheta_rad_ / level.dx : 0;
}

double TorqueStep::ElasticLeg(double s) noexcept {
  const auto loading = [this](double at) noexcept {
    return AlongPath(CuttingLevel(TipOfCrack(state_.crack_mm, at), material_));
  };
  Rate here = AlongPath(CuttingLevel(state_.tip, material_));
  while (s < 1) {
    const double next = NextStop(s, 0);
    const CrackTip ahead = TipOfCrack(state_.crack_mm, next);
    const Rate there = AlongPath(CuttingLevel(ahead, material_));
    if (const std::optional<double> start = FirstReach(loading, s, here, next, there)) {
      const CrackTip tip = TipOfCrack(state_.crack_mm, *start);
      NoteContact({s, state_.tip}, {*start, tip});
      state_.tip = tip;
      StartCutting(*start);
      return *start;
    }
    NoteContact({s, state_.tip}, {next, ahead});
    state_.tip = ahead;
    here = there;
    s = next;
  }
  return 1;
}

double TorqueStep::CuttingLeg(double s) noexcept {
  while (s < 1) {
    const double speed = TipSpeed(state_.tip);
    if (speed + dpivot_mm_ < 0) {
      StopCutting(s);
      return s;
    }
    const Waypoint from{s, state_.tip};
    std::optional<Waypoint> ahead = FollowEdgeAsFarAsPossible(from, NextStop(s, speed));
    if (!ahead) {
      LoseEdge(s);
      return s;
    }
    const bool turns = TipSpeed(ahead->tip) + dpivot_mm_ < 0;
    if (turns) ahead = TurningPoint(from, *ahead);
    const double crack_mm = ahead->tip.x_mm + PivotAt(ahead->s);
    if (crack_mm >= plate_end_mm_) return ReachPlateEnd(from, ahead->s);
    BookCut(from, *ahead);
    state_.crack_mm = std::max(state_.crack_mm, crack_mm);
    state_.tip = ahead->tip;
    s = ahead->s;
    if (turns) {
      StopCutting(s);
      return s;
    }
  }
  return 1;
}

// Ends where the blade comes back to delta_c (cutting) or the load falls below the criterion
// (elastic).
double TorqueStep::RestingLeg(double s) noexcept {
  const auto regrowth = [this](double at) noexcept {
    return AlongPath(GrowthLevel(TipOfCrack(state_.crack_mm, at)));
  };
  const auto unloading = [this](double at) noexcept {
    const Rate loading = AlongPath(CuttingLevel(TipOfCrack(state_.crack_mm, at), material_));
    return Rate{-loading.value, -loading.slope};
  };
  while (s < 1) {
    const double next = NextStop(s, 0);
    const double regrown = FirstReach(regrowth, s, regrowth(s), next, regrowth(next)).value_or(2);
    const double unloaded =
        FirstReach(unloading, s, unloading(s), next, unloading(next)).value_or(2);
    s = std::min({regrown, unloaded, next});
    state_.tip = TipOfCrack(state_.crack_mm, s);
    if (s == regrown) {
      state_.mode = CutMode::kCutting;
      return s;
    }
    if (s == unloaded) {
      StopCutting(s);
      return s;
    }
  }
  return 1;
}

double TorqueStep::StuckLeg() noexcept {
  state_.tip = TipOfCrack(state_.crack_mm, 1);
  if (GrowthLevel(state_.tip).value < 0) {
    state_.mode = CutMode::kElastic;
  } else if (SnapOutwards(1) && state_.mode != CutMode::kThrough) {
    state_.mode = CutMode::kCutting;
  }
  return 1;
}

}  // namespace bladecurve
