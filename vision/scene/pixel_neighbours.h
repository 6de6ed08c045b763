// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// Calls visit(q) for each of the up to four neighbours q of pixel p, both numbered row by row.
template <typename Visit>
void ForNeighbours(const cv::Size& size, int p, const Visit& visit) {
  const int column = p % size.width;
  if (column > 0) visit(p - 1);
  if (column + 1 < size.width) visit(p + 1);
  if (p >= size.width) visit(p - size.width);
  if (p + size.width < size.area()) visit(p + size.width);
}

// Of these those that come later than p: every pair of neighbours once.
template <typename Visit>
void ForLaterNeighbours(const cv::Size& size, int p, const Visit& visit) {
  if (p % size.width + 1 < size.width) visit(p + 1);
  if (p + size.width < size.area()) visit(p + size.width);
}

}  // namespace bladecurve
