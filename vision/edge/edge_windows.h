// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vision/edge/edge_levels.h"

namespace bladecurve {

// Overlapping windows along an edge, one every two stretches and 13 stretches long, with the levels
// found in each. A value "along the edge" has one entry a sample.
class EdgeWindows {
 public:
  // stretch: samples whose pixels are kept together; 4 make windows of about 50 samples.
  EdgeWindows(int samples, int stretch);

  void Add(int sample, const LevelVector& terms, double light, double weight);

  // Takes stretches whose pixels fit worse than their like out of the balance;
  // chi_square: per pixel, of the stretches of an earlier round, evenly spaced.
  void Distrust(const std::vector<double>& chi_square);

  // Levels of every window, the terms held to zero by their precision (edge_levels.h). Pixels that
  // are added after the first Solve have no say.
  void Solve(const LevelVector& precision);

  // The precision that keeps slopes only where the windows together support them; after a Solve
  // that left them free.
  [[nodiscard]] LevelVector SupportedSlopes() const;

  [[nodiscard]] const std::vector<LevelFit>& fits() const { return fits_; }
  [[nodiscard]] double PlacedShare()
      const;  // of the windows that place the edge to a third of a px
  [[nodiscard]] const LevelFit& Nearest(int sample) const;
  [[nodiscard]] LevelVector LevelsAt(int sample) const;  // interpolated; no shift or spread
  [[nodiscard]] std::vector<double> AlongTheEdge(const std::vector<double>& of_windows) const;
  [[nodiscard]] int CenterSample(size_t window) const;  // the sample a window is centred on

 private:
  // Window coordinate of a sample: window w is centred on the middle of stretch 2 w.
  [[nodiscard]] double Position(int sample) const;

  void SumStretches();

  int samples_, stretch_;
  std::vector<LevelMoments> moments_;  // of stretches
  std::vector<LevelMoments> sums_;     // of windows, once they are asked for
  std::vector<double> trust_;
  std::vector<LevelFit> fits_;
};

}  // namespace bladecurve
