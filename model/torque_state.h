// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "model/crack_tip.h"
#include "model/fluctuation.h"

namespace bladecurve {

// What delta does while the plate is cut.
enum class DeltaPolicy {
  kConstant,   // stays as it was when cutting began (the paper)
  kCriterion,  // such that the elastic torque equals tau_c throughout: no jump where cutting stops
};

enum class Phase : std::uint8_t { kNone, kDeformation, kCutting, kRelaxation, kThrough };

// Above CurveFlag's bits.
enum TorqueFlag : std::uint32_t {
  kTorqueCannotCut = 1u << 8,     // the edge cannot cut there: torque held at its last valid value
  kTorqueBeyondBlade = 1u << 9,   // the crack tip lies beyond the blade's end: torque fades to 0
  kTorqueBadInput = 1u << 10,     // NaN, Inf or a negative dt came in: last safe output
  kTorqueStepTooLong = 1u << 11,  // dt beyond longest_step_s: last safe output
  kTorqueSearchShort = 1u << 12,  // too much in one step: its end was taken in one stride
};

struct TorqueOptions {
  DeltaPolicy delta_policy = DeltaPolicy::kConstant;
  double longest_step_s = 1.0;   // a longer pause leaves the path between the samples unknown
  Fluctuation fluctuation = {};  // of the torque while cutting; events and ledger tell the mean one
};

struct TorqueSample {
  double torque_nmm = 0;      // closing must overcome it: >= 0
  double force_x_n = 0;       // on the pivot, eq. (18): < 0 pushes the scissors back
  double normal_force_n = 0;  // f_n, of the plate on the edge
  double x_c_mm = 0;          // crack tip from the pivot
  double delta_mm = 0;        // deflection of the upper edge of the plate there; < 0: a gap
  Phase phase = Phase::kNone;
  std::uint32_t flags = 0;  // CurveFlag | TorqueFlag
};

enum class TorqueEventKind : std::uint8_t {
  kContact,
  kCutStart,
  kCutStop,
  kRelease,
  kThrough,
  kSnap,
  kBladeEnd
};

// Something that happened between two samples, located on the straight path between them.
struct TorqueEvent {
  TorqueEventKind kind = TorqueEventKind::kContact;
  double path = 0;  // 0: at the earlier sample, 1: at the later one
  double theta_rad = 0, pivot_mm = 0, x_c_mm = 0;
  double torque_before_nmm = 0, torque_after_nmm = 0;
};

// Work audit. For constant delta and a pivot at rest, cut_work = J_c h cut_length exactly (12, 14).
// The average torque of cutting (17) is cut_work over cut_turn.
struct CutLedger {
  double cut_work_nmm = 0;      // integral of -tau_c dtheta while the crack grows
  double cut_turn_rad = 0;      // what the blades closed by meanwhile
  double cut_length_mm = 0;     // what the crack grew by meanwhile
  double pivot_advance_mm = 0;  // what the pivot moved by then: no work against the torque
  double snapped_mm = 0;        // what the crack jumped at once, for want of an equilibrium
};

// The events of one step; more than fit are left out.
struct EventLog {
  std::array<TorqueEvent, 16> events;
  std::size_t count = 0;
};

// kResting: cutting before, now delta < delta_c, but the plate is still loaded beyond the
// criterion, so that the crack neither grows nor may the torque exceed tau_c. kStuck: cutting, and
// the edge has no equilibrium further out.
enum class CutMode : std::uint8_t { kElastic, kCutting, kResting, kStuck, kThrough };

// All that a step leaves to the next one.
struct TorqueState {
  double theta_rad = 0, pivot_mm = 0;
  double crack_mm = 0;          // X_c, from the pivot's first position; never falls
  double delta_c_mm = 0;        // deflection at which the plate is cut; policy "constant" only
  double valid_torque_nmm = 0;  // last torque where the edge could cut
  CrackTip tip;
  TorqueSample output;
  CutLedger ledger;
  CutMode mode = CutMode::kElastic;
  bool started = false;
};

}  // namespace bladecurve
