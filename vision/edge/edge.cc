// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "vision/edge/edge_choice.h"
#include "vision/edge/edge_common.h"
#include "vision/edge/edge_fit.h"
#include "vision/edge/edge_path.h"
#include "vision/edge/edge_scatter.h"
#include "vision/edge/edge_softness.h"
#include "vision/image/robust_statistics.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

constexpr double kLeastClear =
    0.15;  // share of stations with a clear step; noise alone reaches a tenth
constexpr double kLeastPlaced =
    0.3;  // share of windows that place the edge; below, most of it is a guess
constexpr double kMostBroken =
    0.25;  // share of the edge without a break; beyond, two lines were taken for one
constexpr double kGuessSmoothing = 3;  // px: rounds the corners of the guessed polyline

void Check(const cv::Mat& grey, const EdgeGuess& guess) {
  if (grey.empty() || grey.type() != CV_8UC1)
    throw std::invalid_argument("edge: grey must be CV_8UC1");
  if (guess.path_px.size() < 2)
    throw std::invalid_argument("edge: path_px needs two points or more");
  if (!(guess.search_px > 0)) throw std::invalid_argument("edge: search_px must be positive");
}

void RefuseIfTooShort(const EdgePath& path) {
  constexpr int kLeastLength = 12;  // px; shorter, a line cannot be told from a curve
  if (path.size() >= kLeastLength) return;
  throw Refused(Reason::kEdgeTooShort,
                "edge: " + std::to_string(path.size()) +
                    " px of free edge are too few; photograph from nearer");
}

// What edges are looked for in, and about where.
struct Picture {
  const cv::Mat& grey;
  const ToneCurve& tone;
  const EdgeOptions& options;
  const EdgePath& rough;
};

void RefuseIfUnseen(double share_seen, double least_share, const Picture& picture) {
  if (share_seen >= least_share) return;
  constexpr double kSharpPrintPx = 3;  // beside which a soft line is a shadow's border
  if (!(picture.options.most_blur_px < kSharpPrintPx) &&
      IsBlurredAway(picture.grey, picture.rough)) {
    throw Refused(Reason::kBlurred,
                  "edge: too soft to be located; focus on the blades, hold the camera still, or "
                  "keep shadows off them");
  }
  throw Refused(Reason::kLowContrast,
                "edge: the blade stands out from its background along only " +
                    std::to_string(std::lround(100 * share_seen)) +
                    " % of its edge; use another background or light");
}

using Point = std::vector<LocatedEdgePoint>::const_iterator;

// How many points in a row stray, at most.
size_t MostStrayInARow(Point from, Point to) {
  size_t stray = 0, most = 0;
  for (Point point = from; point != to; ++point) {
    stray = point->inlier ? 0 : stray + 1;
    most = std::max(most, stray);
  }
  return most;
}

double ShareOf(const LocatedEdge& edge, size_t points) {
  return static_cast<double>(points) / static_cast<double>(std::max(edge.points.size(), size_t{1}));
}

// As LongestStray, but between points that count.
double LongestGap(const LocatedEdge& edge) {
  const auto counts = [](const LocatedEdgePoint& point) { return point.inlier; };
  const Point first = std::find_if(edge.points.begin(), edge.points.end(), counts);
  const auto last = std::find_if(edge.points.rbegin(), edge.points.rend(), counts);
  return first == edge.points.end() ? 0 : ShareOf(edge, MostStrayInARow(first, last.base()));
}

void RefuseIfBroken(double gap) {
  if (gap <= kMostBroken) return;
  throw Refused(Reason::kLowContrast,
                "edge: lost along " + std::to_string(std::lround(100 * gap)) +
                    " % of the blade; use another background or light");
}

// The edge as the fit sees it, along the transition that was chosen.
LocatedEdge FitAlong(const ChosenTransition& chosen, bool blade_on_left, const Picture& picture) {
  const EdgeOptions& options = picture.options;
  RefuseIfUnseen(chosen.support, kLeastClear, picture);
  EdgeFitOptions fit_options;
  fit_options.inner_px = chosen.inner_px;
  fit_options.outer_px = chosen.outer_px;
  fit_options.blur_px = options.blur_px.value_or(chosen.blur_px);
  fit_options.blur_known = options.blur_px.has_value();
  fit_options.most_blur_px = options.most_blur_px;
  fit_options.may_be_softer = options.may_be_softer;
  const EdgeFit fit =
      FitEdge(picture.grey, picture.tone, chosen.points, blade_on_left, fit_options);
  RefuseIfUnseen(fit.seen, kLeastPlaced, picture);
  LocatedEdge edge = PointsFromFit(fit);
  edge.overexposed = fit.overexposed;
  const double gap = LongestGap(edge);
  RefuseIfBroken(gap);
  edge.ambiguity = std::max({chosen.ambiguity, 1 - chosen.support, gap / kMostBroken});
  edge.rival_px = chosen.rival_px;
  edge.rival_path_px = chosen.rival;
  edge.rival_sigma_px = RivalSigma(chosen);
  edge.slope_sigma_px = SlopeSigma(fit);
  edge.common_sigma_px = CommonSigma(fit, picture.tone, chosen, options.blur_px.has_value());
  return edge;
}

// The same, the shadow being taken for the blade: it ends at an inner transition then, as a bevel
// does, of which the fit knows.
LocatedEdge FitFromTheShadow(ChosenTransition chosen, bool blade_on_left, const Picture& picture) {
  std::swap(chosen.inner_px, chosen.outer_px);
  LocatedEdge edge = FitAlong(chosen, !blade_on_left, picture);
  for (LocatedEdgePoint& point : edge.points) {
    point.normal = -point.normal;
    point.contrast = -point.contrast;
  }
  return edge;
}

// Median of one of the numbers of the points that count.
double MedianOf(double LocatedEdgePoint::*number, const std::vector<LocatedEdgePoint>& points) {
  std::vector<double> numbers;
  for (const LocatedEdgePoint& point : points) {
    if (point.inlier) numbers.push_back(point.*number);
  }
  return Median(std::move(numbers));
}

EdgePath RoughPath(const cv::Mat& grey, const EdgeGuess& guess) {
  Check(grey, guess);
  EdgePath rough = SmoothPath(guess.path_px, guess.blade_on_left, kGuessSmoothing);
  RefuseIfTooShort(rough);
  return rough;
}

}  // namespace

double TypicalContrast(const LocatedEdge& edge) {
  return MedianOf(&LocatedEdgePoint::contrast, edge.points);
}

double TypicalSigma(const std::vector<LocatedEdgePoint>& points) {
  return MedianOf(&LocatedEdgePoint::sigma_px, points);
}

double TotalSigma(const LocatedEdge& edge) {
  return std::hypot(TypicalSigma(edge.points), edge.common_sigma_px);
}

double BlurOr(const LocatedEdge& edge, double usual_px) {
  return std::isfinite(edge.blur_px) ? edge.blur_px : usual_px;
}

std::size_t NearestPoint(const LocatedEdge& edge, const Eigen::Vector2d& place_px) {
  const auto nearest =
      std::min_element(edge.points.begin(), edge.points.end(), [&](const auto& a, const auto& b) {
        return (a.trend_px - place_px).squaredNorm() < (b.trend_px - place_px).squaredNorm();
      });
  return static_cast<std::size_t>(nearest - edge.points.begin());
}

double DistanceTo(const LocatedEdge& edge, const Eigen::Vector2d& place_px) {
  return (edge.points[NearestPoint(edge, place_px)].trend_px - place_px).norm();
}

double LongestStray(const LocatedEdge& edge) {
  return ShareOf(edge, MostStrayInARow(edge.points.begin(), edge.points.end()));
}

LocatedEdge LocateEdge(const cv::Mat& grey,
                       const ToneCurve& tone,
                       const EdgeGuess& guess,
                       const EdgeOptions& options) {
  const EdgePath rough = RoughPath(grey, guess);
  return FitAlong(ChooseTransition(grey, rough, guess.search_px),
                  guess.blade_on_left,
                  {grey, tone, options, rough});
}

LocatedEdge LocateEdgeBeyond(const LocatedEdge& line,
                             double width_px,
                             bool blade_on_left,
                             const cv::Mat& grey,
                             const ToneCurve& tone,
                             const EdgeOptions& options) {
  constexpr double kUsualBlurPx = 0.9;
  EdgeGuess guess{{}, blade_on_left};
  ChosenTransition chosen;
  for (const LocatedEdgePoint& point : line.points)
    guess.path_px.push_back(point.trend_px + width_px * point.normal);
  const EdgePath rough = RoughPath(grey, guess);
  chosen.points = rough.points;
  chosen.inner_px = {width_px};
  chosen.outer_px = {kNoTransition};
  chosen.blur_px = BlurOr(line, kUsualBlurPx);
  chosen.support = 1;
  return FitAlong(chosen, blade_on_left, {grey, tone, options, rough});
}

LocatedEdge LocateEdgeInShadow(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const EdgeGuess& guess,
                               Shadow shadow,
                               const EdgeOptions& options) {
  const EdgePath rough = RoughPath(grey, guess);
  const ChosenTransition start = ChooseShadow(grey, rough, guess.search_px, shadow);
  const Picture picture{grey, tone, options, rough};
  // A shadow that ends softly is a slope beside the blade, one that ends sharply another step.
  const auto sharp =
      UnlessRefused([&] { return FitFromTheShadow(start, guess.blade_on_left, picture); });
  const auto fit_soft = [&] { return FitAlong(start, guess.blade_on_left, picture); };
  if (!sharp) return fit_soft();
  const auto soft = UnlessRefused(fit_soft);
  return soft && TotalSigma(*soft) < TotalSigma(*sharp) ? *soft : *sharp;
}

}  // namespace bladecurve
