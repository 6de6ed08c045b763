// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_windows.h"

#include <algorithm>
#include <cmath>

#include "vision/edge/edge_path.h"
#include "vision/image/robust_statistics.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

constexpr int kStretchesPerStep = 2;  // from one window to the next
constexpr int kReach = 6;             // stretches to either side of a window's centre
constexpr int kReachAtEnds = 2;
constexpr double kOverlap = (2.0 * kReach + 1) / kStretchesPerStep;  // windows that share a stretch

}  // namespace

EdgeWindows::EdgeWindows(int samples, int stretch)
    : samples_(samples),
      stretch_(stretch),
      moments_(Index((samples + stretch - 1) / stretch)),
      trust_(moments_.size(), 1.0) {}

double EdgeWindows::Position(int sample) const {
  return (sample - 0.5 * (stretch_ - 1)) / (stretch_ * kStretchesPerStep);
}

void EdgeWindows::Add(int sample, const LevelVector& terms, double light, double weight) {
  moments_[Index(sample / stretch_)].Add(terms, light, weight);
}

void EdgeWindows::Distrust(const std::vector<double>& chi_square) {
  constexpr double kUsual = 2.5;  // times the median: what texture does
  if (chi_square.empty()) return;
  const double usual = std::max(kUsual * Median(chi_square), 1e-12);
  const size_t last = chi_square.size() - 1;
  for (size_t s = 0; s < trust_.size(); ++s) {
    // The neighbours count too: a glint rarely ends where a stretch does.
    const size_t k = s * chi_square.size() / trust_.size();
    const double worst =
        std::max({chi_square[k > 0 ? k - 1 : 0], chi_square[k], chi_square[std::min(k + 1, last)]});
    const double excess = worst / usual;
    trust_[s] = excess > 1 ? 1 / (excess * excess) : 1;
  }
}

void EdgeWindows::SumStretches() {
  const int last = static_cast<int>(moments_.size()) - 1;
  for (int center = 0; center <= last; center += kStretchesPerStep) {
    // Towards the ends the other blade and the tip change the light quickly: the windows shrink
    // with the distance.
    const int reach = std::clamp(std::min(center, last - center), kReachAtEnds, kReach);
    LevelMoments& sum = sums_.emplace_back();
    for (int s = std::max(center - reach, 0); s <= std::min(center + reach, last); ++s) {
      sum.Add(moments_[Index(s)], trust_[Index(s)]);
    }
  }
}

void EdgeWindows::Solve(const LevelVector& precision) {
  if (sums_.empty()) SumStretches();
  fits_.resize(sums_.size());
  constexpr int kPart = 16;  // windows that are worth a thread
  ParallelForBands(static_cast<int>(sums_.size()), kPart, [&](int first, int last) {
    for (int w = first; w < last; ++w) fits_[Index(w)] = SolveLevels(sums_[Index(w)], precision);
  });
}

LevelVector EdgeWindows::SupportedSlopes() const { return SlopePrecision(fits_, kOverlap); }

double EdgeWindows::PlacedShare() const {
  constexpr double kInformation = 9;  // 1/px^2
  const auto placed = std::count_if(fits_.begin(), fits_.end(), [](const LevelFit& fit) {
    return fit.offset_information > kInformation * std::max(fit.chi_square_per_pixel, 1.0);
  });
  return static_cast<double>(placed) / static_cast<double>(fits_.size());
}

const LevelFit& EdgeWindows::Nearest(int sample) const {
  const long nearest = std::lround(Position(sample));
  return fits_[static_cast<size_t>(std::clamp(nearest, 0L, static_cast<long>(fits_.size()) - 1))];
}

LevelVector EdgeWindows::LevelsAt(int sample) const {
  const int last = static_cast<int>(fits_.size()) - 1;
  const double position = std::clamp(Position(sample), 0.0, static_cast<double>(last));
  const int a = static_cast<int>(position), b = std::min(a + 1, last);
  const double t = position - a;
  LevelVector levels = (1 - t) * fits_[Index(a)].levels + t * fits_[Index(b)].levels;
  levels[kShift] = levels[kSpread] = 0;
  return levels;
}

std::vector<double> EdgeWindows::AlongTheEdge(const std::vector<double>& of_windows) const {
  std::vector<double> values;
  const int last = static_cast<int>(of_windows.size()) - 1;
  for (int i = 0; i < samples_; ++i) {
    const double position = std::clamp(Position(i), 0.0, static_cast<double>(last));
    const int a = static_cast<int>(position), b = std::min(a + 1, last);
    values.push_back(of_windows[Index(a)] +
                     (position - a) * (of_windows[Index(b)] - of_windows[Index(a)]));
  }
  return values;
}

int EdgeWindows::CenterSample(size_t window) const {
  return std::min(static_cast<int>(window) * stretch_ * kStretchesPerStep, samples_ - 1);
}

}  // namespace bladecurve
