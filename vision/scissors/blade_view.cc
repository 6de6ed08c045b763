// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/blade_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "vision/image/robust_statistics.h"
#include "vision/refused.h"
#include "vision/scissors/scene_guess.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

LocatedEdge InViewOrHalved(const ColourView& view, const EdgeGuess& guess) {
  const auto edge = UnlessRefused([&] { return LocateEdgeInView(view, guess); });
  return edge ? *edge : LocateEdgeInHalvedView(view, guess);
}

std::vector<double> Distances(const LocatedEdge& edge, const LocatedEdge& other) {
  std::vector<double> distances;
  for (const LocatedEdgePoint& p : edge.points) distances.push_back(DistanceTo(other, p.trend_px));
  return distances;
}

// About both blades, as far as anything that is looked for may lie off them.
cv::Rect AreaOf(const Scene& scene, const cv::Size& size) {
  constexpr double kOfLength = 0.25;  // of a blade
  Vector2d low = scene.pivot_px, high = low;
  double margin = 0;
  for (const SceneBlade* blade : {&scene.left, &scene.right}) {
    for (const std::vector<Vector2d>* side : {&blade->inner_px, &blade->outer_px}) {
      for (const Vector2d& p : *side) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    margin = std::max(margin, kOfLength * (blade->tip_px - scene.pivot_px).norm());
  }
  const cv::Point first(static_cast<int>(low.x() - margin), static_cast<int>(low.y() - margin));
  const cv::Point last(static_cast<int>(high.x() + margin), static_cast<int>(high.y() + margin));
  return cv::Rect(first, last) & cv::Rect({0, 0}, size);
}

// One pixel for each two by two of the picture.
PicturePart Halved(const PicturePart& part) {
  const cv::Rect area = part.Area();
  const cv::Point first((area.x + 1) / 2, (area.y + 1) / 2), last = area.br() / 2;
  const cv::Size size(last - first);
  cv::Mat half;
  cv::resize(
      part.pixels(cv::Rect(2 * first - area.tl(), size * 2)), half, size, 0, 0, cv::INTER_AREA);
  return {half, first};
}

}  // namespace

BladeView::BladeView(const Photo& photo, const ScaleResult& scale, const Scene& scene)
    : photo_(photo), scale_(scale), scene_(scene) {
  // A blade's edge, nearer to the camera than print by a plate or so, is as sharp.
  options_.most_blur_px = PrintBlurPx(scale.markers).value_or(options_.most_blur_px);
}

std::optional<LocatedEdge> BladeView::InGrey(const EdgeGuess& guess) const {
  if (guess.path_px.size() < 2) return std::nullopt;
  return UnlessRefused([&] { return LocateEdge(grey(), tone(), guess, options_); });
}

template <typename Look>
LocatedEdge BladeView::InGreyOr(const Look& look, const EdgeGuess& guess) const {
  constexpr double kFaintPx = 1, kSurer = 0.5;
  try {
    LocatedEdge edge = LocateEdge(grey(), tone(), guess, options_);
    if (TypicalSigma(edge.points) <= kFaintPx || edge.ambiguity > kAsGood) return edge;
    const auto coloured = UnlessRefused([&] { return InColours(look, guess).value_or(edge); });
    return coloured && TotalSigma(*coloured) < kSurer * TotalSigma(edge) ? *coloured : edge;
  } catch (const Refused&) {
    if (auto coloured = InColours(look, guess)) return *std::move(coloured);
    throw;
  }
}

// look(view, guess) in better colours. Throws Refused as `look`.
template <typename Look>
std::optional<LocatedEdge> BladeView::InColours(const Look& look, const EdgeGuess& guess) const {
  const std::optional<ColourView> view = InBetterColours(guess);
  return view ? std::optional(look(*view, guess)) : std::nullopt;
}

std::optional<ColourView> BladeView::InBetterColours(const EdgeGuess& guess) const {
  constexpr double kGain = 1.5;  // times better separated; less is no other picture
  ColourView view = ViewWhereSidesDiffer(Colours(), tone(), guess);
  const double in_grey = GreySeparation(grey(), tone(), guess);
  const bool better = view.separation > 0 && view.separation >= kGain * in_grey;
  return better ? std::optional(std::move(view)) : std::nullopt;
}

LocatedEdge BladeView::InGreyOrColours(const EdgeGuess& guess) const {
  return InGreyOr(LocateEdgeInView, guess);
}

LocatedEdge BladeView::InGreyOrAnyColours(const EdgeGuess& guess) const {
  return InGreyOr(InViewOrHalved, guess);
}

std::optional<LocatedEdge> BladeView::InColoursAlone(const EdgeGuess& guess, double shade) const {
  return UnlessRefused(
      [&] { return InViewOrHalved(ViewWhereSidesDiffer(Colours(), tone(), guess, shade), guess); });
}

std::optional<LocatedEdge> BladeView::ClearerInGrey(const LocatedEdge& coloured,
                                                    bool blade_on_left) const {
  constexpr double kColoursOffPx = 2;
  auto in_grey = InGrey({TrendOf(coloured), blade_on_left, kColoursOffPx});
  const bool clearer =
      in_grey && in_grey->ambiguity < kAsGood && Information(*in_grey) > Information(coloured);
  return clearer ? std::move(in_grey) : std::nullopt;
}

std::optional<LocatedEdge> BladeView::InShadow(const EdgeGuess& guess, Shadow shadow) const {
  std::optional<LocatedEdge> edge =
      UnlessRefused([&] { return LocateEdgeInShadow(grey(), tone(), guess, shadow, options_); });
  const bool is_such = edge && (TypicalContrast(*edge) < 0) == (shadow == Shadow::kDarker);
  return is_such ? std::move(edge) : std::nullopt;
}

const std::optional<LocatedEdge>& BladeView::OuterSide(bool left) const {
  Side& side = outer_sides_[left ? 0 : 1];
  std::call_once(side.looked_for, [&] { side.edge = InGrey(OuterSideOf(scene_, left)); });
  return side.edge;
}

const std::optional<LocatedEdge>& BladeView::ShankSide(bool left) const {
  Side& side = shank_sides_[left ? 0 : 1];
  std::call_once(side.looked_for, [&] { side.edge = InGrey(ShankSideOf(scene_, left)); });
  return side.edge;
}

std::optional<Margin> BladeView::MarginOf(const LocatedEdge& edge, bool left) const {
  return FindMargin(grey(), tone(), edge, BladeOf(scene_, left).width_px);
}

std::optional<Margin> BladeView::DarkLineOf(const LocatedEdge& edge, bool left) const {
  return FindDarkLine(grey(), tone(), edge, BladeOf(scene_, left).width_px);
}

const PicturePart& BladeView::Colours() const {
  std::call_once(decoded_,
                 [this] { colours_ = photo_.DecodeColourPart(AreaOf(scene_, grey().size())); });
  return colours_;
}

bool BladeView::IsLarge() const {
  constexpr double kLarge = 6e6;  // px
  return static_cast<double>(grey().total()) > kLarge;
}

const ReducedColours& BladeView::Reduced() const {
  constexpr int kSmallest = 2000;  // px, of the longest side
  std::call_once(halved_, [this] {
    const bool small = std::max(grey().cols, grey().rows) < kSmallest;
    reduced_ = small ? ReducedColours{Colours(), 1} : ReducedColours{Halved(Colours()), 2};
  });
  return reduced_;
}

bool BladeView::ShowsColourAtTop() const {
  constexpr double kTop = 1.0 / 64;  // of the picture: a quarter of a millisecond of 12 MP
  constexpr int kLongSide = 1000;    // px
  std::call_once(top_seen_, [this] {
    coloured_at_top_ = ShowsColour(photo_.DecodeTopColour(kTop, kLongSide), tone());
  });
  return coloured_at_top_;
}

double InlyingShare(const LocatedEdge& edge) {
  const auto inlying = std::count_if(edge.points.begin(),
                                     edge.points.end(),
                                     [](const LocatedEdgePoint& point) { return point.inlier; });
  return static_cast<double>(inlying) / static_cast<double>(edge.points.size());
}

double Information(const LocatedEdge& edge) {
  return InlyingShare(edge) / std::pow(TotalSigma(edge), 2);
}

std::size_t LostPoints(const LocatedEdge& edge) {
  const auto last = std::find_if(edge.points.rbegin(),
                                 edge.points.rend(),
                                 [](const LocatedEdgePoint& point) { return point.inlier; });
  return static_cast<std::size_t>(std::distance(edge.points.rbegin(), last));
}

std::vector<Vector2d> TrendOf(const LocatedEdge& edge) {
  std::vector<Vector2d> path;
  for (const LocatedEdgePoint& point : edge.points) path.push_back(point.trend_px);
  return path;
}

double MedianDistance(const LocatedEdge& edge, const LocatedEdge& other) {
  return Median(Distances(edge, other));
}

double DistanceOfFarthestThird(const LocatedEdge& edge, const LocatedEdge& other) {
  return MedianOfFarthestThird(Distances(edge, other));
}

}  // namespace bladecurve
