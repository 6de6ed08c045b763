// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace bladecurve {

// A smooth curve in the picture, sampled about every pixel of its length.
struct EdgePath {
  std::vector<Eigen::Vector2d> points;    // px
  std::vector<Eigen::Vector2d> tangents;  // unit, along the path
  std::vector<Eigen::Vector2d> normals;   // unit, out of the blade
  std::vector<double> curvatures;         // 1/px, positive where the blade is convex
  bool blade_on_left = true;              // as EdgeGuess means it

  [[nodiscard]] int size() const { return static_cast<int>(points.size()); }
};

// Place in a vector of sample or station i.
[[nodiscard]] inline std::size_t Index(int i) { return static_cast<std::size_t>(i); }

// The polyline resampled every pixel, its corners rounded over about smoothing_px.
// Throws Refused{kEdgeTooShort} if it has no length.
[[nodiscard]] EdgePath SmoothPath(const std::vector<Eigen::Vector2d>& polyline,
                                  bool blade_on_left,
                                  double smoothing_px);

// Each point moved by its offset along its normal; offsets are to vary slowly.
[[nodiscard]] std::vector<Eigen::Vector2d> Shifted(const EdgePath& path,
                                                   const std::vector<double>& offsets_px);

// Evenly spaced values along an edge, one for each of `count` samples: the value before it.
[[nodiscard]] std::vector<double> SpreadEvenly(const std::vector<double>& values, int count);

// The curve f that minimises sum w (f - v)^2 + stiffness sum (second difference of f)^2: follows
// the values where they have weight, bridges the gaps between by cubics (Whittaker 1923). One value
// per sample; weights >= 0, some positive.
[[nodiscard]] std::vector<double> SmoothValues(const std::vector<double>& values,
                                               const std::vector<double>& weights,
                                               double stiffness);

}  // namespace bladecurve
