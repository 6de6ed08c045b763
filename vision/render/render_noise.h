// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace bladecurve::render {

// Random values that depend on place and seed alone, so that pictures do not depend on the order of
// work.
[[nodiscard]] std::uint64_t HashOf(std::uint64_t seed, std::int64_t x, std::int64_t y);

// Uniform in [0, 1).
[[nodiscard]] double UniformAt(std::uint64_t seed, std::int64_t x, std::int64_t y);

// Standard normal, independent from place to place.
[[nodiscard]] double NormalAt(std::uint64_t seed, std::int64_t x, std::int64_t y);

// Smooth noise of period 1 in [-1, 1]: random values on the integer grid, joined by C1 cubic steps.
[[nodiscard]] double SmoothNoise(std::uint64_t seed, double x, double y);

// Sum of `octaves` smooth noises, each of half the period and half the strength of the one before.
[[nodiscard]] double FractalNoise(std::uint64_t seed, double x, double y, int octaves);

}  // namespace bladecurve::render
