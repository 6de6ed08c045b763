// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "model/blade_curve.h"
#include "model/event_search.h"
#include "model/plate.h"
#include "model/torque_state.h"

namespace bladecurve {

// The straight way from one sample to the next: s from 0 to 1.
struct MotionPath {
  double theta_rad = 0, pivot_mm = 0;          // at s = 0
  double theta_end_rad = 0, pivot_end_mm = 0;  // at s = 1
};

// One step of the torque model: follows the path from event to event, each in a leg of its own, and
// changes `state` and `log` accordingly. Lives for the length of one call; real-time safe.
class TorqueStep {
 public:
  TorqueStep(const BladeCurve& blade,
             const Material& material,
             double plate_end_mm,
             const TorqueOptions& options,
             const MotionPath& path,
             TorqueState& state,
             EventLog& log) noexcept;

  void Run() noexcept;

 private:
  // Where on the path, and the crack tip there.
  struct Waypoint {
    double s = 0;
    CrackTip tip;
  };

  [[nodiscard]] double ThetaAt(double s) const noexcept;
  [[nodiscard]] double PivotAt(double s) const noexcept;
  [[nodiscard]] CrackTip TipAt(double x_mm, double s) noexcept;
  [[nodiscard]] CrackTip TipOfCrack(double crack_mm, double s) noexcept;
  [[nodiscard]] double NextStop(double s, double tip_speed_mm) noexcept;

  [[nodiscard]] Level GrowthLevel(const CrackTip& tip) const noexcept;
  [[nodiscard]] Rate AlongPath(const Level& level) const noexcept;
  [[nodiscard]] double TipSpeed(const CrackTip& tip) const noexcept;

  void RunFirstSample() noexcept;
  [[nodiscard]] double RunLeg(double s) noexcept;
  [[nodiscard]] double ElasticLeg(double s) noexcept;
  [[nodiscard]] double CuttingLeg(double s) noexcept;
  [[nodiscard]] double RestingLeg(double s) noexcept;
  [[nodiscard]] double StuckLeg() noexcept;

  [[nodiscard]] std::optional<CrackTip> FollowEdge(const Waypoint& from, double next) noexcept;
  [[nodiscard]] std::optional<Waypoint> FollowEdgeAsFarAsPossible(const Waypoint& from,
                                                                  double next) noexcept;
  [[nodiscard]] Waypoint TurningPoint(const Waypoint& from, const Waypoint& beyond) noexcept;
  [[nodiscard]] bool SnapOutwards(double s) noexcept;

  void StartCutting(double s) noexcept;
  void StopCutting(double s) noexcept;
  void LoseEdge(double s) noexcept;
  [[nodiscard]] double ReachPlateEnd(const Waypoint& from, double next) noexcept;
  void BookCut(const Waypoint& from, const Waypoint& to) noexcept;
  void NoteContact(const Waypoint& from, const Waypoint& to) noexcept;
  void Log(TorqueEventKind kind,
           const Waypoint& where,
           double before_nmm,
           double after_nmm) noexcept;
  void Report() noexcept;
  [[nodiscard]] Phase ElasticPhase() const noexcept;
  [[nodiscard]] double TorqueNow() const noexcept;
  [[nodiscard]] double CuttingTorque() const noexcept;

  const BladeCurve& blade_;
  const Material& material_;
  const double plate_end_mm_;
  const TorqueOptions& options_;
  const MotionPath path_;
  const double dtheta_rad_, dpivot_mm_;
  const double strides_;  // that the motion takes at least
  TorqueState& state_;
  EventLog& log_;
  int evaluations_ = 0;
  double leg_start_delta_mm_ = 0;
  std::uint32_t flags_ = 0;
};

}  // namespace bladecurve
