// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/choose_knots.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bladecurve {
namespace {

constexpr int kMaxSpans = 24;
constexpr double kPointsPerCoefficient =
    3;                        // fewer independent points a coefficient follow the noise
constexpr int kPatience = 3;  // a wave needs several knots before it shows

double Bic(const LinearSpline& fit, double effective_points) {
  return fit.chi2 + fit.space.size() * std::log(std::max(effective_points, 2.0));
}

// The search: what is asked, what was tried, the best so far.
struct Search {
  const std::vector<FlatPoint>& points;
  const KnotRequest& request;
  std::vector<KnotCandidate> tried;

  SplineSpace Space(int degree, const std::vector<double>& interior) const {
    return ClampedSpace(degree, request.lower, request.upper, interior);
  }
  LinearSpline Try(const SplineSpace& space) {
    LinearSpline fit = FitLinearSpline(points, space);
    const int spans = space.size() - space.degree;
    tried.push_back({space.degree, spans, fit.chi2, Bic(fit, request.effective_points)});
    return fit;
  }
};

// chi2 of every span, over the points in it.
std::vector<double> SpanChi2(const std::vector<FlatPoint>& points,
                             const LinearSpline& fit,
                             const std::vector<double>& breaks) {
  std::vector<double> chi2(breaks.size() - 1, 0.0);
  size_t span = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    while (span + 2 < breaks.size() && points[i].u >= breaks[span + 1]) ++span;
    chi2[span] += fit.residuals[i] * fit.residuals[i];
  }
  return chi2;
}

std::vector<double> Breaks(const SplineSpace& space) {
  std::vector<double> breaks = InteriorKnots(space);
  breaks.insert(breaks.begin(), space.lower());
  breaks.push_back(space.upper());
  return breaks;
}

// Schoenberg-Whitney, and points in every span: without them coefficients are determined, but by
// rounding.
bool Supported(const std::vector<FlatPoint>& points, const SplineSpace& space) {
  constexpr std::ptrdiff_t kFewestInSpan = 3;
  const std::vector<double> breaks = Breaks(space);
  auto begin = points.begin();
  for (size_t i = 1; i < breaks.size(); ++i) {
    const auto end =
        i + 1 == breaks.size()
            ? points.end()
            : std::lower_bound(begin, points.end(), breaks[i], [](const FlatPoint& p, double u) {
                return p.u < u;
              });
    if (end - begin < kFewestInSpan) return false;
    begin = end;
  }
  return SchoenbergWhitney(points, space);
}

// One knot more, in the span with the largest chi2 in which one has room: the best of three places.
std::optional<LinearSpline> AddKnot(const LinearSpline& fit, Search& search) {
  const std::vector<double> breaks = Breaks(fit.space);
  const std::vector<double> chi2 = SpanChi2(search.points, fit, breaks);
  std::vector<size_t> order(chi2.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(
      order.begin(), order.end(), [&](size_t a, size_t b) { return chi2[a] > chi2[b]; });
  for (const size_t span : order) {
    std::optional<LinearSpline> best;
    for (const double part : {0.25, 0.5, 0.75}) {
      std::vector<double> interior = InteriorKnots(fit.space);
      interior.push_back(breaks[span] + part * (breaks[span + 1] - breaks[span]));
      std::sort(interior.begin(), interior.end());
      const SplineSpace space = search.Space(fit.space.degree, interior);
      if (!Supported(search.points, space)) continue;
      LinearSpline candidate = search.Try(space);
      if (!best || candidate.chi2 < best->chi2) best = std::move(candidate);
    }
    if (best) return best;
  }
  return std::nullopt;
}

int MostSpans(const KnotRequest& request, int degree) {
  const auto supported = static_cast<int>(request.effective_points / kPointsPerCoefficient);
  return std::clamp(supported - degree, 1, kMaxSpans);
}

// Whether noise alone explains the residuals: chi2 not above its mean by more than its standard
// deviation. What a knot would then still gain are small biases that neighbouring points share, and
// a curve that follows them swings beyond the last point.
bool Explained(const LinearSpline& fit, double effective_points) {
  const double freedom = std::max(effective_points - fit.space.size(), 1.0);
  return fit.chi2 < freedom + std::sqrt(2 * freedom);
}

// Knots one by one; the best by the criterion, or exactly `spans` pieces if that many are asked
// for.
LinearSpline Grow(LinearSpline fit, Search& search) {
  const KnotRequest& request = search.request;
  const int most = request.num_spans.value_or(MostSpans(request, fit.space.degree));
  LinearSpline best = fit;
  int without_gain = 0;
  for (int spans = 2; spans <= most && without_gain < kPatience; ++spans) {
    std::optional<LinearSpline> next = AddKnot(fit, search);
    if (!next) break;
    fit = std::move(*next);
    const bool better = Bic(fit, request.effective_points) < Bic(best, request.effective_points);
    if (better || request.num_spans) best = fit;
    without_gain = better || request.num_spans ? 0 : without_gain + 1;
  }
  return best;
}

// Knots that later ones made superfluous.
LinearSpline Prune(LinearSpline fit, Search& search) {
  const double n = search.request.effective_points;
  for (bool removed = true; removed;) {
    removed = false;
    const std::vector<double> interior = InteriorKnots(fit.space);
    for (size_t k = 0; k < interior.size() && !removed; ++k) {
      std::vector<double> fewer = interior;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
      LinearSpline candidate = search.Try(search.Space(fit.space.degree, fewer));
      removed = Bic(candidate, n) < Bic(fit, n);
      if (removed) fit = std::move(candidate);
    }
  }
  return fit;
}

// The degree asked for, or the highest below it that the points support.
int SupportedDegree(int degree, const Search& search) {
  while (degree > 1 && !SchoenbergWhitney(search.points, search.Space(degree, {}))) --degree;
  return degree;
}

LinearSpline Chosen(Search& search) {
  const KnotRequest& request = search.request;
  const int degree = SupportedDegree(request.degree.value_or(3), search);
  if (request.interior) return search.Try(search.Space(degree, *request.interior));
  if (request.degree || request.num_spans) {
    LinearSpline grown = Grow(search.Try(search.Space(degree, {})), search);
    return request.num_spans ? grown : Prune(std::move(grown), search);
  }
  LinearSpline best = search.Try(search.Space(1, {}));
  LinearSpline last = best;
  for (int higher = 2; higher <= degree; ++higher) {
    const SplineSpace space = search.Space(higher, {});
    if (!SchoenbergWhitney(search.points, space)) return best;
    last = search.Try(space);
    if (Bic(last, request.effective_points) < Bic(best, request.effective_points)) best = last;
  }
  const double n = request.effective_points;
  if (Explained(best, n)) return best;
  LinearSpline grown = Prune(Grow(std::move(last), search), search);
  return Bic(grown, n) < Bic(best, n) ? grown : best;
}

// The edge's slope as far as a plain cubic knows it, for the shift of photographs along u.
std::vector<FlatPoint> WithSlopes(std::vector<FlatPoint> points, const KnotRequest& request) {
  const int degree = points.size() < 8 ? 1 : 3;
  const LinearSpline fit =
      FitLinearSpline(points, ClampedSpace(degree, request.lower, request.upper, {}));
  for (FlatPoint& point : points) {
    const BasisRow row = EvalBasis(fit.space, point.u);
    point.slope = 0;
    for (int j = 0; j <= degree; ++j) point.slope += row.slope[j] * fit.coefficients(row.first + j);
  }
  return points;
}

}  // namespace

bool SchoenbergWhitney(const std::vector<FlatPoint>& points, const SplineSpace& space) {
  // Greedy matching: the leftmost point inside each support, every point used once. It succeeds if
  // any does.
  size_t next = 0;
  for (int j = 0; j < space.size(); ++j) {
    const double begin = space.knots[j], end = space.knots[j + space.degree + 1];
    const bool at_start = j == 0, at_end = j == space.size() - 1;
    const auto inside = [&](double u) { return (u > begin || at_start) && (u < end || at_end); };
    while (next < points.size() && !inside(points[next].u) && points[next].u < end) ++next;
    if (next == points.size() || !inside(points[next].u)) return false;
    const double used = points[next].u;
    while (next < points.size() && points[next].u <= used) ++next;
  }
  return true;
}

KnotChoice ChooseKnots(const std::vector<FlatPoint>& points, const KnotRequest& request) {
  const std::vector<FlatPoint> sloped = WithSlopes(points, request);
  Search search{sloped, request, {}};
  KnotChoice choice{Chosen(search), {}, false};
  choice.tried = std::move(search.tried);
  const SplineSpace& space = choice.spline.space;
  choice.limited_by_data = request.num_spans && space.size() - space.degree < *request.num_spans;
  return choice;
}

}  // namespace bladecurve
