// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <stdexcept>

#include "curvefit/fit.h"

// No photograph, no curve: the call links, runs and says so.
int main() {
  try {
    (void)bladecurve::FitBlade({});
  } catch (const std::exception&) {
    return EXIT_SUCCESS;
  }
  return EXIT_FAILURE;
}
