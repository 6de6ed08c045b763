// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// What a person wants to know of a cut at once.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/degrees.h"
#include "model/number_table.h"
#include "samples/cut_run.h"

namespace bladecurve {
namespace {

constexpr std::array kPhases = {
    Phase::kNone, Phase::kDeformation, Phase::kCutting, Phase::kRelaxation, Phase::kThrough};

const char* EventName(TorqueEventKind kind) {
  switch (kind) {
    case TorqueEventKind::kContact:
      return "contact";
    case TorqueEventKind::kCutStart:
      return "cutting starts";
    case TorqueEventKind::kCutStop:
      return "cutting stops";
    case TorqueEventKind::kRelease:
      return "contact ends";
    case TorqueEventKind::kThrough:
      return "plate ends";
    case TorqueEventKind::kSnap:
      return "crack jumps";
    case TorqueEventKind::kBladeEnd:
      break;
  }
  return "blade ends";
}

std::string EventLine(const TorqueEvent& event) {
  std::string line = fmt::format("  {:<15} theta {} deg, crack tip {} mm from the pivot",
                                 EventName(event.kind),
                                 NumberText(event.theta_rad * kDegPerRad),
                                 NumberText(event.x_c_mm));
  if (event.pivot_mm != 0) line += fmt::format(", pivot {} mm", NumberText(event.pivot_mm));
  if (event.kind == TorqueEventKind::kCutStart) {
    line += fmt::format(", torque {} N mm", NumberText(event.torque_after_nmm));
  } else if (event.torque_before_nmm != 0 || event.torque_after_nmm != 0) {
    line += fmt::format(", torque {} -> {} N mm (jump {:+.3g} %)",
                        NumberText(event.torque_before_nmm),
                        NumberText(event.torque_after_nmm),
                        100 * (event.torque_after_nmm / event.torque_before_nmm - 1));
  }
  return line + "\n";
}

// A noisy motion starts and stops cutting thousands of times: the first ones tell enough.
std::string EventLines(const std::vector<TorqueEvent>& events) {
  constexpr std::size_t kMostLines = 24;
  std::string lines;
  for (std::size_t i = 0; i < std::min(events.size(), kMostLines); ++i)
    lines += EventLine(events[i]);
  if (events.size() > kMostLines)
    lines += fmt::format("  ... and {} more\n", events.size() - kMostLines);
  return lines;
}

std::string PhaseLine(const CutRun& run) {
  std::string line = "  samples        ";
  for (const Phase phase : kPhases) {
    const auto in_phase = [phase](const CutRow& row) { return row.cut.phase == phase; };
    const auto count = std::count_if(run.rows.begin(), run.rows.end(), in_phase);
    if (count > 0) line += fmt::format(" {} {}", PhaseName(phase), count);
  }
  return line + "\n";
}

std::string PeakLine(const CutRun& run) {
  const auto less = [](const CutRow& a, const CutRow& b) {
    return a.cut.torque_nmm < b.cut.torque_nmm;
  };
  const CutRow& peak = *std::max_element(run.rows.begin(), run.rows.end(), less);
  std::string line = fmt::format("  peak torque     {} N mm at {} deg",
                                 NumberText(peak.cut.torque_nmm),
                                 NumberText(peak.motion.theta_deg));
  if (!std::isnan(peak.force_n)) line += fmt::format(", {:.4g} N at the handle", peak.force_n);
  return line + "\n";
}

std::string AuditLines(const CutRun& run) {
  const CutLedger& ledger = run.ledger;
  if (ledger.cut_length_mm == 0) return "  work audit      nothing was cut\n";
  const double expected_nmm = run.toughness_n * (ledger.cut_length_mm - ledger.pivot_advance_mm);
  std::string lines =
      fmt::format("  work audit      cutting did {} N mm; J_c h l_c = {} N mm for l_c = {} mm",
                  NumberText(ledger.cut_work_nmm),
                  NumberText(expected_nmm),
                  NumberText(ledger.cut_length_mm - ledger.pivot_advance_mm));
  if (expected_nmm != 0)
    lines += fmt::format(" (difference {:.2g})", ledger.cut_work_nmm / expected_nmm - 1);
  lines += "\n";
  if (ledger.cut_turn_rad > 0) {
    lines += fmt::format("  average torque  {} N mm of cutting, over {:.4g} deg\n",
                         NumberText(ledger.cut_work_nmm / ledger.cut_turn_rad),
                         ledger.cut_turn_rad * kDegPerRad);
  }
  if (ledger.pivot_advance_mm != 0) {
    lines += fmt::format("                  and {:.6g} mm were cut by moving the pivot\n",
                         ledger.pivot_advance_mm);
  }
  return lines;
}

std::string ErrorLines(const CutRun& run) {
  if (std::isnan(run.rows.front().motion.measured_n)) return "";
  std::string lines = "  predicted - measured handle force, N:\n";
  for (const Phase phase : kPhases) {
    double sum = 0, square = 0, count = 0;
    for (const CutRow& row : run.rows) {
      if (row.cut.phase != phase) continue;
      const double error = row.force_n - row.motion.measured_n;
      sum += error;
      square += error * error;
      ++count;
    }
    if (count == 0) continue;
    lines += fmt::format("    {:<13} mean {:+.4g}, rms {:.4g}, {} samples\n",
                         PhaseName(phase),
                         sum / count,
                         std::sqrt(square / count),
                         count);
  }
  return lines;
}

std::string FlagLine(const CutRun& run) {
  std::uint32_t flags = 0;
  for (const CutRow& row : run.rows) flags |= row.cut.flags;
  std::string line;
  const auto name = [&](std::uint32_t bit, const char* text) {
    if ((flags & bit) != 0) line += std::string(line.empty() ? "" : ", ") + text;
  };
  name(kCurveXOutside, "x outside the blade's domain");
  name(kCurveThetaOutside, "theta outside the blade's domain");
  name(kCurveNotGraph, "edge too steep for a curve over x");
  name(kTorqueCannotCut, "blade cannot cut there");
  name(kTorqueBeyondBlade, "crack tip beyond the end of the blade");
  name(kTorqueStepTooLong, "a pause too long to follow");
  name(kTorqueSearchShort, "steps too coarse");
  return line.empty() ? "" : "  flagged         " + line + "\n";
}

}  // namespace

std::string CutSummary(const CutRun& run) {
  return EventLines(run.events) + PhaseLine(run) + PeakLine(run) + AuditLines(run) +
         ErrorLines(run) + FlagLine(run);
}

}  // namespace bladecurve
