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

double Interpolated(const ToneCurve& tone, double stored) {
  const size_t low = static_cast<size_t>(std::clamp(stored, 0.0, 254.0));
  const double part = stored - static_cast<double>(low);
  return (1 - part) * tone.linear[low] + part * tone.linear[low + 1];
}

// The profile in linear light, from 0 to 1 between its ends.
Profile Normalised(const Profile& profile, const ToneCurve& tone) {
  constexpr size_t kEnd = 4;  // one pixel of level ground on each side
  Profile light;
  for (const double stored : profile) light.push_back(Interpolated(tone, stored));
  double dark = 0, bright = 0;
  for (size_t k = 0; k < kEnd; ++k) {
    dark += light[k] / kEnd;
    bright += light[light.size() - 1 - k] / kEnd;
  }
  for (double& value : light) value = (value - dark) / (bright - dark);
  return light;
}

double At(const Profile& profile, double place) {
  const double last = static_cast<double>(profile.size() - 1);
  const double x = std::clamp(place, 0.0, last - 1e-9);
  const size_t k = static_cast<size_t>(x);
  return profile[k] + (x - static_cast<double>(k)) * (profile[k + 1] - profile[k]);
}

// How far the profile is from f(c + d) + f(c - d) = 1: mean square over d, for the best c.
double Skewness(const Profile& light) {
  const double middle = 0.5 * static_cast<double>(light.size() - 1);
  double best = std::numeric_limits<double>::infinity();
  constexpr double kStep = 0.04;  // of a bin: a hundredth of a pixel
  for (double c = middle - 4; c <= middle + 4; c += kStep) {
    const double reach = std::min(c, static_cast<double>(light.size() - 1) - c);
    double sum = 0, count = 0;
    for (double d = 0; d <= reach; d += 1) {
      const double off = At(light, c + d) + At(light, c - d) - 1;
      sum += off * off;
      count += 1;
    }
    best = std::min(best, sum / count);
  }
  return best;
}

// The power that makes the profiles least skew, all together; golden section.
double BestPower(const std::vector<Profile>& profiles) {
  constexpr double kGolden = 0.6180339887498949;
  const auto cost = [&](double power) {
    const ToneCurve tone = PowerToneCurve(power);
    double sum = 0;
    for (const Profile& profile : profiles) sum += Skewness(Normalised(profile, tone));
    return sum;
  };
  double low = kMinPower, high = kMaxPower;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double cost_a = cost(a), cost_b = cost(b);
  while (high - low > 0.004) {
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
  double mean = 0, square = 0;
  for (const Profile& profile : profiles) {
    const double power = BestPower({profile});
    mean += power;
    square += power * power;
  }
  const double n = static_cast<double>(profiles.size());
  mean /= n;
  const double sigma = std::sqrt(std::max(0.0, square / n - mean * mean) / (n - 1));
  if (sigma > kMaxSigma) return SrgbToneCurve();
  const double power = BestPower(profiles);
  ToneCurve tone = std::abs(power - 1) < 2 * sigma ? SrgbToneCurve() : PowerToneCurve(power);
  tone.measured = true;
  tone.gamma_sigma = kEncodedGamma * sigma;
  return tone;
}

}  // namespace bladecurve
