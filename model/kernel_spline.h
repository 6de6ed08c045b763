/* SPDX-FileCopyrightText: 2026 The bladecurve authors
 * SPDX-License-Identifier: MIT
 *
 * One blade ready to evaluate, and its spline s(u). Lengths mm, angles rad. C99 and C++.
 */
#ifndef BLADECURVE_KERNEL_SPLINE_H
#define BLADECURVE_KERNEL_SPLINE_H

/* On the way of every evaluation, and off it. Left to themselves compilers put the border elsewhere
 * and take half as long again. */
#if defined(__GNUC__)
#define BLADECURVE_HOT static inline __attribute__((always_inline))
#define BLADECURVE_COLD static __attribute__((noinline))
#else
#define BLADECURVE_HOT static inline
#define BLADECURVE_COLD static
#endif

enum { kMaxDegree = 5, kRowSize = kMaxDegree + 2 };

/* Inputs beyond this are taken for this, so that nothing overflows: a thousand kilometres. */
static const double kFarthest = 1e9;

/* One blade, ready to evaluate. A spline s(u) is a row {centre, c0 .. c5} for each span,
 * s = sum c_i (u - centre)^i, with a straight continuation as first and last row. */
typedef struct BladeKernel {
  double x_min, x_max, theta_min, theta_max;
  double a, b, gain; /* tapered rectangle */
  int is_spline;     /* 0: a tapered rectangle; its row, a line of zeros, is not used */
  int degree;
  int num_rows;
  const double* rows;
  const double* ends; /* num_rows + 1 values of u: row i holds from ends[i] to ends[i + 1] */
  double chord_offset, chord_slope; /* the straight line between the spline's two ends */
  double slope_min, slope_max;      /* of s', and where it is so */
  double u_slope_min, u_slope_max;
  /* An edge point this near to the wanted x is near enough for Taylor's series to finish, unless
   * it is as near to the end of its row: then nearness is down to rounding. */
  double near_mm, exact_mm;
} BladeKernel;

/* The spline and its Taylor coefficients at u: s, s', s''/2, s'''/6. */
typedef struct SplinePoint {
  double u, s, s1, s2, s3;
  int row;
} SplinePoint;

/* Row i: {centre, c0 .. c5}. */
BLADECURVE_HOT const double* RowOf(const BladeKernel* k, long i) { return k->rows + kRowSize * i; }

BLADECURVE_HOT double Clamp(double value, double low, double high) {
  return value < low ? low : (value > high ? high : value);
}

/* The rows are few, and successive calls mostly end on the same one, which the processor learns:
 * faster than a search by halves. */
BLADECURVE_HOT int RowAt(const BladeKernel* k, double u) {
  int row = 0;
  while (row + 1 < k->num_rows && k->ends[row + 1] <= u) ++row;
  return row;
}

/* The coefficients beyond the degree are 0. */
BLADECURVE_HOT SplinePoint PointOnRow(const BladeKernel* k, int row, double u) {
  const double* c = RowOf(k, row) + 1;
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

BLADECURVE_HOT SplinePoint PointAt(const BladeKernel* k, double u) {
  return PointOnRow(k, RowAt(k, u), u);
}

#endif /* BLADECURVE_KERNEL_SPLINE_H */
