// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "curvefit/fit_report.h"
#include "curvefit/linear_spline.h"

namespace bladecurve {

struct KnotRequest {
  std::optional<int> degree, num_spans;         // not set: chosen
  std::optional<std::vector<double>> interior;  // these knots and no others
  double lower = 0, upper = 1;                  // ends of the spline
  double effective_points = 0;                  // independent samples that the points are worth
};

struct KnotChoice {
  LinearSpline spline;
  std::vector<KnotCandidate> tried;
  bool limited_by_data = false;  // more pieces were asked for than the points support
};

// The spline of lowest degree and fewest knots that the points (sorted by u) need: a line, a
// parabola, a cubic, then, where noise does not explain what these leave, knots one by one where
// the residuals ask for them, as long as the Bayesian information criterion falls. Every choice
// meets the Schoenberg-Whitney conditions.
[[nodiscard]] KnotChoice ChooseKnots(const std::vector<FlatPoint>& points,
                                     const KnotRequest& request);

// Whether points can be matched to basis functions such that each is positive at its own point;
// points sorted by u.
[[nodiscard]] bool SchoenbergWhitney(const std::vector<FlatPoint>& points,
                                     const SplineSpace& space);

}  // namespace bladecurve
