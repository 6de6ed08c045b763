// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/number_table.h"

namespace bladecurve {

// Thrown where a log, or what stands in it, will not do. what() is "FILE:LINE: what is wrong; what
// to do" (without LINE where the whole file is meant). The codes are stable, for scripts:
// "unreadable", "unsorted", "saturated", "too_short", "no_cut".
class LogRefused : public std::runtime_error {
 public:
  LogRefused(std::string code, const std::string& detail)
      : std::runtime_error(detail), code_(std::move(code)) {}
  [[nodiscard]] const std::string& code() const noexcept { return code_; }

 private:
  std::string code_;
};

// A recorded closing of the scissors, through a plate or empty.
struct ForceLog {
  std::string source;              // the file, for messages
  std::vector<double> theta_rad;   // falls, the encoder's noise apart; its steps evened out
  std::vector<double> torque_nmm;  // positive resists closing
  std::vector<int> lines;          // where each row stands in the file
  double step_rad = 0;             // the least that two angles read differ by
};

// From columns theta_deg and force_n (of a sensor at radius_mm) or torque_nmm, perhaps t_s. Where
// both are logged, the force counts if the radius is known (not NaN). Rows of ascending angle are
// turned round if there is no t_s. Throws LogRefused for fewer than 50 rows, time that does not
// ascend, scissors that open again by over half a degree; std::invalid_argument for a force without
// a radius.
[[nodiscard]] ForceLog ForceLogOfTable(const NumberTable& table, double radius_mm);
[[nodiscard]] ForceLog ReadForceLog(const std::filesystem::path& path, double radius_mm);

// Throws LogRefused where the largest torque is the end of the sensor's range: it stands still over
// ten rows or more while the blades turn, and three times as long as any other large value does.
void RefuseSaturation(const ForceLog& log);

// Angles between the steps of an encoder: linear in `time` between the middles of the jumps from
// one reading to the next. Readings of which nine in ten differ from the one before stay as they
// are.
[[nodiscard]] std::vector<double> EvenedAngles(const std::vector<double>& time,
                                               const std::vector<double>& theta_rad);

}  // namespace bladecurve
