// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "curvefit/fit.h"
#include "vision/measure.h"
#include "vision/refused.h"

namespace bladecurve {

struct AnalysisSettings {
  MeasureOptions measure;
  std::vector<double> theta_rad;  // given opening angles, one a photograph; or empty
  FitOptions fit;
  int num_threads = 1;
};

// What the photographs of one pair of scissors give.
struct Analysis {
  std::vector<PhotoMeasurement> photos;
  BladeFit fit;
  double fit_ms = 0;
};

// Refused, and by which photograph; what() names it.
class PhotoRefused : public Refused {
 public:
  PhotoRefused(const Refused& refusal, std::string photo);
  [[nodiscard]] const std::string& photo() const noexcept { return photo_; }

 private:
  std::string photo_;
};

// Measures each photograph and fits one blade to all of them. The result does not depend on
// num_threads. Throws PhotoRefused; std::invalid_argument where theta_rad and the photographs
// differ in number, or two photographs are the same.
[[nodiscard]] Analysis AnalyzeScissors(const std::vector<std::filesystem::path>& photos,
                                       const AnalysisSettings& settings);

}  // namespace bladecurve
