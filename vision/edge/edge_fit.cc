// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vision/edge/edge_band.h"
#include "vision/edge/edge_blur.h"
#include "vision/edge/edge_clipping.h"
#include "vision/edge/edge_glare.h"
#include "vision/edge/edge_levels.h"
#include "vision/edge/edge_reach.h"
#include "vision/edge/edge_slice.h"
#include "vision/edge/edge_windows.h"
#include "vision/image/blurred_step.h"
#include "vision/image/robust_statistics.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

constexpr int kEnoughSamples = 400;  // samples; of longer edges every second or third tells as much
constexpr int kStretchSamples = 4;   // samples whose pixels are kept together
// Samples that are worth a thread; stretches and the samples of sketches go into it without rest.
constexpr int kPartSamples = 96;
constexpr double kFirstShare =
    0.7;  // of the blur expected: from below, a soft shadow is not taken for the edge

// How thoroughly a round goes to work.
struct Round {
  int stride = 1;        // on every so many samples
  bool placed = true;    // the edge is in its place already; out of place it looks blurred
  bool bends = true;     // the background may bend; at first that could take the edge's place
  bool settles = false;  // whether slopes are needed is judged anew
  bool last = false;     // the blur stays, the pixels are kept
};
constexpr int kSketchRounds = 5;  // from 1.5 px off and a blur wrong by 2 to within 0.05 px
constexpr Round kFirstSketch = {6, false, false, true, false};
constexpr Round kSketch = {6, true, false, true, false};
constexpr int kImproveRounds = 2;
constexpr Round kImprove = {2, true, true, true, false};
constexpr Round kFinal = {1, true, true, true, true};
constexpr double kLeastNoise = 2e-4;  // linear light; rendered pictures without noise

class Fitter {
 public:
  Fitter(const cv::Mat& grey, const ToneCurve& tone, const EdgeFitOptions& options)
      : grey_(grey),
        tone_(tone),
        options_(options),
        most_blur_(options.most_blur_px),
        blur_(options.blur_known ? options.blur_px : kFirstShare * options.blur_px),
        unbound_blur_(blur_) {}

  EdgeFit Run(const std::vector<Eigen::Vector2d>& start, bool blade_on_left) {
    constexpr double kStartSmoothing = 2, kSmoothing = 1;  // px; what was fitted is smooth already
    Take(SmoothPath(start, blade_on_left, kStartSmoothing));
    for (int k = 0; k < kSketchRounds; ++k) Improve(k == 0 ? kFirstSketch : kSketch);
    if (SoftBeyondBound()) {
      most_blur_ = EdgeFitOptions::kFree;
      for (int k = 0; k < kSketchRounds; ++k) Improve(kSketch);
    }
    before_ = offsets_;
    Take(SmoothPath(Shifted(path_, offsets_), blade_on_left, kSmoothing));
    for (int k = 0; k < kImproveRounds; ++k) Improve(kImprove);
    softer_ = SofterThanUsual();
    Solve(kFinal);
    return Finish();
  }

 private:
  void Take(EdgePath path) {
    path_ = std::move(path);
    stride_ =
        options_.blur_known ? 1 : 1 + path_.size() / kEnoughSamples;  // glare needs every pixel
    offsets_.assign(path_.points.size(), 0.0);
    inner_px_ = SpreadEvenly(options_.inner_px, path_.size());
    for (double& inner : inner_px_) inner -= face_moved_px_;
    band_ =
        GatherPixels(grey_,
                     tone_,
                     path_,
                     ReachBeside(blur_, inner_px_, SpreadEvenly(options_.outer_px, path_.size())));
    if (options_.blur_known) glare_ = Glare(band_);
  }

  void Improve(const Round& round) {
    Solve(round);
    MeasureNoise();
    MoveFace();
    if (round.placed) UpdateBlur();
    Advance();
  }

  void Solve(const Round& round) {
    EdgeWindows windows(path_.size(), kStretchSamples * stride_);
    windows.Distrust(misfit_);
    if (round.last) kept_.resize(Index((band_.size() + stride_ - 1) / stride_));
    ParallelForBands(band_.size(), kPartSamples * stride_, [&](int first, int last) {
      AddSamples(first, last, round, &windows);
    });
    windows_ = std::move(windows);
    SolveWindows(round);
  }

  // Samples [first, last).
  void AddSamples(int first, int last, const Round& round, EdgeWindows* windows) {
    std::vector<PreparedPixel> prepared;
    for (int i = first; i < last; i += round.stride * stride_) {
      Prepare(i, &prepared);
      for (const PreparedPixel& pixel : prepared) {
        if (pixel.weight > 0) windows->Add(i, pixel.terms, pixel.light, pixel.weight);
      }
      glare_.AddUnknownLight(i, windows);
      if (round.last) kept_[Index(i / stride_)] = prepared;
    }
  }

  void SolveWindows(const Round& round) {
    LevelVector precision = LevelVector::Zero();
    if (round.last) precision[kSpread] = kFixed;
    if (!round.bends) precision[kGroundBend] = kFixed;
    if (round.settles) slopes_ = SupportedSlopes(precision);
    windows_.Solve(precision + slopes_);
  }

  // First without the bend: slope and bend together leave each other so uncertain that neither
  // would seem supported, and a shadow along the blade would move the edge into it.
  LevelVector SupportedSlopes(const LevelVector& precision) {
    LevelVector straight = precision;
    straight[kGroundBend] = kFixed;
    windows_.Solve(straight);
    LevelVector slopes = windows_.SupportedSlopes();
    slopes[kGroundBend] = 0;
    if (precision[kGroundBend] < kFixed) windows_.Solve(precision + slopes);
    slopes[kGroundBend] = windows_.SupportedSlopes()[kGroundBend];
    return slopes;
  }

  // A shadow softens the background's side alone; where the blade's slopes too, it is the lens that
  // is softer than the bound.
  [[nodiscard]] bool SoftBeyondBound() const {
    return options_.may_be_softer && blur_ == most_blur_ && slopes_[kBladeSlope] < kFixed;
  }

  // Whether the windows see more blur than the sharper steps nearby let it have.
  [[nodiscard]] bool SofterThanUsual() const {
    constexpr double kMore = 0.05;  // of the blur
    const double most = MostBlur(options_.blur_px, NoisePerContrast(windows_.fits(), Noise()));
    return !options_.blur_known && blur_ >= most && most < most_blur_ &&
           SpreadSeen(windows_.fits()) > kMore * blur_;
  }

  // The pixels of sample i, the edge lying offsets_[i] out of the path.
  void Prepare(int i, std::vector<PreparedPixel>* prepared) const {
    prepared->clear();
    const BlurredStep step(path_.normals[Index(i)], blur_);
    const double variance = TotalBlurVariance(blur_);
    // Blur moves the half-way level of a curved edge towards its centre of curvature: variance /
    // 2R.
    const double bend = 0.5 * path_.curvatures[Index(i)] * variance;
    const double shift = bend - offsets_[Index(i)];
    for (int p = band_.begin[Index(i)]; p < band_.begin[Index(i) + 1]; ++p) {
      const double across = band_.pixels[Index(p)].across + shift;
      const StepSample sample = step.At(across);
      prepared->push_back(
          {band_.pixels[Index(p)].light,
           glare_.Weight(i, sample.step, noise_),
           LevelTerms(sample, step.At(across + inner_px_[Index(i)]), across, variance)});
    }
    if (glare_.At(i)) {
      const bool known = !windows_.fits().empty();
      Glare::HideWhite(known ? std::optional(windows_.LevelsAt(i)) : std::nullopt, prepared);
    }
  }

  // What the levels leave over on plain blade and plain background, and where it is too much.
  void MeasureNoise() {
    constexpr double kPlain = 0.02;  // share of the other side
    std::vector<double> blade, ground, misfit;
    std::vector<PreparedPixel> prepared;
    for (int i = 0; i < band_.size(); i += 2 * kStretchSamples * stride_) {
      const LevelVector levels = windows_.LevelsAt(i);
      double squares = 0;
      Prepare(i, &prepared);
      for (const PreparedPixel& pixel : prepared) {
        if (pixel.weight == 0) continue;
        const double rest = pixel.light - levels.dot(pixel.terms), step = pixel.terms[kGround];
        if (step < kPlain) blade.push_back(rest);
        if (step > 1 - kPlain) ground.push_back(rest);
        squares += pixel.weight * rest * rest;
      }
      misfit.push_back(squares / std::max(static_cast<double>(prepared.size()), 1.0));
    }
    if (!blade.empty()) noise_.blade = std::max(RobustSigma(blade), kLeastNoise);
    if (!ground.empty()) noise_.ground = std::max(RobustSigma(ground), kLeastNoise);
    misfit_ = std::move(misfit);
  }

  void MoveFace() {
    const double outwards = FaceShift(windows_.fits());
    face_moved_px_ += outwards;
    for (double& inner : inner_px_) inner -= outwards;
  }

  void UpdateBlur() {
    if (options_.blur_known) return;
    unbound_blur_ = ImprovedBlur(
        blur_, windows_.fits(), options_.blur_px, NoisePerContrast(windows_.fits(), Noise()));
    blur_ = std::min(unbound_blur_, most_blur_);
  }

  [[nodiscard]] double Noise() const { return std::max(noise_.blade, noise_.ground); }

  void Advance() {
    const std::vector<double> step = Step();
    for (size_t i = 0; i < step.size(); ++i) offsets_[i] += step[i];
  }

  // How far the edge has moved from the start already.
  [[nodiscard]] double MovedAt(int i) const {
    const double before =
        before_.empty()
            ? 0
            : before_[std::min(Index(i) * before_.size() / offsets_.size(), before_.size() - 1)];
    return before + offsets_[Index(i)];
  }

  // How far the windows see the edge from where it was taken to be, one per sample.
  [[nodiscard]] std::vector<double> Step() const {
    constexpr double kMostStep =
        1.5;  // px a round; beyond, the expansion to first order means nothing
    constexpr double kMostMove = 1.6;  // px in all; further off lies another transition
    constexpr double kStartSigma = 1;  // px; where nothing is seen the edge stays where it was
    constexpr double kBendSigma =
        0.05;  // px a stride; what a blade bends from one window to the next
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
    return windows_.AlongTheEdge(
        SmoothValues(offsets, weights, 1 / (stride_ * stride_ * kBendSigma * kBendSigma)));
  }

  EdgeFit Finish() {
    EdgeFit fit;
    fit.seen = windows_.PlacedShare();
    fit.blur_px = blur_;
    fit.unbound_blur_px = unbound_blur_;
    fit.softer = softer_;
    fit.even =
        std::min({slopes_[kBladeSlope], slopes_[kGroundSlope], slopes_[kGroundBend]}) == kFixed;
    fit.overexposed = Overexposure(band_).Share();
    fit.spacing = stride_;
    fit.slices = SolveSlices(kept_, {stride_, noise_.blade, noise_.ground}, windows_);
    for (EdgeSlice& slice : fit.slices) slice.offset_px += offsets_[Index(slice.sample)];
    fit.path = std::move(path_);
    return fit;
  }

  const cv::Mat& grey_;
  const ToneCurve& tone_;
  const EdgeFitOptions& options_;
  double most_blur_, blur_, unbound_blur_;
  bool softer_ = false;
  SideNoise noise_;
  EdgePath path_;
  PixelBand band_;
  Glare glare_;                                   // none unless the blur is known
  double face_moved_px_ = 0;                      // the blade's inner transition, towards the edge
  std::vector<double> inner_px_;                  // to the blade's inner transition, one per sample
  int stride_ = 1;                                // of the samples that are looked at
  std::vector<std::vector<PreparedPixel>> kept_;  // of all in the last round
  LevelVector slopes_ = LevelVector::Zero();      // precision: which slopes are needed
  EdgeWindows windows_{0, kStretchSamples};
  std::vector<double> misfit_;   // chi-square per pixel of stretches of the last round
  std::vector<double> offsets_;  // of the edge from the path, one per sample
  std::vector<double> before_;   // of the path from the start, evenly spaced
};

}  // namespace

EdgeFit FitEdge(const cv::Mat& grey,
                const ToneCurve& tone,
                const std::vector<Eigen::Vector2d>& start,
                bool blade_on_left,
                const EdgeFitOptions& options) {
  EdgeFit fit = Fitter(grey, tone, options).Run(start, blade_on_left);
  if (!fit.softer) return fit;
  // What looked like sharper steps may be fringes of compression. A plain step shows it: fitted as
  // soft as it is, the light is even on both sides of it, which no shadow's is.
  constexpr double kMuchSofter = 2;
  EdgeFitOptions lifted = options;
  lifted.blur_px *= kMuchSofter;
  EdgeFit soft = Fitter(grey, tone, lifted).Run(start, blade_on_left);
  return soft.even && !soft.softer ? soft : fit;
}

}  // namespace bladecurve
