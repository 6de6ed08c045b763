/* SPDX-FileCopyrightText: 2026 The bladecurve authors
 * SPDX-License-Identifier: MIT
 *
 * phi(x, theta) and its derivatives. The library compiles this text and every exported plugin
 * contains it verbatim, so both give the same bits (with -ffp-contract=off). C99 and C++.
 */
#ifndef BLADECURVE_KERNEL_PHI_H
#define BLADECURVE_KERNEL_PHI_H

#include "model/blade_plugin.h"
#include "model/kernel_spline.h"
#include "model/kernel_turn.h"

/* phi and its derivatives at a point of the domain; t is theta. */
typedef struct BladeJet {
  double f, x, t, xx, xt, tt;
  double xxt, xtt; /* wanted beyond the domain only */
} BladeJet;

static inline int IsFinite(double value) { return value - value == 0.0; }

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

/* By implicit differentiation: d/dx = (1/advance) d/du along the edge, at a point near x and from
 * there to x by Taylor's series; and 2 phi_theta = x + phi phi_x for a rigid turn, which
 * differentiates to the rest. */
BLADECURVE_HOT BladeJet SplineJet(const BladeKernel* k, double x, double theta, unsigned* flags) {
  const EdgeTurn turn = TurnBy(k, theta);
  const SplinePoint p = PointNear(k, &turn, &x, flags);
  const double advance = turn.cosine - p.s1 * turn.sine;
  const double per = 1.0 / (advance > kLeastAdvance ? advance : kLeastAdvance);
  const double per3 = per * per * per;
  const double dx = x - XOfPoint(&turn, p);
  const double slope = (turn.sine + p.s1 * turn.cosine) * per, bend = 2.0 * p.s2 * per3;
  const double xxx = (6.0 * p.s3 + 12.0 * p.s2 * p.s2 * turn.sine * per) * per3 * per;
  BladeJet j;
  if (p.row == 0 || p.row == k->num_rows - 1) *flags |= BLADECURVE_X_OUTSIDE;
  j.f = (p.u * turn.sine + p.s * turn.cosine) + dx * (slope + 0.5 * dx * bend);
  j.x = slope + dx * bend;
  j.xx = bend + dx * xxx;
  j.t = 0.5 * (x + j.f * j.x);
  j.xt = 0.5 * ((1.0 + j.x * j.x) + j.f * j.xx);
  j.tt = 0.5 * (j.t * j.x + j.f * j.xt);
  j.xxt = 0.5 * (3.0 * j.x * j.xx + j.f * xxx);
  j.xtt = 0.5 * (2.0 * j.x * j.xt + j.t * j.xx + j.f * j.xxt);
  return j;
}

BLADECURVE_HOT void Fill(bladecurve_sample* sample, BladeJet j, unsigned flags) {
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

BLADECURVE_COLD void EvalOutside(const BladeKernel* k,
                                 double x,
                                 double theta,
                                 bladecurve_sample* sample) {
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
  j = k->is_spline ? SplineJet(k, x_in, theta_in, &flags) : TaperedJet(k, x_in, theta_in);
  Fill(sample, Continued(j, dx, dt), flags);
}

static inline int IsInside(const BladeKernel* k, double x, double theta) {
  return x >= k->x_min && x <= k->x_max && theta >= k->theta_min && theta <= k->theta_max;
}

/* phi at any (x, theta). */
static inline void EvalBlade(const BladeKernel* k,
                             double x,
                             double theta,
                             bladecurve_sample* sample) {
  if (!IsInside(k, x, theta)) {
    EvalOutside(k, x, theta, sample);
  } else if (!k->is_spline) {
    Fill(sample, TaperedJet(k, x, theta), 0u);
  } else {
    unsigned flags = 0u;
    const BladeJet j = SplineJet(k, x, theta, &flags);
    Fill(sample, j, flags);
  }
}

#endif /* BLADECURVE_KERNEL_PHI_H */
