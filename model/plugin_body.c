/* SPDX-FileCopyrightText: 2026 The bladecurve authors
 * SPDX-License-Identifier: MIT
 *
 * The exported functions: the last part of every plugin, after kBlade and bladecurve_entry.
 */

unsigned bladecurve_version(void) { return bladecurve_entry.version; }
const char* bladecurve_id(void) { return bladecurve_entry.id; }
const char* bladecurve_units(void) { return bladecurve_entry.units; }
const char* bladecurve_source_sha256(void) { return bladecurve_entry.source_sha256; }
const char* bladecurve_family(void) { return bladecurve_entry.family; }
int bladecurve_num_parameters(void) { return bladecurve_entry.num_parameters; }

static int IsParameter(int i) { return i >= 0 && i < bladecurve_entry.num_parameters; }

const char* bladecurve_parameter_name(int i) {
  return IsParameter(i) ? bladecurve_entry.parameter_names[i] : "";
}

double bladecurve_parameter(int i) { return IsParameter(i) ? bladecurve_entry.parameters[i] : 0.0; }

double bladecurve_standard_error(int i) {
  return IsParameter(i) ? bladecurve_entry.standard_errors[i] : -1.0;
}

double bladecurve_fit_rms_mm(void) { return bladecurve_entry.fit_rms_mm; }

void bladecurve_domain(double* x_min_mm,
                       double* x_max_mm,
                       double* theta_min_rad,
                       double* theta_max_rad) {
  *x_min_mm = kBlade.x_min;
  *x_max_mm = kBlade.x_max;
  *theta_min_rad = kBlade.theta_min;
  *theta_max_rad = kBlade.theta_max;
}

void bladecurve_eval(double x_mm, double theta_rad, bladecurve_sample* sample) {
  EvalBlade(&kBlade, x_mm, theta_rad, sample);
}

void bladecurve_eval_n(int n,
                       const double* x_mm,
                       const double* theta_rad,
                       bladecurve_sample* samples) {
  int i;
  for (i = 0; i < n; ++i) EvalBlade(&kBlade, x_mm[i], theta_rad[i], &samples[i]);
}

int bladecurve_contacts(double y_mm, double theta_rad, double* x_mm, int capacity) {
  return BladeContacts(&kBlade, y_mm, theta_rad, x_mm, capacity);
}
