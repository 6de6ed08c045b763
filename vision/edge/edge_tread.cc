// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_tread.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "vision/edge/light_along.h"
#include "vision/image/blurred_step.h"

namespace bladecurve {
namespace {

// Light across an edge, from within the blade to the ground.
constexpr double kFromPx = -7, kToPx = 4, kStepPx = 0.5;
constexpr Eigen::Index kSamples = static_cast<Eigen::Index>((kToPx - kFromPx) / kStepPx) + 1;

using TreadProfile = Eigen::Array<double, kSamples, 1>;

double AcrossPx(Eigen::Index i) { return kFromPx + kStepPx * static_cast<double>(i); }

std::optional<TreadProfile> TreadProfileAcross(const cv::Mat& grey,
                                               const ToneCurve& tone,
                                               const LocatedEdge& edge) {
  TreadProfile light;
  for (Eigen::Index i = 0; i < kSamples; ++i) {
    const auto at = TypicalLight(grey, tone, edge, AcrossPx(i));
    if (!at) return std::nullopt;
    light[i] = *at;
  }
  return light;
}

// From 0 to 1 at a place, blurred.
TreadProfile BlurredAt(double at_px, double blur_px) {
  TreadProfile step;
  for (Eigen::Index i = 0; i < kSamples; ++i)
    step[i] = BlurredPower(AcrossPx(i) - at_px, 0, blur_px);
  return step;
}

// Least squares of plate + heights * steps.
template <int kSteps>
struct StepFit {
  Eigen::Matrix<double, 1 + kSteps, 1> heights;  // the plate's light first
  double squares = std::numeric_limits<double>::infinity();
};

template <typename... Steps>
StepFit<sizeof...(Steps)> FitSteps(const TreadProfile& light, const Steps&... steps) {
  Eigen::Matrix<double, kSamples, 1 + sizeof...(Steps)> terms;
  terms.col(0).setOnes();
  Eigen::Index column = 1;
  ((terms.col(column++) = steps.matrix()), ...);
  StepFit<sizeof...(Steps)> fit;
  fit.heights = (terms.transpose() * terms).ldlt().solve(terms.transpose() * light.matrix());
  fit.squares = (light.matrix() - terms * fit.heights).squaredNorm();
  return fit;
}

constexpr double kOffs[] = {-0.6, -0.4, -0.2, 0, 0.2, 0.4, 0.6};  // px, of the outer step
constexpr double kBlurs[] = {0.4, 0.5, 0.6, 0.7, 0.85, 1, 1.2, 1.5, 1.8, 2.2, 2.7};

double SquaresOfOneStep(const TreadProfile& light) {
  double least = std::numeric_limits<double>::infinity();
  for (const double blur : kBlurs) {
    for (const double off : kOffs) {
      least = std::min(least, FitSteps(light, BlurredAt(off, blur)).squares);
    }
  }
  return least;
}

struct TwoSteps {
  Tread tread;
  StepFit<2> fit;
};

TwoSteps FitTwoSteps(const TreadProfile& light) {
  constexpr double kNarrowest = 0.8, kWidest = 5, kFiner = 0.2;
  constexpr double kPerBlur = 1.6;  // narrower ones are blur
  constexpr double kSoft = 1;       // px; what is softer is a soft shadow's slope
  TwoSteps best;
  for (const double blur : kBlurs) {
    if (blur > kSoft) break;
    for (const double off : kOffs) {
      const TreadProfile outer = BlurredAt(off, blur);
      for (double width = std::max(kNarrowest, kPerBlur * blur); width <= kWidest;
           width += kFiner) {
        const StepFit<2> fit = FitSteps(light, BlurredAt(off - width, blur), outer);
        if (fit.squares < best.fit.squares) best = {{off - width, width, 0}, fit};
      }
    }
  }
  return best;
}

// Whether light leaves the plate earlier than it reaches the ground, as blur alone does not.
bool MayHaveTread(const TreadProfile& light) {
  constexpr double kDarker = 1.5, kLeast = 0.025;  // of the step
  constexpr double kPlatePx = -6, kBesidePx = 1.5;
  constexpr double kPlainWhite = 0.93;  // cuts off how light reaches the ground
  const auto at = [&](double px) { return light[std::lround((px - kFromPx) / kStepPx)]; };
  const double plate = at(kPlatePx), ground = at(kToPx), step = ground - plate;
  if (ground < kDarker * plate || ground > kPlainWhite) return false;
  return (at(-kBesidePx) - plate) - (ground - at(kBesidePx)) > kLeast * step;
}

}  // namespace

std::optional<Tread> FindTread(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const LocatedEdge& edge) {
  constexpr double kBetter = 0.35;                 // of the squares
  constexpr double kMisfit = 0.008;                // of the step, rms, of one step
  constexpr double kFaintest = 0.03, kMost = 0.5;  // of the step, the tread's
  const std::optional<TreadProfile> light = TreadProfileAcross(grey, tone, edge);
  if (!light || !MayHaveTread(*light)) return std::nullopt;
  const double one = SquaresOfOneStep(*light);
  TwoSteps two = FitTwoSteps(*light);
  const double inner = two.fit.heights[1], step = inner + two.fit.heights[2];
  if (two.fit.squares > kBetter * one || std::sqrt(one / kSamples) < kMisfit * step)
    return std::nullopt;
  if (inner < kFaintest * step || inner > kMost * step) return std::nullopt;
  two.tread.share = (two.fit.heights[0] + inner) / (two.fit.heights[0] + step);
  return two.tread;
}

}  // namespace bladecurve
