// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "model/blade_curve.h"
#include "vision/edge_points.h"

namespace bladecurve {

// Gaussian numbers that are the same with every standard library.
class Noise {
 public:
  explicit Noise(unsigned seed) : random_(seed) {}
  double Uniform();  // (0, 1)
  double Gaussian();
  Eigen::Vector2d Gaussian(const Eigen::Matrix2d& covariance);

 private:
  std::mt19937 random_;
};

// A pair of scissors, known exactly: the upper edge y(x) at an angle, or v = s(u) turned by half of
// it.
struct TrueScissors {
  BladeShape shape;
  double u_first_mm = 12, u_end_mm = 60;  // free edge, from the crotch to the distal end
};

// How it is photographed. Everything observed scatters by its stated sigma.
struct SimulatedPhoto {
  double theta_rad = 0.5;
  int points = 400;
  double seen_end_mm = std::numeric_limits<double>::infinity();  // beyond it the edge is lost
  double sigma_mm = 0.02;                                        // of an edge point
  double pivot_sigma_mm = 0.05;
  // Along the symmetry line; far larger where the screw is not seen.
  std::optional<double> pivot_along_sigma_mm;
  double end_along_sigma_mm = 0.2;  // of the distal ends along their edges
  double scale_sigma = 0, offset_sigma_mm = 0;
  double correlation_length_mm = 0;   // the noise of neighbours is a running mean over this
  Eigen::Vector2d pivot_mm = {0, 0};  // in the frame of the EdgePoints
  double axis_rad = 0;
  bool lower = true;
  bool theta_given = false;
  double theta_sigma_rad = 0.001;
  double noise_scale =
      1;  // 0: exact observations with the stated sigmas; 2: sigmas too small by two
};

// The same observations that the fit gets from a photograph.
[[nodiscard]] EdgePoints Photograph(const TrueScissors& scissors,
                                    const SimulatedPhoto& photo,
                                    Noise& noise);

// An edge of radius about 250 mm that crosses the ray to its end: s(u_end) = 0.
[[nodiscard]] TrueScissors CurvedScissors();
// A spline of the degree and interior knots, coefficients of common size, s(u_end) = 0.
[[nodiscard]] TrueScissors SplineScissors(int degree, const std::vector<double>& interior_mm);
// A straight edge that turns rigidly.
[[nodiscard]] TrueScissors StraightScissors();
// The paper's small scissors.
[[nodiscard]] TrueScissors TaperedScissors(double gain = 0.5);

// The true curve, over a domain wide enough for every test.
[[nodiscard]] BladeCurve TrueCurve(const TrueScissors& scissors);

}  // namespace bladecurve
