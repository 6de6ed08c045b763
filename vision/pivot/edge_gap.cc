// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/edge_gap.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace bladecurve {

EdgeGap GapBetween(const EdgeAboutLine& first, const EdgeAboutLine& second) {
  EdgeGap gap;
  for (std::size_t i = 0; i < first.along.size(); ++i) {
    const auto after = std::lower_bound(second.along.begin(), second.along.end(), first.along[i]);
    if (after == second.along.begin() || after == second.along.end()) continue;
    const auto k = static_cast<std::size_t>(after - second.along.begin());
    const double t =
        (first.along[i] - second.along[k - 1]) / (second.along[k] - second.along[k - 1]);
    gap.along.push_back(first.along[i]);
    gap.apart.push_back(first.aside[i] - std::lerp(second.aside[k - 1], second.aside[k], t));
  }
  return gap;
}

Eigen::Vector3d GapCourse::PowersAt(double along) const {
  const double t = (along - origin) / length;
  return {1, t, t * t};
}

void GapCourse::Fit(const EdgeGap& gap,
                    Eigen::Index terms,
                    const std::function<bool(std::size_t)>& counts) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < gap.along.size(); ++i) {
    if (!counts(i)) continue;
    const Eigen::Vector3d row = PowersAt(gap.along[i]);
    normal += row * row.transpose();
    moments += row * gap.apart[i];
  }
  powers.head(terms) = normal.topLeftCorner(terms, terms).ldlt().solve(moments.head(terms));
}

}  // namespace bladecurve
