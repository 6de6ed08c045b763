// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_choice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vision/edge_path.h"

namespace bladecurve {
namespace {

size_t Index(int i) { return static_cast<size_t>(i); }

constexpr int kStationSpacing = 4;  // columns between stations
constexpr int kStationReach =
    5;  // columns averaged to either side of a station: evens out texture and noise
// Rises across the band: differences of the means of two rows, smoothed over about a photograph's
// blur.
constexpr std::array<double, 4> kRise = {-0.25, -0.5, 0.5, 0.25};

constexpr int kFlank =
    3;  // rows: a sharp step is over at this distance, a shadow's border still rises
constexpr int kFilterReach = 6;  // rows at the band's borders where steps cannot be told

// Steps found everywhere in the band, by stations along it.
struct StepMap {
  int stations = 0, rows = 0;
  std::vector<float>
      step;  // [station * rows + row]: height of the step there, background minus blade
  std::vector<float> clear;  // 0 to 1: how clearly it is a step

  [[nodiscard]] float Step(int station, int row) const { return step[Index(station * rows + row)]; }
  [[nodiscard]] float Clear(int station, int row) const {
    return clear[Index(station * rows + row)];
  }
};

std::vector<double> MeanColumn(const StraightBand& band, int center) {
  std::vector<double> mean(Index(band.rows), 0.0);
  const int first = std::max(center - kStationReach, 0);
  const int last = std::min(center + kStationReach, band.columns - 1);
  for (int column = first; column <= last; ++column) {
    const float* light = band.Column(column);
    for (int row = 0; row < band.rows; ++row) mean[Index(row)] += light[row];
  }
  for (double& value : mean) value /= last - first + 1;
  return mean;
}

double MedianOf(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Rise between row - 1/2 and row + 1/2 is stored at row: the map lies half a row further out than
// the band.
std::vector<double> Rises(const std::vector<double>& mean) {
  std::vector<double> rises(mean.size(), 0.0);
  for (size_t row = 1; row + 2 < mean.size(); ++row) {
    double rise = 0;
    for (size_t tap = 0; tap < kRise.size(); ++tap) rise += kRise[tap] * mean[row + tap - 1];
    rises[row] = std::isfinite(rise) ? rise : 0.0;
  }
  return rises;
}

// What a rise has beyond that of the soft gradient it sits on.
double SharpPart(const std::vector<double>& rises, size_t row) {
  const double rise = rises[row], sign = rise < 0 ? -1 : 1;
  const double gradient =
      0.5 * (std::max(sign * rises[row - kFlank], 0.0) + std::max(sign * rises[row + kFlank], 0.0));
  return sign * std::max(sign * rise - gradient, 0.0);
}

StepMap FindSteps(const StraightBand& band) {
  StepMap map;
  map.stations = (band.columns + kStationSpacing - 1) / kStationSpacing;
  map.rows = band.rows;
  map.step.assign(Index(map.stations * map.rows), 0.0F);
  for (int station = 0; station < map.stations; ++station) {
    const std::vector<double> rises = Rises(MeanColumn(band, station * kStationSpacing));
    for (int row = kFilterReach; row + kFilterReach < band.rows; ++row) {
      map.step[Index(station * map.rows + row)] = static_cast<float>(SharpPart(rises, Index(row)));
    }
  }
  return map;
}

// What texture and noise of the background look like to the filter: the typical response in the
// outermost rows.
double BackgroundResponse(const StepMap& map, int first_row) {
  std::vector<float> responses;
  for (int station = 0; station < map.stations; ++station) {
    for (int row = first_row; row + kFilterReach < map.rows; ++row)
      responses.push_back(std::abs(map.Step(station, row)));
  }
  constexpr double kSigmaPerMedian = 1.4826;
  constexpr double kLeastResponse = 5e-4;  // linear light: an eighth of a grey level at mid-grey
  return std::max(kSigmaPerMedian * MedianOf(std::move(responses)), kLeastResponse);
}

// A step is clear if it stands out of the background's texture and is no side lobe or halo of a
// stronger one.
void RateSteps(StepMap& map, double background_response) {
  constexpr double kSigmas =
      4;  // half-way to clear: random texture reaches this once in 10^4 places
  constexpr double kHaloShare =
      0.2;  // sharpening and the filter's side lobes stay below this share of their step
  constexpr int kHaloReach = 4;
  map.clear.assign(map.step.size(), 0.0F);
  for (int station = 0; station < map.stations; ++station) {
    for (int row = kFilterReach; row + kFilterReach < map.rows; ++row) {
      const double height = std::abs(map.Step(station, row));
      double strongest = 0;
      for (int near = std::max(row - kHaloReach, 0);
           near <= std::min(row + kHaloReach, map.rows - 1);
           ++near) {
        strongest = std::max(strongest, static_cast<double>(std::abs(map.Step(station, near))));
      }
      const bool peak = height >= std::abs(map.Step(station, row - 1)) &&
                        height >= std::abs(map.Step(station, row + 1));
      const double relative = std::min(height / (kSigmas * background_response),
                                       height / (kHaloShare * strongest + 1e-12));
      const double clear = 1 - std::exp2(-relative * relative);
      map.clear[Index(station * map.rows + row)] = static_cast<float>(peak ? clear : 0.5 * clear);
    }
  }
}

// The row at each station whose sum of scores is largest, neighbours differing by at most one row.
struct BestLine {
  std::vector<int> rows;
  double score = 0;  // per station
};

BestLine FindBestLine(int stations, int rows, const std::vector<float>& score) {
  constexpr float kBend = 0.15F;  // cost of a change by one row
  std::vector<float> total(score.begin(), score.begin() + rows);
  std::vector<signed char> from(Index(stations * rows), 0);
  for (int station = 1; station < stations; ++station) {
    std::vector<float> next(Index(rows));
    for (int row = 0; row < rows; ++row) {
      float best = total[Index(row)];
      for (const int change : {-1, 1}) {
        if (row + change < 0 || row + change >= rows) continue;
        if (total[Index(row + change)] - kBend > best) {
          best = total[Index(row + change)] - kBend;
          from[Index(station * rows + row)] = static_cast<signed char>(change);
        }
      }
      next[Index(row)] = best + score[Index(station * rows + row)];
    }
    total = std::move(next);
  }
  BestLine line;
  int row = static_cast<int>(std::max_element(total.begin(), total.end()) - total.begin());
  line.score = total[Index(row)] / static_cast<double>(stations);
  line.rows.resize(Index(stations));
  for (int station = stations; station-- > 0;) {
    line.rows[Index(station)] = row;
    row += from[Index(station * rows + row)];
  }
  return line;
}

std::vector<float> Scores(const StepMap& map, const StraightBand& band, double search_px) {
  constexpr double kOutwards = 0.03;  // a px: of two clear lines the outer one is the border
  std::vector<float> score(map.clear);
  for (int row = 0; row < map.rows; ++row) {
    const double across = band.Across(row + 0.5);
    const bool allowed = std::abs(across) <= search_px;
    for (int station = 0; station < map.stations; ++station) {
      float& at = score[Index(station * map.rows + row)];
      at = allowed ? at * static_cast<float>(1 + kOutwards * across) : -1.0F;
    }
  }
  return score;
}

// Position of the step between rows, from the parabola through the heights around it.
double PeakRow(const StepMap& map, int station, int row) {
  const double before = std::abs(map.Step(station, row - 1)), at = std::abs(map.Step(station, row));
  const double after = std::abs(map.Step(station, row + 1));
  const double bend = before - 2 * at + after;
  if (bend >= 0 || at < before || at < after) return row;
  return row + 0.5 * (before - after) / bend;
}

// Distance from the line at `row` to the next step at least half as clear and a quarter as high,
// stepping by `toward`.
double FreeDistance(const StepMap& map, int station, int row, int toward) {
  constexpr double kShare = 0.25;
  constexpr int kOwn = 2;        // rows that still belong to the step itself
  constexpr double kMargin = 1;  // px: the blur of the other step
  constexpr double kFree = 1e3;
  const double height = std::abs(map.Step(station, row));
  for (int r = row + kOwn * toward; r >= kFilterReach && r + kFilterReach < map.rows; r += toward) {
    const double other = std::abs(map.Step(station, r));
    const bool peak =
        other >= std::abs(map.Step(station, r - 1)) && other >= std::abs(map.Step(station, r + 1));
    if (peak && map.Clear(station, r) > 0.5 && other > kShare * height)
      return std::abs(r - row) - kMargin;
  }
  return kFree;
}

// A line that keeps away from the chosen one, for comparison.
double RivalScore(const StepMap& map,
                  std::vector<float> score,
                  const BestLine& chosen,
                  double& rival_px) {
  constexpr int kApart = 2;
  for (int station = 0; station < map.stations; ++station) {
    const int row = chosen.rows[Index(station)];
    for (int near = std::max(row - kApart, 0); near <= std::min(row + kApart, map.rows - 1);
         ++near) {
      score[Index(station * map.rows + near)] = -0.25F;
    }
  }
  const BestLine rival = FindBestLine(map.stations, map.rows, score);
  double apart = 0;
  for (int station = 0; station < map.stations; ++station) {
    apart += rival.rows[Index(station)] - chosen.rows[Index(station)];
  }
  rival_px = apart / map.stations;
  return std::max(rival.score, 0.0);
}

std::vector<double> PerColumn(const std::vector<double>& stations, int columns) {
  std::vector<double> values;
  const int last = static_cast<int>(stations.size()) - 1;
  for (int column = 0; column < columns; ++column) {
    const double position =
        std::min(static_cast<double>(column) / kStationSpacing, static_cast<double>(last));
    const int a = static_cast<int>(position), b = std::min(a + 1, last);
    values.push_back(stations[Index(a)] +
                     (position - a) * (stations[Index(b)] - stations[Index(a)]));
  }
  return values;
}

}  // namespace

ChosenTransition ChooseTransition(const StraightBand& band, double search_px) {
  StepMap map = FindSteps(band);
  const int outermost = static_cast<int>(std::lround(search_px - band.first_across_px));
  RateSteps(map, BackgroundResponse(map, std::min(outermost, map.rows - kFilterReach - 3)));
  const std::vector<float> score = Scores(map, band, search_px);
  const BestLine line = FindBestLine(map.stations, map.rows, score);

  std::vector<double> offset, weight, inner, outer;
  ChosenTransition chosen;
  for (int station = 0; station < map.stations; ++station) {
    const int row = line.rows[Index(station)];
    offset.push_back(band.Across(PeakRow(map, station, row) + 0.5));
    weight.push_back(map.Clear(station, row) + 1e-3);
    inner.push_back(FreeDistance(map, station, row, -1));
    outer.push_back(FreeDistance(map, station, row, 1));
    chosen.support += (map.Clear(station, row) > 0.5) / static_cast<double>(map.stations);
  }
  constexpr double kStiffness = 4;  // bends within three stations are noise
  chosen.offset_px = PerColumn(SmoothValues(offset, weight, kStiffness), band.columns);
  chosen.inner_px = PerColumn(inner, band.columns);
  chosen.outer_px = PerColumn(outer, band.columns);
  chosen.ambiguity = std::clamp(
      RivalScore(map, score, line, chosen.rival_px) / std::max(line.score, 1e-6), 0.0, 1.0);
  return chosen;
}

}  // namespace bladecurve
