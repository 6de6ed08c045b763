// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/torque.h"
#include "tests/model/cutting_scenes.h"

namespace bladecurve {

// What every output must be, whatever came in.
inline void ExpectFinite(const TorqueSample& sample, const std::string& scene) {
  EXPECT_TRUE(std::isfinite(sample.torque_nmm) && std::isfinite(sample.force_x_n) &&
              std::isfinite(sample.x_c_mm) && std::isfinite(sample.delta_mm) &&
              std::isfinite(sample.normal_force_n))
      << scene;
  EXPECT_GE(sample.torque_nmm, 0) << scene;
}

}  // namespace bladecurve
