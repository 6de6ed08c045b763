// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_profiles.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/image/bilinear.h"
#include "vision/image/blurred_step.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

constexpr int kFewestProfiles = 24;
constexpr double kTapPx = 0.5;                // spacing along a profile
constexpr double kSmoothingTurns = 1.0 / 64;  // Gaussian sigma along the rim before judging

// Of what may be in a profile: trend, common shape and its displacement.
using Basis =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Eigen::Dynamic, 4 + kMostShading>;
using Normal =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4 + kMostShading, 4 + kMostShading>;

Eigen::VectorXd Window(const Eigen::VectorXd& t, double half_px, bool flat) {
  const Eigen::ArrayXd relative = (t.array() / half_px).square();  // 0.2 at the ends
  const Eigen::ArrayXd exponent = flat ? Eigen::ArrayXd(relative.pow(4)) : relative;
  return (-1.6 * exponent).exp();
}

// Takes mean and slope out of every profile: shading says nothing about the place of the rim.
RimRows WithoutTrend(const RimProfiles& profiles) {
  const Eigen::VectorXd& w = profiles.window;
  const Eigen::VectorXd wt =
      w.cwiseProduct(profiles.t);  // the window is even: constant and slope are orthogonal
  const Eigen::VectorXd mean = profiles.values * w / w.sum();
  const Eigen::VectorXd slope = profiles.values * wt / wt.dot(profiles.t);
  RimRows detrended = profiles.values.colwise() - mean;
  detrended.noalias() -= slope * profiles.t.transpose();
  return detrended;
}

// The dominant principal component of the profiles, each scaled so that a glint has no more say
// than others.
std::optional<RimShape> FindCommonShape(const RimProfiles& profiles, const RimRows& detrended) {
  const Eigen::VectorXd root_window = profiles.window.cwiseSqrt();
  RimRows scaled = detrended * root_window.asDiagonal();
  const Eigen::VectorXd norms = scaled.rowwise().norm();
  const double typical = Median({norms.data(), norms.data() + norms.size()}) + 1e-12;
  scaled.array().colwise() *= (norms.array() + typical).inverse();
  Eigen::VectorXd component = scaled.colwise().mean().transpose();
  Eigen::VectorXd shares(scaled.rows());
  for (int round = 0; round < 4 && component.norm() > 1e-12; ++round) {
    shares.noalias() = scaled * component.normalized();
    component.noalias() = scaled.transpose() * shares;
  }
  if (!(component.norm() > 1e-12)) return std::nullopt;
  RimShape shape;
  shape.value = component.normalized().cwiseQuotient(root_window);
  const Eigen::Index last = shape.value.size() - 1;
  shape.derivative.resize(last + 1);
  for (Eigen::Index k = 0; k <= last; ++k) {
    const Eigen::Index before = std::max<Eigen::Index>(k - 1, 0), after = std::min(k + 1, last);
    shape.derivative[k] = (shape.value[after] - shape.value[before]) / (kTapPx * (after - before));
  }
  // The slope taken out of the profiles is put back: most taps lie on level ground.
  const double level = Median({shape.derivative.data(), shape.derivative.data() + last + 1});
  const Eigen::VectorXd energy =
      profiles.window.array() * (shape.derivative.array() - level).square();
  shape.center_px = energy.dot(profiles.t) / energy.sum();
  return shape;
}

// Linear least squares a f(t - d) + trend ~ a f - (a d) f' + trend, profile by profile. Within
// the head light may also go with powers of the distance from the rim up to `shading`; its bend at
// the rim, were it sharp, would be taken for a shift of the rim.
std::vector<RimMatch> MatchToShape(const RimProfiles& profiles,
                                   const RimRows& detrended,
                                   const RimShape& shape,
                                   int shading) {
  constexpr double kBlurPx = 1.2;  // lens, pixel and the sampling between pixels
  const Eigen::Index taps = detrended.cols(), unknowns = 4 + shading;
  Basis basis(taps, unknowns);
  basis.rightCols(4) << Eigen::VectorXd::Ones(taps), profiles.t, shape.value, -shape.derivative;
  for (int power = 1; power <= shading; ++power) {
    for (Eigen::Index k = 0; k < taps; ++k)
      basis(k, power - 1) = BlurredPower(shape.center_px - profiles.t[k], power, kBlurPx);
  }
  const Basis weighted = profiles.window.asDiagonal() * basis;
  const Normal normal = basis.transpose() * weighted;
  // Of the unknowns the last two: a and a d.
  const Eigen::Matrix<double, Eigen::Dynamic, 2> estimator =
      weighted * normal.ldlt().solve(Normal::Identity(unknowns, unknowns)).rightCols(2);
  // Of so few columns, dot products are quicker than a blocked product.
  const Eigen::Matrix<double, Eigen::Dynamic, 2> solution = detrended.lazyProduct(estimator);

  const double sigma = std::max(0.7, kSmoothingTurns * static_cast<double>(detrended.rows()));
  const SmoothedRows smooth = SmoothAlongRim(detrended, sigma);
  const Eigen::VectorXd along = smooth.values * profiles.window.cwiseProduct(shape.value);
  const Eigen::VectorXd squares = smooth.values.cwiseAbs2() * profiles.window;
  const double most_shift = kMostRelativeShift * profiles.t[taps - 1];
  std::vector<RimMatch> matches(static_cast<std::size_t>(detrended.rows()));
  for (Eigen::Index i = 0; i < detrended.rows(); ++i) {
    RimMatch& match = matches[static_cast<std::size_t>(i)];
    match.correlation = along[i] / (std::sqrt(squares[i]) + 1e-12 * smooth.weights);
    match.strength = along[i] / smooth.weights;
    match.amplitude = solution(i, 0);
    const double safe = std::copysign(std::max(std::abs(match.amplitude), 1e-12), match.amplitude);
    match.shift_px = std::clamp(solution(i, 1) / safe, -most_shift, most_shift) + shape.center_px;
  }
  return matches;
}

// kColumns of a row and its weighted neighbours on both sides; sums that fit into registers.
template <int kColumns>
void SmoothColumns(const double* middle,
                   Eigen::Index stride,
                   const std::vector<double>& weights,
                   double* out) {
  Eigen::Array<double, kColumns, 1> sum = Eigen::Map<const decltype(sum)>(middle);
  const double *after = middle, *before = middle;
  for (const double weight : weights) {
    sum += weight * (Eigen::Map<const decltype(sum)>(after += stride) +
                     Eigen::Map<const decltype(sum)>(before -= stride));
  }
  Eigen::Map<decltype(sum)>{out} = sum;
}

// One row and its weighted neighbours on both sides.
void SmoothRow(const RimRows& rows,
               Eigen::Index row,
               const std::vector<double>& weights,
               double* out) {
  constexpr Eigen::Index kAtOnce = 8;
  const double* const middle = rows.row(row).data();
  Eigen::Index column = 0;
  for (; column + kAtOnce <= rows.cols(); column += kAtOnce)
    SmoothColumns<kAtOnce>(middle + column, rows.cols(), weights, out + column);
  for (; column < rows.cols(); ++column)
    SmoothColumns<1>(middle + column, rows.cols(), weights, out + column);
}

// Values of a picture along straight lines. One step for all places of a line before the next step:
// so the compiler takes several places at a time.
class LineSampler {
 public:
  LineSampler(const cv::Mat& picture, const Eigen::VectorXd& t)
      : picture_(picture),
        t_(t),
        right_(t.size()),
        down_(t.size()),
        pixels_(t.size(), 4),
        offset_(t.size()) {}

  // At start + t direction; beyond the picture its border repeats.
  void Sample(const Eigen::Vector2d& start, const Eigen::Vector2d& direction, double* values) {
    const Eigen::Index last = t_.size() - 1;
    if (LiesWithin(picture_, start + t_[0] * direction) &&
        LiesWithin(picture_, start + t_[last] * direction)) {
      Locate(start, direction);
      Gather();
      Interpolate(values);
      return;
    }
    for (Eigen::Index k = 0; k <= last; ++k)
      values[k] = Bilinear<float>(picture_, start + t_[k] * direction);
  }

 private:
  void Locate(const Eigen::Vector2d& start, const Eigen::Vector2d& direction) {
    const auto step = static_cast<int>(picture_.step1());
    const double *t = t_.data(), x0 = start.x(), y0 = start.y();
    const double dx = direction.x(), dy = direction.y();
    double *right = right_.data(), *down = down_.data();
    int* offset = offset_.data();
    for (Eigen::Index k = 0; k < t_.size(); ++k) {
      const double x = x0 + t[k] * dx, y = y0 + t[k] * dy;
      const int column = static_cast<int>(x), row = static_cast<int>(y);
      right[k] = x - column;
      down[k] = y - row;
      offset[k] = row * step + column;
    }
  }

  void Gather() {
    const auto* picture = picture_.ptr<float>();
    const auto step = picture_.step1();
    for (Eigen::Index k = 0; k < t_.size(); ++k) {
      const float *upper = picture + offset_[k], *lower = upper + step;
      pixels_(k, 0) = upper[0];
      pixels_(k, 1) = upper[1];
      pixels_(k, 2) = lower[0];
      pixels_(k, 3) = lower[1];
    }
  }

  // As Bilinear does.
  void Interpolate(double* values) const {
    const auto pixels = pixels_.cast<double>();
    Eigen::Map<Eigen::ArrayXd>(values, t_.size()) =
        (1 - down_) * ((1 - right_) * pixels.col(0) + right_ * pixels.col(1)) +
        down_ * ((1 - right_) * pixels.col(2) + right_ * pixels.col(3));
  }

  const cv::Mat& picture_;
  const Eigen::VectorXd& t_;
  Eigen::ArrayXd right_, down_;                    // within the pixel
  Eigen::Array<float, Eigen::Dynamic, 4> pixels_;  // about each place
  Eigen::ArrayXi offset_;                          // of the first of them
};

}  // namespace

SmoothedRows SmoothAlongRim(const RimRows& rows, double sigma_rows) {
  const Eigen::Index count = rows.rows();
  const auto reach = std::min(static_cast<Eigen::Index>(std::ceil(2.5 * sigma_rows)), count / 2);
  SmoothedRows smooth;
  std::vector<double> weights;
  for (Eigen::Index k = 1; k <= reach; ++k) {
    weights.push_back(std::exp(-0.5 * static_cast<double>(k * k) / (sigma_rows * sigma_rows)));
    smooth.weights += 2 * weights.back();
    smooth.squared_weights += 2 * weights.back() * weights.back();
  }
  RimRows closed(count + 2 * reach, rows.cols());  // the rim goes on with its other end
  closed << rows.bottomRows(reach), rows, rows.topRows(reach);
  smooth.values.resize(count, rows.cols());
  for (Eigen::Index row = 0; row < count; ++row)
    SmoothRow(closed, row + reach, weights, smooth.values.row(row).data());
  return smooth;
}

RimProfiles SampleProfiles(const cv::Mat& picture,
                           const RimEllipse& rim,
                           const RimSampling& sampling) {
  const double perimeter = 2 * std::numbers::pi * rim.MeanRadius();
  const int count =
      std::clamp(static_cast<int>(perimeter), kFewestProfiles, sampling.most_profiles);
  const int half_taps = static_cast<int>(std::ceil(sampling.half_px / kTapPx));
  const int taps = 2 * half_taps + 1;
  RimProfiles profiles;
  profiles.values.resize(count, taps);
  profiles.jacobian.resize(count, 5);
  profiles.t = Eigen::VectorXd::LinSpaced(taps, -half_taps * kTapPx, half_taps * kTapPx);
  profiles.window = Window(profiles.t, sampling.half_px, sampling.flat_window);
  const Eigen::Matrix2d inverse_shape = rim.shape.inverse();
  LineSampler sampler(picture, profiles.t);
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(2 * std::numbers::pi / count).matrix();
  Eigen::Vector2d u(1, 0);
  for (int i = 0; i < count; ++i, u = turn * u) {
    const Eigen::Vector2d n = (inverse_shape * u).normalized(), p = rim.PointAt(u);
    sampler.Sample(p, n, profiles.values.row(i).data());
    profiles.jacobian.row(i) << n.x(), n.y(), n.x() * u.x(), n.x() * u.y() + n.y() * u.x(),
        n.y() * u.y();
  }
  return profiles;
}

std::optional<RimMatches> MatchProfiles(const RimProfiles& profiles, int shading) {
  const RimRows detrended = WithoutTrend(profiles);
  const std::optional<RimShape> shape = FindCommonShape(profiles, detrended);
  if (!shape) return std::nullopt;
  return RimMatches{*shape, MatchToShape(profiles, detrended, *shape, shading)};
}

}  // namespace bladecurve
