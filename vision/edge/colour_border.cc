// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/colour_border.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "vision/image/chroma.h"
#include "vision/image/cross.h"
#include "vision/image/pixel_light.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// An edge is looked at in so many stretches, each averaged along its length.
constexpr int kStretches = 12;

struct Stretch {
  std::size_t first, last;  // points of the edge, `last` excluded
};

Stretch StretchOf(const LocatedEdge& edge, int k) {
  const auto begin = [&](int i) {
    return edge.points.size() * static_cast<std::size_t>(i) / kStretches;
  };
  return {begin(k), begin(k + 1)};
}

// Linear light (BGR) across a stretch, a row every pixel of the reduced picture.
struct Profile {
  int inner = 0, outer = 0;  // rows within the blade and outside
  std::vector<Vector3d> rows;

  [[nodiscard]] const Vector3d& At(int across) const {
    return rows[static_cast<std::size_t>(across + inner)];
  }
  // Of the rows from..to, as far as there are any.
  [[nodiscard]] Vector3d Mean(int from, int to) const {
    Vector3d sum = Vector3d::Zero();
    from = std::clamp(from, -inner, outer);
    to = std::clamp(to, -inner, outer);
    for (int v = from; v <= to; ++v) sum += At(v);
    return sum / (to - from + 1);
  }
};

// `light` without what is of the colour of `other`: no shade of that accounts for the rest.
Vector3d Apart(const Vector3d& light, const Vector3d& other) {
  constexpr double kBlack = 1e-9;
  return light - other * (light.dot(other) / std::max(other.squaredNorm(), kBlack));
}

// Where, going inwards over the rows from..to, the light along `apart` passes half of `level`.
double HalfWay(const Profile& profile, const Vector3d& apart, double level, int from, int to) {
  const auto above = [&](int v) { return profile.At(v).dot(apart) - 0.5 * level; };
  for (int v = from; v > to; --v) {
    if ((above(v) >= 0) != (above(v - 1) >= 0)) return v - above(v) / (above(v) - above(v - 1));
  }
  return above(from) >= 0 ? to : from;
}

// Where a profile, going inwards, leaves the ground's colour for the blade's; rows from the edge.
// Colours mix half and half nearer to the darker side, the blade's light comes up late where the
// blade is dim at its border, and the ground's goes early where a shadow begins: the border lies
// among the three.
struct Transition {
  double of_colour = 0, of_blades_light = 0, of_grounds_light = 0;
  double way = 0;     // between the two chromas
  int outermost = 0;  // row that was looked at

  // How far off the edge it lies for certain: inwards, the middle one of the three, as a shadow
  // beside a blade spreads them that way; outwards, the nearest. 0 if not for certain.
  [[nodiscard]] double Certain() const {
    std::array three{of_colour, of_blades_light, of_grounds_light};
    std::sort(three.begin(), three.end());
    return three[1] < 0 ? three[1] : std::max(three[0], 0.0);
  }
};

// Whether what has the ground's colour between the edge and a border further in lies in shadow:
// darker than the ground outside, and all the more the nearer to the blade. A bevel that mirrors
// the ground is brighter than what lies before it in the blade's own shadow. True where the two
// are too close to tell.
bool LiesInShadow(const Profile& profile, double border) {
  constexpr int kBeside = 3;      // rows
  constexpr double kEven = 1.05;  // ratio of light
  const int first = static_cast<int>(std::ceil(border)) + 1, middle = first / 2;
  if (first > -2) return true;
  const double outside = profile.Mean(1, kBeside).sum();
  const double outer = profile.Mean(middle, -1).sum(),
               inner = profile.Mean(first, middle - 1).sum();
  return outside > kEven * outer && inner < kEven * outer;
}

// widest_bevel: rows; what mirrors the ground is no wider.
std::optional<Transition> TransitionIn(const Profile& profile,
                                       double widest_bevel,
                                       double told_apart) {
  constexpr double kAlone = 0.7;                   // of the profile: beyond, ground or blade alone
  constexpr double kGround = 0.25, kBlade = 0.75;  // of the way from ground to blade
  constexpr double kStillBlade = 0.4, kStillBevel = 0.2;  // which mirrors some of the ground
  constexpr double kPlainWhite = 0.95;    // beside it, a faint colour is what was cut off
  constexpr int kSlowest = 5;             // rows; a slower change is that of a mirrored ground
  constexpr int kBeside = 2, kPlain = 4;  // rows from the transition, where light is plain
  const int outer = profile.outer, inner = -profile.inner;
  const int blade_from = -static_cast<int>(kAlone * profile.inner);
  const Vector3d ground = profile.Mean(static_cast<int>(kAlone * outer), outer);
  const Vector3d blade = profile.Mean(inner, blade_from);
  const Chroma of_ground = ChromaOf(ground), way = ChromaOf(blade) - of_ground;
  if (way.norm() < told_apart) return std::nullopt;
  if (way.norm() < kToldApart && ground.maxCoeff() > kPlainWhite) return std::nullopt;
  const auto share = [&](int v) {
    return (ChromaOf(profile.At(v)) - of_ground).dot(way) / way.squaredNorm();
  };
  int last_ground = outer;
  while (last_ground > inner && share(last_ground) < kGround) --last_ground;
  int first_blade = last_ground;
  while (first_blade > inner && share(first_blade) < kBlade) --first_blade;
  if (last_ground == outer || first_blade <= blade_from || last_ground - first_blade > kSlowest)
    return std::nullopt;
  for (int v = first_blade; v >= inner; --v) {
    if (share(v) < (v > 0 ? kStillBevel : kStillBlade)) return std::nullopt;
  }
  const int from = std::min(last_ground + kPlain, outer);
  const int to = std::max(first_blade - kPlain, inner);
  const Vector3d blades = Apart(blade, ground), grounds = Apart(ground, blade);
  const double blades_level = profile.Mean(first_blade - kPlain, first_blade - kBeside).dot(blades);
  const double grounds_level =
      profile.Mean(last_ground + kBeside, last_ground + kPlain).dot(grounds);
  const Transition found{0.5 * (last_ground + first_blade + 1),
                         HalfWay(profile, blades, blades_level, from, to),
                         HalfWay(profile, grounds, grounds_level, from, to),
                         way.norm(),
                         outer};
  const bool may_be_mirrored = found.Certain() < 0 && found.of_colour > -widest_bevel;
  if (may_be_mirrored && !LiesInShadow(profile, found.of_colour)) return std::nullopt;
  return found;
}

// An edge in the reduced picture.
struct EdgeInColours {
  const ReducedColours& colours;
  const ToneCurve& tone;
  const LocatedEdge& edge;
  double blade_px;  // of the photograph
  double told_apart;

  // std::nullopt where much of it is out of the picture.
  [[nodiscard]] std::optional<Profile> ProfileAcross(const Stretch& stretch,
                                                     int inner,
                                                     int outer) const {
    Profile profile{inner, outer, {}};
    for (int across = -inner; across <= outer; ++across) {
      Vector3d sum = Vector3d::Zero();
      std::size_t count = 0;
      for (std::size_t i = stretch.first; i < stretch.last; ++i) {
        const LocatedEdgePoint& point = edge.points[i];
        const auto light =
            LightAt(colours.bgr, tone, colours.Reduced(point.trend_px) + across * point.normal);
        if (!light) continue;
        sum += *light;
        ++count;
      }
      if (2 * count <= stretch.last - stretch.first) return std::nullopt;
      profile.rows.emplace_back(sum / static_cast<double>(count));
    }
    return profile;
  }

  [[nodiscard]] std::optional<Transition> TransitionOver(const Stretch& stretch,
                                                         int inner,
                                                         int outer) const {
    constexpr double kWidestBevel = 0.3;  // of the blade's width
    const auto profile = ProfileAcross(stretch, inner, outer);
    return profile ? TransitionIn(*profile, kWidestBevel * blade_px / colours.px, told_apart)
                   : std::nullopt;
  }

  // As wide outside as within, where there is room.
  [[nodiscard]] std::optional<Transition> TransitionNear(const Stretch& stretch,
                                                         std::initializer_list<int> reaches,
                                                         int most_outer) const {
    for (const int rows : reaches) {
      if (auto found = TransitionOver(stretch, rows, std::min(rows, most_outer))) return found;
    }
    return std::nullopt;
  }

  // Blades taper: where much of a blade's width is too much, less of it is looked at; where a wide
  // shadow passes for part of it, nearly all; and where a wide bevel passes for ground, from which
  // the blade is then less unlike than from what lies beyond, most of the gap.
  [[nodiscard]] std::optional<Transition> TransitionAcross(const Stretch& stretch,
                                                           double gap_px) const {
    constexpr double kMuch = 0.65, kLess = 0.3, kNearlyAll = 0.95;  // of the blade's width
    constexpr double kOfGap = 0.6;
    constexpr int kLeast = 6;            // rows
    constexpr double kMoreUnlike = 1.3;  // times
    const int most_outer = static_cast<int>(kOfGap * gap_px / colours.px);
    if (most_outer < kLeast) return std::nullopt;
    const auto rows = [&](double of_blade) {
      return std::max(kLeast, static_cast<int>(of_blade * blade_px / colours.px));
    };
    const int much = rows(kMuch), less = rows(kLess);
    const auto near = TransitionNear(stretch, {much, less, rows(kNearlyAll)}, most_outer);
    if (most_outer <= much) return near;
    auto far = TransitionOver(stretch, much, most_outer);
    if (!far) far = TransitionOver(stretch, less, most_outer);
    const bool is_beyond =
        near && far && far->of_colour > near->outermost && far->way > kMoreUnlike * near->way;
    return !near || is_beyond ? far : near;
  }
};

struct StretchOffset {
  int stretch = 0;
  double offset_px = 0;
};

// The edge's points moved by the offsets: linear between the stretches, constant beyond.
std::vector<Vector2d> Moved(const LocatedEdge& edge, const std::vector<StretchOffset>& offsets) {
  std::vector<Vector2d> path;
  std::size_t k = 0;
  for (std::size_t i = 0; i < edge.points.size(); ++i) {
    const double at =
        (static_cast<double>(i) + 0.5) * kStretches / static_cast<double>(edge.points.size()) - 0.5;
    while (k + 2 < offsets.size() && offsets[k + 1].stretch < at) ++k;
    const StretchOffset& a = offsets[k];
    const StretchOffset& b = offsets[k + 1];
    const double share = std::clamp((at - a.stretch) / (b.stretch - a.stretch), 0.0, 1.0);
    const double offset = std::lerp(a.offset_px, b.offset_px, share);
    path.push_back(edge.points[i].trend_px + offset * edge.points[i].normal);
  }
  return path;
}

// Whether the border leaves the edge, or comes to it, by a block of compression and more at once:
// shadows and bevels narrow slowly, smeared colour ends with its blocks.
bool Jumps(const std::vector<Vector2d>& border, const std::vector<StretchOffset>& offsets) {
  constexpr double kBlockPx = 8;
  constexpr double kSteep = 0.4;  // px a px along the edge
  for (std::size_t k = 1; k < border.size(); ++k) {
    const double across = std::abs(offsets[k].offset_px - offsets[k - 1].offset_px);
    if (across >= kBlockPx && across > kSteep * (border[k] - border[k - 1]).norm()) return true;
  }
  return false;
}

// Typical distance of a place on the border from the line between its neighbours.
double KinkOf(const std::vector<Vector2d>& border) {
  std::vector<double> kinks;
  for (std::size_t k = 1; k + 1 < border.size(); ++k) {
    const Vector2d along = (border[k + 1] - border[k - 1]).normalized();
    kinks.push_back(std::abs(Cross(along, border[k] - border[k - 1])));
  }
  return Median(std::move(kinks));
}

}  // namespace

bool ShowsColour(const cv::Mat& bgr, const ToneCurve& tone) {
  constexpr int kPartPx = 64;  // wide; what noise and compression colour evens out
  for (int from = 0; from < bgr.cols; from += kPartPx) {
    const cv::Mat part = bgr.colRange(from, std::min(from + kPartPx, bgr.cols));
    Vector3d sum = Vector3d::Zero();
    for (const cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(part)) sum += LightOf(pixel, tone);
    if (ChromaOf(sum / static_cast<double>(part.total())).norm() > kToldApart) return true;
  }
  return false;
}

std::optional<ColourBorder> FindColourBorder(const ReducedColours& colours,
                                             const ToneCurve& tone,
                                             const LocatedEdge& edge,
                                             const LocatedEdge& other,
                                             double blade_px,
                                             double told_apart) {
  constexpr std::size_t kFewest = 4;  // stretches
  constexpr double kSmooth = 1;       // px of the reduced picture; borders have no kinks
  if (edge.points.size() < kStretches || other.points.empty()) return std::nullopt;
  const EdgeInColours seen{colours, tone, edge, blade_px, told_apart};
  std::vector<StretchOffset> offsets;
  std::vector<double> certain;  // from the crotch on
  std::vector<Vector2d> border;
  for (int k = 0; k < kStretches; ++k) {
    const Stretch stretch = StretchOf(edge, k);
    const LocatedEdgePoint& middle = edge.points[(stretch.first + stretch.last) / 2];
    const auto transition = seen.TransitionAcross(stretch, DistanceTo(other, middle.trend_px));
    if (!transition) continue;
    offsets.push_back({k, colours.px * transition->of_colour});
    border.push_back(middle.trend_px + offsets.back().offset_px * middle.normal);
    certain.push_back(colours.px * transition->Certain());
  }
  if (offsets.size() < kFewest || KinkOf(border) > kSmooth * colours.px || Jumps(border, offsets))
    return std::nullopt;
  return ColourBorder{Moved(edge, offsets), MedianOfFarthestThird(certain)};
}

}  // namespace bladecurve
