/* SPDX-FileCopyrightText: 2026 The bladecurve authors
 * SPDX-License-Identifier: MIT
 *
 * Contacts: every x of the domain with phi(x, theta) = y. C99 and C++.
 */
#ifndef BLADECURVE_KERNEL_CONTACTS_H
#define BLADECURVE_KERNEL_CONTACTS_H

#include "model/kernel_phi.h"
#include "model/kernel_polynomial.h"
#include "model/kernel_spline.h"
#include "model/kernel_turn.h"

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
  const double* s = RowOf(k, row) + 1;
  const int n = k->degree;
  double height[kMaxDegree + 1];
  int i, m;
  for (i = 0; i <= kMaxDegree; ++i) height[i] = turn->cosine * s[i];
  height[0] += turn->sine * s[-1] - y;
  height[1] += turn->sine;
  for (i = 0; i < 2 * kMaxDegree; ++i) gap[i] = i <= kMaxDegree ? height[i] : 0.0;
  if (dt == 0.0) return n;
  for (i = 0; i <= n; ++i) gap[i] *= turn->cosine;
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
  const SplinePoint low = PointNear(k, &turn, &x_low, &flags),
                    high = PointNear(k, &turn, &x_high, &flags);
  int n = 0, row, i;
  for (row = low.row; row <= high.row; ++row) {
    const double centre = RowOf(k, row)[0];
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
  if (k->is_spline) return SplineContacts(k, y, theta_in, dt, x, capacity);
  return TaperedContacts(k, y, theta_in, dt, x, capacity);
}

#endif /* BLADECURVE_KERNEL_CONTACTS_H */
