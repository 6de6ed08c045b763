// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vision/blurred_step.h"
#include "vision/edge_band.h"
#include "vision/edge_levels.h"

namespace bladecurve {
namespace {

size_t Index(int i) { return static_cast<size_t>(i); }

constexpr int kGroup = 4;        // samples whose normal equations are kept together
constexpr int kNodeGroups = 2;   // a window every 8 px
constexpr int kWindowReach = 6;  // groups to either side: windows of 52 px
constexpr int kRounds = 6;  // from 1.5 px off and a blur wrong by 2 to below 1e-3 px in all trials
constexpr double kLeastBlur = 0.25, kMostBlur = 6;
constexpr double kLeastNoise = 2e-4;  // linear light; rendered pictures without noise

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

class Fitter {
 public:
  Fitter(const cv::Mat& grey,
         const ToneCurve& tone,
         bool blade_on_left,
         const EdgeFitOptions& options)
      : grey_(grey),
        tone_(tone),
        blade_on_left_(blade_on_left),
        options_(options),
        blur_(options.blur_px) {}

  EdgeFit Run(const std::vector<Eigen::Vector2d>& start) {
    constexpr double kGuessSmoothing = 3, kFitSmoothing = 1;  // px; a fitted path is smooth already
    path_ = SmoothPath(start, blade_on_left_, kGuessSmoothing);
    for (int round = 0; round < kRounds; ++round) {
      Gather();
      SolveWindows(round + 1 == kRounds);
      MeasureNoise();
      UpdateBlur();
      if (round + 1 < kRounds) Move(kFitSmoothing);
    }
    return Finish();
  }

 private:
  void Gather() {
    band_ = GatherPixels(grey_,
                         tone_,
                         path_,
                         {ReachOfSamples(options_.inner_px), ReachOfSamples(options_.outer_px)});
    const int groups = (path_.size() + kGroup - 1) / kGroup;
    moments_.assign(Index(groups), {});
    samples_.resize(band_.pixels.size());
    for (int i = 0; i < band_.size(); ++i) {
      const BlurredStep profile(path_.normals[Index(i)], blur_);
      const double shift = CurvatureShift(i);
      for (int p = band_.begin[Index(i)]; p < band_.begin[Index(i) + 1]; ++p) {
        const double across = band_.pixels[Index(p)].across + shift;
        const StepSample sample = profile.At(across);
        samples_[Index(p)] = sample;
        moments_[Index(i / kGroup)].Add(LevelTerms(sample, across, TotalBlurVariance(blur_)),
                                        band_.pixels[Index(p)].light,
                                        noise_.Weight(sample.step));
      }
    }
  }

  // The levels must be seen beyond the blur, but not the next transition.
  [[nodiscard]] std::vector<double> ReachOfSamples(const std::vector<double>& free_px) const {
    constexpr double kReachPerBlur = 5, kLeast = 1.5, kMost = 14;
    const double wanted =
        std::clamp(kReachPerBlur * std::sqrt(TotalBlurVariance(blur_)), 5.0, kMost);
    std::vector<double> reach;
    for (int i = 0; i < path_.size(); ++i) {
      const size_t k = Index(i) * (free_px.size() - 1) / Index(std::max(path_.size() - 1, 1));
      reach.push_back(std::clamp(free_px[k], kLeast, wanted));
    }
    return reach;
  }

  // Blur moves the half-way level of a curved edge towards the centre of curvature, by variance /
  // 2R.
  [[nodiscard]] double CurvatureShift(int i) const {
    return options_.correct_curvature ? 0.5 * path_.curvatures[Index(i)] * TotalBlurVariance(blur_)
                                      : 0.0;
  }

  void SolveWindows(bool blur_known) {
    LevelVector precision = LevelVector::Zero();
    if (blur_known) precision[kSpread] = kFixed;
    if (!options_.model_slopes) {
      for (const LevelTerm term : {kBladeSlope, kGroundSlope, kGroundBend})
        precision[term] = kFixed;
      SolveWith(precision);
      return;
    }
    SolveWith(precision);
    const LevelVector slopes = SlopePrecision(windows_, (2.0 * kWindowReach + 1) / kNodeGroups);
    SolveWith(precision + slopes);
  }

  void SolveWith(const LevelVector& precision) {
    windows_.clear();
    const int groups = static_cast<int>(moments_.size());
    for (int center = 0; center < groups; center += kNodeGroups) {
      LevelMoments sum;
      const int first = std::max(center - kWindowReach, 0),
                last = std::min(center + kWindowReach, groups - 1);
      for (int g = first; g <= last; ++g) sum.Add(moments_[Index(g)], 1);
      windows_.push_back(SolveLevels(sum, precision));
    }
  }

  // Levels of the window about sample i, interpolated between windows.
  [[nodiscard]] LevelVector LevelsAt(int i) const {
    const double position = (i - 0.5 * (kGroup - 1)) / (kGroup * kNodeGroups);
    const int last = static_cast<int>(windows_.size()) - 1;
    const int a = std::clamp(static_cast<int>(std::floor(position)), 0, last),
              b = std::min(a + 1, last);
    const double t = std::clamp(position - a, 0.0, 1.0);
    LevelVector levels = (1 - t) * windows_[Index(a)].levels + t * windows_[Index(b)].levels;
    levels[kShift] = levels[kSpread] = 0;
    return levels;
  }

  void MeasureNoise() {
    constexpr double kPlain = 0.02;  // S this close to 0 or 1: a plain piece of blade or background
    std::vector<double> blade, ground;
    for (int i = 0; i < band_.size(); ++i) {
      const LevelVector levels = LevelsAt(i);
      for (int p = band_.begin[Index(i)]; p < band_.begin[Index(i) + 1]; ++p) {
        const StepSample& sample = samples_[Index(p)];
        if (sample.step > kPlain && sample.step < 1 - kPlain) continue;
        const BandPixel& pixel = band_.pixels[Index(p)];
        const double across = pixel.across + CurvatureShift(i);
        const double rest =
            pixel.light - levels.dot(LevelTerms(sample, across, TotalBlurVariance(blur_)));
        (sample.step < 0.5 ? blade : ground).push_back(rest);
      }
    }
    if (!blade.empty()) noise_.blade = std::max(RobustSigma(blade), kLeastNoise);
    if (!ground.empty()) noise_.ground = std::max(RobustSigma(ground), kLeastNoise);
  }

  void UpdateBlur() {
    constexpr double kPriorInformation =
        30;  // 1/px^2; windows that know less together do not change the blur
    std::vector<std::pair<double, double>> steps{{options_.blur_px - blur_, kPriorInformation}};
    for (const LevelFit& window : windows_) {
      steps.emplace_back(window.spread_px,
                         window.spread_information / std::max(window.chi_square_per_pixel, 1.0));
    }
    const double step = std::clamp(WeightedMedian(std::move(steps)), -0.4 * blur_, 0.6 * blur_);
    blur_ = std::clamp(blur_ + step, kLeastBlur, kMostBlur);
  }

  // Takes the path to where the windows see the edge, remembering how far that is from the start.
  void Move(double smoothing_px) {
    const std::vector<double> step = Trend();
    std::vector<Eigen::Vector2d> points = Shifted(path_, step);
    std::vector<double> moved;
    for (int i = 0; i < path_.size(); ++i) moved.push_back(MovedAt(i) + step[Index(i)]);
    moved_ = std::move(moved);
    path_ = SmoothPath(points, blade_on_left_, smoothing_px);
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
    std::vector<double> offsets, weights;
    constexpr double kStartInformation = 1 / (kStartSigma * kStartSigma);
    for (size_t w = 0; w < windows_.size(); ++w) {
      const LevelFit& window = windows_[w];
      const double information =
          window.offset_information / std::max(window.chi_square_per_pixel, 1.0);
      const double moved =
          MovedAt(std::min(static_cast<int>(w) * kGroup * kNodeGroups, path_.size() - 1));
      const double seen = std::clamp(window.offset_px, -kMostStep, kMostStep);
      const double weight = information + kStartInformation;
      const double offset = (information * seen - kStartInformation * moved) / weight;
      offsets.push_back(std::clamp(moved + offset, -kMostMove, kMostMove) - moved);
      weights.push_back(weight);
    }
    return Interpolated(SmoothValues(offsets, weights, 1 / (kBendSigma * kBendSigma)));
  }

  [[nodiscard]] std::vector<double> Interpolated(const std::vector<double>& nodes) const {
    std::vector<double> values;
    const int last = static_cast<int>(nodes.size()) - 1;
    for (int i = 0; i < path_.size(); ++i) {
      const double position =
          std::clamp((i - 0.5 * (kGroup - 1)) / (kGroup * kNodeGroups), 0.0, 1.0 * last);
      const int a = std::min(static_cast<int>(position), last), b = std::min(a + 1, last);
      const double t = position - a;
      values.push_back((1 - t) * nodes[Index(a)] + t * nodes[Index(b)]);
    }
    return values;
  }

  EdgeFit Finish() {
    EdgeFit fit;
    fit.trend_px = Trend();
    fit.blur_px = blur_;
    fit.noise_blade = noise_.blade;
    fit.noise_ground = noise_.ground;
    for (int i = 0; i < band_.size(); ++i)
      fit.slices.push_back(FitSlice(i, fit.trend_px[Index(i)]));
    fit.path = std::move(path_);
    return fit;
  }

  EdgeSlice FitSlice(int i, double trend) const {
    const LevelVector levels = LevelsAt(i);
    const double contrast = levels[kGround] - levels[kBlade];
    const BlurredStep profile(path_.normals[Index(i)], blur_);
    double information = 0, push = 0, chi = 0;
    const int first = band_.begin[Index(i)], last = band_.begin[Index(i) + 1];
    for (int p = first; p < last; ++p) {
      const double across = band_.pixels[Index(p)].across + CurvatureShift(i) - trend;
      const StepSample sample = profile.At(across);
      const double rest = band_.pixels[Index(p)].light -
                          levels.dot(LevelTerms(sample, across, TotalBlurVariance(blur_)));
      const double weight = noise_.Weight(sample.step), gradient = contrast * sample.slope;
      information += weight * gradient * gradient;
      push -= weight * gradient * rest;
      chi += weight * rest * rest;
    }
    const LevelFit& window =
        windows_[std::min(Index(i / (kGroup * kNodeGroups)), windows_.size() - 1)];
    EdgeSlice slice;
    slice.contrast = contrast;
    // Where a slice says next to nothing it takes after its neighbours: a blade is smooth to that
    // much.
    constexpr double kRoughness = 0.5;  // px
    slice.offset_px = trend + push / (information + 1 / (kRoughness * kRoughness));
    slice.sigma_px = information > 0 ? 1 / std::sqrt(information * window.kept_information)
                                     : std::numeric_limits<double>::infinity();
    slice.misfit = chi / std::max(last - first, 1);
    return slice;
  }

  const cv::Mat& grey_;
  const ToneCurve& tone_;
  bool blade_on_left_;
  EdgeFitOptions options_;
  double blur_;
  SideNoise noise_;
  EdgePath path_;
  PixelBand band_;
  std::vector<StepSample> samples_;
  std::vector<LevelMoments> moments_;
  std::vector<double> moved_;  // along the path, from its start, px
  std::vector<LevelFit> windows_;
};

}  // namespace

EdgeFit FitEdge(const cv::Mat& grey,
                const ToneCurve& tone,
                const std::vector<Eigen::Vector2d>& start,
                bool blade_on_left,
                const EdgeFitOptions& options) {
  return Fitter(grey, tone, blade_on_left, options).Run(start);
}

}  // namespace bladecurve
