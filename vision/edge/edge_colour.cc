// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_colour.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/edge/edge_path.h"
#include "vision/edge/edge_survey.h"
#include "vision/image/pixel_light.h"
#include "vision/image/reduced.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRounding = 0.004;  // linear light; a grey level: no channel scatters less

// Mean and scatter of the light on one side of an edge; grey pictures fill all three channels.
struct SideLight {
  Vector3d mean = Vector3d::Zero();
  Matrix3d scatter = Matrix3d::Zero();
};

// The side `outwards` of the path (-1: the blade), some way off it: the guess may be as far off as
// its search range. The part near the crotch, where the other blade is close, is left out.
SideLight SampleSide(const PicturePart& picture,
                     const ToneCurve& tone,
                     const EdgePath& path,
                     double search_px,
                     double outwards) {
  constexpr double kFirst = 0.4, kLast = 0.9;        // shares of the path
  constexpr double kNearest = 0.5, kFarthest = 1.5;  // of the search range
  SideLight side;
  double count = 0;
  for (int i = static_cast<int>(kFirst * path.size()); i < kLast * path.size(); i += 2) {
    const auto k = static_cast<size_t>(i);
    for (double d = kNearest * search_px; d <= kFarthest * search_px; d += 2) {
      const auto light = LightAt(picture, tone, path.points[k] + outwards * d * path.normals[k]);
      if (!light) continue;
      side.mean += *light;
      side.scatter += *light * light->transpose();
      ++count;
    }
  }
  side.mean /= std::max(count, 1.0);
  side.scatter = side.scatter / std::max(count, 1.0) - side.mean * side.mean.transpose();
  return side;
}

struct Sides {
  SideLight blade, ground;

  [[nodiscard]] Matrix3d Scatter() const {
    return 0.5 * (blade.scatter + ground.scatter) + kRounding * kRounding * Matrix3d::Identity();
  }
  [[nodiscard]] double SeparationAlong(const Vector3d& weights) const {
    return std::abs(weights.dot(ground.mean - blade.mean)) /
           std::sqrt(weights.dot(Scatter() * weights));
  }
};

Sides SampleSides(const PicturePart& picture, const ToneCurve& tone, const EdgeGuess& guess) {
  constexpr double kSmoothing = 3;  // px
  const EdgePath path = SmoothPath(guess.path_px, guess.blade_on_left, kSmoothing);
  return {SampleSide(picture, tone, path, guess.search_px, -1),
          SampleSide(picture, tone, path, guess.search_px, 1)};
}

// Light from a channel's stored value, times the channel's weight.
using WeightedLight = std::array<std::array<float, 256>, 3>;

WeightedLight Weighted(const ToneCurve& tone, const Vector3d& weights) {
  WeightedLight light;
  for (size_t c = 0; c < 3; ++c) {
    for (size_t v = 0; v < 256; ++v)
      light[c][v] = static_cast<float>(weights[static_cast<Eigen::Index>(c)]) * tone.linear[v];
  }
  return light;
}

// The mixture stretched so that both sides, scatter and all, fill the range of a byte.
cv::Mat Mixed(const cv::Mat& bgr,
              const ToneCurve& tone,
              const Sides& sides,
              const Vector3d& weights) {
  constexpr double kSigmas = 4;  // beyond the means; what lies further out is neither side
  const double a = weights.dot(sides.blade.mean), b = weights.dot(sides.ground.mean);
  const double margin = kSigmas * std::sqrt(weights.dot(sides.Scatter() * weights));
  const double low = std::min(a, b) - margin, range = std::abs(a - b) + 2 * margin;
  const WeightedLight light = Weighted(tone, weights * 255 / range);
  const auto black = static_cast<float>(0.5 - 255 * low / range);
  cv::Mat mixed(bgr.size(), CV_8UC1);
  for (int y = 0; y < bgr.rows; ++y) {
    const auto* from = bgr.ptr<cv::Vec3b>(y);
    uchar* to = mixed.ptr<uchar>(y);
    for (int x = 0; x < bgr.cols; ++x) {
      const float value =
          black + light[0][from[x][0]] + light[1][from[x][1]] + light[2][from[x][2]];
      to[x] = static_cast<uchar>(std::clamp(value, 0.0F, 255.0F));
    }
  }
  return mixed;
}

ToneCurve LinearTone(const ToneCurve& original) {
  ToneCurve tone = original;
  for (size_t v = 0; v < tone.linear.size(); ++v) tone.linear[v] = static_cast<float>(v) / 255;
  return tone;
}

// What was located in the reduced picture, in px of the photograph.
LocatedEdge Back(const Reduction& reduction, LocatedEdge edge) {
  for (LocatedEdgePoint& p : edge.points) {
    p.point_px = reduction.Back(p.point_px);
    p.trend_px = reduction.Back(p.trend_px);
    p.sigma_px *= reduction.factor;
  }
  for (Vector2d& p : edge.rival_path_px) p = reduction.Back(p);
  for (double* length_px : {&edge.blur_px,
                            &edge.correlation_px,
                            &edge.common_sigma_px,
                            &edge.rival_sigma_px,
                            &edge.slope_sigma_px,
                            &edge.rival_px})
    *length_px *= reduction.factor;
  edge.unbound_blur_px = std::numeric_limits<double>::quiet_NaN();
  return edge;
}

LocatedEdge LocateReduced(const ColourView& view, const EdgeGuess& guess, int factor) {
  if (view.grey.empty())
    throw Refused(Reason::kLowContrast, "edge: it would lie outside of what is seen in colour");
  const Reduction reduction{view.corner_px, factor};
  cv::Mat grey = view.grey;
  if (factor > 1) cv::resize(view.grey, grey, {}, 1.0 / factor, 1.0 / factor, cv::INTER_AREA);
  EdgeGuess reduced = guess;
  for (Vector2d& p : reduced.path_px) p = reduction.There(p);
  reduced.search_px /= factor;
  return Back(reduction, LocateEdge(grey, view.tone, reduced));
}

}  // namespace

double GreySeparation(const cv::Mat& grey, const ToneCurve& tone, const EdgeGuess& guess) {
  const Sides sides = SampleSides(grey, tone, guess);
  return std::abs(sides.ground.mean[0] - sides.blade.mean[0]) / std::sqrt(sides.Scatter()(0, 0));
}

ColourView ViewWhereSidesDiffer(const PicturePart& bgr,
                                const ToneCurve& tone,
                                const EdgeGuess& guess,
                                double shade) {
  Sides sides = SampleSides(bgr, tone, guess);
  sides.ground.scatter += shade * shade * sides.ground.mean * sides.ground.mean.transpose();
  const Vector3d weights = sides.Scatter().ldlt().solve(sides.ground.mean - sides.blade.mean);
  const cv::Rect around = SurveyedPart(bgr.Area(), guess.path_px, guess.search_px);
  ColourView view;
  view.tone = LinearTone(tone);
  view.corner_px = {around.x, around.y};
  const double separation = sides.SeparationAlong(weights);
  if (separation > 0) {
    view.grey = Mixed(bgr.pixels(around - bgr.corner_px), tone, sides, weights);
    view.separation = separation;
  } else {  // plain white on both sides, say, where it is 0 over 0
    view.grey = cv::Mat::zeros(around.size(), CV_8UC1);
    view.separation = 0;
  }
  return view;
}

LocatedEdge LocateEdgeInView(const ColourView& view, const EdgeGuess& guess) {
  return LocateReduced(view, guess, 1);
}

LocatedEdge LocateEdgeInHalvedView(const ColourView& view, const EdgeGuess& guess) {
  constexpr double kOfBlur = 0.15;  // what uneven blocks beside a soft edge move it by
  LocatedEdge edge = LocateReduced(view, guess, 2);
  edge.common_sigma_px = std::hypot(edge.common_sigma_px, kOfBlur * edge.blur_px);
  return edge;
}

}  // namespace bladecurve
