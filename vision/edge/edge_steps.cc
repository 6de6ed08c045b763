// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_steps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

// Difference of the light on two sides, smoothed over about a photograph's blur.
constexpr std::array<double, 4> kRise = {-0.25, -0.5, 0.5, 0.25};
constexpr double kOwnVariance =
    0.65;  // rows^2: what pixel box, interpolation and kRise add to a step's width
constexpr double kLeastBlur = 0.4;  // px; sharper photographs are undersampled
constexpr int kFlank = 2;           // rows from a step to where its width is judged
constexpr int kBeyond = 3;          // rows from a sharp step to where it is over

void AverageColumns(const StraightBand& band, int center, int reach, std::vector<float>& mean) {
  std::fill(mean.begin(), mean.end(), 0.0F);
  const int first = std::max(center - reach, 0), last = std::min(center + reach, band.columns - 1);
  for (int column = first; column <= last; ++column) {
    const float* light = band.Column(column);
    for (size_t row = 0; row < mean.size(); ++row) mean[row] += light[row];
  }
  const float share = 1.0F / static_cast<float>(last - first + 1);
  for (float& value : mean) value *= share;
}

void FindHeights(const StraightBand& band, StepMap& map) {
  std::vector<float> mean(static_cast<size_t>(band.rows));
  for (int station = 0; station < map.stations; ++station) {
    AverageColumns(band, station * map.layout.spacing, map.layout.reach, mean);
    for (int row = 1; row + 2 < band.rows; ++row) {
      double height = 0;
      for (size_t tap = 0; tap < kRise.size(); ++tap)
        height += kRise[tap] * mean[static_cast<size_t>(row) + tap - 1];
      map.unseen[map.At(station, row)] = !std::isfinite(height);
      if (std::isfinite(height)) map.height[map.At(station, row)] = static_cast<float>(height);
    }
  }
}

// One place in the map and its neighbours across the band, all counted positive in the direction of
// the step.
class Place {
 public:
  Place(const StepMap& map, int station, int row)
      : height_(&map.height[map.At(station, row)]), sign_(*height_ < 0 ? -1 : 1) {}

  [[nodiscard]] double Height(int rows_away = 0) const {
    return sign_ * static_cast<double>(height_[rows_away]);
  }
  [[nodiscard]] bool IsPeak() const { return Height() >= Height(-1) && Height() > Height(1); }

  // 1 at a peak and where a peak lies between this row and the next, less on its flanks.
  [[nodiscard]] double Peakedness() const {
    constexpr double kFlankShare = 0.4, kLow = 0.6, kHigh = 0.9;  // of the higher neighbour
    if (IsPeak()) return 1;
    const double share = Height() / std::max({Height(-1), Height(1), 1e-12});
    return kFlankShare + (1 - kFlankShare) * std::clamp((share - kLow) / (kHigh - kLow), 0.0, 1.0);
  }

  // What the step has beyond a steady gradient it may sit on.
  [[nodiscard]] double AboveGradient() const {
    return Height() - 0.5 * (Height(-kBeyond) + Height(kBeyond));
  }

  // Variance of its width in rows^2, pixels and filter included, as of a Gaussian: soft shadows are
  // wide. A peak is judged on its steeper side, for a shadow may begin on the other, but not where
  // another step overlaps; off a peak the other side tells that it belongs to something wide.
  [[nodiscard]] double Variance() const {
    const auto [low, high] = std::minmax({Height(-kFlank), Height(kFlank)});
    const double flank = IsPeak() && low > 0 ? low : high;
    const double share = std::clamp(flank / std::max(Height(), 1e-12), 1e-6, 0.98);
    return 0.5 * kFlank * kFlank / -std::log(share);
  }

  // Sharpening and compression put a small step of the other sign beside a large one.
  [[nodiscard]] bool IsHalo() const {
    constexpr double kHaloShare = 0.15;
    double strongest = 0;
    for (int away = 2; away <= 4; ++away)
      strongest = std::max({strongest, -Height(-away), -Height(away)});
    return Height() < kHaloShare * strongest;
  }

 private:
  const float* height_;
  double sign_;
};

template <typename Visit>
void ForEachPlace(const StepMap& map, int first_row, const Visit& visit) {
  for (int station = 0; station < map.stations; ++station) {
    for (int row = std::max(first_row, kStepMargin); row + kStepMargin < map.rows; ++row)
      visit(station, row);
  }
}

// What texture and noise do: how far stations that share no column differ, for a shadow's border or
// another blade may run along the band.
double BackgroundResponse(const StepMap& map, int background_row) {
  const int apart = (2 * map.layout.reach + 1) / map.layout.spacing + 1;
  const int first_row = std::clamp(background_row, kStepMargin, map.rows - kStepMargin - 2);
  std::vector<double> differences;
  for (int station = 0; station + apart < map.stations; ++station) {
    for (int row = first_row; row + kStepMargin < map.rows; ++row) {
      const size_t here = map.At(station, row), there = map.At(station + apart, row);
      if (map.unseen[here] || map.unseen[there]) continue;
      differences.push_back(std::abs(map.height[here] - map.height[there]));
    }
  }
  // The lower quarter of |x| keeps clear of another blade that runs across the background.
  constexpr double kShare = 0.25, kSigmaPerQuantile = 3.138;
  constexpr double kLeastResponse = 1e-3;  // a quarter of a grey level
  if (differences.empty()) return kLeastResponse;
  const double quantile = SampleQuantile(std::move(differences), kShare);
  return std::max(kSigmaPerQuantile * quantile / std::sqrt(2.0), kLeastResponse);
}

constexpr double kSigmas = 3;  // texture of normal distribution reaches this once in 400 places

// Width of a sharp step in this photograph: that of the sharper ones among all that stand out.
double SharpVariance(const StepMap& map) {
  constexpr double kShare = 0.3;
  std::vector<double> variances;
  ForEachPlace(map, 0, [&](int station, int row) {
    const Place place(map, station, row);
    if (place.IsPeak() && place.AboveGradient() > 1.5 * kSigmas * map.background_response &&
        !place.IsHalo()) {
      variances.push_back(place.Variance());
    }
  });
  return variances.empty() ? 1.5 : SampleQuantile(std::move(variances), kShare);
}

double BlurOf(double step_variance) {
  return std::sqrt(std::max(step_variance - kOwnVariance, kLeastBlur * kLeastBlur));
}

double Clearness(const Place& place, double background_response, double sharp_variance) {
  constexpr double kPenumbra =
      2;  // px^2 of variance beyond the sharp steps': half-way from blade to soft shadow
  const double above = place.AboveGradient();
  if (above <= 0 || place.IsHalo()) return 0;
  const double relative = above / (kSigmas * background_response);
  const double softness = std::max(place.Variance() - sharp_variance, 0.0) / kPenumbra;
  return place.Peakedness() * (1 - std::exp2(-relative * relative)) / (1 + softness * softness);
}

}  // namespace

StepMap FindSteps(const StraightBand& band, const StationLayout& layout, int background_row) {
  StepMap map;
  map.layout = layout;
  map.stations = (band.columns + layout.spacing - 1) / layout.spacing;
  map.rows = band.rows;
  map.height.assign(map.At(map.stations, 0), 0.0F);
  map.unseen.assign(map.height.size(), false);
  map.clear.assign(map.height.size(), 0.0F);
  FindHeights(band, map);
  map.background_response = BackgroundResponse(map, background_row);
  const double sharp_variance = SharpVariance(map);
  map.blur_px = BlurOf(sharp_variance);
  ForEachPlace(map, 0, [&](int station, int row) {
    const Place place(map, station, row);
    map.clear[map.At(station, row)] =
        static_cast<float>(Clearness(place, map.background_response, sharp_variance));
  });
  return map;
}

double BlurUnder(const StepMap& map, const std::vector<int>& rows) {
  std::vector<double> variances;
  for (int station = 0; station < map.stations; ++station) {
    const int row = rows[static_cast<size_t>(station)];
    if (row < kStepMargin || row + kStepMargin >= map.rows) continue;
    variances.push_back(Place(map, station, row).Variance());
  }
  return BlurOf(Median(std::move(variances)));
}

}  // namespace bladecurve
