// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/cut_run.h"

#include <cmath>

#include "model/number_table.h"

namespace bladecurve {
namespace {

// The way the handles move at sample i; at a standstill as before, at the first sample as after.
std::vector<Direction> Directions(const std::vector<MotionSample>& motion) {
  std::vector<Direction> directions(motion.size(), Direction::kUnknown);
  for (std::size_t i = 1; i < motion.size(); ++i) {
    const double turn_rad = motion[i].theta_rad() - motion[i - 1].theta_rad();
    directions[i] = turn_rad == 0 ? directions[i - 1]
                                  : (turn_rad < 0 ? Direction::kClosing : Direction::kOpening);
  }
  if (directions.size() > 1) directions[0] = directions[1];
  return directions;
}

double FrictionForce(const FrictionCurve& friction, Direction direction, double theta_rad) {
  if (direction == Direction::kClosing) return friction.Closing(theta_rad);
  return direction == Direction::kOpening ? friction.Opening(theta_rad) : 0;
}

void AppendCell(std::string& csv, double value) {
  csv += NumberText(value);
  csv += ',';
}

void AppendRow(std::string& csv, const CutRow& row, bool measured) {
  for (const double value : {row.motion.t_s, row.motion.theta_deg, row.motion.pivot_mm}) {
    AppendCell(csv, value);
  }
  csv += PhaseName(row.cut.phase);
  csv += ',';
  for (const double value : {row.cut.x_c_mm,
                             row.cut.delta_mm,
                             row.cut.torque_nmm,
                             row.force_n,
                             row.cut.force_x_n,
                             row.friction_n}) {
    AppendCell(csv, value);
  }
  csv += std::to_string(row.cut.flags);
  if (measured) {
    csv += ',';
    csv += NumberText(row.motion.measured_n);
  }
  csv += '\n';
}

}  // namespace

CutRun RunCut(TorqueModel model,
              const std::vector<MotionSample>& motion,
              double radius_mm,
              const std::optional<FrictionCurve>& friction) {
  CutRun run;
  run.rows.reserve(motion.size());
  run.toughness_n = model.material().toughness_n_per_mm * model.material().thickness_mm;
  const std::vector<Direction> directions = Directions(motion);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double dt_s = i == 0 ? 0 : motion[i].t_s - motion[i - 1].t_s;
    CutRow row{motion[i], model.Step(motion[i].theta_rad(), motion[i].pivot_mm, dt_s)};
    if (friction) row.friction_n = FrictionForce(*friction, directions[i], motion[i].theta_rad());
    row.force_n = row.cut.torque_nmm / radius_mm + row.friction_n;
    run.rows.push_back(row);
    run.events.insert(run.events.end(), model.events().begin(), model.events().end());
  }
  run.ledger = model.ledger();
  return run;
}

std::string CutCsv(const CutRun& run) {
  const bool measured = !run.rows.empty() && !std::isnan(run.rows.front().motion.measured_n);
  std::string csv =
      "t_s,theta_deg,pivot_mm,phase,x_c_mm,delta_mm,torque_nmm,force_n,force_x_n,friction_n,flags";
  csv += measured ? ",measured_n\n" : "\n";
  for (const CutRow& row : run.rows) AppendRow(csv, row, measured);
  return csv;
}

const char* PhaseName(Phase phase) {
  switch (phase) {
    case Phase::kNone:
      return "none";
    case Phase::kDeformation:
      return "deformation";
    case Phase::kCutting:
      return "cutting";
    case Phase::kRelaxation:
      return "relaxation";
    case Phase::kThrough:
      break;
  }
  return "through";
}

}  // namespace bladecurve
