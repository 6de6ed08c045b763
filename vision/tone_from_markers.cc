// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/tone_from_markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "vision/marker_corners.h"
#include "vision/straight_edge.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kBinPx = 0.25;
constexpr double kEncodedGamma = 2.2;  // effective exponent of sRGB
constexpr double kMinPower = 0.35,
                 kMaxPower = 1.8;  // from linear pictures to strong contrast curves

// Mean stored grey value by distance from a side, dark to bright, evenly spaced by kBinPx about the
// middle.
using Profile = std::vector<double>;

std::optional<Profile> MeasureProfile(const cv::Mat& grey,
                                      const StraightEdge& edge,
                                      double reach_px) {
  const size_t bins = 2 * static_cast<size_t>(reach_px / kBinPx) + 1;
  const double half = 0.5 * static_cast<double>(bins) * kBinPx;
  std::vector<double> sum(bins, 0), count(bins, 0);
  const Vector2d bright = edge.contrast > 0 ? edge.normal() : Vector2d(-edge.normal());
  const Vector2d along = 0.5 * edge.length_px * edge.direction;
  const Vector2d extent = along.cwiseAbs() + half * bright.cwiseAbs();
  const int x0 = std::max(0, static_cast<int>(edge.middle_px.x() - extent.x()));
  const int y0 = std::max(0, static_cast<int>(edge.middle_px.y() - extent.y()));
  const int x1 = std::min(grey.cols - 1, static_cast<int>(edge.middle_px.x() + extent.x()) + 1);
  const int y1 = std::min(grey.rows - 1, static_cast<int>(edge.middle_px.y() + extent.y()) + 1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vector2d offset = Vector2d(x, y) - edge.middle_px;
      const double place = offset.dot(bright) / kBinPx + 0.5 * static_cast<double>(bins);
      if (std::abs(offset.dot(edge.direction)) > 0.5 * edge.length_px || place < 0 ||
          place >= static_cast<double>(bins))
        continue;
      sum[static_cast<size_t>(place)] += grey.at<uchar>(y, x);
      count[static_cast<size_t>(place)] += 1;
    }
  }
  constexpr double kMinCount = 8;  // rejects sides so short that a bin holds single pixels
  for (size_t k = 0; k < bins; ++k) {
    if (count[k] < kMinCount) return std::nullopt;
    sum[k] /= count[k];
  }
  return sum;
}

// A place of the profile in linear light, 0 to 1 between its ends, and what one stored grey value
// is there.
struct Light {
  double level, per_grey;
};

std::vector<Light> Normalised(const Profile& profile, const ToneCurve& tone) {
  constexpr size_t kEnd = 4;  // one pixel of level ground on each side
  std::vector<Light> light;
  for (const double stored : profile) {
    const size_t low = static_cast<size_t>(std::clamp(stored, 0.0, 254.0));
    const double slope = tone.linear[low + 1] - tone.linear[low];
    light.push_back({tone.linear[low] + (stored - static_cast<double>(low)) * slope, slope});
  }
  double dark = 0, bright = 0;
  for (size_t k = 0; k < kEnd; ++k) {
    dark += light[k].level / kEnd;
    bright += light[light.size() - 1 - k].level / kEnd;
  }
  for (Light& place : light) {
    place.level = (place.level - dark) / (bright - dark);
    place.per_grey /= bright - dark;
  }
  return light;
}

Light At(const std::vector<Light>& profile, double place) {
  const double last = static_cast<double>(profile.size() - 1);
  const double x = std::clamp(place, 0.0, last - 1e-9);
  const size_t k = static_cast<size_t>(x);
  const double part = x - static_cast<double>(k);
  return {profile[k].level + part * (profile[k + 1].level - profile[k].level),
          profile[k].per_grey + part * (profile[k + 1].per_grey - profile[k].per_grey)};
}

// How far f(c + d) + f(c - d) is from being the same for all d: mean square in units of the noise,
// which is even in stored grey values. Without those units curves that press the noise together
// would win, and without solving for the sum curves that spare the noise of the ends.
double SkewnessAbout(const std::vector<Light>& light, double c) {
  const double reach = std::min(c, static_cast<double>(light.size() - 1) - c);
  double count = 0, weights = 0, mean = 0, square = 0;
  for (double d = 0; d <= reach; d += 1) {
    const Light above = At(light, c + d), below = At(light, c - d);
    const double sum = above.level + below.level - 1;
    const double weight = 1 / (above.per_grey * above.per_grey + below.per_grey * below.per_grey);
    count += 1;
    weights += weight;
    mean += weight * sum;
    square += weight * sum * sum;
  }
  return (square - mean * mean / weights) / count;
}

// The least of a function with one minimum near the best of a few places: golden section about
// that.
template <typename Function>
double Minimum(const Function& cost, const std::vector<double>& places, double tolerance) {
  constexpr double kGolden = 0.6180339887498949;
  size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < places.size(); ++k) {
    const double here = cost(places[k]);
    if (here < least) least = here, best = k;
  }
  double low = places[best == 0 ? 0 : best - 1],
         high = places[std::min(best + 1, places.size() - 1)];
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double cost_a = cost(a), cost_b = cost(b);
  while (high - low > tolerance) {
    if (cost_a < cost_b) {
      high = b, b = a, cost_b = cost_a;
      a = high - kGolden * (high - low), cost_a = cost(a);
    } else {
      low = a, a = b, cost_a = cost_b;
      b = low + kGolden * (high - low), cost_b = cost(b);
    }
  }
  return 0.5 * (low + high);
}

double Skewness(const std::vector<Light>& light) {
  // The middle lies within a pixel and a half of where the side was located with the assumed curve.
  const double middle = 0.5 * static_cast<double>(light.size() - 1);
  std::vector<double> places;
  for (int bin = -6; bin <= 6; ++bin) places.push_back(middle + bin);
  const auto about = [&](double c) { return SkewnessAbout(light, c); };
  return SkewnessAbout(light, Minimum(about, places, 0.02));
}

// The power that makes the profiles least skew, all together.
double BestPower(const std::vector<Profile>& profiles) {
  const auto cost = [&](double power) {
    const ToneCurve tone = PowerToneCurve(power);
    double sum = 0;
    for (const Profile& profile : profiles) sum += Skewness(Normalised(profile, tone));
    return sum;
  };
  return Minimum(cost, {0.35, 0.45, 0.55, 0.7, 0.85, 1, 1.2, 1.4, 1.7}, 0.004);
}

struct Power {
  double value, sigma;
};

// With its standard uncertainty by leaving out one group of sides after the other (jackknife).
Power MeasurePower(const std::vector<Profile>& profiles) {
  constexpr size_t kGroups = 4;
  double mean = 0, square = 0;
  for (size_t group = 0; group < kGroups; ++group) {
    std::vector<Profile> rest;
    for (size_t i = 0; i < profiles.size(); ++i) {
      if (i % kGroups != group) rest.push_back(profiles[i]);
    }
    const double power = BestPower(rest);
    mean += power / kGroups;
    square += power * power / kGroups;
  }
  return {BestPower(profiles), std::sqrt((kGroups - 1) * std::max(0.0, square - mean * mean))};
}

std::vector<Profile> SideProfiles(const cv::Mat& grey, const SeenMarker& marker) {
  // An overexposed or crushed side has lost its shape.
  constexpr double kDarkest = 2, kBrightest = 252;
  std::vector<Profile> profiles;
  const ToneCurve srgb = SrgbToneCurve();
  for (int k = 0; k < 4; ++k) {
    const StraightEdgeGuess guess = MarkerSide(marker.corners_px, k, {1, std::nullopt});
    const auto edge = LocateStraightEdge(grey, srgb, guess);
    if (!edge || edge->used < 0.95) continue;
    const double reach = std::min({guess.free_px, 4 * edge->blur_px + 2, 8.0});
    const auto profile = MeasureProfile(grey, *edge, reach);
    if (profile && profile->front() > kDarkest && profile->back() < kBrightest)
      profiles.push_back(*profile);
  }
  return profiles;
}

}  // namespace

ToneCurve PowerToneCurve(double power) {
  ToneCurve tone = SrgbToneCurve();
  for (float& value : tone.linear)
    value = static_cast<float>(std::pow(static_cast<double>(value), power));
  return tone;
}

ToneCurve MeasureToneCurve(const cv::Mat& grey, const std::vector<SeenMarker>& markers) {
  constexpr size_t kMinSides = 4, kMaxSides = 24;
  constexpr double kMaxSigma = 0.07;  // the assumption that pictures are sRGB is as good as that
  std::vector<Profile> profiles;
  for (const SeenMarker& marker : markers) {
    if (!std::isfinite(marker.corner_sigma_px) || profiles.size() >= kMaxSides) continue;
    for (Profile& profile : SideProfiles(grey, marker)) profiles.push_back(std::move(profile));
  }
  if (profiles.size() < kMinSides) return SrgbToneCurve();
  const Power power = MeasurePower(profiles);
  if (power.sigma > kMaxSigma) return SrgbToneCurve();
  // Nearly all pictures are sRGB: that is kept where the sides do not contradict it.
  const bool srgb = std::abs(power.value - 1) < 2 * power.sigma;
  ToneCurve tone = srgb ? SrgbToneCurve() : PowerToneCurve(power.value);
  tone.measured = true;
  tone.gamma_sigma = kEncodedGamma * power.sigma;
  return tone;
}

}  // namespace bladecurve
