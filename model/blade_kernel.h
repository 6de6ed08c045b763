/* SPDX-FileCopyrightText: 2026 The bladecurve authors
 * SPDX-License-Identifier: MIT
 *
 * The arithmetic of phi(x, theta), C99 and C++. The library compiles this text and every exported
 * plugin contains it verbatim, so both give the same bits (with -ffp-contract=off).
 * Lengths mm, angles rad.
 */
#ifndef BLADECURVE_KERNEL_H
#define BLADECURVE_KERNEL_H

#include <math.h>

#include "model/blade_plugin.h"

enum { kMaxDegree = 5, kRowSize = kMaxDegree + 2, kMaxPolynomial = 2 * kMaxDegree - 1 };

/* dx/du of the turned edge below this counts as standing upright (steeper than about 89.9 deg). */
static const double kLeastAdvance = 1e-3;
/* Inputs beyond this are taken for this, so that nothing overflows: a thousand kilometres. */
static const double kFarthest = 1e9;

/* One blade, ready to evaluate. A spline s(u) is a row {centre, c0 .. c5} for each span,
 * s = sum c_i (u - centre)^i, with a straight continuation as first and last row. */
typedef struct BladeKernel {
  double x_min, x_max, theta_min, theta_max;
  double a, b, gain; /* tapered rectangle */
  int num_rows;      /* 0: tapered rectangle */
  int degree;
  const double* rows; /* num_rows rows */
  const double* ends; /* num_rows + 1 values of u: row i holds from ends[i] to ends[i + 1] */
  double chord_offset, chord_slope; /* the straight line between the spline's two ends */
  double slope_min, slope_max;      /* of s', and where it is so */
  double u_slope_min, u_slope_max;
  double near_mm; /* a Newton step this small is finished by Taylor's series */
} BladeKernel;

/* The turn of the blade by theta/2, and the part of the edge that is then a graph over x:
 * dx/du >= least between u_low and u_high. */
typedef struct EdgeTurn {
  double cosine, sine;
  double least, u_low, u_high;
  int is_whole; /* the whole edge is a graph */
} EdgeTurn;

/* The spline and its Taylor coefficients at u: s, s', s''/2, s'''/6. */
typedef struct SplinePoint {
  double u, s, s1, s2, s3;
  int row;
} SplinePoint;

/* phi and its derivatives at a point of the domain; t is theta. */
typedef struct BladeJet {
  double f, x, t, xx, xt, tt;
  double xxt, xtt; /* wanted beyond the domain only */
} BladeJet;

static inline double Clamp(double value, double low, double high) {
  return value < low ? low : (value > high ? high : value);
}

static inline int IsFinite(double value) { return value - value == 0.0; }

/* ---- polynomials: coefficients c ascending ---- */

/* The value; *noise bounds what rounding may hide. */
static inline double Polynomial(const double* c, int degree, double t, double* noise) {
  double value = c[degree], size = fabs(c[degree]);
  int i;
  for (i = degree; i-- > 0;) {
    value = value * t + c[i];
    size = size * fabs(t) + fabs(c[i]);
  }
  *noise = 1e-15 * size;
  return value;
}

static inline double PolynomialSlope(const double* c, int degree, double t) {
  double slope = 0.0;
  int i;
  for (i = degree; i > 0; --i) slope = slope * t + i * c[i];
  return slope;
}

/* The root between a and b, where the polynomial is monotone and changes sign: Newton's steps,
 * halving the bracket where they leave it or do not shrink. */
static inline double RootBetween(const double* c, int degree, double a, double b, int rising) {
  double t = 0.5 * (a + b), last_step = b - a;
  int i;
  for (i = 0; i < 200; ++i) {
    double noise, next;
    const double value = Polynomial(c, degree, t, &noise);
    const double slope = PolynomialSlope(c, degree, t);
    if (value == 0.0) return t;
    if ((value > 0.0) == (rising != 0))
      b = t;
    else
      a = t;
    next = t - value / (slope != 0.0 ? slope : 1.0);
    if (slope == 0.0 || !(next > a && next < b) || fabs(next - t) > 0.5 * last_step)
      next = 0.5 * (a + b);
    if (next == t || next == a || next == b) return next;
    last_step = fabs(next - t);
    t = next;
  }
  return t;
}

/* The roots in the monotone parts between the nodes; a node at which rounding hides the value
 * (two roots that touch) is one root. */
static inline int RootsBetweenNodes(
    const double* c, int degree, const double* nodes, int num_nodes, double* roots) {
  double last = 0.0;
  int last_is_root = 0, n = 0, i;
  for (i = 0; i < num_nodes; ++i) {
    double noise;
    const double value = Polynomial(c, degree, nodes[i], &noise);
    const int is_root = fabs(value) <= noise;
    if (i > 0 && !is_root && !last_is_root && (value > 0.0) != (last > 0.0) && n < degree)
      roots[n++] = RootBetween(c, degree, nodes[i - 1], nodes[i], value > 0.0);
    if (is_root && !last_is_root && n < degree) roots[n++] = nodes[i];
    last = value;
    last_is_root = is_root;
  }
  return n;
}

/* All roots in [a, b], ascending, at most `degree`: those of each derivative are the nodes of the
 * one before it. */
static inline int PolynomialRoots(const double* c, int degree, double a, double b, double* roots) {
  double nodes[kMaxPolynomial + 2], derivative[kMaxPolynomial + 1];
  int n = 0, order, i, k;
  for (order = degree - 1; order >= 0; --order) {
    for (i = 0; i <= degree - order; ++i) {
      derivative[i] = c[i + order];
      for (k = 1; k <= order; ++k) derivative[i] *= i + k;
    }
    nodes[0] = a;
    for (i = 0; i < n; ++i) nodes[i + 1] = roots[i];
    nodes[n + 1] = b;
    n = RootsBetweenNodes(derivative, degree - order, nodes, n + 2, roots);
  }
  return n;
}

/* ---- angles ---- */

/* tan(theta/4) as a fraction, |theta| <= pi. Minimax of tan(q)/q in q^2, relative error 2e-17, by
 * the Remez algorithm. The C library's functions would differ in the last bit from one system to
 * the next, and take longer than all the rest of a tapered rectangle. */
typedef struct QuarterTangent {
  double num, den;
} QuarterTangent;

static inline QuarterTangent QuarterTangentOf(double theta) {
  const double q = 0.25 * theta, z = q * q;
  QuarterTangent tangent;
  tangent.num = q * ((1.0 - 0.12828350168243329619 * z) +
                     z * z * (0.0028059217245041402614 - 7.4836686415908291604e-6 * z));
  tangent.den = (1.0 - 0.46161683501576378859 * z) +
                z * z * (0.023344866729689041094 - 0.00020844854405326998535 * z);
  return tangent;
}

/* ---- the spline s(u) ---- */

static inline int RowAt(const BladeKernel* k, double u) {
  const double* base = k->ends + 1;
  int count = k->num_rows - 1;
  while (count > 0) {
    const int half = (count + 1) / 2;
    base += base[half - 1] <= u ? half : 0;
    count -= half;
  }
  return (int)(base - k->ends) - 1;
}

/* The coefficients beyond the degree are 0. */
static inline SplinePoint PointOnRow(const BladeKernel* k, int row, double u) {
  const double* c = k->rows + kRowSize * row + 1;
  const double t = u - c[-1];
  const double tt = t * t;
  SplinePoint p;
  p.u = u;
  p.row = row;
  p.s = (c[0] + c[1] * t) + tt * (c[2] + c[3] * t);
  p.s1 = c[1] + t * (2.0 * c[2] + 3.0 * c[3] * t);
  p.s2 = c[2] + 3.0 * c[3] * t;
  p.s3 = c[3];
  if (k->degree > 3) {
    const double tc5 = t * c[5];
    p.s += tt * tt * (c[4] + tc5);
    p.s1 += tt * t * (4.0 * c[4] + 5.0 * tc5);
    p.s2 += tt * (6.0 * c[4] + 10.0 * tc5);
    p.s3 += t * (4.0 * c[4] + 10.0 * tc5);
  }
  return p;
}

static inline SplinePoint PointAt(const BladeKernel* k, double u) {
  return PointOnRow(k, RowAt(k, u), u);
}

/* The point a tiny step further, by Taylor's series. */
static inline SplinePoint Moved(SplinePoint p, double step) {
  p.u += step;
  p.s += step * (p.s1 + step * p.s2);
  p.s1 += step * (2.0 * p.s2 + 3.0 * step * p.s3);
  p.s2 += 3.0 * step * p.s3;
  return p;
}

/* ---- the turned edge: x = u cos - s sin, y = u sin + s cos ---- */

/* How far dx/du is below kLeastAdvance on a row, as a polynomial in u - centre. */
static inline void SteepnessOfRow(const BladeKernel* k, int row, const EdgeTurn* turn, double* c) {
  const double* s = k->rows + kRowSize * row + 1;
  int i;
  for (i = 0; i < k->degree; ++i) c[i] = turn->sine * (i + 1) * s[i + 1];
  c[0] += kLeastAdvance - turn->cosine;
}

/* From u outwards, direction -1 or 1: the first u at which the edge is too steep. */
static inline double GraphEnd(const BladeKernel* k, const EdgeTurn* turn, double u, int direction) {
  int row = RowAt(k, u);
  for (; row >= 0 && row < k->num_rows; row += direction) {
    const double centre = k->rows[kRowSize * row];
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
static void FindGraph(const BladeKernel* k, EdgeTurn* turn) {
  const double u = turn->sine > 0.0 ? k->u_slope_min : k->u_slope_max;
  turn->least = kLeastAdvance;
  turn->u_low = GraphEnd(k, turn, u, -1);
  turn->u_high = GraphEnd(k, turn, u, 1);
}

static inline EdgeTurn TurnBy(const BladeKernel* k, double theta) {
  const QuarterTangent q = QuarterTangentOf(theta);
  const double dd = q.den * q.den, nn = q.num * q.num, per = 1.0 / (dd + nn);
  EdgeTurn turn;
  turn.cosine = (dd - nn) * per;
  turn.sine = 2.0 * q.num * q.den * per;
  turn.least = turn.cosine - turn.sine * (turn.sine > 0.0 ? k->slope_max : k->slope_min);
  turn.u_low = -kFarthest;
  turn.u_high = kFarthest;
  turn.is_whole = turn.least >= kLeastAdvance;
  if (!turn.is_whole) FindGraph(k, &turn);
  return turn;
}

static inline double XOfPoint(const EdgeTurn* turn, SplinePoint p) {
  return p.u * turn->cosine - p.s * turn->sine;
}

/* The step along u that lessens the edge's x by `miss`, by reversion of Taylor's series up to the
 * fourth power; Newton's where that is of no use. */
static inline double StepBy(const EdgeTurn* turn, SplinePoint p, double miss) {
  const double per = 1.0 / (turn->cosine - p.s1 * turn->sine);
  const double step = -miss * per, bend = turn->sine * per * step;
  const double b = p.s2 * bend, c = p.s3 * step * bend;
  if (fabs(b) + fabs(c) > 0.1) return step;
  return step * (1.0 + b * (1.0 + b * (2.0 + 5.0 * b)) + c * (1.0 + 5.0 * b));
}

static inline int IsOnRow(const BladeKernel* k, int row, double u) {
  return u >= k->ends[row] && u <= k->ends[row + 1];
}

/* The point of the edge over x, for an x between those of u_low and u_high, from any start:
 * Newton's steps, halving the bracket where they leave it or do not shrink. */
static SplinePoint SearchPointOver(const BladeKernel* k,
                                   const EdgeTurn* turn,
                                   double x,
                                   double start) {
  SplinePoint p = PointAt(k, Clamp(start, turn->u_low, turn->u_high));
  const double reach = fabs(XOfPoint(turn, p) - x) / turn->least;
  double low = p.u - reach > turn->u_low ? p.u - reach : turn->u_low;
  double high = p.u + reach < turn->u_high ? p.u + reach : turn->u_high;
  double last_step = high - low;
  int i;
  for (i = 0; i < 200; ++i) {
    const double miss = XOfPoint(turn, p) - x;
    const double step = -miss / (turn->cosine - p.s1 * turn->sine);
    double next = p.u + step;
    if (fabs(step) <= k->near_mm && IsOnRow(k, p.row, next)) return Moved(p, step);
    if (miss > 0.0)
      high = p.u;
    else
      low = p.u;
    if (!(next > low && next < high) || fabs(step) > 0.5 * last_step) next = 0.5 * (low + high);
    if (next == p.u || next == low || next == high) return p;
    last_step = fabs(next - p.u);
    p = PointAt(k, next);
  }
  return p;
}

/* The point over x of an edge that is no graph everywhere: where x is beyond the graph, its end,
 * with its own x, flagged. */
static SplinePoint PointOfPartOver(const BladeKernel* k,
                                   const EdgeTurn* turn,
                                   double* x,
                                   unsigned* flags) {
  const SplinePoint low = PointAt(k, turn->u_low), high = PointAt(k, turn->u_high);
  const double x_low = XOfPoint(turn, low), x_high = XOfPoint(turn, high);
  if (*x > x_low && *x < x_high) return SearchPointOver(k, turn, *x, 0.5 * (low.u + high.u));
  *flags |= BLADECURVE_NOT_GRAPH;
  if (*x <= x_low) {
    *x = x_low;
    return low;
  }
  *x = x_high;
  return high;
}

/* The point of the edge over x. From the spline's chord two steps nearly always do. */
static inline SplinePoint PointOver(const BladeKernel* k,
                                    const EdgeTurn* turn,
                                    double* x,
                                    unsigned* flags) {
  const double start =
      (*x + k->chord_offset * turn->sine) / (turn->cosine - k->chord_slope * turn->sine);
  SplinePoint p;
  int i;
  if (!turn->is_whole) return PointOfPartOver(k, turn, x, flags);
  p = PointAt(k, start);
  for (i = 0; i < 4; ++i) {
    const double step = StepBy(turn, p, XOfPoint(turn, p) - *x);
    const double next = p.u + step;
    const int same_row = IsOnRow(k, p.row, next);
    if (fabs(step) <= k->near_mm && same_row) return Moved(p, step);
    p = same_row ? PointOnRow(k, p.row, next) : PointAt(k, next);
  }
  return SearchPointOver(k, turn, *x, start);
}

/* ---- phi ---- */

static inline BladeJet TaperedJet(const BladeKernel* k, double x, double theta) {
  const QuarterTangent q = QuarterTangentOf(theta);
  const double tangent = 2.0 * q.num * q.den / (q.den * q.den - q.num * q.num);
  BladeJet j;
  j.x = k->b + k->gain * tangent;
  j.f = k->a + x * j.x;
  j.xt = 0.5 * k->gain * (1.0 + tangent * tangent);
  j.t = x * j.xt;
  j.xtt = j.xt * tangent;
  j.tt = x * j.xtt;
  j.xx = j.xxt = 0.0;
  return j;
}

/* By implicit differentiation: d/dx = (1/advance) d/du along the edge, and 2 phi_theta = x + phi
 * phi_x for a rigid turn, which differentiates to the rest. */
static inline BladeJet SplineJet(const BladeKernel* k, double x, double theta, unsigned* flags) {
  const EdgeTurn turn = TurnBy(k, theta);
  const SplinePoint p = PointOver(k, &turn, &x, flags);
  const double advance = turn.cosine - p.s1 * turn.sine;
  const double per = 1.0 / (advance > kLeastAdvance ? advance : kLeastAdvance);
  const double per3 = per * per * per;
  BladeJet j;
  double xxx;
  if (p.row == 0 || p.row == k->num_rows - 1) *flags |= BLADECURVE_X_OUTSIDE;
  j.f = p.u * turn.sine + p.s * turn.cosine;
  j.x = (turn.sine + p.s1 * turn.cosine) * per;
  j.xx = 2.0 * p.s2 * per3;
  j.t = 0.5 * (x + j.f * j.x);
  j.xt = 0.5 * (1.0 + j.x * j.x + j.f * j.xx);
  j.tt = 0.5 * (j.t * j.x + j.f * j.xt);
  xxx = (6.0 * p.s3 + 12.0 * p.s2 * p.s2 * turn.sine * per) * per3 * per;
  j.xxt = 0.5 * (3.0 * j.x * j.xx + j.f * xxx);
  j.xtt = 0.5 * (2.0 * j.x * j.xt + j.t * j.xx + j.f * j.xxt);
  return j;
}

static inline void Fill(bladecurve_sample* sample, BladeJet j, unsigned flags) {
  sample->phi_mm = j.f;
  sample->phi_x = j.x;
  sample->phi_theta_mm_per_rad = j.t;
  sample->phi_xx_per_mm = j.xx;
  sample->phi_xtheta_per_rad = j.xt;
  sample->phi_thetatheta_mm_per_rad2 = j.tt;
  sample->flags = flags;
}

/* The jet at the nearest point of the domain, continued linearly by dx and dt. */
static inline BladeJet Continued(BladeJet j, double dx, double dt) {
  BladeJet far = j;
  far.f = j.f + j.x * dx + (j.t + j.xt * dx) * dt;
  far.x = j.x + j.xt * dt;
  far.t = j.t + j.xt * dx;
  far.xx = dx == 0.0 ? j.xx + j.xxt * dt : 0.0;
  far.tt = dt == 0.0 ? j.tt + j.xtt * dx : 0.0;
  return far;
}

static void EvalOutside(const BladeKernel* k, double x, double theta, bladecurve_sample* sample) {
  const double x_in = Clamp(x, k->x_min, k->x_max);
  const double theta_in = Clamp(theta, k->theta_min, k->theta_max);
  const double dx = Clamp(x, -kFarthest, kFarthest) - x_in;
  const double dt = Clamp(theta, -kFarthest, kFarthest) - theta_in;
  const BladeJet nothing = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  unsigned flags =
      (dx == 0.0 ? 0u : BLADECURVE_X_OUTSIDE) | (dt == 0.0 ? 0u : BLADECURVE_THETA_OUTSIDE);
  BladeJet j;
  if (!IsFinite(x) || !IsFinite(theta)) {
    Fill(sample, nothing, BLADECURVE_NOT_FINITE);
    return;
  }
  j = k->num_rows > 0 ? SplineJet(k, x_in, theta_in, &flags) : TaperedJet(k, x_in, theta_in);
  Fill(sample, Continued(j, dx, dt), flags);
}

/* phi at any (x, theta). */
static inline void EvalBlade(const BladeKernel* k,
                             double x,
                             double theta,
                             bladecurve_sample* sample) {
  if (!(x >= k->x_min && x <= k->x_max && theta >= k->theta_min && theta <= k->theta_max)) {
    EvalOutside(k, x, theta, sample);
  } else if (k->num_rows == 0) {
    Fill(sample, TaperedJet(k, x, theta), 0u);
  } else {
    unsigned flags = 0u;
    const BladeJet j = SplineJet(k, x, theta, &flags);
    Fill(sample, j, flags);
  }
}

/* ---- contacts: every x of the domain with phi(x, theta) = y ---- */

static inline int TaperedContacts(
    const BladeKernel* k, double y, double theta, double dt, double* x, int capacity) {
  const BladeJet at_zero = TaperedJet(k, 0.0, theta);
  const double root = (y - at_zero.f) / (at_zero.x + at_zero.xt * dt);
  if (!(root >= k->x_min && root <= k->x_max)) return 0;
  if (capacity > 0) x[0] = root;
  return 1;
}

/* phi - y on a row, as a polynomial in u - centre; beyond the theta domain, where phi goes on as
 * phi + phi_theta dt with phi_theta = (u + s s') / (2 advance), times the advance. Returns its
 * degree. */
static inline int GapOfRow(
    const BladeKernel* k, int row, const EdgeTurn* turn, double y, double dt, double* gap) {
  const double* s = k->rows + kRowSize * row + 1;
  const int n = k->degree;
  double height[kMaxDegree + 1];
  int i, m;
  for (i = 0; i <= n; ++i) height[i] = turn->cosine * s[i];
  height[0] += turn->sine * s[-1] - y;
  height[1] += turn->sine;
  if (!(dt < 0.0 || dt > 0.0)) {
    for (i = 0; i <= n; ++i) gap[i] = height[i];
    return n;
  }
  for (i = 0; i < 2 * n; ++i) gap[i] = i <= n ? turn->cosine * height[i] : 0.0;
  gap[0] += 0.5 * dt * s[-1];
  gap[1] += 0.5 * dt;
  for (i = 0; i <= n; ++i)
    for (m = 1; m <= n; ++m)
      gap[i + m - 1] += m * s[m] * (0.5 * dt * s[i] - turn->sine * height[i]);
  return 2 * n - 1;
}

static inline int SplineContacts(
    const BladeKernel* k, double y, double theta, double dt, double* x, int capacity) {
  const double same = 1e-9 * (k->x_max - k->x_min);
  const EdgeTurn turn = TurnBy(k, theta);
  unsigned flags = 0u;
  double x_low = k->x_min, x_high = k->x_max, last = k->x_min - 1.0 - same;
  const SplinePoint low = PointOver(k, &turn, &x_low, &flags),
                    high = PointOver(k, &turn, &x_high, &flags);
  int n = 0, row, i;
  for (row = low.row; row <= high.row; ++row) {
    const double centre = k->rows[kRowSize * row];
    const double from = (row == low.row ? low.u : k->ends[row]) - centre;
    const double to = (row == high.row ? high.u : k->ends[row + 1]) - centre;
    double gap[2 * kMaxDegree], roots[kMaxPolynomial];
    const int num_roots =
        PolynomialRoots(gap, GapOfRow(k, row, &turn, y, dt, gap), from, to, roots);
    for (i = 0; i < num_roots; ++i) {
      const double root = Clamp(XOfPoint(&turn, PointAt(k, centre + roots[i])), x_low, x_high);
      if (root - last <= same) continue;
      last = root;
      if (n < capacity) x[n] = root;
      ++n;
    }
  }
  return n;
}

static inline int BladeContacts(
    const BladeKernel* k, double y, double theta, double* x, int capacity) {
  const double theta_in = Clamp(theta, k->theta_min, k->theta_max);
  const double dt = Clamp(theta, -kFarthest, kFarthest) - theta_in;
  if (!IsFinite(y) || !IsFinite(theta)) return 0;
  if (k->num_rows > 0) return SplineContacts(k, y, theta_in, dt, x, capacity);
  return TaperedContacts(k, y, theta_in, dt, x, capacity);
}

#endif /* BLADECURVE_KERNEL_H */
