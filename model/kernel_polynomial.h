/* SPDX-FileCopyrightText: 2026 The bladecurve authors
 * SPDX-License-Identifier: MIT
 *
 * Real roots of polynomials of low degree, every one isolated. Coefficients ascending. C99 and C++.
 */
#ifndef BLADECURVE_KERNEL_POLYNOMIAL_H
#define BLADECURVE_KERNEL_POLYNOMIAL_H

#include <math.h>

enum { kMaxPolynomial = 9 }; /* the largest degree: what a spline of degree 5 leads to */

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

#endif /* BLADECURVE_KERNEL_POLYNOMIAL_H */
