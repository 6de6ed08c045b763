// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_ground.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "vision/image/bilinear.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Quadratic = Eigen::Matrix<double, 6, 1>;

// A pixel near the rim: `q` from the head's centre in units of its radius, `t` px outwards.
struct Place {
  cv::Point at;
  Eigen::Vector2d q;
  double t;
};

Quadratic TermsOf(const Eigen::Vector2d& q) {
  return {1, q.x(), q.y(), q.x() * q.x(), q.x() * q.y(), q.y() * q.y()};
}

// All pixels of a picture from so far to so far outwards of the rim.
std::vector<Place> PlacesAbout(const RimEllipse& rim,
                               const cv::Size& size,
                               double from_px,
                               double to_px) {
  const Eigen::Matrix2d inverse = rim.shape.inverse();
  const double radius = rim.MeanRadius();
  std::vector<Place> places;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Eigen::Vector2d offset = Eigen::Vector2d(x, y) - rim.center, u = inverse * offset;
      const double norm = u.norm();
      const double t = (norm - 1) * norm / (inverse * u).norm();  // to first order
      if (t >= from_px && t <= to_px) places.push_back({{x, y}, offset / radius, t});
    }
  }
  return places;
}

struct Ground {
  Quadratic shading;   // light, as weights of TermsOf
  cv::Mat rest, mask;  // what that leaves over where mask is 1; 0 elsewhere
};

// Least squares without what is no ground: another edge, dirt, a glint.
Ground FitShading(const cv::Mat& picture, const std::vector<Place>& places) {
  constexpr int kRounds = 4;
  constexpr double kSigmas = 3.5;
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd terms(count, 6);
  Eigen::VectorXd light(count), weight = Eigen::VectorXd::Ones(count), rest(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Place& place = places[static_cast<std::size_t>(i)];
    terms.row(i) = TermsOf(place.q);
    light[i] = picture.at<float>(place.at);
  }
  Ground ground;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixXd weighted = weight.asDiagonal() * terms;
    const Eigen::Matrix<double, 6, 6> normal = weighted.transpose() * terms;
    ground.shading = normal.ldlt().solve(weighted.transpose() * light);
    rest = light - terms * ground.shading;
    const double sigma = kSigmaPerMedian * MedianAbsolute({rest.data(), rest.data() + count});
    weight = (rest.array().abs() <= kSigmas * sigma).cast<double>();
  }
  ground.rest = cv::Mat::zeros(picture.size(), CV_32F);
  ground.mask = cv::Mat::zeros(picture.size(), CV_32F);
  for (Eigen::Index i = 0; i < count; ++i) {
    const cv::Point& at = places[static_cast<std::size_t>(i)].at;
    ground.rest.at<float>(at) = static_cast<float>(weight[i] * rest[i]);
    ground.mask.at<float>(at) = static_cast<float>(weight[i]);
  }
  return ground;
}

// Sums of products of a picture with itself, shifted by up to `reach` px; no shift in the middle.
cv::Mat Autocorrelation(const cv::Mat& picture, int reach) {
  const cv::Size size(cv::getOptimalDFTSize(picture.cols + reach),
                      cv::getOptimalDFTSize(picture.rows + reach));
  cv::Mat padded, spectrum, power, sums;
  cv::copyMakeBorder(picture,
                     padded,
                     0,
                     size.height - picture.rows,
                     0,
                     size.width - picture.cols,
                     cv::BORDER_CONSTANT,
                     0);
  cv::dft(padded, spectrum, 0, picture.rows);
  cv::mulSpectrums(spectrum, spectrum, power, 0, true);
  cv::dft(power, sums, cv::DFT_INVERSE | cv::DFT_SCALE);
  cv::Mat lags(2 * reach + 1, 2 * reach + 1, CV_32F);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      lags.at<float>(y + reach, x + reach) =
          sums.at<float>((y + size.height) % size.height, (x + size.width) % size.width);
    }
  }
  return lags;
}

struct Streaks {
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  double length_px = 0;  // Gaussian sigma of their covariance along them
  double noise = 0;  // variance of what a pixel does not share with its streak, over the streaks'
};

constexpr int kLongestStreakPx = 40;

constexpr int kNearPx = 3;  // nearer, lens and pixels make all alike

// Covariance of the light of two pixels, by how far apart they are: up to `reach` px each way.
class Covariance {
 public:
  Covariance(const Ground& ground, int reach)
      : reach_(reach),
        lags_(Autocorrelation(ground.rest, reach) /
              cv::max(Autocorrelation(ground.mask, reach), 1.F)) {}

  [[nodiscard]] double At(const Eigen::Vector2d& lag) const {
    return Bilinear<float>(lags_, lag + Eigen::Vector2d::Constant(reach_));
  }
  // Mean over lags of `from` to `to` px.
  [[nodiscard]] double Along(const Eigen::Vector2d& direction, int from, int to) const {
    double sum = 0;
    for (int s = from; s <= to; ++s) sum += At(s * direction);
    return sum / (to - from + 1);
  }

 private:
  int reach_;
  cv::Mat lags_;
};

Eigen::Vector2d MostAlikeDirection(const Covariance& covariance, int reach) {
  constexpr int kDirections = 60;
  const auto along = [](double turns) {
    return Eigen::Vector2d(std::cos(std::numbers::pi * turns), std::sin(std::numbers::pi * turns));
  };
  std::vector<double> alike;
  for (int i = 0; i < kDirections; ++i) {
    const double turns = static_cast<double>(i) / kDirections;
    alike.push_back(covariance.Along(along(turns), kNearPx, reach));
  }
  const auto most = std::max_element(alike.begin(), alike.end());
  const auto best = static_cast<int>(most - alike.begin());
  const double before = alike[static_cast<std::size_t>((best + kDirections - 1) % kDirections)];
  const double after = alike[static_cast<std::size_t>((best + 1) % kDirections)];
  // Where the parabola through the three has its top.
  const double bend = std::max(2 * *most - before - after, 1e-6 * std::abs(*most) + 1e-300);
  return along((best + std::clamp(0.5 * (after - before) / bend, -0.5, 0.5)) / kDirections);
}

// std::nullopt where the ground is alike in no direction.
std::optional<Streaks> FindStreaks(const Ground& ground, double radius_px) {
  constexpr double kReach = 0.7;         // of the radius: further on the ground is another
  constexpr double kHalfWidth = 1.1774;  // of a Gaussian, in sigmas
  const int reach = std::clamp(static_cast<int>(kReach * radius_px), 2 * kNearPx, kLongestStreakPx);
  const Covariance covariance(ground, reach);
  Streaks streaks{.along = MostAlikeDirection(covariance, reach)};
  const double variance = covariance.Along(streaks.along, kNearPx, 2 * kNearPx - 1);
  if (!(variance > 0)) return std::nullopt;
  int half = kNearPx + 1;
  while (half < reach && covariance.At(half * streaks.along) > 0.5 * variance) ++half;
  streaks.length_px = half / kHalfWidth;
  streaks.noise = std::max(0.0, covariance.At(Eigen::Vector2d::Zero()) / variance - 1);
  return streaks;
}

// What the streak that a pixel lies on shows elsewhere: the mean along it, as far as the noise
// leaves it to be believed.
class StreakMeans {
 public:
  StreakMeans(const Ground& ground, const Streaks& streaks) : noise_(streaks.noise) {
    constexpr double kSigmas = 2;
    const int reach = static_cast<int>(kSigmas * streaks.length_px);
    border_ = reach + 1;
    for (const auto& [from, to] : {std::pair{&ground.rest, &rest_}, {&ground.mask, &mask_}}) {
      cv::copyMakeBorder(*from, *to, border_, border_, border_, border_, cv::BORDER_CONSTANT, 0);
    }
    const auto row = static_cast<std::ptrdiff_t>(rest_.step1());
    for (int s = -reach; s <= reach; ++s) {
      const double sigmas = s / streaks.length_px;
      steps_.push_back(
          {std::lround(s * streaks.along.y()) * row + std::lround(s * streaks.along.x()),
           static_cast<float>(std::exp(-0.5 * sigmas * sigmas))});
    }
  }

  [[nodiscard]] double At(const cv::Point& at) const {
    const float* rest = rest_.ptr<float>(at.y + border_) + at.x + border_;
    const float* mask = mask_.ptr<float>(at.y + border_) + at.x + border_;
    float sum = 0, weights = 0;
    for (const Step& step : steps_) {
      sum += step.weight * rest[step.offset];
      weights += step.weight * mask[step.offset];
    }
    return weights > 0 ? sum / (weights + noise_) : 0;
  }

 private:
  struct Step {
    std::ptrdiff_t offset;
    float weight;
  };
  double noise_;
  int border_ = 0;
  cv::Mat rest_, mask_;
  std::vector<Step> steps_;
};

// Light by which the ground is uneven, at all pixels from so far to so far outwards of the rim.
cv::Mat UnevennessAbout(const cv::Mat& picture,
                        const RimEllipse& rim,
                        double from_px,
                        double to_px) {
  constexpr double kClearPx = 2;              // of the rim's blur
  constexpr double kWide = 0.5, kWidePx = 2;  // of the radius: further off other things lie
  const double radius = rim.MeanRadius();
  const Ground ground =
      FitShading(picture, PlacesAbout(rim, picture.size(), kClearPx, kWide * radius + kWidePx));
  const std::optional<Streaks> streaks = FindStreaks(ground, radius);
  std::optional<StreakMeans> means;
  if (streaks) means.emplace(ground, *streaks);
  cv::Mat uneven = cv::Mat::zeros(picture.size(), CV_32F);
  for (const Place& place : PlacesAbout(rim, picture.size(), from_px, to_px)) {
    const double shading = ground.shading.dot(TermsOf(place.q)) - ground.shading[0];
    uneven.at<float>(place.at) = static_cast<float>(shading + (means ? means->At(place.at) : 0));
  }
  return uneven;
}

// Of large heads, at a scale at which they are no larger than this: finer streaks average out
// along the rim, and it costs no more than in small ones.
constexpr double kLargestRadiusPx = 64;

cv::Mat Unevenness(const cv::Mat& picture, const RimEllipse& rim, double from_px, double to_px) {
  const double scale = rim.MeanRadius() / kLargestRadiusPx;
  if (scale <= 1) return UnevennessAbout(picture, rim, from_px, to_px);
  constexpr double kMargin = 2;  // for the pixels between which the larger ones lie
  cv::Mat small, uneven;
  cv::resize(picture, small, {}, 1 / scale, 1 / scale, cv::INTER_AREA);
  // Outer borders of the pictures stay together, pixel centres shift by half a pixel of each.
  const Eigen::Vector2d origin = Eigen::Vector2d::Constant(0.5 * scale - 0.5);
  uneven = UnevennessAbout(
      small, rim.Into(origin, scale), from_px / scale - kMargin, to_px / scale + kMargin);
  cv::resize(uneven, uneven, picture.size(), 0, 0, cv::INTER_LINEAR);
  return uneven;
}

}  // namespace

cv::Mat WithEvenGround(const cv::Mat& picture, const RimEllipse& rim) {
  constexpr double kFromPx = -2.5, kToPx = 8;  // what profiles across the rim see of the ground
  constexpr double kBlurPx = 1;                // of the rim, by lens and pixel
  const cv::Mat uneven = Unevenness(picture, rim, kFromPx, kToPx);
  cv::Mat even = picture.clone();
  for (const Place& place : PlacesAbout(rim, picture.size(), kFromPx, kToPx)) {
    const double seen = 0.5 * std::erfc(-place.t / kBlurPx / std::numbers::sqrt2);
    even.at<float>(place.at) -= static_cast<float>(seen) * uneven.at<float>(place.at);
  }
  return even;
}

}  // namespace bladecurve
