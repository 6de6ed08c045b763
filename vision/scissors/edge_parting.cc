// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/edge_parting.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "vision/edge/edge_curve.h"
#include "vision/pivot/edge_gap.h"
#include "vision/refused.h"
#include "vision/scissors/edge_difference.h"
#include "vision/scissors/gap_trend.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// An edge's inlying points about the mirror line, in units of the plane map.
struct Profile : EdgeAboutLine {
  std::vector<std::size_t> index;  // of the point in the edge
  double side = 1;                 // of the line, left positive
};

Profile ProfileOf(const MirrorLine& line, const LocatedBlade& blade) {
  const Vector2d across = line.Across();
  const auto offset = [&](const Vector2d& px) {
    return Vector2d(line.map.PlaneFromImage(px) - line.pivot);
  };
  Profile profile;
  profile.side = std::copysign(1.0, offset(blade.used.back().trend_px).dot(across));
  for (std::size_t i = 0; i < blade.edge.points.size(); ++i) {
    if (!blade.edge.points[i].inlier) continue;
    const Vector2d p = offset(blade.edge.points[i].trend_px);
    if (!profile.along.empty() && p.dot(line.direction) <= profile.along.back()) continue;
    profile.along.push_back(p.dot(line.direction));
    profile.aside.push_back(profile.side * p.dot(across));
    profile.index.push_back(i);
  }
  return profile;
}

// The points of an edge from one place along the mirror line to another.
PointRange Between(const Profile& profile, double from, double to) {
  const auto first = std::lower_bound(profile.along.begin(), profile.along.end(), from);
  const auto last = std::upper_bound(first, profile.along.end(), to);
  const auto at = [&](auto place) {
    const std::ptrdiff_t k = place - profile.along.begin();
    return profile.index[std::min(static_cast<std::size_t>(k), profile.index.size() - 1)];
  };
  return {at(first), at(first == last ? last : std::prev(last))};
}

// How much of an edge lies there.
double ShareBetween(const Profile& profile, double from, double to) {
  const auto there = std::count_if(profile.along.begin(), profile.along.end(), [&](double along) {
    return along >= from && along <= to;
  });
  return static_cast<double>(there) / static_cast<double>(profile.along.size());
}

// Whether an end of either edge was cut off.
struct WasCut {
  bool upper = false, lower = false;
};

// Both edges about the mirror line, and where they part.
class PartingComparison {
 public:
  PartingComparison(const MirrorLine& line, Blades* blades) : line_(line), blades_(*blades) {
    TakeProfiles();
    gap_ = GapBetween(upper_, lower_);
  }

  // Marks the points beyond as strays. The gap between blades that are bent to one side, which are
  // no mirror images, follows a parabola.
  WasCut CutEnds() {
    constexpr std::size_t kFewest = 60;                // points; fewer have no middle to go by
    constexpr double kCloser = 1.0 / 3, kFewer = 0.5;  // of the straight line's scatter and strays
    if (gap_.along.size() < kFewest) return {};
    trend_ = TrendOf(gap_, 2);
    Parting parting = PartingOff(trend_);
    if (parting.Count() == 0) return {};
    const Trend bent = TrendOf(gap_, 3);
    const Parting from_bent = PartingOff(bent);
    if (bent.scatter < kCloser * trend_.scatter && from_bent.Count() < kFewer * parting.Count()) {
      trend_ = bent;
      parting = from_bent;
    }
    const WasCut tip = CutTip(parting.tip);
    const WasCut crotch = CutCrotch(parting.crotch);
    TakeProfiles();
    return {tip.upper || crotch.upper, tip.lower || crotch.lower};
  }

  // Where the lower edge says that the upper one goes on towards the tip, and the other way round.
  [[nodiscard]] std::vector<Vector2d> BeyondUpper() const { return Beyond(upper_, lower_, 1); }
  [[nodiscard]] std::vector<Vector2d> BeyondLower() const { return Beyond(lower_, upper_, -1); }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr std::size_t kSeen = 5;  // places of the gap; fewer may be chance

  void TakeProfiles() {
    upper_ = ProfileOf(line_, blades_.upper);
    lower_ = ProfileOf(line_, blades_.lower);
  }

  [[nodiscard]] Parting PartingOff(const Trend& trend) const {
    constexpr double kTolerancePx = 1, kScatters = 4;
    const Vector2d pivot_px = line_.map.ImageFromPlane(line_.pivot);
    const double per_px = std::sqrt(std::abs(line_.map.JacobianAt(pivot_px).determinant()));
    return PartingFrom(trend, kTolerancePx * per_px + kScatters * trend.scatter);
  }

  // A tenth of the gap from either end, which the course of what is kept does not need.
  [[nodiscard]] std::size_t Margin() const { return gap_.along.size() / 10; }

  WasCut CutTip(std::size_t count) {
    if (count < kSeen) return {};
    const double from = gap_.along[gap_.along.size() - 1 - count];
    return Cut({gap_.along[Margin()], from}, {from, gap_.along.back()}, {from, kInfinity});
  }

  WasCut CutCrotch(std::size_t count) {
    if (count < kSeen) return {};
    const double to = gap_.along[count];
    return Cut({to, gap_.along[gap_.along.size() - 1 - Margin()]},
               {gap_.along.front(), to},
               {-kInfinity, to});
  }

  // From one place along the mirror line to another.
  struct Stretch {
    double from = 0, to = 0;
  };

  // Cuts off the edge that leaves its own course there, or off both. Continued further, a course
  // says little; edges that part over so much are no mirror images.
  WasCut Cut(const Stretch& kept, const Stretch& parting, const Stretch& strays) {
    constexpr double kMost = 0.35;    // of the edge that is cut
    constexpr double kClearly = 1.5;  // times as far
    const auto leaves_by = [&](const Profile& profile, const LocatedBlade& blade) {
      return LeavesCourseBy(blade.edge.points,
                            Between(profile, kept.from, kept.to),
                            Between(profile, parting.from, parting.to));
    };
    const auto cut = [&](const Profile& profile, LocatedBlade* blade) {
      if (ShareBetween(profile, strays.from, strays.to) == 0) return;
      const PointRange range = Between(profile, strays.from, strays.to);
      for (std::size_t i = range.first; i <= range.last; ++i) blade->edge.points[i].inlier = false;
    };
    const double upper = leaves_by(upper_, blades_.upper), lower = leaves_by(lower_, blades_.lower);
    const WasCut was_cut{upper > lower / kClearly, lower > upper / kClearly};
    const auto too_much = [&](const Profile& profile) {
      return ShareBetween(profile, strays.from, strays.to) > kMost;
    };
    if ((was_cut.upper && too_much(upper_)) || (was_cut.lower && too_much(lower_))) {
      blades_.edges_part = true;
      return {};
    }
    if (was_cut.upper) cut(upper_, &blades_.upper);
    if (was_cut.lower) cut(lower_, &blades_.lower);
    return was_cut;
  }

  [[nodiscard]] std::vector<Vector2d> Beyond(const Profile& own,
                                             const Profile& other,
                                             double sign) const {
    std::vector<Vector2d> points;
    for (std::size_t i = 0; i < other.along.size(); ++i) {
      const double along = other.along[i];
      if (along <= own.along.back()) continue;
      points.push_back(
          line_.At(along, own.side * (other.aside[i] + sign * trend_.course.At(along))));
    }
    return points;
  }

  MirrorLine line_;
  Blades& blades_;
  Profile upper_, lower_;
  EdgeGap gap_;
  Trend trend_;
};

// Cuts the ends and trims what is left. Throws Refused where that is too little.
WasCut CutAndTrim(const BladeView& view, const Pivot& pivot, Blades* blades) {
  PartingComparison comparison(LineBetween(view, pivot, *blades), blades);
  const WasCut was_cut = comparison.CutEnds();
  if (was_cut.upper) TrimToFree(view, &blades->upper, comparison.BeyondUpper());
  if (was_cut.lower) TrimToFree(view, &blades->lower, comparison.BeyondLower());
  return was_cut;
}

}  // namespace

void CutWhereEdgesPart(const BladeView& view, const Pivot& pivot, Blades* blades) {
  if (!AssumesMirror(view, pivot) || pivot.bent) return;
  const bool may_agree =
      KnowsMirror(view, pivot) ? !AreUnlike(pivot.asymmetry) : AreAlike(pivot.asymmetry);
  if (!may_agree) return;
  Blades cut = *blades;
  try {
    CutAndTrim(view, pivot, &cut);
    *blades = std::move(cut);
  } catch (const Refused&) {
    blades->edges_part = cut.edges_part;
  }
}

void CutUnlikeEnds(const BladeView& view, Pivot* pivot, Blades* blades) {
  constexpr double kLeft = 0.3;  // of the difference
  if (!AssumesMirror(view, *pivot) || pivot->bent || !AreUnlike(pivot->asymmetry)) return;
  Blades cut = *blades;
  try {
    const WasCut was_cut = CutAndTrim(view, *pivot, &cut);
    if (!was_cut.upper && !was_cut.lower) return;
    const double asymmetry = AsymmetryOf(view, *pivot, cut.upper, cut.lower);
    if (!AreAlike(asymmetry) || std::abs(asymmetry) > kLeft * std::abs(pivot->asymmetry)) return;
    pivot->asymmetry = asymmetry;
    *blades = std::move(cut);
  } catch (const Refused&) {
    return;  // too little would be left
  }
}

}  // namespace bladecurve
