// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace bladecurve {

// Why a photograph, or the data taken from it, will not do. The codes are stable: scripts read
// them.
enum class Reason {
  kUnreadable,        // the file cannot be decoded
  kNotScissors,       // something else is in the picture, or nothing
  kClosed,            // the blades lie over each other: no edge to see
  kBladesNotVisible,  // a tip or a blade is outside the frame or hidden
  kSeveralScissors,   // more than one pair; --roi chooses
  kOutOfPlane,        // blades bent or angled out of their common plane
  kNoScale,           // nothing says how many mm a pixel is
  kTooSmall,          // too few pixels along the blade
  kBlurred,           // the edge is too soft to be located
  kLowContrast,       // the blade does not stand out from its background
  kEdgeTooShort,      // too little free edge between crotch and tip
  kAmbiguousPivot,    // no screw, and the blades do not say where they turn
  kFitFailed,         // no curve explains the points, or they leave theta open
};

// "not_scissors", "closed", ...
[[nodiscard]] std::string_view ReasonCode(Reason reason);

// Thrown where a photograph cannot give a result. what() is "stage: what happened, numbers; what to
// do".
class Refused : public std::runtime_error {
 public:
  Refused(Reason reason, const std::string& detail) : std::runtime_error(detail), reason_(reason) {}
  [[nodiscard]] Reason reason() const noexcept { return reason_; }

 private:
  Reason reason_;
};

// The same where no other look at the photograph may find otherwise.
class RefusedForGood : public Refused {
 public:
  using Refused::Refused;
};

// make(), or nothing where that throws Refused.
template <typename Make>
[[nodiscard]] auto UnlessRefused(const Make& make)
    -> std::optional<std::invoke_result_t<const Make&>> {
  try {
    return make();
  } catch (const Refused&) {
    return std::nullopt;
  }
}

}  // namespace bladecurve
