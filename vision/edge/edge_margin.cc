// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_margin.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "vision/edge/light_along.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

constexpr double kNearestPx = 2;  // from the edge, whose blur ends there
constexpr double kDarker = 1.5;   // times lighter is the ground than a margin

using Across = std::function<double(double)>;  // light at a distance from an edge

Across LightAcross(const cv::Mat& grey, const ToneCurve& tone, const LocatedEdge& edge) {
  return [&](double across) { return TypicalLight(grey, tone, edge, across).value_or(0); };
}

double GroundBeside(const Across& light_at) {
  constexpr double kNearPx = 4, kFarPx = 10;
  std::vector<double> ground;
  for (double across = kNearPx; across <= kFarPx; ++across) ground.push_back(light_at(across));
  return Median(std::move(ground));
}

std::optional<Margin> DarkMargin(const Across& light_at, double ground, double widest_px) {
  constexpr double kDarkestPx = 4;
  constexpr double kRises = 1.2, kPlate = 1.25;  // light where the margin ends, and behind
  constexpr double kBehindPx = 6;
  constexpr double kStep = 0.1;  // of the width
  Margin margin{kNearestPx, light_at(-kNearestPx), ground};
  for (double across = kNearestPx + 1; across <= kDarkestPx; ++across) {
    const double light = light_at(-across);
    if (light < margin.light) margin = {across, light, ground};
  }
  if (margin.light <= 0 || ground < kDarker * margin.light) return std::nullopt;
  while (margin.width_px < widest_px && light_at(-margin.width_px) < kRises * margin.light)
    margin.width_px += std::max(1.0, kStep * margin.width_px);
  for (double behind = 0; behind <= kBehindPx; ++behind) {
    const bool in_reach = margin.width_px + behind <= widest_px;
    if (in_reach && light_at(-margin.width_px - behind) > kPlate * margin.light) return margin;
  }
  return std::nullopt;
}

// It ends half way from its light to the blade's, and within a blur's width.
std::optional<Margin> BrightMargin(const Across& light_at,
                                   double ground,
                                   double widest_px,
                                   const LocatedEdge& edge) {
  constexpr double kBlurs = 3, kUsualBlurPx = 0.8;  // sigmas: where the ground's light ends
  constexpr double kBrighter = 1.5;                 // than the blade
  constexpr double kHalf = 0.5, kEnds = 0.75;       // of the way to the blade's light
  const double foot = std::max(kNearestPx, kBlurs * BlurOr(edge, kUsualBlurPx));
  const double shoulder = light_at(-foot);
  if (ground < kDarker * shoulder) return std::nullopt;
  std::vector<double> light;
  for (double across = foot; across <= widest_px; ++across) light.push_back(light_at(-across));
  if (light.empty()) return std::nullopt;
  const double plate = *std::min_element(light.begin(), light.end());
  if (plate <= 0 || shoulder < kBrighter * plate) return std::nullopt;
  const auto falls_at = [&](double share) {  // px from the foot
    const double level = shoulder + share * (plate - shoulder);
    const auto fallen = [&](double l) { return l <= level; };
    return static_cast<double>(std::find_if(light.begin(), light.end(), fallen) - light.begin());
  };
  if (falls_at(kEnds) - falls_at(kHalf) > foot) return std::nullopt;
  return Margin{foot + falls_at(kHalf), shoulder, ground, Shadow::kBrighter};
}

bool WithinFactor(double a, double b, double factor) { return a < factor * b && b < factor * a; }

bool AreAlike(
    const Margin& a, const Margin& b, double same_light, double same_ground, double same_width) {
  return a.than_blade == b.than_blade && WithinFactor(a.light, b.light, same_light) &&
         WithinFactor(a.ground, b.ground, same_ground) &&
         WithinFactor(a.width_px, b.width_px, same_width);
}

}  // namespace

std::optional<Margin> FindMargin(const cv::Mat& grey,
                                 const ToneCurve& tone,
                                 const LocatedEdge& edge,
                                 double blade_px) {
  constexpr double kWidest = 0.5;        // of the blade,
  constexpr double kLeastWidestPx = 10;  // but no less
  const Across light_at = LightAcross(grey, tone, edge);
  const double ground_light = GroundBeside(light_at);
  const double widest = std::max(kWidest * blade_px, kLeastWidestPx);
  std::optional<Margin> margin = DarkMargin(light_at, ground_light, widest);
  return margin ? margin : BrightMargin(light_at, ground_light, widest, edge);
}

bool EndsSharply(const cv::Mat& grey,
                 const ToneCurve& tone,
                 const LocatedEdge& edge,
                 const Margin& margin) {
  constexpr double kDark = 1.1, kBright = 1.3;  // times the margin's light
  constexpr double kPerBlur = 3;                // from the one to the other
  constexpr double kStepPx = 0.5, kBehindPx = 6;
  const Across light_at = LightAcross(grey, tone, edge);
  std::optional<double> dark_px;  // the last place
  for (double across = kNearestPx; across <= margin.width_px + kBehindPx; across += kStepPx) {
    const double light = light_at(-across);
    if (light < kDark * margin.light) {
      dark_px = across;
    } else if (dark_px && light > kBright * margin.light) {
      return across - *dark_px <= kPerBlur * std::max(1.0, BlurOr(edge, 1));
    }
  }
  return false;
}

std::optional<Margin> FindDarkLine(const cv::Mat& grey,
                                   const ToneCurve& tone,
                                   const LocatedEdge& edge,
                                   double blade_px) {
  constexpr double kNarrowestPx = 1, kWidestPx = 3, kOfBlade = 0.06;
  constexpr double kGroundPx = 3, kStepPx = 0.25, kFlankPx = 2.5;
  constexpr double kDeep = 0.2;  // of the step to the ground
  constexpr double kSteep = 2;   // times as much as light falls off further in
  if (TypicalContrast(edge) <= 0) return std::nullopt;
  const Across light_at = LightAcross(grey, tone, edge);
  double darkest_px = 0, dark = light_at(0);
  for (double across = kStepPx; across <= kWidestPx; across += kStepPx) {
    const double light = light_at(-across);
    if (light < dark) dark = light, darkest_px = across;
  }
  const double ground = light_at(kGroundPx);
  const double plate = light_at(-darkest_px - kFlankPx);
  const double further_in = light_at(-darkest_px - 2 * kFlankPx);
  const double rise = plate - dark;
  if (rise < kDeep * (ground - dark) || rise < kSteep * std::abs(further_in - plate))
    return std::nullopt;
  Margin line{darkest_px, dark, ground};
  while (light_at(-line.width_px) < dark + 0.5 * rise && line.width_px < kWidestPx + kFlankPx)
    line.width_px += kStepPx;
  const double widest_px = std::min(kWidestPx, kOfBlade * blade_px);
  if (line.width_px < kNarrowestPx || line.width_px > widest_px) return std::nullopt;
  return line;
}

std::optional<double> TrailPx(const cv::Mat& grey, const ToneCurve& tone, const LocatedEdge& edge) {
  constexpr double kBladePx = 4, kFarthestPx = 12, kStepPx = 0.25;
  constexpr double kEnds = 0.1;              // of the step
  constexpr double kBrighter = 2;            // times the ground's light is the blade's
  const auto root_at = [&](double across) {  // of light: its noise is even, and faint light counts
    return std::sqrt(TypicalLight(grey, tone, edge, across).value_or(0));
  };
  const double blade = root_at(-kBladePx);
  double darkest = blade;  // the ground, or a shadow on it
  for (double across = 1; across <= kFarthestPx; ++across)
    darkest = std::min(darkest, root_at(across));
  if (blade * blade < kBrighter * darkest * darkest) return std::nullopt;
  const double end = darkest + kEnds * (blade - darkest);
  double trail = 0;
  while (trail < kFarthestPx && root_at(trail) > end) trail += kStepPx;
  return trail;
}

std::optional<double> ShadowBesidePx(const cv::Mat& grey,
                                     const ToneCurve& tone,
                                     const LocatedEdge& edge,
                                     const LocatedEdge& other,
                                     double widest_px) {
  constexpr double kEnds = 1.25;  // times darker than the ground, at most
  const double ground = GroundBeside(LightAcross(grey, tone, other));
  const Across light_at = LightAcross(grey, tone, edge);  // 0 out of the picture
  const double farthest = kNearestPx + widest_px;
  double across = kNearestPx;
  while (across <= farthest && kDarker * light_at(across) < ground) ++across;
  if (across == kNearestPx) return std::nullopt;
  const double width = across - 1;
  while (across <= farthest && kEnds * light_at(across) <= ground) ++across;
  return across <= farthest ? std::optional(width) : std::nullopt;
}

std::optional<Band> BandBeside(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const LocatedEdge& edge,
                               double line_px) {
  const auto light = TypicalLight(grey, tone, edge, 0.5 * line_px);
  return light ? std::optional(Band{std::abs(line_px), *light}) : std::nullopt;
}

bool MayLieAlong(const cv::Mat& grey,
                 const ToneCurve& tone,
                 const LocatedEdge& edge,
                 const Band& band) {
  constexpr double kAsWide = 0.35, kBlurPx = 3;  // of the width; the strip's two steps
  constexpr double kAsLight = 1.4;               // a factor
  const double least_px = std::max(1.0, kAsWide * band.width_px - kBlurPx);
  double alike_px = 0;
  for (double across = -band.width_px - kBlurPx; across <= band.width_px + kBlurPx; ++across) {
    const auto light = TypicalLight(grey, tone, edge, across);
    if (!light) return true;
    const bool alike = WithinFactor(
        std::max(*light, kDarkestLight), std::max(band.light, kDarkestLight), kAsLight);
    alike_px = alike ? alike_px + 1 : 0;
    if (alike_px >= least_px) return true;
  }
  return false;
}

bool AreOneShading(const Margin& a, const Margin& b) {
  constexpr double kSameLight = 1.6, kSameGround = 1.25, kSameWidth = 2;
  return a.than_blade == Shadow::kDarker && AreAlike(a, b, kSameLight, kSameGround, kSameWidth);
}

bool AreAsDark(const Margin& a, const Margin& b) {
  constexpr double kSameLight = 0.1;  // of the ground's
  return std::abs(a.light / a.ground - b.light / b.ground) < kSameLight;
}

bool AreOneShadow(const Margin& a, const Margin& b, double same_width) {
  constexpr double kSameLight = 1.12, kSameGround = 1.06;
  return AreAlike(a, b, kSameLight, kSameGround, same_width);
}

}  // namespace bladecurve
