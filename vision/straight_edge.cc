// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/straight_edge.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "vision/edge_profile.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Illumination may fall off along the edge, but counts as even across the band: a slope of s a
// pixel moves the edge by 1.4 s blur^2, 0.003 px for a strong 0.002, whereas solving for it would
// double the scatter.
enum Parameter { kOffset, kAngle, kDark, kContrast, kBlur, kAlong };
constexpr int kParameters = 6;
using Vector = Eigen::Matrix<double, kParameters, 1>;
using Matrix = Eigen::Matrix<double, kParameters, kParameters>;

constexpr double kMinBlurPx =
    0.2;  // sharper than any lens and pixel; below, the blur has no effect left
constexpr double kMaxBlurPx = 6;  // rejects shadows and gradients
constexpr double kBinPx = 8;      // pieces along the edge that are kept or left out as one

struct Sample {
  double across, along;  // px from the middle of the guess
  double light;          // linear, 0 to 1
  int bin;
};

struct LinearPicture {
  const cv::Mat& grey;
  const ToneCurve& tone;
};

// The line of the guess, and the band about it.
struct Band {
  Vector2d middle, direction, normal;
  double length, half_width, bow;
};

Band MakeBand(const StraightEdgeGuess& guess, double half_width) {
  const Vector2d chord = guess.to_px - guess.from_px;
  const Vector2d direction = chord.normalized();
  return {0.5 * (guess.from_px + guess.to_px),
          direction,
          {-direction.y(), direction.x()},
          chord.norm(),
          half_width,
          guess.bow_px};
}

double Sagitta(const Band& band, double along) {
  const double x = 2 * along / band.length;
  return band.bow * (1 - x * x);
}

// The pixels of the band, column by column if it lies flat, row by row if it is steep. `stride`
// thins them out.
std::vector<Sample> Collect(const LinearPicture& picture, const Band& band, int stride) {
  const cv::Mat& grey = picture.grey;
  const int major = std::abs(band.direction.x()) >= std::abs(band.direction.y()) ? 0 : 1,
            minor = 1 - major;
  const std::array<int, 2> size = {grey.cols, grey.rows};
  const double steep = band.direction[minor] / band.direction[major];
  const double reach = (band.half_width + std::abs(band.bow)) / std::abs(band.direction[major]) + 1;
  const double extent = 0.5 * band.length * std::abs(band.direction[major]) + band.half_width;
  const int first = std::max(0, static_cast<int>(std::ceil(band.middle[major] - extent)));
  const int last = std::min(size[static_cast<size_t>(major)] - 1,
                            static_cast<int>(std::floor(band.middle[major] + extent)));
  std::vector<Sample> samples;
  for (int a = first; a <= last; a += stride) {
    const double centre = band.middle[minor] + steep * (a - band.middle[major]);
    const int low = std::max(0, static_cast<int>(std::ceil(centre - reach)));
    const int high = std::min(size[static_cast<size_t>(minor)] - 1,
                              static_cast<int>(std::floor(centre + reach)));
    for (int b = low; b <= high; ++b) {
      const Vector2d offset = (major == 0 ? Vector2d(a, b) : Vector2d(b, a)) - band.middle;
      const double along = offset.dot(band.direction);
      const double across = offset.dot(band.normal) - Sagitta(band, along);
      if (std::abs(along) > 0.5 * band.length || std::abs(across) > band.half_width) continue;
      const uchar value = major == 0 ? grey.at<uchar>(b, a) : grey.at<uchar>(a, b);
      samples.push_back({across,
                         along,
                         picture.tone.linear[value],
                         static_cast<int>((along + 0.5 * band.length) / kBinPx)});
    }
  }
  return samples;
}

size_t BinCount(const Band& band) { return static_cast<size_t>(band.length / kBinPx) + 2; }

// Grey profile across the band, linear light, one value a pixel of distance, over part of its
// length.
std::vector<double> MeanProfile(const std::vector<Sample>& samples,
                                const Band& band,
                                const std::array<double, 2>& part) {
  const size_t count = static_cast<size_t>(2 * band.half_width) + 1;
  std::vector<double> sum(count, 0), weight(count, 0);
  for (const Sample& s : samples) {
    const double place = s.along / band.length + 0.5;
    if (place < part[0] || place > part[1]) continue;
    const size_t k = std::min(count - 1, static_cast<size_t>(s.across + band.half_width));
    sum[k] += s.light;
    weight[k] += 1;
  }
  for (size_t k = 0; k < count; ++k) sum[k] = weight[k] > 0 ? sum[k] / weight[k] : -1;
  return sum;
}

// Where the profile crosses the middle between its ends; distance from the band's middle.
std::optional<double> HalfLevelCrossing(const std::vector<double>& profile, double half_width) {
  const double start = profile[1], end = profile[profile.size() - 2];
  if (start < 0 || end < 0 || start == end) return std::nullopt;
  const double half = 0.5 * (start + end);
  for (size_t k = 1; k + 2 < profile.size(); ++k) {
    const double p = profile[k], q = profile[k + 1];
    if (p < 0 || q < 0 || (p < half) == (q < half)) continue;
    return static_cast<double>(k) + 0.5 + (half - p) / (q - p) - half_width;
  }
  return std::nullopt;
}

struct Fit {
  Vector parameters = Vector::Zero();
  Matrix covariance = Matrix::Zero();
  double mean_square = 0;
  size_t count = 0;
};

// Offset and angle from the crossings in the parts of the edge, levels from the band's rims.
std::optional<Vector> Start(const std::vector<Sample>& samples, const Band& band) {
  constexpr int kParts = 6;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int part = 0; part < kParts; ++part) {
    const double from = static_cast<double>(part) / kParts;
    const auto profile = MeanProfile(samples, band, {from, from + 1.0 / kParts});
    const std::optional<double> crossing = HalfLevelCrossing(profile, band.half_width);
    if (!crossing) continue;
    const double x = (from + 0.5 / kParts - 0.5) * band.length;
    n += 1, sx += x, sy += *crossing, sxx += x * x, sxy += x * *crossing;
  }
  if (n < 3) return std::nullopt;  // rejects edges hidden along more than half their length
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  const auto profile = MeanProfile(samples, band, {0, 1});
  Vector start = Vector::Zero();
  start[kOffset] = (sy - slope * sx) / n;
  start[kAngle] = std::atan(slope);
  start[kDark] = profile[1];
  start[kContrast] = profile[profile.size() - 2] - profile[1];
  start[kBlur] = 1;
  return start;
}

class EdgeModel {
 public:
  EdgeModel(const Band& band, const Vector& p)
      : p_(p),
        cos_(std::cos(p[kAngle])),
        sin_(std::sin(p[kAngle])),
        scale_(1 / band.length),
        profile_(std::atan2(band.normal.y(), band.normal.x()) + p[kAngle], p[kBlur]) {}

  // Residual, light minus model, and the model's derivatives. A saturated pixel says no more than
  // that it is bright.
  double Residual(const Sample& s, Vector* gradient) const {
    const double distance = s.across * cos_ - s.along * sin_ - p_[kOffset];
    const EdgeProfile::Value step = profile_.At(distance);
    const double light = p_[kDark] + p_[kContrast] * step.level;
    const double lamp = 1 + p_[kAlong] * s.along * scale_;
    if (s.light >= 1 && lamp * light >= 1) {
      gradient->setZero();
      return 0;
    }
    const double edge = lamp * p_[kContrast] * step.slope_per_px;
    *gradient << -edge, -edge * s.along, lamp, lamp * step.level,
        lamp * p_[kContrast] * p_[kBlur] * step.curvature_per_px2, light * s.along * scale_;
    return s.light - lamp * light;
  }

 private:
  const Vector& p_;
  double cos_, sin_, scale_;
  EdgeProfile profile_;
};

struct NormalEquations {
  Matrix information = Matrix::Zero();
  Vector gradient = Vector::Zero();
  double sum_square = 0;
};

NormalEquations Accumulate(const std::vector<Sample>& samples,
                           const Band& band,
                           const Vector& parameters) {
  const EdgeModel model(band, parameters);
  NormalEquations equations;
  Vector derivative;
  for (const Sample& s : samples) {
    const double residual = model.Residual(s, &derivative);
    equations.information.noalias() += derivative * derivative.transpose();
    equations.gradient += residual * derivative;
    equations.sum_square += residual * residual;
  }
  return equations;
}

// Sandwich estimate with the pieces along the edge as clusters: holds whatever the noise does
// within a piece. Compression makes it stronger at the edge and alike in neighbours, so that s^2
// (J'J)^-1 is up to five times too small.
Matrix ClusteredCovariance(const std::vector<Sample>& samples,
                           const Band& band,
                           const Vector& parameters,
                           const Matrix& information) {
  const EdgeModel model(band, parameters);
  std::vector<Vector> scores(BinCount(band), Vector::Zero());
  Vector derivative;
  for (const Sample& s : samples) {
    const double residual = model.Residual(s, &derivative);
    scores[static_cast<size_t>(s.bin)] += residual * derivative;
  }
  Matrix middle = Matrix::Zero();
  double pieces = 0;
  for (const Vector& score : scores) {
    middle += score * score.transpose();
    pieces += score.isZero() ? 0 : 1;
  }
  const Matrix inverse = information.ldlt().solve(Matrix::Identity());
  // Few pieces fit their own noise: the usual correction for the parameters they feed.
  const double correction = pieces / std::max(1.0, pieces - 2);
  return correction * inverse * middle * inverse;
}

bool Plausible(const Vector& p, const Band& band) {
  return p.allFinite() && p[kBlur] <= kMaxBlurPx && std::abs(p[kOffset]) < band.half_width &&
         std::abs(p[kAngle]) * band.length < 2 * band.half_width;
}

// Levenberg-Marquardt. std::nullopt if it leaves the band.
std::optional<Fit> Refine(const std::vector<Sample>& samples,
                          const Band& band,
                          const Vector& start) {
  constexpr int kMaxSteps = 30;
  constexpr double kDonePx = 1e-5;
  Fit fit{start, Matrix::Zero(), 0, samples.size()};
  NormalEquations now = Accumulate(samples, band, fit.parameters);
  double damping = 1e-4;
  for (int step = 0; step < kMaxSteps; ++step) {
    Matrix damped = now.information;
    damped.diagonal() += damping * now.information.diagonal() + Vector::Constant(1e-9);
    const Vector change = damped.ldlt().solve(now.gradient);
    Vector next = fit.parameters + change;
    next[kBlur] = std::max(next[kBlur], kMinBlurPx);
    if (!Plausible(next, band)) return std::nullopt;
    const NormalEquations there = Accumulate(samples, band, next);
    if (there.sum_square > now.sum_square) {
      damping = std::max(10 * damping, 1e-3);
      if (damping > 1e6) break;
      continue;
    }
    fit.parameters = next;
    now = there;
    damping *= 0.1;
    if (std::abs(change[kOffset]) + std::abs(change[kAngle]) * band.length < kDonePx) break;
  }
  fit.covariance = ClusteredCovariance(samples, band, fit.parameters, now.information);
  fit.mean_square =
      now.sum_square / std::max(1.0, static_cast<double>(samples.size()) - kParameters);
  return fit;
}

// Leaves out the pieces along the edge that fit much worse than the typical one: something lies
// over them.
std::vector<Sample> WithoutCovered(const std::vector<Sample>& samples,
                                   const Band& band,
                                   const Vector& parameters) {
  // A piece holds some 60 pixels, so its mean square scatters by a fifth; four times the median
  // is no chance.
  constexpr double kWorse = 4;
  const size_t bins = BinCount(band);
  std::vector<double> square(bins, 0), count(bins, 0), typical;
  const EdgeModel model(band, parameters);
  Vector derivative;
  for (const Sample& s : samples) {
    const double residual = model.Residual(s, &derivative);
    square[static_cast<size_t>(s.bin)] += residual * residual;
    count[static_cast<size_t>(s.bin)] += 1;
  }
  for (size_t k = 0; k < bins; ++k) {
    if (count[k] > 0) typical.push_back(square[k] /= count[k]);
  }
  std::nth_element(
      typical.begin(), typical.begin() + static_cast<long>(typical.size() / 2), typical.end());
  // Rounding to whole grey values alone leaves a hundred thousandth.
  const double limit = kWorse * std::max(typical[typical.size() / 2], 1e-6);
  std::vector<Sample> kept;
  for (const Sample& s : samples) {
    if (square[static_cast<size_t>(s.bin)] <= limit) kept.push_back(s);
  }
  return kept;
}

StraightEdge Describe(const Fit& fit, const Band& band, double used) {
  const Vector& p = fit.parameters;
  const double c = std::cos(p[kAngle]), s = std::sin(p[kAngle]);
  StraightEdge edge;
  // The line {across cos - along sin = offset}, at the foot of the band's middle.
  edge.direction = c * band.direction + s * band.normal;
  edge.middle_px = band.middle + p[kOffset] * edge.normal();
  edge.length_px = band.length;
  edge.bow_px = band.bow;
  edge.covariance = fit.covariance.topLeftCorner<2, 2>();
  edge.blur_px = p[kBlur];
  edge.noise = std::sqrt(fit.mean_square);
  edge.contrast = p[kContrast];
  edge.used = used;
  return edge;
}

}  // namespace

std::optional<StraightEdge> LocateStraightEdge(const cv::Mat& grey,
                                               const ToneCurve& tone,
                                               const StraightEdgeGuess& guess) {
  const LinearPicture picture{grey, tone};
  const Band wide = MakeBand(guess, std::min(guess.search_px + 4, std::max(guess.free_px, 2.5)));
  const int thin = std::max(1, static_cast<int>(wide.length / 60));
  const std::vector<Sample> coarse = Collect(picture, wide, thin);
  if (coarse.size() < 3 * kParameters) return std::nullopt;
  const std::optional<Vector> start = Start(coarse, wide);
  if (!start) return std::nullopt;
  const std::optional<Fit> rough = Refine(coarse, wide, *start);
  if (!rough) return std::nullopt;
  // The final band is as wide as the blur needs for its levels and no wider, along the line just
  // found.
  const StraightEdge found = Describe(*rough, wide, 1);
  const double blur = std::hypot(found.blur_px, 0.3);
  StraightEdgeGuess better = guess;
  better.from_px = found.middle_px - 0.5 * wide.length * found.direction;
  better.to_px = found.middle_px + 0.5 * wide.length * found.direction;
  const Band band =
      MakeBand(better, std::min(std::max(4.0, 5 * blur), std::max(guess.free_px, 2.0)));
  Vector parameters = rough->parameters;
  parameters[kOffset] = parameters[kAngle] = 0;
  std::vector<Sample> samples = Collect(picture, band, 1);
  const double all = static_cast<double>(samples.size());
  std::optional<Fit> fit = Refine(samples, band, parameters);
  for (int pass = 0; pass < 2 && fit; ++pass) {
    samples = WithoutCovered(samples, band, fit->parameters);
    if (samples.size() == fit->count) break;
    fit = Refine(samples, band, fit->parameters);
  }
  if (!fit) return std::nullopt;
  return Describe(*fit, band, static_cast<double>(fit->count) / all);
}

EdgeCrossing Cross(const StraightEdge& first, const StraightEdge& second) {
  // n . p = c for both; a bow moves c by what it is at the crossing, which two rounds settle.
  Eigen::Matrix2d normals;
  normals.row(0) = first.normal().transpose();
  normals.row(1) = second.normal().transpose();
  const Eigen::Matrix2d inverse = normals.inverse();
  const std::array<const StraightEdge*, 2> edges = {&first, &second};
  EdgeCrossing crossing{Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  Vector2d along = Vector2d::Zero();
  for (int round = 0; round < 3; ++round) {
    Vector2d offset;
    for (int i = 0; i < 2; ++i) {
      const StraightEdge& e = *edges[static_cast<size_t>(i)];
      const double x = 2 * along[i] / e.length_px;
      const double bow = round == 0 ? 0 : e.bow_px * (1 - x * x);
      offset[i] = e.normal().dot(e.middle_px) + bow;
    }
    crossing.point_px = inverse * offset;
    for (int i = 0; i < 2; ++i) {
      const StraightEdge& e = *edges[static_cast<size_t>(i)];
      along[i] = e.direction.dot(crossing.point_px - e.middle_px);
    }
  }
  Eigen::Matrix2d offsets = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 2; ++i) {
    const Vector2d lever(1, along[i]);
    offsets(i, i) = lever.dot(edges[static_cast<size_t>(i)]->covariance * lever);
  }
  crossing.covariance_px2 = inverse * offsets * inverse.transpose();
  return crossing;
}

}  // namespace bladecurve
