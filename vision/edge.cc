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
  const EdgePath rough = SmoothPath(guess.path_px, guess.blade_on_left, kGuessSmoothing);
  const ChosenTransition chosen = ChooseTransition(grey, rough, guess.search_px);
  RefuseIfUnseen(chosen);
  EdgeFitOptions fit_options;
  fit_options.inner_px = chosen.inner_px;
  fit_options.outer_px = chosen.outer_px;
  fit_options.blur_px = chosen.blur_px;
  fit_options.correct_curvature = options.correct_curvature;
  fit_options.model_slopes = options.model_background_slope;
  const EdgeFit fit = FitEdge(grey, tone, chosen.points, guess.blade_on_left, fit_options);
  LocatedEdge edge = PointsFromFit(fit, options);
  edge.ambiguity = chosen.ambiguity;
  edge.common_sigma_px = ToneSigma(fit, tone);
  return edge;
}

}  // namespace bladecurve
