/* SPDX-FileCopyrightText: 2026 The bladecurve authors
 * SPDX-License-Identifier: MIT
 *
 * The edge turned by theta/2, x = u cos - s sin, y = u sin + s cos, and its point over an x.
 * C99 and C++.
 */
#ifndef BLADECURVE_KERNEL_TURN_H
#define BLADECURVE_KERNEL_TURN_H

#include <math.h>

#include "model/blade_plugin.h"
#include "model/kernel_polynomial.h"
#include "model/kernel_spline.h"

/* dx/du of the turned edge below this counts as standing upright (steeper than about 89.9 deg). */
static const double kLeastAdvance = 1e-3;

/* The turn of the blade by theta/2, and the part of the edge that is then a graph over x:
 * dx/du >= least between u_low and u_high. */
typedef struct EdgeTurn {
  double cosine, sine;
  double norm, norm_cosine, norm_sine; /* the same times norm, known before a division is done */
  double least, u_low, u_high;
  int is_whole; /* the whole edge is a graph */
} EdgeTurn;

/* tan(theta/4) as a fraction, |theta| <= pi. Minimax of tan(q)/q in q^2, relative error 2e-17, by
 * the Remez algorithm. The C library's functions would differ in the last bit from one system to
 * the next, and take longer than all the rest of a tapered rectangle. */
typedef struct QuarterTangent {
  double num, den;
} QuarterTangent;

BLADECURVE_HOT QuarterTangent QuarterTangentOf(double theta) {
  const double q = 0.25 * theta, z = q * q;
  QuarterTangent tangent;
  tangent.num = q * ((1.0 - 0.12828350168243329619 * z) +
                     z * z * (0.0028059217245041402614 - 7.4836686415908291604e-6 * z));
  tangent.den = (1.0 - 0.46161683501576378859 * z) +
                z * z * (0.023344866729689041094 - 0.00020844854405326998535 * z);
  return tangent;
}

/* How far dx/du is below kLeastAdvance on a row, as a polynomial in u - centre. */
static inline void SteepnessOfRow(const BladeKernel* k, int row, const EdgeTurn* turn, double* c) {
  const double* s = RowOf(k, row) + 1;
  int i;
  for (i = 0; i < kMaxDegree; ++i) c[i] = turn->sine * (i + 1) * s[i + 1];
  c[0] += kLeastAdvance - turn->cosine;
}

/* From u outwards, direction -1 or 1: the first u at which the edge is too steep. */
static inline double GraphEnd(const BladeKernel* k, const EdgeTurn* turn, double u, int direction) {
  int row = RowAt(k, u);
  for (; row >= 0 && row < k->num_rows; row += direction) {
    const double centre = RowOf(k, row)[0];
    const double low = (direction > 0 && u > k->ends[row] ? u : k->ends[row]) - centre;
    const double high = (direction < 0 && u < k->ends[row + 1] ? u : k->ends[row + 1]) - centre;
    double steepness[kMaxDegree], roots[kMaxDegree], noise;
    int n;
    SteepnessOfRow(k, row, turn, steepness);
    if (Polynomial(steepness, k->degree - 1, direction > 0 ? low : high, &noise) > noise)
      return centre + (direction > 0 ? low : high);
    n = PolynomialRoots(steepness, k->degree - 1, low, high, roots);
    if (n > 0) return centre + (direction > 0 ? roots[0] : roots[n - 1]);
  }
  return direction * kFarthest;
}

/* Where the turned edge is a graph: the part around its flattest place. */
BLADECURVE_COLD void FindGraph(const BladeKernel* k, EdgeTurn* turn) {
  const double u = turn->sine > 0.0 ? k->u_slope_min : k->u_slope_max;
  turn->least = kLeastAdvance;
  turn->u_low = GraphEnd(k, turn, u, -1);
  turn->u_high = GraphEnd(k, turn, u, 1);
}

BLADECURVE_HOT EdgeTurn TurnBy(const BladeKernel* k, double theta) {
  const QuarterTangent q = QuarterTangentOf(theta);
  EdgeTurn turn;
  double per_norm;
  turn.norm = q.den * q.den + q.num * q.num;
  turn.norm_cosine = q.den * q.den - q.num * q.num;
  turn.norm_sine = 2.0 * q.num * q.den;
  per_norm = 1.0 / turn.norm;
  turn.cosine = turn.norm_cosine * per_norm;
  turn.sine = turn.norm_sine * per_norm;
  turn.least = turn.cosine - turn.sine * (turn.sine > 0.0 ? k->slope_max : k->slope_min);
  turn.u_low = -kFarthest;
  turn.u_high = kFarthest;
  turn.is_whole = turn.least >= kLeastAdvance;
  if (!turn.is_whole) FindGraph(k, &turn);
  return turn;
}

BLADECURVE_HOT double XOfPoint(const EdgeTurn* turn, SplinePoint p) {
  return p.u * turn->cosine - p.s * turn->sine;
}

/* Whether Taylor's series reaches x from here: near it, on the same row. */
BLADECURVE_HOT int IsNear(const BladeKernel* k, const EdgeTurn* turn, SplinePoint p, double x) {
  const double inner = k->near_mm;
  const int is_inner = p.u - inner >= k->ends[p.row] && p.u + inner <= k->ends[p.row + 1];
  return fabs(XOfPoint(turn, p) - x) <= (is_inner ? inner * turn->least : k->exact_mm);
}

/* The step along u to where the edge is over x, by reversion of Taylor's series; Newton's where
 * that is of no use. */
BLADECURVE_HOT double StepTowards(const EdgeTurn* turn, SplinePoint p, double x) {
  const double per = 1.0 / (turn->cosine - p.s1 * turn->sine);
  const double step = (x - XOfPoint(turn, p)) * per;
  const double bend = p.s2 * (turn->sine * per) * step;
  const double twist = p.s3 * (turn->sine * per) * (step * step);
  if (fabs(bend) + fabs(twist) > 0.1) return step;
  return step * ((1.0 + bend) + (2.0 * bend * bend + twist));
}

/* A point of the edge near x, for an x between those of u_low and u_high, from any start: Newton's
 * steps, halving the bracket where they leave it or do not shrink. */
BLADECURVE_COLD SplinePoint SearchPointNear(const BladeKernel* k,
                                            const EdgeTurn* turn,
                                            double x,
                                            double start) {
  SplinePoint p = PointAt(k, Clamp(start, turn->u_low, turn->u_high));
  const double reach = fabs(XOfPoint(turn, p) - x) / turn->least;
  double low = p.u - reach > turn->u_low ? p.u - reach : turn->u_low;
  double high = p.u + reach < turn->u_high ? p.u + reach : turn->u_high;
  double last_step = high - low;
  int i;
  for (i = 0; i < 200 && !IsNear(k, turn, p, x); ++i) {
    const double miss = XOfPoint(turn, p) - x;
    const double step = -miss / (turn->cosine - p.s1 * turn->sine);
    double next = p.u + step;
    if (miss > 0.0)
      high = p.u;
    else
      low = p.u;
    if (!(next > low && next < high) || fabs(step) > 0.5 * last_step) next = 0.5 * (low + high);
    if (next == p.u || next == low || next == high) break;
    last_step = fabs(next - p.u);
    p = PointAt(k, next);
  }
  return p;
}

/* How far back over the graph the rest of the spline hangs, beyond u in direction -1 or 1: the x
 * of its farthest fold or end. */
static double OverhangBeyond(const BladeKernel* k, const EdgeTurn* turn, double u, int direction) {
  double farthest = direction * kFarthest;
  int row, i;
  for (row = 1; row < k->num_rows - 1; ++row) {
    const double centre = RowOf(k, row)[0];
    double steepness[kMaxDegree], folds[kMaxDegree + 2];
    int n;
    SteepnessOfRow(k, row, turn, steepness);
    n = PolynomialRoots(
        steepness, k->degree - 1, k->ends[row] - centre, k->ends[row + 1] - centre, folds);
    folds[n++] = k->ends[row] - centre;
    folds[n++] = k->ends[row + 1] - centre;
    for (i = 0; i < n; ++i) {
      const double x = XOfPoint(turn, PointAt(k, centre + folds[i]));
      if (direction * (centre + folds[i] - u) > 0.0 && direction * (x - farthest) < 0.0)
        farthest = x;
    }
  }
  return farthest;
}

/* A point near x of an edge that is no graph everywhere: where x is beyond the graph, its end,
 * with its own x. Flagged there and where another part of the edge hangs over x too. */
BLADECURVE_COLD SplinePoint PointOfPartNear(const BladeKernel* k,
                                            const EdgeTurn* turn,
                                            double* x,
                                            unsigned* flags) {
  const SplinePoint low = PointAt(k, turn->u_low), high = PointAt(k, turn->u_high);
  const double x_low = XOfPoint(turn, low), x_high = XOfPoint(turn, high);
  if (*x <= OverhangBeyond(k, turn, turn->u_low, -1) || *x <= x_low ||
      *x >= OverhangBeyond(k, turn, turn->u_high, 1) || *x >= x_high) {
    *flags |= BLADECURVE_NOT_GRAPH;
  }
  if (*x > x_low && *x < x_high) return SearchPointNear(k, turn, *x, 0.5 * (low.u + high.u));
  if (*x <= x_low) {
    *x = x_low;
    return low;
  }
  *x = x_high;
  return high;
}

/* A point of the edge near x. From the spline's chord one step nearly always does. */
BLADECURVE_HOT SplinePoint PointNear(const BladeKernel* k,
                                     const EdgeTurn* turn,
                                     double* x,
                                     unsigned* flags) {
  const double start = (*x * turn->norm + k->chord_offset * turn->norm_sine) /
                       (turn->norm_cosine - k->chord_slope * turn->norm_sine);
  SplinePoint p;
  int i;
  if (!turn->is_whole) return PointOfPartNear(k, turn, x, flags);
  p = PointAt(k, start);
  for (i = 0; i < 4; ++i) {
    double next;
    if (IsNear(k, turn, p, *x)) return p;
    next = p.u + StepTowards(turn, p, *x);
    p = next >= k->ends[p.row] && next <= k->ends[p.row + 1] ? PointOnRow(k, p.row, next)
                                                             : PointAt(k, next);
  }
  return IsNear(k, turn, p, *x) ? p : SearchPointNear(k, turn, *x, start);
}

#endif /* BLADECURVE_KERNEL_TURN_H */
