// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "samples/photographs_with_truth.h"
#include "samples/validation_scene.h"

namespace bladecurve {

// What is compared with the truth.
enum class Quantity { kUpperEdge, kLowerEdge, kPivot, kTheta, kScale, kPhi, kTorque };
inline constexpr int kQuantities = 7;

// An error and the standard uncertainty that the program stated for it, in the same unit.
struct StatedError {
  double error = 0;
  double sigma = 0;
};

struct QuantityErrors {
  double size =
      std::numeric_limits<double>::quiet_NaN();  // never negative; px, px, px, deg, ppm, mm, %
  std::vector<StatedError> stated;  // of its components; empty where no uncertainty is stated
};

inline constexpr const char* kAnyReason = "refuse";

struct ValidationRow {
  std::string scene;     // its number, or the photograph's name
  std::string expected;  // "ok", the reason code that is right, or kAnyReason
  std::string outcome;   // "ok", "review" or the reason code that came
  std::vector<std::string> warnings;
  std::string detail;                                    // what the refusal says
  double theta_deg = 0;                                  // of the scene
  double ms = std::numeric_limits<double>::quiet_NaN();  // photograph to curve, in process
  std::array<QuantityErrors, kQuantities> errors;

  [[nodiscard]] bool measured() const { return outcome == "ok" || outcome == "review"; }
  [[nodiscard]] const QuantityErrors& Of(Quantity q) const {
    return errors[static_cast<std::size_t>(q)];
  }
};

// Renders the scene into a file in `folder`, runs the pipeline on it as `fit` does (marker
// size, camera calibration and plane height given, the last two as well as users know them) and
// compares the result with the truth. The file is removed again.
[[nodiscard]] ValidationRow ValidateScene(const ValidationScene& scene,
                                          const std::filesystem::path& folder);

// The same of a photograph that exists, told what its truth says of markers, camera and height; the
// camera's file is left in `folder`.
[[nodiscard]] ValidationRow ValidatePhotograph(const PhotographWithTruth& photograph,
                                               const std::filesystem::path& folder);

}  // namespace bladecurve
