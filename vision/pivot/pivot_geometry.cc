// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/pivot_geometry.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "vision/image/cross.h"
#include "vision/pivot/edge_gap.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

struct Chord {
  Vector2d point, direction;
};

Vector2d MeanOf(const std::vector<Vector2d>& edge, double from_share, double to_share) {
  const auto count = static_cast<double>(edge.size());
  const auto first = static_cast<std::size_t>(from_share * count);
  const auto last = std::max(first + 1, static_cast<std::size_t>(to_share * count));
  Vector2d sum = Vector2d::Zero();
  for (std::size_t i = first; i < last; ++i) sum += edge[i];
  return sum / static_cast<double>(last - first);
}

// Clear of the crotch, where the other blade's edge may be followed for a while.
Chord ProximalChord(const std::vector<Vector2d>& edge) {
  const Vector2d from = MeanOf(edge, 0.05, 0.2), to = MeanOf(edge, 0.5, 0.65);
  return {from, (to - from).normalized()};
}

// Signed distances of the pivot from the two edges, continued, over the length of the blades;
// positive where an edge passes on the other blade's side of it.
struct Passing {
  double left = 0, right = 0;
};

Passing PassingBy(const EdgePair& edges, const Vector2d& pivot_px) {
  const Chord a = ProximalChord(edges.left_px);
  const Chord b = ProximalChord(edges.right_px);
  const double length =
      0.5 * ((edges.left_px.back() - pivot_px).norm() + (edges.right_px.back() - pivot_px).norm());
  const double per_length = 1 / std::max(1.0, length);
  return {-per_length * Cross(a.direction, pivot_px - a.point),
          per_length * Cross(b.direction, pivot_px - b.point)};
}

// About a line through the pivot, over the length of the blades.
EdgeAboutLine EdgeAbout(const std::vector<Vector2d>& edge,
                        const Vector2d& pivot_px,
                        const Vector2d& direction,
                        double side,
                        double length_px) {
  EdgeAboutLine about;
  for (const Vector2d& p : edge) {
    const Vector2d offset = (p - pivot_px) / length_px;
    const double along = offset.dot(direction);
    if (!about.along.empty() && along <= about.along.back()) continue;
    about.along.push_back(along);
    about.aside.push_back(side * Cross(direction, offset));
  }
  return about;
}

// About the line between the edges' ends, over the length of the blades.
EdgeGap GapAbout(const EdgePair& edges, const Vector2d& pivot_px) {
  const Vector2d left = edges.left_px.back() - pivot_px, right = edges.right_px.back() - pivot_px;
  const double length_px = std::max(1.0, 0.5 * (left.norm() + right.norm()));
  const Vector2d direction = (left.normalized() + right.normalized()).normalized();
  const double side = std::copysign(1.0, Cross(direction, left));
  return GapBetween(EdgeAbout(edges.left_px, pivot_px, direction, side, length_px),
                    EdgeAbout(edges.right_px, pivot_px, direction, -side, length_px));
}

// A gap as a polynomial, from the line's zero.
struct FittedGap {
  GapCourse course;
  double scatter = 0;
};

FittedGap FitAllOf(const EdgeGap& gap, Eigen::Index terms) {
  FittedGap fitted;
  fitted.course.Fit(gap, terms, [](std::size_t) { return true; });
  double squares = 0;
  for (std::size_t i = 0; i < gap.along.size(); ++i)
    squares += std::pow(gap.apart[i] - fitted.course.At(gap.along[i]), 2);
  fitted.scatter = std::sqrt(squares / static_cast<double>(gap.along.size()));
  return fitted;
}

// What is left of a normal distribution between two limits: its mean and standard deviation. Where
// next to nothing is left, the nearer limit, and how far off it was.
Estimate Truncated(const Estimate& normal, double low, double high) {
  constexpr double kNothing = 1e-4;
  const double a = (low - normal.value) / normal.sigma, b = (high - normal.value) / normal.sigma;
  const double mass = 0.5 * (std::erf(b / std::numbers::sqrt2) - std::erf(a / std::numbers::sqrt2));
  if (mass < kNothing) {
    const double nearest = std::clamp(normal.value, low, high);
    return {nearest, std::abs(nearest - normal.value)};
  }
  const auto density = [&](double z) {
    return std::exp(-0.5 * z * z) / (mass * std::sqrt(2 * std::numbers::pi));
  };
  const double shift = density(a) - density(b);
  const double narrowing = (std::isfinite(b) ? b * density(b) : 0) - a * density(a);
  return {normal.value + normal.sigma * shift,
          normal.sigma * std::sqrt(std::max(1 - narrowing - shift * shift, 0.0))};
}

// How far behind the edges' crossing the pivot lies if the edges overlap by the share k of the
// blades' length: d sine = k (length + d cosine), a little short of the length for d << length.
double BehindForOverlap(const EdgeMirror& mirror, double k) {
  const double per_length = mirror.sine - k * std::sqrt(1 - mirror.sine * mirror.sine);
  return per_length > 0 ? k * mirror.length_px / per_length
                        : std::numeric_limits<double>::infinity();
}

}  // namespace

EdgePair SeenFromAbove(const ScaleResult& scale, EdgePair edges, const Vector2d& about_px) {
  if (!scale.sheet || !scale.map) return edges;
  const Vector2d about_mm = scale.map->PlaneFromImage(about_px);
  const double px_per_mm = 1 / std::sqrt(std::abs(scale.map->JacobianAt(about_px).determinant()));
  for (std::vector<Vector2d>* edge : {&edges.left_px, &edges.right_px}) {
    for (Vector2d& p : *edge) {
      const Vector2d offset_mm = scale.map->PlaneFromImage(p) - about_mm;  // y up
      p = about_px + px_per_mm * Vector2d(offset_mm.x(), -offset_mm.y());
    }
  }
  return edges;
}

EdgeMirror MirrorOf(const EdgePair& edges) {
  constexpr double kParallel = 0.02;  // sine of the angle between the edges
  const Chord a = ProximalChord(edges.left_px);
  const Chord b = ProximalChord(edges.right_px);
  EdgeMirror mirror;
  mirror.direction = (a.direction + b.direction).normalized();
  const double sine = Cross(a.direction, b.direction);
  if (std::abs(sine) < kParallel) {
    mirror.point_px = 0.5 * (a.point + b.point);
  } else {
    mirror.point_px = a.point + Cross(b.point - a.point, b.direction) / sine * a.direction;
    mirror.sine = std::abs(Cross(a.direction, mirror.direction));
  }
  const Vector2d left = edges.left_px.back() - mirror.point_px;
  const Vector2d right = edges.right_px.back() - mirror.point_px;
  mirror.length_px =
      std::copysign(0.5 * (left.norm() + right.norm()), (left + right).dot(mirror.direction));
  return mirror;
}

double EdgeAsymmetry(const EdgePair& edges, const Vector2d& pivot_px) {
  const Passing by = PassingBy(edges, pivot_px);
  return by.left - by.right;
}

// Of the blades' length, as all that follow. Straight and curved scissors seen at a slant reach
// 0.1, bandage scissors 0.25 and more.
bool LieInNoPlane(double asymmetry) { return std::abs(asymmetry) > 0.2; }

// Rendered scissors differ by 0.007, photographed ones by up to 0.09, but there no other transition
// accounts for it.
bool AreSuspect(double asymmetry) { return std::abs(asymmetry) >= 0.010; }
bool AreFarUnlike(double asymmetry) { return std::abs(asymmetry) >= 0.025; }
bool AreUnlike(double asymmetry) { return std::abs(asymmetry) >= 0.018; }
bool AreAlike(double asymmetry) { return std::abs(asymmetry) <= 0.014; }

bool AreBentToOneSide(const EdgePair& edges, const Vector2d& pivot_px) {
  constexpr double kLeast = 0.006;                // of the length; less is how blades are made
  constexpr double kCloser = 1.0 / 3;             // of the scatter about a straight line
  constexpr double kSmooth = 0.0013;              // of the length, scatter about the parabola,
  constexpr double kSmoothOfBend = 1.0 / 7;       // or of the scatter about a straight line
  constexpr double kBehind = -0.05, kHeel = 0.3;  // of the length, from the pivot
  constexpr std::size_t kFewestAbreast = 60;      // points; fewer show no bend
  if (edges.traced) return false;
  const EdgeGap gap = GapAbout(edges, pivot_px);
  if (gap.along.size() < kFewestAbreast) return false;
  const FittedGap straight = FitAllOf(gap, 2), bent = FitAllOf(gap, 3);
  const double square = bent.course.powers[2];
  const double most_scatter =
      std::min(kCloser * straight.scatter, std::max(kSmooth, kSmoothOfBend * straight.scatter));
  if (std::abs(square) < kLeast || bent.scatter > most_scatter) return false;
  // By the line's choice the edges are alike at the ends, the other root is where the bend begins.
  const double begins = bent.course.powers[0] / square;
  return begins > kBehind && begins < kHeel;
}

double EdgeUnlikeness(const EdgePair& edges, const Vector2d& pivot_px) {
  constexpr std::size_t kFewestAbreast = 20;  // points; fewer show no shape
  const EdgeGap gap = GapAbout(edges, pivot_px);
  if (gap.along.size() < kFewestAbreast) return std::numeric_limits<double>::quiet_NaN();
  return FitAllOf(gap, 2).scatter;
}

double EdgeOverlap(const EdgePair& edges, const Vector2d& pivot_px) {
  const Passing by = PassingBy(edges, pivot_px);
  return 0.5 * (by.left + by.right);
}

Estimate BehindByWaist(const Scene& scene, const EdgeMirror& mirror) {
  // Over rendered scissors without a visible screw the waist errs by that much more than it seems;
  // where the silhouette is in doubt, by half the blades' length.
  constexpr double kWaistErrs = 1.3, kDoubt = 0.5;
  const double behind = (mirror.point_px - scene.pivot_px).dot(mirror.direction);
  const double length = std::max(mirror.length_px + behind, 0.0);
  return {behind,
          std::hypot(kWaistErrs * scene.pivot_sigma_px, kDoubt * (1 - scene.quality) * length)};
}

Estimate BehindByGeometry(const Scene& scene, const EdgeMirror& mirror) {
  constexpr double kMostOverlap = 0.14;
  constexpr double kContradicted = 0.5;  // of what the limits move it by: an edge may be wrong
  const Estimate waist = BehindByWaist(scene, mirror);
  const double nearest = BehindForOverlap(mirror, kUsualOverlap);
  if (mirror.length_px <= 0 || !std::isfinite(nearest)) return waist;
  const Estimate held = Truncated(waist, nearest, BehindForOverlap(mirror, kMostOverlap));
  return {held.value, std::hypot(held.sigma, kContradicted * (held.value - waist.value))};
}

}  // namespace bladecurve
