// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace bladecurve {

// Points as blade files and truths hold them, [x, y], lists of them, and matrices, row by row.
[[nodiscard]] nlohmann::ordered_json PointJson(const Eigen::Vector2d& point);
[[nodiscard]] nlohmann::ordered_json PointsJson(const std::vector<Eigen::Vector2d>& points);
[[nodiscard]] nlohmann::ordered_json MatrixJson(const Eigen::MatrixXd& matrix);

// Throw what nlohmann::json does where it is something else.
[[nodiscard]] Eigen::Vector2d PointOf(const nlohmann::json& point);
[[nodiscard]] std::vector<Eigen::Vector2d> PointsOf(const nlohmann::json& list);

}  // namespace bladecurve
