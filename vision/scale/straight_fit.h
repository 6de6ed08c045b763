// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vision/scale/straight_band.h"

namespace bladecurve {

// Illumination may fall off along the edge, but counts as even across the band: a slope of s a
// pixel moves the edge by 1.4 s blur^2, 0.003 px for a strong 0.002, whereas solving for it would
// double the scatter.
enum StraightParameter { kOffset, kAngle, kDark, kContrast, kEdgeBlur, kAlong };
inline constexpr int kStraightParameters = 6;
using StraightVector = Eigen::Matrix<double, kStraightParameters, 1>;
using StraightMatrix = Eigen::Matrix<double, kStraightParameters, kStraightParameters>;

struct StraightFit {
  StraightVector parameters = StraightVector::Zero();
  StraightMatrix covariance = StraightMatrix::Zero();
  double mean_square = 0;
  size_t count = 0;  // of pixels
};

// Light of the bright side.
[[nodiscard]] double BrightSide(const StraightVector& parameters);

// Offset and angle from where the light crosses the middle between its levels in the parts of the
// edge, levels from the band's rims. std::nullopt for edges hidden along half their length.
[[nodiscard]] std::optional<StraightVector> StartOf(const std::vector<BandSample>& samples,
                                                    const StraightEdgeBand& band);

// Levenberg-Marquardt. Near white also with a bright side beyond white, of which the picture shows
// the lower part of the step alone. std::nullopt if it leaves the band.
[[nodiscard]] std::optional<StraightFit> RefineStraight(const std::vector<BandSample>& samples,
                                                        const StraightEdgeBand& band,
                                                        const StraightVector& start);

// Leaves out the pieces along the edge that fit much worse than the typical one: something lies
// over them.
[[nodiscard]] std::vector<BandSample> WithoutCovered(const std::vector<BandSample>& samples,
                                                     const StraightEdgeBand& band,
                                                     const StraightVector& parameters);

}  // namespace bladecurve
