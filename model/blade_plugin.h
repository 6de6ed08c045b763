/* SPDX-FileCopyrightText: 2026 The bladecurve authors
 * SPDX-License-Identifier: MIT
 *
 * A blade curve y = phi(x, theta) as a plain C plugin. C99 and C++; units mm and rad.
 *
 * Frame: origin at the pivot, +x along the symmetry line of the blades towards the tips, +y
 * counter-clockwise from it; phi is the cutting edge of the upper blade at opening angle theta.
 *
 * Every function is re-entrant and real-time safe: no allocation, no locks, no input or output,
 * bounded loops, no state. Nothing returned is ever NaN or Inf.
 *
 * Version 1. Fields are only ever appended: a host reads `version` and `size` first and uses no
 * field that lies beyond `size`.
 */
#ifndef BLADECURVE_PLUGIN_H
#define BLADECURVE_PLUGIN_H

#define BLADECURVE_PLUGIN_VERSION 1u

/* Status bits of one evaluation; 0: inside the domain and exact. */
#define BLADECURVE_X_OUTSIDE 1u     /* beyond the x domain or the edge's ends: goes on linearly */
#define BLADECURVE_THETA_OUTSIDE 2u /* beyond the theta domain: goes on linearly */
#define BLADECURVE_NOT_FINITE 4u    /* NaN or Inf came in: all values are 0 */
#define BLADECURVE_NOT_GRAPH                                          \
  8u /* the turned edge is no graph over x there: nearest valid value \
      */

/* NOLINTBEGIN(readability-identifier-naming): C has no namespaces. */
#ifdef __cplusplus
extern "C" {
#endif

/* phi and its derivatives at one (x, theta). */
typedef struct bladecurve_sample {
  double phi_mm, phi_x, phi_theta_mm_per_rad;
  double phi_xx_per_mm, phi_xtheta_per_rad, phi_thetatheta_mm_per_rad2;
  unsigned flags;
} bladecurve_sample;

typedef struct bladecurve_plugin {
  unsigned version;          /* BLADECURVE_PLUGIN_VERSION when this was built */
  unsigned size;             /* sizeof(bladecurve_plugin) when this was built */
  const char* id;            /* the blade's name, UTF-8 */
  const char* units;         /* "mm,rad" */
  const char* source_sha256; /* of the .blade.json it was made from, hexadecimal; "" if unknown */
  const char* family;        /* "tapered-rectangle" or "rigid-spline" */
  int degree;                /* of the spline; 0 for other families */
  int num_knots;
  const double* knots_mm;
  int num_parameters; /* a_mm, b, gain of the tapered rectangle, coefficients of the spline */
  const char* const* parameter_names;
  const double* parameters;
  const double* standard_errors; /* of the parameters; negative: unknown */
  double fit_rms_mm;             /* negative: unknown */
  double x_min_mm, x_max_mm, theta_min_rad, theta_max_rad;

  void (*eval)(double x_mm, double theta_rad, bladecurve_sample* sample);
  void (*eval_n)(int n, const double* x_mm, const double* theta_rad, bladecurve_sample* samples);
  /* All x of the domain with phi(x, theta) = y, ascending; writes at most `capacity` of them and
   * returns how many there are. */
  int (*contacts)(double y_mm, double theta_rad, double* x_mm, int capacity);
} bladecurve_plugin;

/* What a plugin exports: the table, and the same again as flat functions for hosts that call by
 * name (ctypes, P/Invoke). */
extern const bladecurve_plugin bladecurve_entry;

unsigned bladecurve_version(void);
const char* bladecurve_id(void);
const char* bladecurve_units(void);
const char* bladecurve_source_sha256(void);
const char* bladecurve_family(void);
int bladecurve_num_parameters(void);
const char* bladecurve_parameter_name(int i); /* "" beyond the last */
double bladecurve_parameter(int i);           /* 0 beyond the last */
double bladecurve_standard_error(int i);      /* negative: unknown */
double bladecurve_fit_rms_mm(void);           /* negative: unknown */
void bladecurve_domain(double* x_min_mm,
                       double* x_max_mm,
                       double* theta_min_rad,
                       double* theta_max_rad);
void bladecurve_eval(double x_mm, double theta_rad, bladecurve_sample* sample);
void bladecurve_eval_n(int n,
                       const double* x_mm,
                       const double* theta_rad,
                       bladecurve_sample* samples);
int bladecurve_contacts(double y_mm, double theta_rad, double* x_mm, int capacity);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming) */
#endif /* BLADECURVE_PLUGIN_H */
