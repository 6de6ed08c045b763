// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "vision/measure.h"
#include "vision/refused.h"

// A photograph that is not there is refused as unreadable.
int main() {
  try {
    (void)bladecurve::MeasurePhoto("no-such-photograph.jpg", {});
  } catch (const bladecurve::Refused& refusal) {
    return refusal.reason() == bladecurve::Reason::kUnreadable ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  return EXIT_FAILURE;
}
