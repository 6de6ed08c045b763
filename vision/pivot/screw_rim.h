// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "vision/pivot/screw_ellipse.h"

namespace bladecurve {

struct RimFitOptions {
  double first_half_px = 3;  // of the profiles across the rim: how far off the start may be
  double last_half_px = 2;   // narrower in the end, so that slot and ground disturb less
  bool flat_window = false;  // whole profiles count: exact on a clean rim; else mostly their middle
  int shading = 0;           // degree to which light goes with the distance within the head
  // Middle of a third of the rim that has no say; as in RimFit::odd_third_rad.
  std::optional<double> left_out_rad = std::nullopt;
  bool grain = false;      // in the end, each place of the rim is matched as its grain demands
  int most_profiles = 96;  // about one per px of rim up to this many; more only cost time
  int iterations = 6;
  double converged_px = 0.02;     // a smaller change ends the iterations
  double hopeless_support = 0.4;  // less than that after half the iterations: given up
  // Heads are round: how far the semi-axes may be expected to part, of the radius. Where only two
  // opposite arcs are seen this keeps the rest in place. 0: nothing is expected.
  double expected_flattening = 0;
};

struct RimFit {
  RimEllipse rim;
  Eigen::Matrix2d center_covariance;  // px^2; from the scatter of the rim's points, in blocks that
                                      // may be correlated
  // Share of the rim whose profile looks like the common one, at the fitted place.
  double support = 0;
  double third_support = 0;  // the same of that third of the rim where it is least
  double odd_third_rad = 0;  // its middle, angle of u in RimEllipse
  // How the light just within the rim differs from side to side: amplitude of its first harmonic
  // over its mean. Light from everywhere leaves it below 0.01, a lamp brings it to 0.1 and more.
  double one_sided = 0;
};

// Fits an ellipse to the rim near `start` in a CV_32F picture. What the rim looks like across (a
// step, a groove, a bright line, with what blur) is not assumed but learnt from the picture: it is
// what the profiles all round have in common. Each profile is shifted against that common shape
// (Gauss-Newton), and the ellipse is fitted to the shifts (Tukey's biweight). std::nullopt where
// that does not lead to an ellipse near the start.
[[nodiscard]] std::optional<RimFit> FitRim(const cv::Mat& picture,
                                           const RimEllipse& start,
                                           const RimFitOptions& options = {});

}  // namespace bladecurve
