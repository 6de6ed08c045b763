// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_line.h"

#include <algorithm>
#include <cmath>

#include "vision/edge/edge_path.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

constexpr double kClear = 0.5;

}  // namespace

StepLine FindBestLine(const StepMap& map, const std::vector<float>& score, float bend) {
  const auto rows = static_cast<size_t>(map.rows);
  std::vector<float> total(score.begin(), score.begin() + map.rows), next(rows);
  std::vector<signed char> from(score.size(), 0);
  for (int station = 1; station < map.stations; ++station) {
    for (size_t row = 0; row < rows; ++row) {
      const size_t at = map.At(station, static_cast<int>(row));
      float best = total[row];
      if (row > 0 && total[row - 1] - bend > best) {
        best = total[row - 1] - bend;
        from[at] = -1;
      }
      if (row + 1 < rows && total[row + 1] - bend > best) {
        best = total[row + 1] - bend;
        from[at] = 1;
      }
      next[row] = best + score[at];
    }
    std::swap(total, next);
  }
  StepLine line;
  int row = static_cast<int>(std::max_element(total.begin(), total.end()) - total.begin());
  line.score = static_cast<double>(total[static_cast<size_t>(row)]) / map.stations;
  line.rows.resize(static_cast<size_t>(map.stations));
  for (int station = map.stations; station-- > 0;) {
    line.rows[static_cast<size_t>(station)] = row;
    row += from[map.At(station, row)];
  }
  return line;
}

double PeakRow(const StepMap& map, int station, int row) {
  if (row < 1 || row + 1 >= map.rows) return row;
  const float* height = &map.height[map.At(station, row)];
  const double before = std::abs(height[-1]), at = std::abs(height[0]), after = std::abs(height[1]);
  const double bend = before - 2 * at + after;
  if (bend >= 0 || at < before || at < after) return row;
  return row + 0.5 * (before - after) / bend;
}

double ClearShare(const StepMap& map, const StepLine& line) {
  int clear = 0;
  for (int station = 0; station < map.stations; ++station) {
    clear += map.clear[map.At(station, line.rows[static_cast<size_t>(station)])] > kClear;
  }
  return static_cast<double>(clear) / map.stations;
}

double TypicalHeight(const StepMap& map, const StepLine& line) {
  std::vector<double> heights;
  for (int station = 0; station < map.stations; ++station) {
    const size_t at = map.At(station, line.rows[static_cast<size_t>(station)]);
    if (map.clear[at] > kClear) heights.push_back(map.height[at]);
  }
  return Median(std::move(heights));
}

std::vector<double> SmoothRows(const StepMap& map, const StepLine& line, double stiffness) {
  constexpr double kUnseenWeight = 1e-3;
  std::vector<double> rows, weights;
  for (int station = 0; station < map.stations; ++station) {
    const int row = line.rows[static_cast<size_t>(station)];
    rows.push_back(PeakRow(map, station, row));
    weights.push_back(map.clear[map.At(station, row)] + kUnseenWeight);
  }
  return SmoothValues(rows, weights, stiffness);
}

}  // namespace bladecurve
