// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace bladecurve {

// A point as blade files and truths write it: [x, y].
[[nodiscard]] inline Eigen::Vector2d PointOf(const nlohmann::json& point) {
  return {point.at(0).get<double>(), point.at(1).get<double>()};
}

}  // namespace bladecurve
