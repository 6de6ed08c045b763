// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/json_arrays.h"

#include <nlohmann/json.hpp>

namespace bladecurve {

nlohmann::ordered_json PointJson(const Eigen::Vector2d& point) {
  return nlohmann::ordered_json::array({point.x(), point.y()});
}

nlohmann::ordered_json PointsJson(const std::vector<Eigen::Vector2d>& points) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Eigen::Vector2d& point : points) list.push_back(PointJson(point));
  return list;
}

nlohmann::ordered_json MatrixJson(const Eigen::MatrixXd& matrix) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

Eigen::Vector2d PointOf(const nlohmann::json& point) {
  return {point.at(0).get<double>(), point.at(1).get<double>()};
}

std::vector<Eigen::Vector2d> PointsOf(const nlohmann::json& list) {
  std::vector<Eigen::Vector2d> points;
  for (const nlohmann::json& point : list) points.push_back(PointOf(point));
  return points;
}

}  // namespace bladecurve
