// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/deformation_ramp.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bladecurve {
namespace {

// Moments of some rows about a common origin.
struct Moments {
  double n = 0, d = 0, dd = 0, y = 0, dy = 0, yy = 0;
};

Moments Difference(const Moments& a, const Moments& b) {
  return {a.n - b.n, a.d - b.d, a.dd - b.dd, a.y - b.y, a.dy - b.dy, a.yy - b.yy};
}

// Rows in ascending deflection with their cumulated moments, so that a ramp is judged in O(log
// rows) wherever it bends.
class Rows {
 public:
  Rows(std::vector<DeformationRow> rows, double origin_mm) : cumulated_(rows.size() + 1) {
    for (DeformationRow& row : rows) row.delta_mm -= origin_mm;
    std::sort(rows.begin(), rows.end(), [](const DeformationRow& a, const DeformationRow& b) {
      return a.delta_mm < b.delta_mm;
    });
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double d = rows[i].delta_mm, y = rows[i].force_n;
      const Moments& m = cumulated_[i];
      cumulated_[i + 1] = {m.n + 1, m.d + d, m.dd + d * d, m.y + y, m.dy + d * y, m.yy + y * y};
      deltas_.push_back(d);
    }
  }

  // Of the rows with low <= delta < high.
  [[nodiscard]] Moments Between(double low, double high) const {
    return Difference(cumulated_[Index(high)], cumulated_[Index(low)]);
  }

  [[nodiscard]] const Moments& All() const { return cumulated_.back(); }

 private:
  [[nodiscard]] std::size_t Index(double delta) const {
    return static_cast<std::size_t>(std::lower_bound(deltas_.begin(), deltas_.end(), delta) -
                                    deltas_.begin());
  }

  std::vector<double> deltas_;
  std::vector<Moments> cumulated_;  // of the rows before each
};

struct Judged {
  double squares = std::numeric_limits<double>::infinity();  // of the residuals
  DeformationRamp ramp;
};

// The best slopes for given bends; none where the force does not rise up to the start of the cut,
// and more steeply than after it. With a = delta - contact, limited to [0, width], and
// b = max(0, delta - contact - width), the ramp is k a + m b: two normal equations.
Judged Judge(const Rows& rows, double contact, double width) {
  constexpr double kEverything = std::numeric_limits<double>::infinity();
  const double start = contact + width;
  const Moments rise = rows.Between(contact, start), line = rows.Between(start, kEverything);
  const double line_b = line.d - line.n * start;
  const double aa =
      rise.dd - 2 * contact * rise.d + rise.n * contact * contact + line.n * width * width;
  const double ab = width * line_b;
  const double bb = line.dd - 2 * start * line.d + line.n * start * start;
  const double ay = rise.dy - contact * rise.y + width * line.y;
  const double by = line.dy - start * line.y;
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > 0)) return {};
  const double k = (bb * ay - ab * by) / determinant;
  const double m = (aa * by - ab * ay) / determinant;
  if (!(k > 0) || m >= k) return {};
  return {rows.All().yy - k * ay - m * by, {contact, width, k, static_cast<int>(rise.n)}};
}

struct Range {
  double low = 0, high = 0;
};

Range Around(Range range, double middle, int cells) {
  const double reach = 1.5 * (range.high - range.low) / cells;
  return {middle - reach, middle + reach};
}

}  // namespace

// A grid over the two bends, refined about its best node again and again: the sum of squares has
// kinks and more than one minimum, so that descending on it would not do.
DeformationRamp FitDeformationRamp(std::vector<DeformationRow> rows, const RampSearch& search) {
  constexpr int kCells = 11, kRefinements = 9;  // to 1e-5 of the first range
  constexpr double kParameters = 4;             // two bends, two slopes
  const Rows sorted(std::move(rows), search.middle_mm);
  Range contact{-2.5 * search.width_mm, search.width_mm};
  Range log_width{std::log(0.1 * search.width_mm), std::log(3 * search.width_mm)};
  Judged best;
  double least = std::numeric_limits<double>::infinity();
  for (int refinement = 0; refinement < kRefinements; ++refinement) {
    for (int i = 0; i <= kCells; ++i) {
      for (int j = 0; j <= kCells; ++j) {
        const double c = std::lerp(contact.low, contact.high, static_cast<double>(i) / kCells);
        const double w = std::lerp(log_width.low, log_width.high, static_cast<double>(j) / kCells);
        const Judged judged = Judge(sorted, c, std::exp(w));
        const double offset = c + search.middle_mm;
        const double cost = judged.squares + search.contact_weight * offset * offset;
        if (!(cost < least)) continue;
        least = cost;
        best = judged;
      }
    }
    contact = Around(contact, best.ramp.contact_mm, kCells);
    log_width = Around(log_width, std::log(best.ramp.width_mm), kCells);
  }
  best.ramp.contact_mm += search.middle_mm;
  best.ramp.noise_n =
      std::sqrt(std::max(best.squares, 0.0) / std::max(sorted.All().n - kParameters, 1.0));
  return best.ramp;
}

}  // namespace bladecurve
