// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/force_log.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/degrees.h"

namespace bladecurve {
namespace {

constexpr std::size_t kFewestLogged = 50;  // fewer cannot show contact, deformation and cutting
// Rejects rows out of order and scissors that open again, not the flicker of a coarse encoder.
constexpr double kLargestReturn_rad = 0.5 * kRadPerDeg;
constexpr std::size_t kFlatRows = 10;  // as many equal maxima are no coincidence of noise
constexpr std::size_t kFlatRatio = 3;  // nor this much more than a coarse sensor's other values

std::string Place(const std::string& source, int line) {
  return source + ":" + std::to_string(line) + ": ";
}

void RequireAscendingTime(const NumberTable& table, const std::vector<double>& t_s) {
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    if (t_s[i] > t_s[i - 1]) continue;
    throw LogRefused("unsorted",
                     Place(table.source, table.lines[i]) +
                         "t_s does not ascend; sort the rows by time, one row a sample");
  }
}

void RequireClosing(const ForceLog& log) {
  double least_rad = log.theta_rad.front();
  for (std::size_t i = 0; i < log.theta_rad.size(); ++i) {
    least_rad = std::min(least_rad, log.theta_rad[i]);
    if (log.theta_rad[i] - least_rad <= kLargestReturn_rad) continue;
    throw LogRefused("unsorted",
                     Place(log.source, log.lines[i]) +
                         "the scissors open again; give one closing a file, its rows in order");
  }
}

std::vector<double> Column(const NumberTable& table, const char* name) {
  try {
    return table.Get(name);
  } catch (const std::invalid_argument& error) {
    throw LogRefused("unreadable", error.what());
  }
}

std::vector<double> TorqueColumn(const NumberTable& table, double radius_mm) {
  const std::vector<double>* force_n = table.Find("force_n");
  const std::vector<double>* torque_nmm = table.Find("torque_nmm");
  if (torque_nmm != nullptr && (force_n == nullptr || std::isnan(radius_mm))) return *torque_nmm;
  if (force_n == nullptr) return Column(table, "force_n");
  if (std::isnan(radius_mm)) {
    throw std::invalid_argument(table.source +
                                ": logs a force; say how far from the pivot it was measured "
                                "(--radius-mm)");
  }
  std::vector<double> torque = *force_n;
  for (double& value : torque) value *= radius_mm;
  return torque;
}

// Rows at which one more run of equal values begins.
std::vector<std::size_t> RunStarts(const std::vector<double>& values) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == 0 || values[i] != values[i - 1]) starts.push_back(i);
  }
  return starts;
}

double LeastStep(const std::vector<double>& theta_rad) {
  double least_rad = kLargestReturn_rad;
  for (std::size_t i = 1; i < theta_rad.size(); ++i) {
    const double step_rad = std::abs(theta_rad[i] - theta_rad[i - 1]);
    if (step_rad > 0) least_rad = std::min(least_rad, step_rad);
  }
  return least_rad;
}

void TurnRound(ForceLog& log) {
  std::reverse(log.theta_rad.begin(), log.theta_rad.end());
  std::reverse(log.torque_nmm.begin(), log.torque_nmm.end());
  std::reverse(log.lines.begin(), log.lines.end());
}

}  // namespace

std::vector<double> EvenedAngles(const std::vector<double>& time,
                                 const std::vector<double>& theta_rad) {
  const std::vector<std::size_t> starts = RunStarts(theta_rad);
  if (starts.size() < 3 || 10 * starts.size() > 9 * theta_rad.size()) return theta_rad;
  std::vector<double> jump_time, jump_rad;
  for (std::size_t k = 1; k < starts.size(); ++k) {
    const std::size_t i = starts[k];
    jump_time.push_back(0.5 * (time[i - 1] + time[i]));
    jump_rad.push_back(0.5 * (theta_rad[i - 1] + theta_rad[i]));
  }
  std::vector<double> evened(theta_rad.size());
  std::size_t k = 0;
  for (std::size_t i = 0; i < evened.size(); ++i) {
    while (k + 2 < jump_time.size() && time[i] > jump_time[k + 1]) ++k;
    const double share = (time[i] - jump_time[k]) / (jump_time[k + 1] - jump_time[k]);
    // Before the first jump and after the last: not further than a step from the jump.
    evened[i] = std::lerp(jump_rad[k], jump_rad[k + 1], std::clamp(share, -1.0, 2.0));
  }
  return evened;
}

ForceLog ForceLogOfTable(const NumberTable& table, double radius_mm) {
  ForceLog log{
      table.source, Column(table, "theta_deg"), TorqueColumn(table, radius_mm), table.lines};
  if (log.lines.size() < kFewestLogged) {
    throw LogRefused("too_short",
                     table.source + ": " + std::to_string(log.lines.size()) + " rows; at least " +
                         std::to_string(kFewestLogged) + " are needed");
  }
  std::vector<double> time(log.lines.size());
  std::iota(time.begin(), time.end(), 0.0);
  const std::vector<double>* t_s = table.Find("t_s");
  if (t_s != nullptr) RequireAscendingTime(table, time = *t_s);
  for (double& angle : log.theta_rad) angle *= kRadPerDeg;
  if (t_s == nullptr && log.theta_rad.front() < log.theta_rad.back()) TurnRound(log);
  RequireClosing(log);
  log.step_rad = LeastStep(log.theta_rad);
  log.theta_rad = EvenedAngles(time, log.theta_rad);
  return log;
}

ForceLog ReadForceLog(const std::filesystem::path& path, double radius_mm) {
  const auto read = [&path] {
    try {
      return ReadNumberTable(path);
    } catch (const std::invalid_argument& error) {
      throw LogRefused("unreadable", error.what());
    }
  };
  return ForceLogOfTable(read(), radius_mm);
}

void RefuseSaturation(const ForceLog& log) {
  const double largest_nmm = *std::max_element(log.torque_nmm.begin(), log.torque_nmm.end());
  std::vector<std::size_t> starts = RunStarts(log.torque_nmm);
  starts.push_back(log.torque_nmm.size());
  std::size_t flat = 0, flat_row = 0, other = 1;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    const std::size_t rows = starts[k + 1] - starts[k];
    const double value = log.torque_nmm[starts[k]];
    if (value == largest_nmm && rows > flat) {
      flat = rows;
      flat_row = starts[k];
    } else if (value < largest_nmm && value > 0.5 * largest_nmm) {
      other = std::max(other, rows);
    }
  }
  if (flat < kFlatRows || flat < kFlatRatio * other) return;
  if (log.theta_rad[flat_row] == log.theta_rad[flat_row + flat - 1]) return;
  throw LogRefused("saturated",
                   Place(log.source, log.lines[flat_row]) +
                       "the force stays at its largest value " + "for " + std::to_string(flat) +
                       " rows: the sensor is at the end of its range");
}

}  // namespace bladecurve
