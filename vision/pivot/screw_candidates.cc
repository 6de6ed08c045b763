// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace bladecurve {
namespace {

// Of neighbouring circles, of the least radius: on the rim hardly more than the blur of the field.
constexpr double kApartPx = 0.7;
constexpr float kLeastScore = 0.4F;   // below: what any textured ground reaches by chance
constexpr std::size_t kPeaks = 100;   // circles to be asked for straight edges
constexpr std::size_t kClimbed = 15;  // circles to be bent into ellipses
constexpr std::size_t kKept = 12;     // ellipses to be looked at closely
constexpr double kSamePx = 0.7;  // closer in centre and radius than this: the same rim found twice
// |ln(a/b)|/2: beyond 38 degrees of tilt it is half a head cut off by its slot.
constexpr double kMostElongation = 0.12;
constexpr int kMostRoundsPerStep = 3;

// Scores of one radius over all centres.
struct Layer {
  double radius = 0;
  cv::Mat score;
};

std::vector<Layer> ScoreAllCircles(const RimField& field,
                                   const cv::Rect& centers,
                                   double least_radius) {
  std::vector<double> radii;
  for (double r = least_radius; r < 2.05 * least_radius; r *= 1 + kApartPx / least_radius)
    radii.push_back(r);
  const std::vector<cv::Mat> scores = field.ScoreCircles(centers, radii);
  std::vector<Layer> layers;
  for (std::size_t i = 0; i < radii.size(); ++i) layers.push_back({radii[i], scores[i]});
  return layers;
}

// No neighbour in place or radius scores more than it, which beats those in its row.
bool IsPeak(const std::vector<Layer>& layers, std::size_t index, int x, int y) {
  const float value = layers[index].score.at<float>(y, x);
  const std::size_t first = index == 0 ? 0 : index - 1;
  const std::size_t last = std::min(index + 1, layers.size() - 1);
  for (std::size_t layer = first; layer <= last; ++layer) {
    for (int dy = -1; dy <= 1; ++dy) {
      const float* row = layers[layer].score.ptr<float>(y + dy);
      if (row[x - 1] > value || row[x] > value || row[x + 1] > value) return false;
    }
  }
  return true;
}

std::vector<RimCandidate> CirclePeaks(const std::vector<Layer>& layers,
                                      const cv::Rect& centers,
                                      const OctaveSearch& search) {
  std::vector<RimCandidate> peaks;
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    for (int y = 1; y + 1 < centers.height; ++y) {
      const float* row = layers[layer].score.ptr<float>(y);
      for (int x = 1; x + 1 < centers.width; ++x) {
        if (row[x] < kLeastScore || row[x] < row[x - 1] || row[x] < row[x + 1]) continue;
        if (!IsPeak(layers, layer, x, y)) continue;
        const Eigen::Vector2d center(centers.x + x, centers.y + y);
        if ((center - search.guess).norm() > search.range + 1) continue;
        peaks.push_back({RimEllipse::Circle(center, layers[layer].radius), row[x]});
      }
    }
  }
  return peaks;
}

void KeepBest(std::vector<RimCandidate>& candidates, std::size_t count) {
  std::stable_sort(candidates.begin(),
                   candidates.end(),
                   [](const RimCandidate& a, const RimCandidate& b) { return a.score > b.score; });
  if (candidates.size() > count) candidates.resize(count);
}

// Centre, ln radius and the two components of elongation: numbers that may be changed one by one.
using RimParameters = std::array<double, 5>;

RimEllipse RimFrom(const RimParameters& p) {
  const double radius = std::exp(p[2]);
  RimEllipse rim = RimEllipse::Circle({p[0], p[1]}, radius);
  rim.shape << radius * std::exp(p[3]), radius * p[4], radius * p[4], radius * std::exp(-p[3]);
  return rim;
}

bool Admissible(const RimParameters& p, double least_radius) {
  return std::hypot(p[3], p[4]) <= kMostElongation && p[2] > std::log(0.95 * least_radius) &&
         p[2] < std::log(2.1 * least_radius);
}

// Climbs to the ellipse of highest score, one parameter at a time with steps of 1, 1/2 and 1/4 px
// on the rim: the score has kinks and plateaus on which a gradient would stall.
RimCandidate Climb(const RimField& field, const RimCandidate& start, double least_radius) {
  const double radius = start.rim.MeanRadius();
  RimParameters best{start.rim.center.x(), start.rim.center.y(), std::log(radius), 0, 0};
  double best_score = field.Score(start.rim);
  for (const double step : {1.0, 0.5}) {
    bool improved = true;
    for (int round = 0; improved && round < kMostRoundsPerStep; ++round) {
      improved = false;
      for (std::size_t k = 0; k < best.size(); ++k) {
        for (const double sign : {-1.0, 1.0}) {
          RimParameters trial = best;
          trial[k] += sign * step / (k < 2 ? 1 : radius);
          if (!Admissible(trial, least_radius)) continue;
          const double score = field.Score(RimFrom(trial));
          if (score <= best_score) continue;
          best_score = score;
          best = trial;
          improved = true;
        }
      }
    }
  }
  return {RimFrom(best), best_score};
}

std::vector<RimCandidate> WithoutRepeats(const std::vector<RimCandidate>& candidates) {
  std::vector<RimCandidate> kept;
  for (const RimCandidate& candidate : candidates) {
    const bool repeat = std::any_of(kept.begin(), kept.end(), [&](const RimCandidate& other) {
      return (other.rim.center - candidate.rim.center).norm() < kSamePx &&
             std::abs(other.rim.MeanRadius() - candidate.rim.MeanRadius()) < kSamePx;
    });
    if (!repeat) kept.push_back(candidate);
  }
  return kept;
}

}  // namespace

std::vector<RimCandidate> FindRimCandidates(const RimField& field, const OctaveSearch& search) {
  constexpr double kNeighbours = 2.5;  // px, of what lies within range and a pixel
  const int reach = static_cast<int>(std::ceil(search.range + kNeighbours));
  const cv::Rect centers(static_cast<int>(std::lround(search.guess.x())) - reach,
                         static_cast<int>(std::lround(search.guess.y())) - reach,
                         2 * reach + 1,
                         2 * reach + 1);
  std::vector<RimCandidate> candidates =
      CirclePeaks(ScoreAllCircles(field, centers, search.least_radius), centers, search);
  KeepBest(candidates, kPeaks);
  for (RimCandidate& candidate : candidates) {
    candidate.score = field.ScoreWithoutTangents(candidate.rim);
  }
  KeepBest(candidates, kClimbed);
  std::vector<RimCandidate> climbed;
  for (const RimCandidate& candidate : candidates) {
    climbed.push_back(Climb(field, candidate, search.least_radius));
    climbed.back().score = field.ScoreWithoutTangents(climbed.back().rim);
    // It may have left a rim for the straight edges of a shank.
    if (climbed.back().score < candidate.score) climbed.push_back(candidate);
  }
  candidates = std::move(climbed);
  KeepBest(candidates, kClimbed);
  candidates = WithoutRepeats(candidates);
  KeepBest(candidates, kKept);
  return candidates;
}

}  // namespace bladecurve
