// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/clean_edge.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "curvefit/linear_spline.h"
#include "curvefit/statistics.h"

namespace bladecurve {
namespace {

constexpr double kRejectSigmas = 4;     // 6 in 100000 good points are lost
constexpr double kTukeySigmas = 4.685;  // 95 % efficient for Gaussian noise
constexpr int kMaxCleanSpans =
    12;  // of the flexible spline: a wave of a twelfth of the blade is still shape
constexpr int kSamplesPerSpan = 10;
constexpr double kStiffness = 1e-6;  // bridges a nick without bending the rest
constexpr int kTrials =
    400;  // finds 4 good points of 4 among 60 % bad ones with probability 0.9999
constexpr int kScoredPoints = 400;
constexpr double kSupport = 0.35;  // this part of the points at least is the edge
constexpr double kMedianOfHalfNormal = 0.6745;
constexpr double kHardlyMoved = 1.5;  // a scatter below this many sigmas shows no crowd of outliers

// A point's place in the edge, its weight without the correlation, and how far it is off.
struct Cleaning {
  std::vector<FlatPoint> points;  // in the edge's own order, weight: 1/sigma of a point by itself
  SplineSpace space;
  std::vector<double> sigmas;  // of each point off the current curve
};

double MedianSize(std::vector<double> values) {
  for (double& v : values) v = std::abs(v);
  return Quantile(std::move(values), 0.5);
}

double OffCurve(const FlatPoint& point, const LinearSpline& fit) {
  const BasisRow basis = EvalBasis(fit.space, point.u);
  double above = point.v;
  for (int j = 0; j <= fit.space.degree; ++j) {
    above -= basis.value[j] * fit.coefficients(basis.first + j);
  }
  return point.weight * above;
}

void Refit(const std::vector<double>& trust, Cleaning& c) {
  std::vector<FlatPoint> weighted = c.points;
  for (size_t i = 0; i < weighted.size(); ++i) weighted[i].weight *= trust[i];
  const LinearSpline fit = FitLinearSpline(weighted, c.space, kStiffness);
  for (size_t i = 0; i < weighted.size(); ++i) {
    c.sigmas[i] = trust[i] > 0 ? fit.residuals[i] / trust[i] : OffCurve(c.points[i], fit);
  }
}

// The polynomial through the points picked, in powers of u - centre.
Eigen::Vector4d Through(const std::array<FlatPoint, 4>& picked, int degree, double centre) {
  Eigen::Matrix4d powers = Eigen::Matrix4d::Identity();
  Eigen::Vector4d values = Eigen::Vector4d::Zero();
  for (int i = 0; i <= degree; ++i) {
    for (int j = 0; j <= degree; ++j) powers(i, j) = std::pow(picked[i].u - centre, j);
    values(i) = picked[i].v;
  }
  return powers.partialPivLu().solve(values);
}

double PolynomialAt(const Eigen::Vector4d& p, double t) {
  return p(0) + t * (p(1) + t * (p(2) + t * p(3)));
}

// The cubic that the best-fitting third of the points agrees on: least quantile of squares
// (Rousseeuw 1984) over points picked one from each quarter of the edge.
Eigen::Vector4d BestSupported(const std::vector<FlatPoint>& points, double centre) {
  std::mt19937 random(20080531);  // any fixed seed: the same input gives the same curve
  const size_t n = points.size();
  const int degree = n < 12 ? 1 : 3;  // a cubic through 4 of fewer points explains anything
  const size_t step = std::max<size_t>(1, n / kScoredPoints);
  Eigen::Vector4d best = Eigen::Vector4d::Zero();
  double best_score = std::numeric_limits<double>::infinity();
  std::vector<double> sizes;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::array<FlatPoint, 4> picked;
    for (int q = 0; q <= degree; ++q) {
      const size_t begin = q * n / (degree + 1), end = (q + 1) * n / (degree + 1);
      picked[q] = points[begin + random() % (end - begin)];
    }
    const Eigen::Vector4d p = Through(picked, degree, centre);
    sizes.clear();
    for (size_t i = 0; i < n; i += step) {
      sizes.push_back(points[i].weight *
                      std::abs(points[i].v - PolynomialAt(p, points[i].u - centre)));
    }
    const double score = Quantile(sizes, kSupport);
    if (score < best_score) best_score = score, best = p;
  }
  return best;
}

// Scatter of the points that belong to the edge, in units of sigma; starts wide and closes in.
double InlierScale(const std::vector<double>& sigmas, double scale) {
  std::vector<double> inside;
  for (const double s : sigmas) {
    if (std::abs(s) < kTukeySigmas * scale) inside.push_back(s);
  }
  if (inside.empty()) return scale;
  return std::max(1.0, MedianSize(inside) / kMedianOfHalfNormal);
}

// Where a few points only are off, the plain fit is a good start; otherwise the curve that the
// largest minority supports. Returns the scatter.
double StartRobustly(double scale, Cleaning& c) {
  constexpr double kFew = 0.05;
  const auto off = std::count_if(c.sigmas.begin(), c.sigmas.end(), [&](double s) {
    return std::abs(s) > kRejectSigmas * scale;
  });
  if (static_cast<double>(off) < kFew * static_cast<double>(c.sigmas.size()) &&
      scale < kHardlyMoved) {
    return scale;
  }
  const double centre = c.points[c.points.size() / 2].u;
  const Eigen::Vector4d start = BestSupported(c.points, centre);
  for (size_t i = 0; i < c.points.size(); ++i) {
    c.sigmas[i] =
        c.points[i].weight * (c.points[i].v - PolynomialAt(start, c.points[i].u - centre));
  }
  std::vector<double> sizes = c.sigmas;
  for (double& s : sizes) s = std::abs(s);
  return std::max(1.0, Quantile(std::move(sizes), kSupport));
}

// Tukey's biweight by reweighting, until the scatter no longer changes. Returns the scatter.
double FitRobustly(double scale, Cleaning& c) {
  scale = StartRobustly(scale, c);
  constexpr int kRounds = 12;
  std::vector<double> trust(c.points.size());
  for (int round = 0; round < kRounds; ++round) {
    const double last = scale;
    scale = InlierScale(c.sigmas, scale);
    constexpr double kSettled = 0.01;
    constexpr int kFewest = 3;
    if (round >= kFewest && std::abs(scale - last) < kSettled * last) break;
    for (size_t i = 0; i < trust.size(); ++i) {
      const double t = c.sigmas[i] / (kTukeySigmas * scale);
      trust[i] = std::abs(t) < 1 ? 1 - t * t : 0;
    }
    Refit(trust, c);
  }
  return InlierScale(c.sigmas, scale);
}

// Scatter of the edge's own points; `c` then holds the curve through them. A robust curve is
// believed where it lies much closer to its points than the plain one: then there are outliers, not
// sigmas that were stated too small.
double CleanScatter(Cleaning& c) {
  const double plain = std::max(1.0, MedianSize(c.sigmas) / kMedianOfHalfNormal);
  const auto beyond = [&](double s) { return std::abs(s) > kRejectSigmas * plain; };
  const bool tails = std::any_of(c.sigmas.begin(), c.sigmas.end(), beyond);
  if (!tails && plain < kHardlyMoved) return plain;
  Cleaning robust = c;
  const double scatter = FitRobustly(plain, robust);
  constexpr double kMuchCloser = 0.7;
  if (plain >= kHardlyMoved && scatter > kMuchCloser * plain) return plain;
  constexpr double kLeastKept = 0.3;  // fewer points are no edge, however well they agree
  const auto kept = std::count_if(robust.sigmas.begin(), robust.sigmas.end(), [&](double s) {
    return std::abs(s) <= kRejectSigmas * scatter;
  });
  if (static_cast<double>(kept) < kLeastKept * static_cast<double>(c.sigmas.size())) return plain;
  c = std::move(robust);
  return scatter;
}

Cleaning StartCleaning(const EdgeSamples& edge, const Pose& pose, bool is_upper) {
  Cleaning c;
  const BladeFrame frame(pose, is_upper);
  for (int i = 0; i < edge.size(); ++i) {
    const Eigen::Vector2d p = frame(edge.points[i]);
    c.points.push_back({p.x(), p.y(), edge.weights[i] * edge.inflation});
  }
  std::vector<FlatPoint> sorted = c.points;
  SortAlong(sorted);
  const int spans =
      std::clamp(static_cast<int>(edge.effective() / kSamplesPerSpan), 1, kMaxCleanSpans);
  const int degree = std::clamp(static_cast<int>(edge.effective() / 2) - 1, 1, 3);
  c.space = ClampedSpace(degree,
                         sorted.front().u,
                         std::max(sorted.back().u, std::nextafter(sorted.front().u, 1e300)),
                         QuantileKnots(sorted, spans));
  c.sigmas.resize(c.points.size());
  Refit(std::vector<double>(c.points.size(), 1.0), c);
  return c;
}

// Keeps the points within the bound, lists the others.
CleanReport Reject(double bound, const Cleaning& c, EdgeSamples& edge, std::vector<double>& kept) {
  CleanReport report;
  EdgeSamples good;
  good.inflation = edge.inflation;
  for (int i = 0; i < edge.size(); ++i) {
    if (std::abs(c.sigmas[i]) > bound) {
      report.rejected.push_back({edge.indices[i], c.sigmas[i]});
      continue;
    }
    good.points.push_back(edge.points[i]);
    good.weights.push_back(edge.weights[i]);
    good.indices.push_back(edge.indices[i]);
    kept.push_back(c.sigmas[i]);
  }
  edge = std::move(good);
  return report;
}

// Larger sigmas where the scatter or the correlation of neighbours is beyond doubt larger than was
// said.
void Widen(const Cleaning& c,
           const std::vector<double>& kept,
           EdgeSamples& edge,
           CleanReport& report) {
  const double freedom = edge.effective() - c.space.size();
  if (freedom < 1) return;
  double chi2 = 0;
  for (const double s : kept) chi2 += s * s;
  chi2 /= edge.inflation * edge.inflation;
  if (chi2 > ChiSquareQuantile(freedom, 0.999)) report.sigma_scale = std::sqrt(chi2 / freedom);
  const double said = edge.inflation * edge.inflation;
  // Scatter smaller than stated makes up for correlation: the sigma of a mean is what counts.
  const double seen = CorrelatedNeighbours(kept) * std::min(1.0, chi2 / freedom);
  // The estimate scatters by about 3 / sqrt(samples); a quarter of percent of good edges exceed
  // this.
  const double beyond_doubt = 1 + 8 / std::sqrt(edge.effective());
  const double more = seen > beyond_doubt * said ? std::sqrt(seen / said) : 1;
  edge.inflation *= more;
  report.correlation_points = edge.inflation * edge.inflation;
  for (double& w : edge.weights) w /= more * report.sigma_scale;
}

}  // namespace

CleanReport CleanEdge(EdgeSamples& edge, const Pose& pose, bool is_upper, bool reject) {
  if (edge.size() < 3) return {};
  Cleaning c = StartCleaning(edge, pose, is_upper);
  constexpr size_t kFewest = 6;  // with fewer points a majority means nothing
  double bound = std::numeric_limits<double>::infinity();
  if (reject && c.points.size() >= kFewest) bound = kRejectSigmas * CleanScatter(c);
  std::vector<double> kept;
  CleanReport report = Reject(bound, c, edge, kept);
  Widen(c, kept, edge, report);
  return report;
}

}  // namespace bladecurve
