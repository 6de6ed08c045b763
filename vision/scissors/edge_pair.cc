// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scissors/edge_pair.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "vision/edge/colour_border.h"
#include "vision/edge/edge_colour.h"
#include "vision/edge/edge_curve.h"
#include "vision/edge/edge_margin.h"
#include "vision/edge/edge_shadow.h"
#include "vision/image/blurred_step.h"
#include "vision/image/cross.h"
#include "vision/image/robust_statistics.h"
#include "vision/parallel.h"
#include "vision/refused.h"
#include "vision/scissors/consistency.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr double kAsGood = 0.45;  // ambiguity; below, the other transition is no match
constexpr double kFaint = 0.25;   // the same; beside dark metal a shadow's begin is a low step

// The edge as scene finding traced it, for want of a better one: good to a pixel of the small
// picture, and marked as doubtful.
LocatedEdge AsTraced(const Scene& scene, const SceneBlade& blade, bool left) {
  LocatedEdge edge;
  const std::vector<Vector2d>& path = blade.inner_px;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector2d along =
        (path[std::min(i + 3, path.size() - 1)] - path[i < 3 ? 0 : i - 3]).normalized();
    LocatedEdgePoint point;
    point.point_px = path[i];
    point.trend_px = path[i];
    point.normal = (left ? -1.0 : 1.0) * Vector2d(along.y(), -along.x());
    point.sigma_px = 2 * scene.path_sigma_px;
    edge.points.push_back(point);
  }
  edge.correlation_px = 10 * scene.path_sigma_px;
  edge.common_sigma_px = 2 * scene.path_sigma_px;
  edge.ambiguity = 1;
  return edge;
}

// Where the scene saw a blade's edge, and how far from there it may lie.
EdgeGuess GuessFor(const Scene& scene, bool left) {
  constexpr double kNearest = 5;     // px
  constexpr double kFarthest = 0.3;  // of the blade's width: shadow or bevel led the trace astray
  const SceneBlade& blade = left ? scene.left : scene.right;
  EdgeGuess guess;
  guess.path_px = blade.inner_px;
  guess.blade_on_left = left;
  guess.search_px = std::max(kNearest, 1.5 * scene.path_sigma_px + kFarthest * blade.width_px);
  return guess;
}

// Where the scene saw a blade's outer side, but for its ends, which bend.
EdgeGuess OuterSideOf(const Scene& scene, bool left) {
  constexpr double kFirst = 0.25, kLast = 0.85;  // of the side
  EdgeGuess guess = GuessFor(scene, left);
  const std::vector<Vector2d>& side = (left ? scene.left : scene.right).outer_px;
  const auto at = [&](double share) {
    return side.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(side.size()));
  };
  guess.path_px.assign(at(kFirst), at(kLast));
  guess.blade_on_left = !left;
  return guess;
}

// Cut off at white, the step of a glaring blade looks sharper than the other blade's, and lies too
// far out.
bool Glares(const LocatedEdge& edge, const LocatedEdge& other) {
  constexpr double kOverexposed = 0.2, kPlain = 0.05;  // share of an edge
  constexpr double kSharper = 0.85;  // ratio of the blurs; focus and motion differ by less
  constexpr double kOneStep = 0.5;  // ambiguity; the blur of bevel and shadow together is no lens's
  return edge.overexposed > kOverexposed && other.overexposed < kPlain &&
         other.ambiguity < kOneStep && edge.blur_px < kSharper * other.blur_px;
}

// Softer than print and the other blade: a shadow along the edge that was taken for blur.
bool IsTooSoft(const LocatedEdge& edge, const LocatedEdge& other, double most_blur_px) {
  constexpr double kSofter = 1.5;  // ratio; print and blades lie at about one distance
  return std::isfinite(most_blur_px) &&
         edge.blur_px > kSofter * std::max(other.blur_px, most_blur_px);
}

// A transition beside the edge that could be the border instead, with a dark band between: shadow
// or bevel.
bool HasDarkBand(const LocatedEdge& edge, double least_ambiguity) {
  // Narrower bands are blur on both sides, or the steps' own margins.
  constexpr double kLeast = 2.5, kMost = 4, kPerBlur = 4.5;  // px, px, standard deviations
  const double narrowest =
      std::clamp(kPerBlur * std::sqrt(TotalBlurVariance(edge.blur_px)), kLeast, kMost);
  return edge.ambiguity > least_ambiguity && std::abs(edge.rival_px) >= narrowest;
}

bool HasDarkBand(const LocatedEdge& edge) { return HasDarkBand(edge, kAsGood); }

// Light that rises so slowly, going outwards, that the edge is vague although print bounds its
// blur, and no second line near: a shadow's border.
bool IsShadowsBorder(const LocatedEdge& edge, double most_blur_px) {
  constexpr double kVague = 0.6;  // px
  return std::isfinite(most_blur_px) && edge.slope_sigma_px > kVague && !HasDarkBand(edge) &&
         TypicalContrast(edge) > 0;
}

double InlyingShare(const LocatedEdge& edge) {
  const auto inlying = std::count_if(edge.points.begin(),
                                     edge.points.end(),
                                     [](const LocatedEdgePoint& point) { return point.inlier; });
  return static_cast<double>(inlying) / static_cast<double>(edge.points.size());
}

// What the edge's points tell about where it runs, for comparison with another along it.
double Information(const LocatedEdge& edge) {
  return InlyingShare(edge) / std::pow(TotalSigma(edge), 2);
}

std::vector<Vector2d> TrendOf(const LocatedEdge& edge) {
  std::vector<Vector2d> path;
  for (const LocatedEdgePoint& point : edge.points) path.push_back(point.trend_px);
  return path;
}

double MedianDistance(const LocatedEdge& edge, const LocatedEdge& other) {
  std::vector<double> distances;
  for (const LocatedEdgePoint& p : edge.points) distances.push_back(DistanceTo(other, p.trend_px));
  return Median(std::move(distances));
}

// What a wider look saw beside the same line is in doubt although a narrower one does not see it.
void KeepRival(const LocatedEdge& wider, LocatedEdge* narrower) {
  constexpr double kSamePx = 1;
  if (wider.ambiguity <= narrower->ambiguity || MedianDistance(*narrower, wider) > kSamePx) return;
  narrower->ambiguity = wider.ambiguity;
  narrower->rival_px = wider.rival_px;
  narrower->rival_path_px = wider.rival_path_px;
  narrower->common_sigma_px = std::max(narrower->common_sigma_px, wider.common_sigma_px);
}

// Out of the blade, half way along.
Vector2d TypicalNormal(const LocatedEdge& edge) {
  return edge.points[edge.points.size() / 2].normal;
}

Vector2d DirectionOfDistalHalf(const LocatedEdge& edge) {
  return (edge.points.back().trend_px - edge.points[edge.points.size() / 2].trend_px).normalized();
}

// How many points of an edge, from the crotch on, lie before the end of a stretch over which the
// other edge lies on it for longer than where edges cross: one of them was followed on along the
// other blade's. 0 where there is none.
std::size_t CountAlongOther(const LocatedEdge& edge, const LocatedEdge& other) {
  constexpr double kTogetherPx = 2.5;
  constexpr double kLonger = 3, kLeastPx = 20;
  constexpr std::size_t kEnough = 100;  // places along the edge
  const double sine = std::abs(Cross(DirectionOfDistalHalf(edge), DirectionOfDistalHalf(other)));
  const std::size_t stride = 1 + edge.points.size() / kEnough;
  std::size_t count = 0, together = 0;
  for (std::size_t i = 0; i < edge.points.size(); i += stride) {
    if (DistanceTo(other, edge.points[i].trend_px) > kTogetherPx) continue;
    together += stride;
    count = std::min(i + stride, edge.points.size());
  }
  const double spacing_px = (edge.points.back().trend_px - edge.points.front().trend_px).norm() /
                            static_cast<double>(edge.points.size());
  const double length_px = spacing_px * static_cast<double>(together);
  return length_px > kLeastPx + kLonger * kTogetherPx / std::max(sine, 1e-6) ? count : 0;
}

LocatedEdge InViewOrHalved(const ColourView& view, const EdgeGuess& guess) {
  const auto edge = UnlessRefused([&] { return LocateEdgeInView(view, guess); });
  return edge ? *edge : LocateEdgeInHalvedView(view, guess);
}

// Looks for the edges of one photograph, both at a time if need be; decodes its colours only if
// grey leaves a doubt.
class BladeLocator {
 public:
  BladeLocator(const Photo& photo, const ScaleResult& scale, const Scene& scene)
      : photo_(photo), tone_(scale.tone), scene_(scene) {
    // A blade's edge, nearer to the camera than print by a plate or so, is as sharp.
    options_.most_blur_px = PrintBlurPx(scale.markers).value_or(options_.most_blur_px);
  }

  // Where grey hides the edge, the mixture of the colours in which blade and background differ most
  // is looked at. Not before: the mixture depends on what lies somewhere beside the edge, grey on
  // the step at the edge alone.
  [[nodiscard]] LocatedEdge InBestChannel(const EdgeGuess& guess) {
    return InGreyOr(LocateEdgeInView, guess);
  }

  // The edge along `guess` as the place where a shadow begins, if it is seen.
  [[nodiscard]] std::optional<LocatedEdge> InShadow(const EdgeGuess& guess,
                                                    Shadow shadow = Shadow::kDarker) const {
    std::optional<LocatedEdge> edge = UnlessRefused(
        [&] { return LocateEdgeInShadow(photo_.grey(), tone_, guess, shadow, options_); });
    const bool is_such = edge && (TypicalContrast(*edge) < 0) == (shadow == Shadow::kDarker);
    return is_such ? std::move(edge) : std::nullopt;
  }

  [[nodiscard]] LocatedEdge Locate(bool left) {
    LocatedEdge edge = InGreyOr(InViewOrHalved, GuessFor(scene_, left));
    if (IsShadowsBorder(edge, options_.most_blur_px)) edge = LeaveSoftShadow(std::move(edge), left);
    edge = AlongItsCurve(std::move(edge), left);
    return HasDarkBand(edge, kFaint) ? SettleDarkBand(std::move(edge), left) : edge;
  }

  [[nodiscard]] LocatedEdge LocateOrTrace(bool left) {
    if (auto edge = UnlessRefused([&] { return Locate(left); })) return *std::move(edge);
    return AsTraced(scene_, left ? scene_.left : scene_.right, left);
  }

  // The edge along the inner side of a dark band beside it, however faint, if it is seen there.
  [[nodiscard]] std::optional<LocatedEdge> WithinBand(const LocatedEdge& edge, bool left) const {
    if (!HasDarkBand(edge, kFaint) || edge.rival_px > 0) return std::nullopt;
    return AlongSide(edge.rival_path_px, edge, left);
  }

  // What the other blade tells of an edge's blur: a glaring blade's once more, as sharp as the
  // other; a shadow's, with the bound that print gives.
  [[nodiscard]] LocatedEdge WithBlurOf(const LocatedEdge& other, LocatedEdge edge, bool left) {
    EdgeOptions options = options_;
    if (Glares(edge, other)) {
      options.blur_px = other.blur_px;
    } else if (IsTooSoft(edge, other, options.most_blur_px)) {
      options.may_be_softer = false;
    } else {
      return edge;
    }
    try {
      return LocateEdge(photo_.grey(), tone_, GuessFor(scene_, left), options);
    } catch (const Refused&) {
      return edge;  // too little is left without the white pixels; its sigma tells of the glare
    }
  }

  // Where the edges lie on each other before they part, as along the top blade's edge over the
  // other blade, both are looked for from there on alone.
  void LeaveOtherBlade(LocatedEdge* left, LocatedEdge* right) {
    const std::optional<LocatedEdge> l = BeyondOther(*left, *right, true),
                                     r = BeyondOther(*right, *left, false);
    if (l) *left = *l;
    if (r) *right = *r;
  }

  // Of a pair of blades only the one on top shows its bevel: dark bands along both edges are hard
  // shadows, and both borders the bands' inner sides.
  void LeaveShadows(LocatedEdge* left, LocatedEdge* right) {
    const auto banded = [](const LocatedEdge& edge) {
      return HasDarkBand(edge) && edge.rival_px < 0;
    };
    if (!banded(*left) || !banded(*right)) return;
    const auto l = AlongSide(left->rival_path_px, *left, true);
    const auto r = AlongSide(right->rival_path_px, *right, false);
    if (!l || !r) return;
    *left = *l;
    *right = *r;
  }

  // An edge along the border of a shadow that its blade casts is looked for where that begins. The
  // other blade's outer side, which faces the same way, casts the same one.
  void LeaveCastShadow(BladeEdges* edges) const {
    const auto of_upper = MarginOf(edges->upper, true);
    const auto of_lower = MarginOf(edges->lower, false);
    if (of_upper.has_value() == of_lower.has_value()) return;  // bevels, or none
    const bool left = of_upper.has_value();
    const auto outer = LocateOuterSide(!left);
    const auto of_outer = outer ? MarginOf(*outer, !left) : std::nullopt;
    const Margin& shadow = of_upper ? *of_upper : *of_lower;
    if (!of_outer || !AreOneShadow(shadow, *of_outer)) return;
    LocatedEdge& edge = of_upper ? edges->upper : edges->lower;
    edge = WhereShadowBegins(std::move(edge), shadow, left);
  }

  // Both edges are compared with where the ground's colour ends: light changes at shadows' borders
  // and bevels' lines too. In large photographs, whose colours take longer to decode than all else
  // takes, only where grey leaves a doubt, or shadows might pass for blades unseen.
  void SettleByColour(Plan plan, BladeEdges* edges) {
    constexpr double kVaguePx = 0.5, kLarge = 3e6;  // px
    const auto doubtful = [&](const LocatedEdge& edge) {
      return TotalSigma(edge) > kVaguePx || edge.ambiguity > kAsGood;
    };
    const bool costly = static_cast<double>(photo_.grey().total()) > kLarge;
    if (plan == Plan::kAsNeeded && costly && !doubtful(edges->upper) && !doubtful(edges->lower) &&
        !ShadowsMightPass(*edges))
      return;
    const ReducedColours colours = Reduced();
    const BladeEdges found = *edges;
    ParallelFor(2, [&](int blade) {
      if (blade == 0) {
        LeaveLightAlone(colours, found.lower, true, &edges->upper);
      } else {
        LeaveLightAlone(colours, found.upper, false, &edges->lower);
      }
    });
  }

 private:
  // std::nullopt where the other edge does not lie on this one, or too little is left of it.
  [[nodiscard]] std::optional<LocatedEdge> BeyondOther(const LocatedEdge& edge,
                                                       const LocatedEdge& other,
                                                       bool left) {
    constexpr double kSearchPx = 3;
    const auto count = static_cast<std::ptrdiff_t>(CountAlongOther(edge, other));
    if (count == 0) return std::nullopt;
    const std::vector<Vector2d> path = TrendOf(edge);
    const EdgeGuess guess{{path.begin() + count, path.end()}, left, kSearchPx};
    if (guess.path_px.size() < 2) return std::nullopt;
    return UnlessRefused([&] { return InGreyOr(InViewOrHalved, guess); });
  }

  // look(view, guess) in colours that part blade and background much better than grey does, where
  // grey hides the edge, or shows it so faintly that the colours place it twice as well.
  template <typename Look>
  [[nodiscard]] LocatedEdge InGreyOr(const Look& look, const EdgeGuess& guess) {
    constexpr double kFaintPx = 1, kSurer = 0.5;
    try {
      LocatedEdge edge = LocateEdge(photo_.grey(), tone_, guess, options_);
      if (TypicalSigma(edge.points) <= kFaintPx || edge.ambiguity > kAsGood) return edge;
      const auto coloured = UnlessRefused([&] { return InColours(look, guess).value_or(edge); });
      return coloured && TotalSigma(*coloured) < kSurer * TotalSigma(edge) ? *coloured : edge;
    } catch (const Refused&) {
      if (auto coloured = InColours(look, guess)) return *std::move(coloured);
      throw;
    }
  }

  // std::nullopt if colours part the sides little better than grey does. Throws Refused as `look`.
  template <typename Look>
  [[nodiscard]] std::optional<LocatedEdge> InColours(const Look& look, const EdgeGuess& guess) {
    constexpr double kGain = 1.5;  // times better separated; less is no other picture
    const ColourView view = ViewWhereSidesDiffer(Colours(), tone_, guess);
    const double in_grey = GreySeparation(photo_.grey(), tone_, guess);
    if (!(view.separation > 0) || view.separation < kGain * in_grey) return std::nullopt;
    return look(view, guess);
  }

  // Where much of an edge strays, the guess led the look astray: once more, along the curve that
  // most of the edge follows, if that tells more.
  [[nodiscard]] LocatedEdge AlongItsCurve(LocatedEdge edge, bool left) {
    constexpr double kStray = 0.1;   // of the points
    constexpr double kSearchPx = 3;  // the curve's own error, where it had to be continued
    if (InlyingShare(edge) > 1 - kStray) return edge;
    const EdgeGuess guess{PlainCurve(edge.points), left, kSearchPx};
    auto again = UnlessRefused([&] { return InGreyOr(InViewOrHalved, guess); });
    if (!again || Information(*again) <= Information(edge)) return edge;
    KeepRival(edge, &*again);
    return *std::move(again);
  }

  // From a line at which only light changes to the one at which the ground's colour ends; where
  // that line draws the edge back to itself, in colours that show shadows less.
  void LeaveLightAlone(const ReducedColours& colours,
                       const LocatedEdge& other,
                       bool left,
                       LocatedEdge* edge) {
    constexpr double kFarPx = 1.3, kSearchPx = 4;
    constexpr double kWay = 0.5;    // of the way there, at least
    constexpr double kShade = 0.5;  // of the light
    const double width_px = (left ? scene_.left : scene_.right).width_px;
    const auto border = FindColourBorder(colours, tone_, *edge, other, width_px);
    if (!border || std::abs(border->offset_px) < kFarPx) return;
    const EdgeGuess guess{border->path_px, left, kSearchPx};
    for (const double shade : {0.0, kShade}) {
      std::optional<LocatedEdge> again = InColoursThenGrey(guess, shade);
      if (!again || MedianDistance(*again, *edge) < kWay * std::abs(border->offset_px)) continue;
      *edge = *std::move(again);
      return;
    }
    Doubt(edge, std::abs(border->offset_px));
  }

  // Whether what is taken for blade is darker than the ground, as shadows are, and the ground may
  // have a colour that would tell them apart; the topmost rows stand for it.
  [[nodiscard]] bool ShadowsMightPass(const BladeEdges& edges) const {
    constexpr double kTop = 1.0 / 64;  // of the picture: a quarter of a millisecond of 12 MP
    constexpr int kLongSide = 1000;    // px
    const bool darker = TypicalContrast(edges.upper) > 0 || TypicalContrast(edges.lower) > 0;
    return darker && ShowsColour(photo_.DecodeTopColour(kTop, kLongSide), tone_);
  }

  // In the colours, and in grey, which is sharper, where that shows an edge at the same place.
  [[nodiscard]] std::optional<LocatedEdge> InColoursThenGrey(const EdgeGuess& guess, double shade) {
    constexpr double kColoursOffPx = 2;
    auto coloured = UnlessRefused([&] {
      return InViewOrHalved(ViewWhereSidesDiffer(Colours(), tone_, guess, shade), guess);
    });
    if (!coloured) return std::nullopt;
    const EdgeGuess close{TrendOf(*coloured), guess.blade_on_left, kColoursOffPx};
    auto grey = UnlessRefused([&] { return LocateEdge(photo_.grey(), tone_, close, options_); });
    const bool clearer =
        grey && grey->ambiguity < kAsGood && Information(*grey) > Information(*coloured);
    return clearer ? grey : coloured;
  }

  // From a soft shadow's border to where the shadow begins, if that is seen.
  [[nodiscard]] LocatedEdge LeaveSoftShadow(LocatedEdge edge, bool left) const {
    constexpr double kNearest = 1.2, kFarthest = 3.5;  // px; times the edge's uncertainty
    const double farthest = kFarthest * edge.common_sigma_px;
    EdgeGuess guess{{}, left, 0.5 * (farthest - kNearest)};
    for (const LocatedEdgePoint& p : edge.points)
      guess.path_px.push_back(p.trend_px - 0.5 * (kNearest + farthest) * p.normal);
    return InShadow(guess).value_or(std::move(edge));
  }

  // The edge as much further in as the shadow is wide, if light clearly changes there, as it does
  // not where the margin is but shading; doubted all the same.
  [[nodiscard]] LocatedEdge WhereShadowBegins(LocatedEdge edge,
                                              const Margin& shadow,
                                              bool left) const {
    constexpr double kReach = 0.2, kLeast = 3;  // of the width, px; bevels end further in
    constexpr double kUnclear = 0.75;           // ambiguity
    constexpr double kDoubt = 0.5;              // of the width
    EdgeGuess guess{{}, left, std::max(kLeast, kReach * shadow.width_px)};
    for (const LocatedEdgePoint& p : edge.points)
      guess.path_px.push_back(p.trend_px - shadow.width_px * p.normal);
    std::optional<LocatedEdge> begins = InShadow(guess, shadow.than_blade);
    if (!begins || begins->ambiguity > kUnclear) return edge;
    Doubt(&*begins, kDoubt * shadow.width_px);
    return *std::move(begins);
  }

  // The edge once more along one side of the dark band beside it, if it is seen there.
  [[nodiscard]] std::optional<LocatedEdge> AlongSide(std::vector<Vector2d> side_px,
                                                     const LocatedEdge& edge,
                                                     bool left) const {
    constexpr double kReach = 0.65, kLeast = 1.6;  // of the way to the other side, px
    const EdgeGuess guess{
        std::move(side_px), left, std::max(kLeast, kReach * std::abs(edge.rival_px))};
    return UnlessRefused([&] { return LocateEdge(photo_.grey(), tone_, guess, options_); });
  }

  // Whether the blade is as dark along its other side as in the band beside this edge, as rounded
  // ones are. Shadows fall to one side.
  [[nodiscard]] bool IsRound(const LocatedEdge& edge, bool left) const {
    constexpr double kWholeBand = 1.7;  // times a margin's width
    const std::optional<LocatedEdge> border = BeyondBand(edge, left);
    std::optional<LocatedEdge> outer = LocateOuterSide(left);
    if (outer && HasDarkBand(*outer)) outer = BeyondBand(*outer, !left);
    if (!border || !outer) return false;
    const auto band = MarginOf(*border, left), other = MarginOf(*outer, left);
    if (!band || !other || !AreOneShading(*band, *other)) return false;
    return kWholeBand * band->width_px > std::abs(edge.rival_px);
  }

  // The edge along the outer side of the dark band beside it, if it is seen there.
  [[nodiscard]] std::optional<LocatedEdge> BeyondBand(const LocatedEdge& edge, bool left) const {
    return edge.rival_px > 0 ? AlongSide(edge.rival_path_px, edge, left) : edge;
  }

  // std::nullopt where it is not seen.
  [[nodiscard]] std::optional<LocatedEdge> LocateOuterSide(bool left) const {
    const EdgeGuess side = OuterSideOf(scene_, left);
    if (side.path_px.size() < 2) return std::nullopt;
    return UnlessRefused([&] { return LocateEdge(photo_.grey(), tone_, side, options_); });
  }

  // The side of a blade's shank that faces as its cutting edge does; std::nullopt where it is not
  // seen.
  [[nodiscard]] std::optional<LocatedEdge> LocateShank(bool left) const {
    EdgeGuess side = GuessFor(scene_, left);
    side.path_px = (left ? scene_.left : scene_.right).shank_px;
    side.blade_on_left = !left;  // going from the joint to the ring
    if (side.path_px.size() < 2) return std::nullopt;
    return UnlessRefused([&] { return LocateEdge(photo_.grey(), tone_, side, options_); });
  }

  // Whether the shank would have to cast a shadow like the dark band beside the edge, and does not.
  [[nodiscard]] bool CastsNoShadow(const LocatedEdge& edge, bool left) const {
    constexpr double kSameWay = 0.94;  // cosine
    const std::optional<LocatedEdge> shank = LocateShank(left);
    if (!shank || TypicalNormal(*shank).dot(TypicalNormal(edge)) < kSameWay) return false;
    return !MayLieAlong(photo_.grey(), tone_, *shank, BandBeside(photo_.grey(), tone_, edge));
  }

  // Along an edge or outer side of a blade.
  [[nodiscard]] std::optional<Margin> MarginOf(const LocatedEdge& edge, bool left) const {
    const double width_px = (left ? scene_.left : scene_.right).width_px;
    return FindMargin(photo_.grey(), tone_, edge, width_px);
  }

  // Of the two sides of a dark band, the inner one is the blade's border if the band is the
  // background in shadow, the outer one if it is metal; within a band that is either, the edge is
  // in doubt. Faint bands are not worth the colours.
  [[nodiscard]] LocatedEdge SettleDarkBand(LocatedEdge edge, bool left) {
    constexpr double kDoubt = 0.5;  // of the band; in one rendered scene of five the edge is beyond
    const SceneBlade& blade = left ? scene_.left : scene_.right;
    const SceneBlade& other = left ? scene_.right : scene_.left;
    const bool clear = HasDarkBand(edge), is_inner = edge.rival_px > 0;
    DarkBand band = clear ? JudgeDarkBand(Colours(), tone_, edge, blade.width_px, other.inner_px)
                          : JudgeByPattern(photo_.grey(), tone_, edge, other.inner_px);
    if (band == DarkBand::kUnknown && (clear || is_inner) &&
        (IsRound(edge, left) || CastsNoShadow(edge, left)))
      band = DarkBand::kMetal;
    if (band == DarkBand::kUnknown) {
      if (clear && is_inner) Doubt(&edge, kDoubt * edge.rival_px);
      return edge;
    }
    const bool want_inner = band == DarkBand::kShadow;
    return AlongSide(want_inner == is_inner ? TrendOf(edge) : edge.rival_path_px, edge, left)
        .value_or(edge);
  }

  [[nodiscard]] const cv::Mat& Colours() {
    std::call_once(decoded_, [this] { colours_ = photo_.DecodeColour(LongSide()); });
    return colours_;
  }

  // Colours are stored at half resolution anyway. Of a photograph that would not be reduced, the
  // whole, decoded but once.
  [[nodiscard]] ReducedColours Reduced() {
    constexpr int kSmallest = 1000;  // px, of the longest side
    const int half = (LongSide() + 1) / 2;
    const cv::Mat bgr = half < kSmallest ? Colours() : photo_.DecodeColour(half);
    return {bgr, static_cast<double>(photo_.grey().cols) / bgr.cols};
  }

  [[nodiscard]] int LongSide() const { return std::max(photo_.grey().cols, photo_.grey().rows); }

  const Photo& photo_;
  const ToneCurve& tone_;
  const Scene& scene_;
  EdgeOptions options_;
  std::once_flag decoded_;
  cv::Mat colours_;
};

}  // namespace

BladeEdges LocateBlades(const Photo& photo,
                        const ScaleResult& scale,
                        const Scene& scene,
                        Plan plan) {
  BladeLocator locator(photo, scale, scene);
  BladeEdges edges;
  ParallelFor(2, [&](int blade) {
    if (blade == 0) {
      edges.upper = locator.Locate(true);
    } else {
      edges.lower = locator.LocateOrTrace(false);
    }
  });
  locator.LeaveOtherBlade(&edges.upper, &edges.lower);
  locator.LeaveShadows(&edges.upper, &edges.lower);
  edges.upper = locator.WithBlurOf(edges.lower, std::move(edges.upper), true);
  edges.lower = locator.WithBlurOf(edges.upper, std::move(edges.lower), false);
  locator.SettleByColour(plan, &edges);
  locator.LeaveCastShadow(&edges);
  return edges;
}

LocatedEdge LocateBladeAlong(const Photo& photo,
                             const ScaleResult& scale,
                             const Scene& scene,
                             const EdgeGuess& guess) {
  return BladeLocator(photo, scale, scene).InBestChannel(guess);
}

std::optional<LocatedEdge> LocateBladeInShadow(const Photo& photo,
                                               const ScaleResult& scale,
                                               const Scene& scene,
                                               const EdgeGuess& guess) {
  return BladeLocator(photo, scale, scene).InShadow(guess);
}

std::optional<LocatedEdge> LocateBladeWithinBand(const Photo& photo,
                                                 const ScaleResult& scale,
                                                 const Scene& scene,
                                                 const LocatedEdge& edge,
                                                 bool blade_on_left) {
  return BladeLocator(photo, scale, scene).WithinBand(edge, blade_on_left);
}

}  // namespace bladecurve
