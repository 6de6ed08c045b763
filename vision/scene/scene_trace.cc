// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kStep = 0.5;  // of the offsets across the path, px

// Bilinear value of channel c; outside the image the nearest pixel.
float Sample(const cv::Mat& image, const Vector2d& p, int c) {
  const double x = std::clamp(p.x(), 0.0, image.cols - 1.001);
  const double y = std::clamp(p.y(), 0.0, image.rows - 1.001);
  const int ix = static_cast<int>(x);
  const int iy = static_cast<int>(y);
  const auto fx = static_cast<float>(x - ix);
  const auto fy = static_cast<float>(y - iy);
  const int n = image.channels();
  const float* top = image.ptr<float>(iy) + ix * n + c;
  const float* bottom = image.ptr<float>(iy + 1) + ix * n + c;
  return (1 - fy) * ((1 - fx) * top[0] + fx * top[n]) +
         fy * ((1 - fx) * bottom[0] + fx * bottom[n]);
}

// Strength of the transition across each offset of one cross-section: difference over two pixels.
std::vector<double> TransitionStrengths(const cv::Mat& image,
                                        const Vector2d& origin,
                                        const Vector2d& outwards,
                                        double first,
                                        int count) {
  const int margin = static_cast<int>(1 / kStep);
  std::vector<double> strengths(static_cast<std::size_t>(count), 0.0);
  for (int c = 0; c < image.channels(); ++c) {
    std::vector<float> values;
    for (int k = -margin; k < count + margin; ++k) {
      values.push_back(Sample(image, origin + (first + k * kStep) * outwards, c));
    }
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double step = values[i + 2 * static_cast<std::size_t>(margin)] - values[i];
      strengths[i] += step * step;
    }
  }
  for (double& s : strengths) s = std::sqrt(s);
  return strengths;
}

// The smooth sequence of offsets with the largest sum of rewards.
std::vector<int> BestSequence(const std::vector<std::vector<double>>& rewards) {
  constexpr double kTurnPenalty =
      0.35;  // a step of half a pixel sideways costs that share of a full transition
  constexpr int kLargestTurn = 2;
  const int count = static_cast<int>(rewards.front().size());
  std::vector<double> best = rewards.front();
  std::vector<std::vector<int>> from(rewards.size(),
                                     std::vector<int>(static_cast<std::size_t>(count), 0));
  for (std::size_t i = 1; i < rewards.size(); ++i) {
    std::vector<double> next(static_cast<std::size_t>(count),
                             -std::numeric_limits<double>::infinity());
    for (int k = 0; k < count; ++k) {
      for (int turn = -kLargestTurn; turn <= kLargestTurn; ++turn) {
        const int before = k + turn;
        if (before < 0 || before >= count) continue;
        const double sum = best[static_cast<std::size_t>(before)] - kTurnPenalty * turn * turn;
        if (sum > next[static_cast<std::size_t>(k)]) {
          next[static_cast<std::size_t>(k)] = sum;
          from[i][static_cast<std::size_t>(k)] = before;
        }
      }
      next[static_cast<std::size_t>(k)] += rewards[i][static_cast<std::size_t>(k)];
    }
    best = std::move(next);
  }
  std::vector<int> sequence(rewards.size());
  sequence.back() = static_cast<int>(std::max_element(best.begin(), best.end()) - best.begin());
  for (std::size_t i = rewards.size() - 1; i > 0; --i) {
    sequence[i - 1] = from[i][static_cast<std::size_t>(sequence[i])];
  }
  return sequence;
}

double Quantile(std::vector<double> values, double share) {
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace

std::vector<Vector2d> Resample(const std::vector<Vector2d>& path, double step) {
  std::vector<Vector2d> even;
  if (path.empty()) return even;
  even.push_back(path.front());
  double carried = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vector2d d = path[i + 1] - path[i];
    const double length = d.norm();
    if (length == 0) continue;
    double at = step - carried;
    for (; at <= length; at += step) even.push_back(path[i] + at / length * d);
    carried = length - (at - step);
  }
  if ((even.back() - path.back()).norm() > 0.25 * step) even.push_back(path.back());
  return even;
}

std::vector<Vector2d> Smooth(const std::vector<Vector2d>& path, int half_window) {
  std::vector<Vector2d> smooth;
  const int n = static_cast<int>(path.size());
  for (int i = 0; i < n; ++i) {
    const int half = std::min({half_window, i, n - 1 - i});  // the ends stay where they are
    Vector2d sum = Vector2d::Zero();
    for (int k = i - half; k <= i + half; ++k) sum += path[static_cast<std::size_t>(k)];
    smooth.emplace_back(sum / (2 * half + 1));
  }
  return smooth;
}

std::vector<Vector2d> TraceStrongestEdge(const cv::Mat& image,
                                         const std::vector<Vector2d>& path,
                                         int inside,
                                         const TraceRange& range) {
  const std::vector<Vector2d> base = Smooth(Resample(path, 1.0), 4);
  if (base.size() < 4) return base;
  const int count = static_cast<int>(std::lround((range.inwards + range.outwards) / kStep)) + 1;
  std::vector<std::vector<double>> rewards;
  std::vector<Vector2d> normals;
  std::vector<double> peaks;
  for (std::size_t i = 0; i < base.size(); ++i) {
    const Vector2d along =
        (base[std::min(i + 2, base.size() - 1)] - base[i >= 2 ? i - 2 : 0]).normalized();
    const Vector2d left(along.y(), -along.x());
    normals.emplace_back(-inside * left);  // out of the blade
    rewards.push_back(TransitionStrengths(image, base[i], normals.back(), -range.inwards, count));
    peaks.push_back(*std::max_element(rewards.back().begin(), rewards.back().end()));
  }
  // A glint ten times as strong as the edge elsewhere is worth no more than the edge.
  const double full = std::max(1e-6, Quantile(peaks, 0.4));
  for (std::vector<double>& column : rewards) {
    for (double& reward : column) reward = std::min(1.0, reward / full);
  }
  const std::vector<int> offsets = BestSequence(rewards);
  std::vector<Vector2d> traced;
  for (std::size_t i = 0; i < base.size(); ++i) {
    traced.emplace_back(base[i] + (-range.inwards + offsets[i] * kStep) * normals[i]);
  }
  return Smooth(traced, 3);
}

}  // namespace bladecurve
