// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/refused.h"

namespace bladecurve {

std::string_view ReasonCode(Reason reason) {
  switch (reason) {
    case Reason::kUnreadable:
      return "unreadable";
    case Reason::kNotScissors:
      return "not_scissors";
    case Reason::kClosed:
      return "closed";
    case Reason::kBladesNotVisible:
      return "blades_not_visible";
    case Reason::kSeveralScissors:
      return "several_scissors";
    case Reason::kOutOfPlane:
      return "out_of_plane";
    case Reason::kNoScale:
      return "no_scale";
    case Reason::kTooSmall:
      return "too_small";
    case Reason::kBlurred:
      return "blurred";
    case Reason::kLowContrast:
      return "low_contrast";
    case Reason::kEdgeTooShort:
      return "edge_too_short";
    case Reason::kAmbiguousPivot:
      return "ambiguous_pivot";
    case Reason::kFitFailed:
      return "fit_failed";
  }
  return "unreadable";
}

}  // namespace bladecurve
