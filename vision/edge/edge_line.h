// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/edge/edge_steps.h"

namespace bladecurve {

// A line through a step map: one row at each station, neighbours differing by at most one.
struct StepLine {
  std::vector<int> rows;
  double score = 0;  // mean over the stations
};

// The line of the largest sum of scores, by dynamic programming. score[station * rows + row]; each
// change by one row costs `bend`, a station on a clear step being worth 1.
[[nodiscard]] StepLine FindBestLine(const StepMap& map,
                                    const std::vector<float>& score,
                                    float bend);

// Share of its stations in which the line runs on a clear step.
[[nodiscard]] double ClearShare(const StepMap& map, const StepLine& line);

// Median height of the steps under the line: positive where the outside is brighter.
[[nodiscard]] double TypicalHeight(const StepMap& map, const StepLine& line);

// Position of the step nearest to a row, between rows, from the parabola through the heights about
// it.
[[nodiscard]] double PeakRow(const StepMap& map, int station, int row);

// Rows of the line between the rows of the map, by the parabola through each peak, smoothed along
// the line.
[[nodiscard]] std::vector<double> SmoothRows(const StepMap& map,
                                             const StepLine& line,
                                             double stiffness);

}  // namespace bladecurve
