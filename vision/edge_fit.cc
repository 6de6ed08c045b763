// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "vision/blurred_step.h"
#include "vision/edge_band.h"
#include "vision/edge_levels.h"
#include "vision/edge_windows.h"

namespace bladecurve {
namespace {

constexpr int kSketchRounds =
    4;  // on every third sample: from 1.5 px off and a blur wrong by 2 to within 0.05 px
constexpr int kSketchStride = 3;
constexpr double kLeastNoise = 2e-4;  // linear light; rendered pictures without noise

size_t Index(int i) { return static_cast<size_t>(i); }

// Standard deviation without the outliers. Not from a median: in a smooth picture most values are
// rounded to the same.
double RobustSigma(const std::vector<double>& deviations) {
  constexpr double kSigmaPerMean = 1.2533, kOutlier = 4;
  double sum = 0;
  for (const double deviation : deviations) sum += std::abs(deviation);
  const double limit =
      kOutlier * kSigmaPerMean * sum / std::max(static_cast<double>(deviations.size()), 1.0);
  double squares = 0, count = 0;
  for (const double deviation : deviations) {
    if (std::abs(deviation) > limit) continue;
    squares += deviation * deviation;
    ++count;
  }
  return std::sqrt(squares / std::max(count, 1.0));
}

double WeightedMedian(std::vector<std::pair<double, double>> value_and_weight) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double total = 0, passed = 0;
  for (const auto& [value, weight] : value_and_weight) total += weight;
  for (const auto& [value, weight] : value_and_weight) {
    passed += weight;
    if (2 * passed >= total) return value;
  }
  return 0;
}

// Noise may differ between metal and cloth, and does once gamma is undone.
struct SideNoise {
  double blade = 0.02, ground = 0.02;

  [[nodiscard]] double Weight(double step) const {
    return 1 / ((1 - step) * blade * blade + step * ground * ground);
  }
};

// A pixel with what the model needs of it.
struct PreparedPixel {
  double light = 0, weight = 0;
  LevelVector terms;
};

class Fitter {
 public:
  Fitter(const cv::Mat& grey, const ToneCurve& tone, const EdgeFitOptions& options)
      : grey_(grey), tone_(tone), options_(options), blur_(options.blur_px) {}

  EdgeFit Run(const std::vector<Eigen::Vector2d>& start, bool blade_on_left) {
    constexpr double kStartSmoothing = 2;  // px
    path_ = SmoothPath(start, blade_on_left, kStartSmoothing);
    for (int round = 0; round < kSketchRounds; ++round) Improve(kSketchStride);
    Improve(1);
    Solve(1, true);
    return Finish();
  }

 private:
  void Improve(int stride) {
    Solve(stride, false);
    MeasureNoise(stride);
    UpdateBlur();
    Move();
  }

  void Solve(int stride, bool blur_known) {
    inner_px_ = AlongPath(options_.inner_px);
    band_ = GatherPixels(grey_, tone_, path_, {InnerReach(), OuterReach()});
    windows_ = EdgeWindows(path_.size());
    windows_.Distrust(misfit_);
    for (int i = 0; i < band_.size(); i += stride) {
      for (const PreparedPixel& pixel : Prepare(i, 0))
        windows_.Add(i, pixel.terms, pixel.light, pixel.weight);
    }
    windows_.Solve(options_.model_slopes, blur_known);
  }

  // The pixels of sample i, the edge lying `offset` out of the path.
  const std::vector<PreparedPixel>& Prepare(int i, double offset) {
    prepared_.clear();
    const BlurredStep step(path_.normals[Index(i)], blur_);
    const double variance = TotalBlurVariance(blur_);
    // Blur moves the half-way level of a curved edge towards the centre of curvature, by variance /
    // 2R.
    const double bend =
        options_.correct_curvature ? 0.5 * path_.curvatures[Index(i)] * variance : 0;
    for (int p = band_.begin[Index(i)]; p < band_.begin[Index(i) + 1]; ++p) {
      const double across = band_.pixels[Index(p)].across + bend - offset;
      const StepSample sample = step.At(across);
      prepared_.push_back(
          {band_.pixels[Index(p)].light,
           noise_.Weight(sample.step),
           LevelTerms(sample, step.At(across + inner_px_[Index(i)]), across, variance)});
    }
    return prepared_;
  }

  [[nodiscard]] std::vector<double> AlongPath(const std::vector<double>& evenly_spaced) const {
    std::vector<double> values;
    const size_t last = Index(std::max(path_.size() - 1, 1));
    for (int i = 0; i < path_.size(); ++i)
      values.push_back(evenly_spaced[Index(i) * (evenly_spaced.size() - 1) / last]);
    return values;
  }

  // The levels must be seen beyond the blur, but not the next transition: in the background the
  // pixels end before it, in the blade behind it, for there it is modelled.
  [[nodiscard]] double WantedReach() const {
    constexpr double kReachPerBlur = 5, kLeast = 5, kMost = 14;
    return std::clamp(kReachPerBlur * std::sqrt(TotalBlurVariance(blur_)), kLeast, kMost);
  }

  [[nodiscard]] std::vector<double> InnerReach() const {
    constexpr double kBehind = 2;
    std::vector<double> reach;
    for (const double inner : inner_px_) reach.push_back(std::min(inner + kBehind, WantedReach()));
    return reach;
  }

  [[nodiscard]] std::vector<double> OuterReach() const {
    constexpr double kBefore = 1, kLeast = 1.5;
    std::vector<double> reach = AlongPath(options_.outer_px);
    for (double& outer : reach) outer = std::clamp(outer - kBefore, kLeast, WantedReach());
    return reach;
  }

  // What the levels leave over, on plain blade and plain background; and where they leave over too
  // much.
  void MeasureNoise(int stride) {
    constexpr double kPlain = 0.02;  // share of the other side
    std::vector<double> blade, ground, squares(Index(windows_.stretches()), 0.0), counts(squares);
    for (int i = 0; i < band_.size(); i += stride) {
      const LevelVector levels = windows_.LevelsAt(i);
      for (const PreparedPixel& pixel : Prepare(i, 0)) {
        const double rest = pixel.light - levels.dot(pixel.terms), step = pixel.terms[kGround];
        if (step < kPlain) blade.push_back(rest);
        if (step > 1 - kPlain) ground.push_back(rest);
        squares[Index(EdgeWindows::StretchOf(i))] += pixel.weight * rest * rest;
        counts[Index(EdgeWindows::StretchOf(i))] += 1;
      }
    }
    if (!blade.empty()) noise_.blade = std::max(RobustSigma(blade), kLeastNoise);
    if (!ground.empty()) noise_.ground = std::max(RobustSigma(ground), kLeastNoise);
    for (size_t s = 0; s < squares.size(); ++s) squares[s] /= std::max(counts[s], 1.0);
    misfit_ = std::move(squares);
  }

  void UpdateBlur() {
    constexpr double kBlurFactor = 2;  // a wider step is another thing than the blade's border
    constexpr double kPriorInformation =
        30;  // 1/px^2; windows that know less together do not change the blur
    std::vector<std::pair<double, double>> steps{{options_.blur_px - blur_, kPriorInformation}};
    for (const LevelFit& window : windows_.fits()) {
      steps.emplace_back(window.spread_px,
                         window.spread_information / std::max(window.chi_square_per_pixel, 1.0));
    }
    const double step = std::clamp(WeightedMedian(std::move(steps)), -0.4 * blur_, 0.6 * blur_);
    blur_ =
        std::clamp(blur_ + step, options_.blur_px / kBlurFactor, options_.blur_px * kBlurFactor);
  }

  // Takes the path to where the windows see the edge, remembering how far that is from the start.
  void Move() {
    constexpr double kSmoothing = 1;  // px; the offsets are smooth already
    const std::vector<double> step = Trend();
    std::vector<double> moved;
    for (int i = 0; i < path_.size(); ++i) moved.push_back(MovedAt(i) + step[Index(i)]);
    moved_ = std::move(moved);
    path_ = SmoothPath(Shifted(path_, step), path_.blade_on_left, kSmoothing);
  }

  [[nodiscard]] double MovedAt(int i) const {
    if (moved_.empty()) return 0;
    return moved_[std::min(Index(i) * moved_.size() / Index(path_.size()), moved_.size() - 1)];
  }

  // Offsets of the edge from the path, one per sample, from the windows.
  [[nodiscard]] std::vector<double> Trend() const {
    constexpr double kMostStep =
        1.5;  // px a round; beyond, the expansion to first order means nothing
    constexpr double kMostMove = 2.5;    // px in all; further off lies another transition
    constexpr double kStartSigma = 1;    // px; where nothing is seen the edge stays where it was
    constexpr double kBendSigma = 0.05;  // px; what a blade bends from one window to the next
    constexpr double kStartInformation = 1 / (kStartSigma * kStartSigma);
    std::vector<double> offsets, weights;
    for (size_t w = 0; w < windows_.fits().size(); ++w) {
      const LevelFit& window = windows_.fits()[w];
      const double information =
          window.offset_information / std::max(window.chi_square_per_pixel, 1.0);
      const double moved = MovedAt(windows_.CenterSample(w));
      const double seen = std::clamp(window.offset_px, -kMostStep, kMostStep);
      const double weight = information + kStartInformation;
      const double offset = (information * seen - kStartInformation * moved) / weight;
      offsets.push_back(std::clamp(moved + offset, -kMostMove, kMostMove) - moved);
      weights.push_back(weight);
    }
    return windows_.AlongTheEdge(SmoothValues(offsets, weights, 1 / (kBendSigma * kBendSigma)));
  }

  [[nodiscard]] double SeenShare() const {
    constexpr double kInformation = 9;  // 1/px^2
    double seen = 0;
    for (const LevelFit& window : windows_.fits()) {
      seen += window.offset_information > kInformation * std::max(window.chi_square_per_pixel, 1.0);
    }
    return seen / static_cast<double>(windows_.fits().size());
  }

  EdgeFit Finish() {
    EdgeFit fit;
    fit.seen = SeenShare();
    const std::vector<double> trend = Trend();
    fit.blur_px = blur_;
    fit.noise_blade = noise_.blade;
    fit.noise_ground = noise_.ground;
    for (int i = 0; i < band_.size(); ++i) fit.slices.push_back(FitSlice(i, trend[Index(i)]));
    fit.path = std::move(path_);
    return fit;
  }

  EdgeSlice FitSlice(int i, double trend) {
    const LevelVector levels = windows_.LevelsAt(i);
    EdgeSlice slice;
    slice.contrast = levels[kGround] - levels[kBlade];
    slice.ground = levels[kGround];
    double information = 0, push = 0;
    for (const PreparedPixel& pixel : Prepare(i, trend)) {
      const double rest = pixel.light - levels.dot(pixel.terms),
                   gradient = slice.contrast * pixel.terms[kShift];
      information += pixel.weight * gradient * gradient;
      push -= pixel.weight * gradient * rest;
    }
    // Where a slice says next to nothing it takes after its neighbours: a blade is smooth to that
    // much.
    constexpr double kRoughness = 0.5;  // px
    slice.offset_px = trend + push / (information + 1 / (kRoughness * kRoughness));
    slice.sigma_px = information > 0
                         ? 1 / std::sqrt(information * windows_.Nearest(i).kept_information)
                         : std::numeric_limits<double>::infinity();
    return slice;
  }

  const cv::Mat& grey_;
  const ToneCurve& tone_;
  const EdgeFitOptions& options_;
  double blur_;
  SideNoise noise_;
  EdgePath path_;
  PixelBand band_;
  std::vector<double> inner_px_;  // to the blade's inner transition, one per sample
  std::vector<PreparedPixel> prepared_;
  EdgeWindows windows_{0};
  std::vector<double> misfit_;  // chi-square per pixel of stretches of the last round
  std::vector<double> moved_;   // of the path from its start, px
};

}  // namespace

EdgeFit FitEdge(const cv::Mat& grey,
                const ToneCurve& tone,
                const std::vector<Eigen::Vector2d>& start,
                bool blade_on_left,
                const EdgeFitOptions& options) {
  return Fitter(grey, tone, options).Run(start, blade_on_left);
}

}  // namespace bladecurve
