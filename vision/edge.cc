// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "vision/blurred_step.h"
#include "vision/edge_band.h"
#include "vision/edge_choice.h"
#include "vision/edge_fit.h"
#include "vision/edge_path.h"
#include "vision/edge_scatter.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

constexpr double kGuessSmoothing = 3;  // px: rounds the corners of the guessed polyline
constexpr double kBackgroundPx = 10;   // seen beyond the search range, to know the background
constexpr double kBladePx = 8;         // the same inwards

void Check(const cv::Mat& grey, const EdgeGuess& guess, const EdgeOptions& options) {
  if (grey.empty() || grey.type() != CV_8UC1)
    throw std::invalid_argument("edge: grey must be CV_8UC1");
  if (guess.path_px.size() < 2)
    throw std::invalid_argument("edge: path_px needs two points or more");
  if (!(guess.search_px > 0)) throw std::invalid_argument("edge: search_px must be positive");
  if (!(options.step_px > 0)) throw std::invalid_argument("edge: step_px must be positive");
  if (!(options.outlier_sigmas > 0))
    throw std::invalid_argument("edge: outlier_sigmas must be positive");
}

// The transition chosen, and where it runs in the picture.
struct Traced {
  std::vector<Eigen::Vector2d> points;
  ChosenTransition chosen;
};

Traced Trace(const cv::Mat& grey, const ToneCurve& tone, const EdgePath& path, double search_px) {
  const StraightBand band =
      StraightenBand(grey, tone, path, search_px + kBladePx, search_px + kBackgroundPx);
  Traced traced;
  traced.chosen = ChooseTransition(band, search_px);
  traced.points = Shifted(path, traced.chosen.offset_px);
  return traced;
}

Traced FindTransition(const cv::Mat& grey, const ToneCurve& tone, const EdgeGuess& guess) {
  const EdgePath rough = SmoothPath(guess.path_px, guess.blade_on_left, kGuessSmoothing);
  return Trace(grey, tone, rough, guess.search_px);
}

void RefuseIfUnseen(const ChosenTransition& chosen) {
  constexpr double kLeastSupport = 0.1;  // below, most of the line is drawn through texture
  if (chosen.support >= kLeastSupport) return;
  throw Refused(Reason::kLowContrast,
                "edge: the blade stands out from its background along only " +
                    std::to_string(std::lround(100 * chosen.support)) +
                    " % of its edge; use another background or light");
}

}  // namespace

LocatedEdge LocateEdge(const cv::Mat& grey,
                       const ToneCurve& tone,
                       const EdgeGuess& guess,
                       const EdgeOptions& options) {
  Check(grey, guess, options);
  const Traced traced = FindTransition(grey, tone, guess);
  RefuseIfUnseen(traced.chosen);
  EdgeFitOptions fit_options;
  fit_options.inner_px = traced.chosen.inner_px;
  fit_options.outer_px = traced.chosen.outer_px;
  fit_options.correct_curvature = options.correct_curvature;
  fit_options.model_slopes = options.model_background_slope;
  const EdgeFit fit = FitEdge(grey, tone, traced.points, guess.blade_on_left, fit_options);
  LocatedEdge edge = PointsFromFit(fit, options);
  edge.ambiguity = traced.chosen.ambiguity;
  edge.common_sigma_px = ToneSigma(fit, tone);
  return edge;
}

}  // namespace bladecurve
