// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/cut_motion.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "model/number_table.h"
#include "samples/flag_values.h"

namespace bladecurve {
namespace {

constexpr double kMostSamples = 1e7;  // a gigabyte of rows

void RequireAscendingTime(const NumberTable& table) {
  const std::vector<double>& t_s = table.Get("t_s");
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    if (t_s[i] > t_s[i - 1]) continue;
    throw std::invalid_argument(fmt::format(
        "{}:{}: t_s does not ascend; sort the rows by time", table.source, table.lines[i]));
  }
}

// The samples of one straight stretch, its first excluded.
void AppendStretch(std::vector<MotionSample>& motion,
                   double to_deg,
                   double rate_deg_per_s,
                   double rate_hz) {
  const MotionSample from = motion.back();
  const double duration_s = std::abs(to_deg - from.theta_deg) / rate_deg_per_s;
  const double signed_rate = std::copysign(rate_deg_per_s, to_deg - from.theta_deg);
  for (double k = 1; k < duration_s * rate_hz * (1 - 1e-12); ++k) {
    motion.push_back({from.t_s + k / rate_hz, from.theta_deg + signed_rate * (k / rate_hz), 0});
  }
  motion.push_back({from.t_s + duration_s, to_deg, 0});
}

}  // namespace

std::vector<MotionSample> CloseAtRate(const std::vector<double>& angles_deg,
                                      double rate_deg_per_s,
                                      double rate_hz) {
  RequirePositive("--rate-deg-per-s", rate_deg_per_s);
  RequirePositive("--rate-hz", rate_hz);
  if (angles_deg.size() < 2)
    throw std::invalid_argument("--close-deg: give two angles or more, as 30:0");
  double turn_deg = 0;
  for (std::size_t i = 1; i < angles_deg.size(); ++i)
    turn_deg += std::abs(angles_deg[i] - angles_deg[i - 1]);
  if (turn_deg / rate_deg_per_s * rate_hz > kMostSamples) {
    throw std::invalid_argument(
        "--rate-hz: more than ten million samples; give a lower rate or a faster motion");
  }
  std::vector<MotionSample> motion = {{0, angles_deg.front(), 0}};
  for (std::size_t i = 1; i < angles_deg.size(); ++i) {
    if (angles_deg[i] != angles_deg[i - 1])
      AppendStretch(motion, angles_deg[i], rate_deg_per_s, rate_hz);
  }
  return motion;
}

std::vector<MotionSample> ReadMotion(const std::filesystem::path& path, double radius_mm) {
  const NumberTable table = ReadNumberTable(path);
  RequireAscendingTime(table);
  const std::vector<double>& t_s = table.Get("t_s");
  const std::vector<double>& theta_deg = table.Get("theta_deg");
  const std::vector<double>* pivot_mm = table.Find("pivot_mm");
  const std::vector<double>* force_n = table.Find("force_n");
  const std::vector<double>* torque_nmm = table.Find("torque_nmm");
  std::vector<MotionSample> motion(table.num_rows());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    motion[i] = {t_s[i], theta_deg[i], pivot_mm ? (*pivot_mm)[i] : 0};
    if (torque_nmm) motion[i].measured_n = (*torque_nmm)[i] / radius_mm;
    if (force_n) motion[i].measured_n = (*force_n)[i];
  }
  return motion;
}

}  // namespace bladecurve
