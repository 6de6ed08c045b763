// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

namespace bladecurve {

inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace bladecurve
