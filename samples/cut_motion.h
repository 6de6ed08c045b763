// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <limits>
#include <numbers>
#include <vector>

namespace bladecurve {

struct MotionSample {
  double t_s = 0;
  double theta_deg = 0;  // as given in flags and files
  double pivot_mm = 0;
  double measured_n = std::numeric_limits<double>::quiet_NaN();  // handle force, if logged

  [[nodiscard]] double theta_rad() const { return theta_deg * std::numbers::pi / 180; }
};

// From angle to angle in turn, at a constant rate, the pivot at rest; samples at rate_hz and at the
// last angle. Throws std::invalid_argument for fewer than two angles, a rate not above zero, or
// more than ten million samples.
[[nodiscard]] std::vector<MotionSample> CloseAtRate(const std::vector<double>& angles_deg,
                                                    double rate_deg_per_s,
                                                    double rate_hz);

// A recorded motion: columns t_s, theta_deg, optionally pivot_mm (else 0) and force_n or torque_nmm
// as measured (torque over radius_mm gives the force). Throws std::invalid_argument naming file and
// line, also where time does not ascend.
[[nodiscard]] std::vector<MotionSample> ReadMotion(const std::filesystem::path& path,
                                                   double radius_mm);

}  // namespace bladecurve
