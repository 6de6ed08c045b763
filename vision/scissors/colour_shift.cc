// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/colour_shift.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "vision/edge/luma_shift.h"
#include "vision/image/blurred_step.h"
#include "vision/image/pixel_light.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kStretches = 12;  // of an edge; shadows lie along some of it

// Light on either side of a stretch of an edge: the colours clear of its blur, the step at it, as
// in between shadows may end, which are darker than the ground, or a band of the blade's, as of a
// dark bevel's.
class SideColours {
 public:
  void Add(const BladeView& view, const LocatedEdgePoint& p, double clear_px) {
    constexpr double kBeyondPx = 2;
    for (double off_px = clear_px; off_px <= clear_px + kBeyondPx; ++off_px) {
      const auto blade = LightAt(view.Colours(), view.tone(), p.trend_px - off_px * p.normal);
      const auto ground = LightAt(view.Colours(), view.tone(), p.trend_px + off_px * p.normal);
      if (!blade || !ground) continue;
      blade_ += *blade;
      ground_ += *ground;
      contrast_ += p.contrast;
      ++count_;
    }
  }

  [[nodiscard]] double Shift(const ToneCurve& tone) const {
    constexpr double kLeast = 0.05;  // of the light
    if (count_ == 0) return 0;
    const Vector3d blade = blade_ / count_, ground = ground_ / count_;
    const double contrast = contrast_ / count_;
    const double blade_grey = std::max(LightInGrey(blade, tone), kDarkestLight);
    const double ground_grey = std::max(LightInGrey(ground, tone), kDarkestLight);
    const double of_ground = (blade_grey + contrast) / ground_grey;
    if (of_ground <= 1) return LumaShift(blade, std::max(kLeast, of_ground) * ground, tone);
    const double of_blade = (ground_grey - contrast) / blade_grey;
    return LumaShift(std::max(kLeast, of_blade) * blade, ground, tone);
  }

 private:
  Vector3d blade_ = Vector3d::Zero(), ground_ = Vector3d::Zero();
  double contrast_ = 0, count_ = 0;
};

double TotalBlur(const LocatedEdge& edge) { return std::sqrt(TotalBlurVariance(edge.blur_px)); }

void AddCommonSigma(double sigma_px, LocatedEdge* edge) {
  edge->common_sigma_px = std::hypot(edge->common_sigma_px, sigma_px);
}

// In grey; of a mixture of colours, which are mixed in light, there is no unbound blur.
bool IsInGrey(const LocatedEdge& edge) { return !std::isnan(edge.unbound_blur_px); }

// Which of the stretches a point lies in, not whole: half way at its middle.
double StretchOf(std::size_t point, const LocatedEdge& edge) {
  return (static_cast<double>(point) + 0.5) * static_cast<double>(kStretches) /
         static_cast<double>(edge.points.size());
}

std::array<double, kStretches> ShiftsPx(const BladeView& view, const LocatedEdge& edge) {
  constexpr double kPerBlur = 2.5, kChromaPx = 1.5;  // colours are stored at half the resolution
  const double blur_px = TotalBlur(edge);
  std::array<SideColours, kStretches> sides;
  for (std::size_t i = 0; i < edge.points.size(); ++i) {
    if (!edge.points[i].inlier) continue;
    sides[static_cast<std::size_t>(StretchOf(i, edge))].Add(
        view, edge.points[i], kPerBlur * blur_px + kChromaPx);
  }
  std::array<double, kStretches> shifts_px;
  std::transform(sides.begin(), sides.end(), shifts_px.begin(), [&](const SideColours& side) {
    return blur_px * side.Shift(view.tone());
  });
  return shifts_px;
}

void Undo(const BladeView& view, LocatedEdge* edge) {
  constexpr double kDoubt = 0.25;  // of the way
  const std::array<double, kStretches> shifts_px = ShiftsPx(view, *edge);
  double way_px = 0;
  for (std::size_t i = 0; i < edge->points.size(); ++i) {
    const double place =
        std::clamp(StretchOf(i, *edge) - 0.5, 0.0, static_cast<double>(kStretches - 1));
    const auto before = static_cast<std::size_t>(place);
    const std::size_t after = std::min(before + 1, kStretches - 1);
    const double shift_px =
        std::lerp(shifts_px[before], shifts_px[after], place - static_cast<double>(before));
    LocatedEdgePoint& point = edge->points[i];
    point.point_px -= shift_px * point.normal;
    point.trend_px -= shift_px * point.normal;
    way_px += std::abs(shift_px) / static_cast<double>(edge->points.size());
  }
  AddCommonSigma(kDoubt * way_px, edge);
}

}  // namespace

void UndoLumaShift(const BladeView& view, Plan plan, Blades* blades) {
  constexpr double kUnseen = 0.1;  // of the blur; steel on drapes is shifted by up to twice as much
  const bool looks = plan == Plan::kFull || !view.IsLarge() || view.HasColours();
  for (LocatedBlade* blade : {&blades->upper, &blades->lower}) {
    LocatedEdge& edge = blade->edge;
    if (!IsInGrey(edge)) continue;
    if (looks) {
      Undo(view, &edge);
    } else if (view.ShowsColourAtTop()) {
      AddCommonSigma(kUnseen * TotalBlur(edge), &edge);
    }
  }
}

}  // namespace bladecurve
