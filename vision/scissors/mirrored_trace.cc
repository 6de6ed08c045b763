// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/mirrored_trace.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "vision/image/bilinear.h"
#include "vision/image/blurred_step.h"
#include "vision/image/robust_statistics.h"
#include "vision/parallel.h"
#include "vision/scissors/edge_doubt.h"

namespace bladecurve {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int kParts = 10;      // of the trace, each with a break in the light of its own
constexpr double kTapPx = 0.5;  // across the trace
constexpr int kHalfTaps = 10;
constexpr int kTaps = 2 * kHalfTaps + 1;
constexpr double kStepPx = 0.5;  // of the trace's end, from one direction of the mirror to the next

// Where the other edge's mirror image lies.
using Trace = std::vector<LocatedEdgePoint>;

// A run of points of a trace.
struct Part {
  std::size_t first = 0, end = 0;
};

// Clear of the crotch and of the tip.
Part PartOf(std::size_t points, int index) {
  const auto place = [&](double part) {
    return static_cast<std::size_t>(static_cast<double>(points) * part / (kParts + 1));
  };
  return {place(index + 0.5), place(index + 1.5)};
}

Vector2d MiddleOf(const Trace& trace, const Part& part) {
  return trace[(part.first + part.end) / 2].trend_px;
}

// How far outwards of an edge a place lies.
double OutsideBy(const LocatedBlade& blade, const Vector2d& place) {
  const auto nearest =
      std::min_element(blade.used.begin(), blade.used.end(), [&](const auto& a, const auto& b) {
        return (a.point_px - place).squaredNorm() < (b.point_px - place).squaredNorm();
      });
  return (place - nearest->point_px).dot(nearest->normal);
}

// Whether a place lies abreast of what was found of an edge: before and beyond that its own line
// may be seen again.
bool IsAbreast(const LocatedBlade& blade, const Vector2d& place) {
  const Vector2d &first = blade.used.front().point_px, &last = blade.used.back().point_px;
  const Vector2d along = last - first;
  return (place - first).dot(along) >= 0 && (place - last).dot(along) <= 0;
}

// The taps that count, [first, end).
struct Taps {
  int first = 0, end = kTaps;
  [[nodiscard]] int Count() const { return end - first; }
};

double PlaceOf(int tap) { return (tap - kHalfTaps) * kTapPx; }

// Tells a border, at which light steps, or also where it begins to slope, from light that bends
// smoothly there, be the light beside it straight or bent.
class BorderTest {
 public:
  explicit BorderTest(double blur_px) : smooth_(kTaps, 4), borders_(kTaps, 2) {
    for (int k = 0; k < kTaps; ++k) {
      const double t = PlaceOf(k);
      smooth_.row(k) << 1, t, t * t, t * t * t;
      borders_.row(k) << BlurredPower(t, 0, blur_px), BlurredPower(t, 1, blur_px);
    }
  }

  // ln of the odds for the border.
  [[nodiscard]] double LogOdds(const VectorXd& light, const Taps& taps, bool may_slope) {
    constexpr double kIndependent = 8;  // of all taps, neighbours being alike by the blur
    constexpr double kLeastSquares = 1e-7;
    const double independent = kIndependent * taps.Count() / kTaps;
    const VectorXd seen = light.segment(taps.first, taps.Count());
    const auto left = [&](const MatrixXd& basis) {
      return seen.squaredNorm() - (basis.transpose() * seen).squaredNorm() + kLeastSquares;
    };
    double most = -std::numeric_limits<double>::infinity();
    for (const Rivals& rivals : RivalsOver(taps)) {
      const double step = left(rivals.stepped);
      const double border = may_slope ? std::min(step, left(rivals.sloped)) : step;
      most = std::max(most, 0.5 * independent * std::log(left(rivals.smooth) / border));
    }
    return most;
  }

 private:
  // Orthonormal bases of as many functions.
  struct Rivals {
    MatrixXd smooth, stepped, sloped;
  };

  const std::vector<Rivals>& RivalsOver(const Taps& taps) {
    std::vector<Rivals>& all = rivals_[{taps.first, taps.end}];
    if (!all.empty()) return all;
    const auto basis = [&](const MatrixXd& functions) {
      const Eigen::HouseholderQR<MatrixXd> qr(functions.middleRows(taps.first, taps.Count()));
      return MatrixXd(qr.householderQ() * MatrixXd::Identity(taps.Count(), functions.cols()));
    };
    for (const Eigen::Index powers : {2, 3}) {
      const auto bordered = [&](Eigen::Index border) {
        MatrixXd functions(kTaps, powers + 1);
        functions << smooth_.leftCols(powers), borders_.col(border);
        return basis(functions);
      };
      all.push_back({basis(smooth_.leftCols(powers + 1)), bordered(0), bordered(1)});
    }
    return all;
  }

  MatrixXd smooth_, borders_;  // what light may do across a trace, a column each
  std::map<std::pair<int, int>, std::vector<Rivals>> rivals_;  // of the taps that were asked for
};

// Linear light across part of a trace, median along it.
VectorXd ProfileAcross(const BladeView& view, const Trace& trace, const Part& part) {
  const std::array<float, 256>& linear = view.scale().tone.linear;
  VectorXd profile(kTaps);
  std::vector<double> along;
  for (int k = 0; k < kTaps; ++k) {
    along.clear();
    for (std::size_t i = part.first; i < part.end; ++i) {
      const Vector2d at = trace[i].trend_px + (k - kHalfTaps) * kTapPx * trace[i].normal;
      along.push_back(
          Bilinear<uchar>(view.photo().grey(), at, [&](uchar grey) { return linear[grey]; }));
    }
    profile[k] = Median(along);
  }
  return profile;
}

// Whether near its end a trace lies further outwards of the inner edge than the two edges differ
// by. A bevel's line nears the border towards the tip.
bool LeavesEnd(const Trace& trace, const LocatedBlade& inner, double difference_px) {
  constexpr double kMost = 1.5, kNearestPx = 2;  // of the difference
  const Vector2d near_end = MiddleOf(trace, PartOf(trace.size(), kParts - 1));
  return OutsideBy(inner, near_end) > kMost * difference_px + kNearestPx;
}

// Those from so far inwards to so far outwards.
Taps TapsWithin(double inwards_px, double outwards_px) {
  const auto count = [](double px) { return std::min(kHalfTaps, static_cast<int>(px / kTapPx)); };
  return {kHalfTaps - count(inwards_px), kHalfTaps + count(outwards_px) + 1};
}

// What speaks for a trace as a whole, or is asked of it.
struct Support {
  double log_odds = 0;
  int parts = 0;  // that speak for it

  [[nodiscard]] bool Meets(const Support& demand) const {
    return log_odds >= demand.log_odds && parts >= demand.parts;
  }
};

// Whether light is somewhere as white as the picture can store: how it goes on there is not known.
bool IsOverexposed(const BladeView& view, const VectorXd& light) {
  constexpr int kWhite = 254;  // grey
  return light.maxCoeff() >= static_cast<double>(view.scale().tone.linear[kWhite]);
}

// The light across part of a trace, and how much of it says something of the trace: a line that was
// found is not to be seen again, nor the other blade.
struct SeenPart {
  VectorXd light;
  Taps taps;
};

std::vector<SeenPart> PartsSeen(const BladeView& view,
                                const Trace& trace,
                                const LocatedBlade& inner,
                                const LocatedBlade& other) {
  constexpr double kClearPx = 1.5, kLeastBesidePx = 1;
  std::vector<SeenPart> seen;
  for (int index = 0; index < kParts; ++index) {
    const Part part = PartOf(trace.size(), index);
    const Vector2d middle = MiddleOf(trace, part);
    if (!IsAbreast(inner, middle)) continue;
    const double inwards = OutsideBy(inner, middle) - kClearPx;
    const double outwards = OutsideBy(other, middle) - kClearPx;
    if (std::min(inwards, outwards) < kLeastBesidePx) continue;
    VectorXd light = ProfileAcross(view, trace, part);
    const Taps taps = TapsWithin(inwards, outwards);
    if (IsOverexposed(view, light.segment(taps.first, taps.Count()))) continue;
    seen.push_back({std::move(light), taps});
  }
  return seen;
}

// No part decides alone.
Support SupportOf(const std::vector<SeenPart>& parts, bool may_slope, BorderTest* test) {
  constexpr double kLeast = -1, kMost = 8, kSpeaks = 1;
  Support support;
  for (const SeenPart& part : parts) {
    const double log_odds = test->LogOdds(part.light, part.taps, may_slope);
    support.log_odds += std::clamp(log_odds, kLeast, kMost);
    if (log_odds > kSpeaks) ++support.parts;
  }
  return support;
}

// Mean and spread of what rises above half of the best support, in steps.
struct Peak {
  double place = 0, sigma = 0;
};

Peak PeakAbout(const std::vector<Support>& supports, std::ptrdiff_t best) {
  constexpr std::ptrdiff_t kReach = 4;
  const double half = 0.5 * supports[static_cast<std::size_t>(best)].log_odds;
  const auto count = static_cast<std::ptrdiff_t>(supports.size());
  double sum = 0, moment = 0, squares = 0;
  for (auto i = std::max(best - kReach, std::ptrdiff_t{0}); i < std::min(best + kReach + 1, count);
       ++i) {
    const double weight = std::max(0.0, supports[static_cast<std::size_t>(i)].log_odds - half);
    const auto place = static_cast<double>(i);
    sum += weight;
    moment += weight * place;
    squares += weight * place * place;
  }
  const double mean = moment / sum;
  return {mean, std::sqrt(std::max(1.0, squares / sum - mean * mean))};
}

// What speaks most for another border.
double NextBest(const std::vector<Support>& supports, std::ptrdiff_t best) {
  constexpr double kApartPx = 4;  // nearer, it is the same one
  double next = 0;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const double apart_px = kStepPx * std::abs(static_cast<double>(i) - static_cast<double>(best));
    if (apart_px >= kApartPx) next = std::max(next, supports[i].log_odds);
  }
  return next;
}

// A trace as it is seen.
struct SeenTrace {
  std::vector<SeenPart> parts;
  bool leaves_end = false;
};

}  // namespace

std::optional<MirroredTrace> FindMirroredTrace(const BladeView& view,
                                               const LocatedBlade& inner,
                                               const LocatedBlade& other,
                                               const MirrorLine& line,
                                               double difference_px) {
  constexpr double kOfDifference = 2, kNearestPx = 4;  // how far the trace's end may be off
  constexpr double kClearly = 2;                       // times the next best
  constexpr double kUsualBlurPx = 0.8;
  const Support demand{8, 4};
  const double blur_px = std::hypot(BlurOr(other.edge, kUsualBlurPx), 0.3);  // and the pixel's box
  const double reach_px = (other.end.point_px - line.map.ImageFromPlane(line.pivot)).norm();
  const auto farthest = static_cast<int>((kOfDifference * difference_px + kNearestPx) / kStepPx);
  const auto turned = [&](double step) { return line.TurnedBy(step * kStepPx / reach_px); };
  const std::vector<SeenTrace> traces = ParallelMap(2 * farthest + 1, [&](int step) {
    const Trace trace = turned(step - farthest).Reflected(other.used);
    return SeenTrace{PartsSeen(view, trace, inner, other), LeavesEnd(trace, inner, difference_px)};
  });
  BorderTest test(blur_px);
  for (const bool may_slope : {false, true}) {
    std::vector<Support> supports;
    bool is_seen_beyond = false;
    for (const SeenTrace& trace : traces) {
      const Support support = SupportOf(trace.parts, may_slope, &test);
      is_seen_beyond |= trace.leaves_end && support.Meets(demand);
      supports.push_back(trace.leaves_end ? Support{} : support);
    }
    const auto best = std::max_element(
        supports.begin(), supports.end(), [](auto& a, auto& b) { return a.log_odds < b.log_odds; });
    const double next = NextBest(supports, best - supports.begin());
    if (best->Meets(demand) && best->log_odds >= kClearly * next) {
      const Peak peak = PeakAbout(supports, best - supports.begin());
      // Halfway along the blade the trace moves half as far as its end.
      return MirroredTrace{turned(peak.place - farthest), 0.5 * kStepPx * peak.sigma};
    }
    if (is_seen_beyond) break;  // beside a step light slopes as well
  }
  return std::nullopt;
}

}  // namespace bladecurve
