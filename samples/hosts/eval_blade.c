/* SPDX-FileCopyrightText: 2026 The bladecurve authors
 * SPDX-License-Identifier: MIT
 *
 * Calls an exported blade from C, through its table.
 *   cc -I. samples/hosts/eval_blade.c -ldl -o eval_blade && ./eval_blade ./BLADE.so THETA_DEG X_MM
 * prints x_mm,phi_mm,phi_x,phi_theta_mm_per_rad,flags
 */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

#include "model/blade_plugin.h"

int main(int argc, char** argv) {
  void* library = argc == 4 ? dlopen(argv[1], RTLD_NOW) : NULL;
  const bladecurve_plugin* blade;
  bladecurve_sample s;
  double x_mm;
  if (!library) {
    fprintf(
        stderr, "usage: eval_blade ./BLADE.so THETA_DEG X_MM (%s)\n", argc == 4 ? dlerror() : "");
    return 2;
  }
  blade = (const bladecurve_plugin*)dlsym(library, "bladecurve_entry");
  if (!blade || blade->version < 1) {
    fprintf(stderr, "%s is no blade; make one by bladecurve export --as so\n", argv[1]);
    return 1;
  }
  x_mm = atof(argv[3]);
  blade->eval(x_mm, atof(argv[2]) * (3.14159265358979323846 / 180), &s);
  printf("%.17g,%.17g,%.17g,%.17g,%u\n", x_mm, s.phi_mm, s.phi_x, s.phi_theta_mm_per_rad, s.flags);
  return 0;
}
