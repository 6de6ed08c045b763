// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/marker_least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <optional>

#include "vision/scale/straight_edge.h"

namespace bladecurve {
namespace {

struct Equations {
  MarkerMatrix information = MarkerMatrix::Zero();
  MarkerVector gradient = MarkerVector::Zero();
  double sum_square = 0;
};

// What little is known beforehand keeps in place what overexposed paper hides: its light against
// the retreat. Standard deviations, for light that scatters by a hundredth.
MarkerVector PriorInformation() {
  constexpr double kScatter = 0.01, kRetreatSigma = 2, kPaperSigma = 1;
  MarkerVector prior = MarkerVector::Constant(1e-9);
  prior[kRetreat] = kScatter * kScatter / (kRetreatSigma * kRetreatSigma);
  prior[kPaper] = kScatter * kScatter / (kPaperSigma * kPaperSigma);
  return prior;
}

Equations EquationsAt(const MarkerProblem& problem,
                      const std::vector<MarkerPixel>& pixels,
                      const MarkerVector& at) {
  const MarkerModel model(problem.ink, problem.frame, at);
  Equations equations;
  MarkerVector derivative;
  for (const MarkerPixel& pixel : pixels) {
    const double residual = pixel.light - model.Light(pixel.place, &derivative);
    equations.information.noalias() += derivative * derivative.transpose();
    equations.gradient += residual * derivative;
    equations.sum_square += residual * residual;
  }
  const MarkerVector off = problem.start - at, prior = PriorInformation();
  equations.information.diagonal() += prior;
  equations.gradient += prior.cwiseProduct(off);
  equations.sum_square += off.dot(prior.cwiseProduct(off));
  return equations;
}

bool Plausible(const MarkerVector& at) {
  return at.allFinite() && at[kBlur] <= kMaxBlurPx && at[kInk] < at[kPaper];
}

}  // namespace

// Where paper is far beyond white, its light against the retreat comes to rest slowly, long after
// the corners.
MarkerMinimum MinimiseMarker(const MarkerProblem& problem,
                             const std::vector<MarkerPixel>& pixels,
                             MarkerVector at) {
  constexpr int kMostSteps = 30;
  constexpr double kDonePx = 1e-3, kDoneShare = 0.01;  // of the squares that a step would save
  double damping = 1e-4;
  Equations now = EquationsAt(problem, pixels, at);
  for (int step = 0; step < kMostSteps && damping < 1e6; ++step) {
    MarkerMatrix damped = now.information;
    damped.diagonal() *= 1 + damping;
    const MarkerVector change = damped.ldlt().solve(now.gradient);
    MarkerVector next = at + change;
    next[kBlur] = std::max(next[kBlur], kMinBlurPx);
    const double moved_px =
        change.head<kHomography>().cwiseAbs().maxCoeff() * problem.frame.cell_px;
    if (moved_px < kDonePx && change.dot(now.gradient) < kDoneShare * now.sum_square)
      return {Plausible(next) ? next : at, now.information};
    const std::optional<Equations> there =
        Plausible(next) ? std::optional(EquationsAt(problem, pixels, next)) : std::nullopt;
    if (!there || there->sum_square > now.sum_square) {
      damping = std::max(10 * damping, 1e-3);
      continue;
    }
    at = next;
    now = *there;
    damping *= 0.1;
  }
  return {at, now.information};
}

}  // namespace bladecurve
