// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// How the crack grows along the edge, where that begins and ends, and what a step reports.
#include <algorithm>
#include <cmath>

#include "model/torque_step.h"

namespace bladecurve {
namespace {

// Moves along the edge must be small beside the waves of a blade's edge: else another contact is
// met.
constexpr double kLongestContactMove_mm = 2.0;
constexpr int kMostNewtonSteps = 12;
// Relative change of x at which Newton has converged: some rounding errors of phi.
constexpr double kNewtonTolerance = 1e-13;
// A stride is halved this often before the edge counts as lost: to a millionth of it.
constexpr int kMostHalvings = 20;
// The turning point is where the crack is furthest: an error of s enters its length squared.
constexpr int kMostTurningSteps = 48;
constexpr double kTurningTolerance = 1e-10;
// Samples of the way to the end of the blade when the crack jumps to its next contact.
constexpr int kSnapSamples = 128;
// Where so small a share of the torque is left, a crack tip that gets lost has run off the blade's
// end; the share falls with the square of the distance, this one to nothing within the distance
// below.
constexpr double kOffBlade = 1e-6;
constexpr double kOffBlade_mm = 1e-3;

}  // namespace

// The crack tip at `next` on the same branch of contacts. None: the branch ends before, or the
// stride is too long.
std::optional<CrackTip> TorqueStep::FollowEdge(const Waypoint& from, double next) noexcept {
  const double predicted_mm = from.tip.x_mm + TipSpeed(from.tip) * (next - from.s);
  if (std::abs(predicted_mm - from.tip.x_mm) > kLongestContactMove_mm) return std::nullopt;
  double x_mm = predicted_mm;
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    const CrackTip tip = TipAt(x_mm, next);
    const Level level = GrowthLevel(tip);
    if (!tip.can_cut || level.dx >= 0) return std::nullopt;
    const double step_mm = -level.value / level.dx;
    if (std::abs(step_mm) <= kNewtonTolerance * x_mm) return tip;
    x_mm += step_mm;
    if (std::abs(x_mm - predicted_mm) > kLongestContactMove_mm) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<TorqueStep::Waypoint> TorqueStep::FollowEdgeAsFarAsPossible(const Waypoint& from,
                                                                          double next) noexcept {
  double stride = next - from.s;
  for (int i = 0; i < kMostHalvings; ++i) {
    if (const std::optional<CrackTip> tip = FollowEdge(from, next)) return Waypoint{next, *tip};
    stride *= 0.5;
    next = from.s + stride;
  }
  return std::nullopt;
}

// Where the crack is furthest between `from`, where it grows, and `beyond`, where it would shrink:
// false position (Illinois) on its speed.
TorqueStep::Waypoint TorqueStep::TurningPoint(const Waypoint& from,
                                              const Waypoint& beyond) noexcept {
  Waypoint low = from;
  double high = beyond.s;
  double speed_low = TipSpeed(from.tip) + dpivot_mm_;
  double speed_high = TipSpeed(beyond.tip) + dpivot_mm_;
  for (int i = 0; i < kMostTurningSteps && high - low.s > kTurningTolerance; ++i) {
    const double s =
        std::clamp(low.s + (high - low.s) * speed_low / (speed_low - speed_high), low.s, high);
    const std::optional<CrackTip> tip = FollowEdge(from, s);
    if (!tip) break;
    const double speed = TipSpeed(*tip) + dpivot_mm_;
    if (speed >= 0) {
      low = {s, *tip};
      speed_low = speed;
      speed_high *= 0.5;
      if (speed == 0) break;
    } else {
      high = s;
      speed_high = speed;
      speed_low *= 0.5;
    }
  }
  return low;
}

void TorqueStep::StartCutting(double s) noexcept {
  Log(TorqueEventKind::kCutStart,
      {s, state_.tip},
      ElasticTorque(state_.tip, material_),
      state_.tip.cut_torque_nmm);
  state_.delta_c_mm = state_.tip.delta_mm;
  state_.mode = CutMode::kCutting;
}

// The blade goes back. Where the plate is loaded beyond the criterion nevertheless, the crack rests
// in it.
void TorqueStep::StopCutting(double s) noexcept {
  const bool overloaded = CuttingLevel(state_.tip, material_).value > 0;
  if (options_.delta_policy == DeltaPolicy::kConstant && state_.mode == CutMode::kCutting &&
      overloaded) {
    state_.mode = CutMode::kResting;
    return;
  }
  Log(TorqueEventKind::kCutStop,
      {s, state_.tip},
      state_.tip.cut_torque_nmm,
      ElasticTorque(state_.tip, material_));
  leg_start_delta_mm_ = state_.tip.delta_mm;
  state_.mode = CutMode::kElastic;
}

// The branch of contacts that the crack followed ends at s.
void TorqueStep::LoseEdge(double s) noexcept {
  if (state_.tip.on_blade < kOffBlade) {
    Log(TorqueEventKind::kBladeEnd, {s, state_.tip}, 0, 0);
    state_.crack_mm += kOffBlade_mm;
    state_.tip = TipOfCrack(state_.crack_mm, s);
    leg_start_delta_mm_ = state_.tip.delta_mm;
    state_.mode = CutMode::kElastic;
  } else if (!SnapOutwards(s)) {
    state_.mode = CutMode::kStuck;
  }
}

// Moves the crack at once to the next place outwards where it is in equilibrium, or through the
// plate if that ends before. False: there is none up to the end of the blade, and the crack stays.
bool TorqueStep::SnapOutwards(double s) noexcept {
  const auto equilibrium = [this, s](double x_mm) noexcept {
    const CrackTip tip = TipAt(x_mm, s);
    const Level level = GrowthLevel(tip);
    return tip.can_cut ? Rate{-level.value, -level.dx} : Rate{-1, 0};
  };
  const double plate_end_mm = plate_end_mm_ - PivotAt(s);
  const double end_mm = std::min(plate_end_mm, blade_.domain().x_max_mm);
  double a = state_.tip.x_mm;
  Rate at_a{-1, 0};
  const double stride = (end_mm - a) / kSnapSamples;
  std::optional<double> x_mm;
  for (int i = 0; i < kSnapSamples && !x_mm && stride > 0; ++i) {
    const double b = a + stride;
    const Rate at_b = equilibrium(b);
    x_mm = FirstReach(equilibrium, a, at_a, b, at_b);
    a = b;
    at_a = at_b;
  }
  if (!x_mm && end_mm < plate_end_mm) return false;
  const double before_nmm = state_.output.torque_nmm;
  state_.tip = TipAt(x_mm.value_or(plate_end_mm), s);
  const double crack_mm = state_.tip.x_mm + PivotAt(s);
  state_.ledger.snapped_mm += std::max(0.0, crack_mm - state_.crack_mm);
  state_.crack_mm = std::max(state_.crack_mm, crack_mm);
  if (!x_mm) state_.mode = CutMode::kThrough;
  Log(x_mm ? TorqueEventKind::kSnap : TorqueEventKind::kThrough,
      {s, state_.tip},
      before_nmm,
      x_mm ? state_.tip.cut_torque_nmm : 0);
  return true;
}

// Between `from` and `next` the crack comes to the end of the plate: returns where.
double TorqueStep::ReachPlateEnd(const Waypoint& from, double next) noexcept {
  const auto growth = [this](double at) noexcept {
    return AlongPath(GrowthLevel(TipOfCrack(plate_end_mm_, at)));
  };
  const double s = RootInBracket(growth, from.s, next);
  const Waypoint end{s, TipOfCrack(plate_end_mm_, s)};
  BookCut(from, end);
  Log(TorqueEventKind::kThrough, end, end.tip.on_blade * end.tip.cut_torque_nmm, 0);
  state_.crack_mm = plate_end_mm_;
  state_.tip = end.tip;
  state_.mode = CutMode::kThrough;
  return s;
}

// Adds the work of a stretch of cutting: trapezoidal rule with end corrections (error ~ stride^5).
void TorqueStep::BookCut(const Waypoint& from, const Waypoint& to) noexcept {
  if (from.tip.on_blade < 1 || to.tip.on_blade < 1) return;
  const auto torque_rate = [this](const CrackTip& tip) noexcept {
    return tip.cut_torque_x_n * TipSpeed(tip) + tip.cut_torque_theta_nmm * dtheta_rad_;
  };
  const double stride = to.s - from.s;
  const double mean_nmm = 0.5 * (from.tip.cut_torque_nmm + to.tip.cut_torque_nmm) +
                          stride / 12 * (torque_rate(from.tip) - torque_rate(to.tip));
  state_.ledger.cut_work_nmm -= mean_nmm * dtheta_rad_ * stride;
  state_.ledger.cut_turn_rad -= dtheta_rad_ * stride;
  state_.ledger.pivot_advance_mm += dpivot_mm_ * stride;
  state_.ledger.cut_length_mm += to.tip.x_mm - from.tip.x_mm + dpivot_mm_ * stride;
}

// Logs where the blade touched or left the plate between two points.
void TorqueStep::NoteContact(const Waypoint& from, const Waypoint& to) noexcept {
  const bool touched = from.tip.delta_mm > 0;
  const bool touches = to.tip.delta_mm > 0;
  if (touched == touches) return;
  const double sign = touches ? 1 : -1;
  const auto deflection = [this, sign](double at) noexcept {
    const CrackTip tip = TipOfCrack(state_.crack_mm, at);
    const Rate rate = AlongPath({tip.delta_mm, -tip.edge.phi_x, -tip.edge.phi_theta_mm_per_rad});
    return Rate{sign * rate.value, sign * rate.slope};
  };
  const double s = RootInBracket(deflection, from.s, to.s);
  const TorqueEventKind kind = touches ? TorqueEventKind::kContact : TorqueEventKind::kRelease;
  Log(kind, {s, TipOfCrack(state_.crack_mm, s)}, 0, 0);
}

void TorqueStep::Log(TorqueEventKind kind,
                     const Waypoint& where,
                     double before_nmm,
                     double after_nmm) noexcept {
  if (log_.count == log_.events.size()) return;
  log_.events[log_.count++] = {
      kind, where.s, ThetaAt(where.s), PivotAt(where.s), where.tip.x_mm, before_nmm, after_nmm};
}

}  // namespace bladecurve
