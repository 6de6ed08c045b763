// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "model/torque.h"

namespace bladecurve {

// The torque model once more, slow and simple: long double, its own evaluation of the edge, every
// step cut into many, every root by bisection, derivatives by their formulas without any of the
// library's code.
class CuttingOracle {
 public:
  CuttingOracle(const BladeCurve& blade,
                const Material& material,
                PlateSpan span,
                DeltaPolicy policy,
                int substeps);

  struct Sample {
    long double torque_nmm = 0, x_c_mm = 0, force_x_n = 0;
    Phase phase = Phase::kNone;
    bool near_event = false;  // the phase changed in this step
  };
  Sample Step(long double theta_rad, long double pivot_mm);

 private:
  struct Edge {
    long double phi = 0, phi_x = 0, phi_theta = 0;
  };
  enum class Mode { kElastic, kCutting, kResting, kThrough };

  [[nodiscard]] Edge EdgeAt(long double x, long double theta) const;
  [[nodiscard]] long double Delta(long double x, long double theta) const;
  [[nodiscard]] long double Elastic(long double x, long double theta) const;
  [[nodiscard]] long double Sharp(long double x, long double theta) const;
  [[nodiscard]] long double Excess(long double x, long double theta) const;
  [[nodiscard]] long double Growth(long double x, long double theta) const;
  [[nodiscard]] long double Grown(long double x, long double theta) const;
  void Substep(long double theta, long double pivot);
  void SubstepElastic(long double theta, long double pivot);
  void SubstepCutting(long double theta, long double pivot);

  BladeCurve blade_;
  Material material_;
  long double end_;
  DeltaPolicy policy_;
  int substeps_;
  Mode mode_ = Mode::kElastic;
  bool started_ = false;
  long double crack_ = 0, delta_c_ = 0, theta_ = 0, pivot_ = 0, delta_before_ = 0;
  Phase phase_ = Phase::kNone;
};

}  // namespace bladecurve
