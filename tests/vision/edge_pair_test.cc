// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// What colours say of an edge that hardly shows in grey, and both edges together of the dark bands
// beside them.
#include "vision/scissors/edge_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "jpeg_images.h"
#include "measured_blades.h"
#include "process_folder.h"
#include "tests/degree.h"
#include "vision/edge_images.h"
#include "vision/scissors/cast_shadow.h"
#include "vision/scissors/ground_colour.h"
#include "vision/scissors/scene_guess.h"

namespace bladecurve {
namespace {

using testing::FarFrom;
using testing::kBevelPx;
using testing::Measured;
using testing::RetouchedAlongUpperEdge;
using testing::SceneWithShadow;

// Wide open in low sun from behind the rings: both blades throw their shadows into the gap.
SceneSpec SceneWithShadowsInTheGap(double elevation_rad) {
  SceneSpec spec;
  spec.width = 1600;
  spec.height = 1200;
  spec.theta_rad = 75 * kDegree;
  spec.heading_rad = 0;
  spec.scissors.upper_on_top = false;
  spec.scissors.bevel_mm = 0;
  spec.light.direction_rad = std::numbers::pi;
  spec.light.elevation_rad = elevation_rad;
  spec.light.shadow = 0.9;
  spec.light.shadow_blur_mm = 0.15;
  spec.light.glint = 0;
  return spec;
}

// A rendered photograph of known scale up to where its edges are located.
struct Seen {
  explicit Seen(const SceneSpec& spec) : Seen(spec, RenderScene(spec).bgr) {}
  Seen(const SceneSpec& spec, const cv::Mat& picture) : Seen(spec, Measured::PhotoOf(picture)) {}
  Seen(const SceneSpec& spec, Photo taken)
      : photo(std::move(taken)), scale(FindScale(photo, ScaleOf(spec))) {
    StageLog log;
    scene = SceneFinder(photo, scale.markers, {}, &log).Likeliest();
  }

  static ScaleOptions ScaleOf(const SceneSpec& spec) {
    ScaleOptions options;
    options.mm_per_px = spec.camera.mm_per_px;
    return options;
  }

  [[nodiscard]] BladeEdges Locate() const { return LocateBlades(BladeView(photo, scale, scene)); }

  Photo photo;
  ScaleResult scale;
  Scene scene;
};

TEST(LocateBlades, TakesDarkBandsAlongBothBladesForShadows) {
  constexpr double kClosePx = 0.3;
  for (const double elevation_rad : {45 * kDegree, 35 * kDegree}) {
    const SceneSpec spec = SceneWithShadowsInTheGap(elevation_rad);
    const BladeEdges edges = Seen(spec).Locate();
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << elevation_rad;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << elevation_rad;
  }
}

// In their shadows the drape is as dark as the blades: grey shows the shadows' borders alone, and
// clearly.
SceneSpec BlackBladesInSunOnDrape(double shadow) {
  SceneSpec spec = SceneWithShadowsInTheGap(35 * kDegree);
  spec.finish = Finish::kBlack;
  spec.backdrop = Backdrop::kDrape;
  spec.drape_rgb = {0.06, 0.2, 0.12};
  spec.light.shadow = shadow;
  return spec;
}

TEST(LocateBlades, TakesTheColoursWhereShadowsHideTheEdgesInGrey) {
  constexpr double kClosePx = 0.3;
  for (const double shadow : {0.78, 0.8}) {
    const SceneSpec spec = BlackBladesInSunOnDrape(shadow);
    const BladeEdges edges = Seen(spec).Locate();
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << shadow;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << shadow;
  }
}

TEST(LiesInGround, IsTrueOfAShadowsBorderOnColouredGroundAlone) {
  constexpr double kFarPx = 3;
  const SceneSpec spec = BlackBladesInSunOnDrape(0.78);
  const Seen seen(spec);
  const BladeView view(seen.photo, seen.scale, seen.scene);
  const auto in_grey = view.InGrey(CuttingEdgeOf(seen.scene, true));
  ASSERT_TRUE(in_grey);
  ASSERT_GT(FarFrom(TruthOf(spec).upper, in_grey->points), kFarPx);
  const BladeEdges edges = LocateBlades(view);
  EXPECT_TRUE(LiesInGround(view, *in_grey, edges.lower, true));
  EXPECT_FALSE(LiesInGround(view, edges.upper, edges.lower, true));
  EXPECT_FALSE(GroundEndsAt(view, *in_grey, edges.lower, true));
  EXPECT_TRUE(GroundEndsAt(view, edges.upper, edges.lower, true));
}

// Steel on ground of a warmer white, in shadows about as dark as the blades.
TEST(LocateBlades, FindEdgesBesideShadowsOnNearlyWhiteGround) {
  constexpr double kClosePx = 0.3;
  for (const double shadow : {0.55, 0.62}) {
    SceneSpec spec = SceneWithShadowsInTheGap(45 * kDegree);
    spec.backdrop = Backdrop::kDrape;
    spec.drape_rgb = {0.68, 0.66, 0.6};
    spec.texture = 0;
    spec.light.shadow = shadow;
    const BladeEdges edges = Seen(spec).Locate();
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << shadow;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << shadow;
  }
}

// On paper a hard shadow of the blade's grey, 2.3 px wide: grey shows its border alone, and
// clearly.
TEST(LocateBlades, TakesTheColoursWhereTheyHardlyTellShadowsFromBlades) {
  constexpr double kClosePx = 1;
  constexpr std::uint64_t kSeed = 1002003147;
  const SceneSpec spec = RandomScene(kSeed, Difficulty::kSun);
  const BladeEdges edges = Seen(spec).Locate();
  EXPECT_LT(FarFrom(TruthOf(spec).upper, edges.upper.points), kClosePx);
}

// A drape about as bright as the blades, whose tips the mask has cut short.
TEST(TrimToFree, FindsInColoursTheTipsThatGreyDoesNotShow) {
  constexpr double kClosePx = 1, kShortPx = 14;
  for (const double green : {0.5, 0.55, 0.6, 0.65}) {
    SceneSpec spec = SceneWithShadowsInTheGap(60 * kDegree);
    spec.light.shadow = spec.light.contact_shadow = 0;
    spec.theta_rad = 30 * kDegree;
    spec.scissors.tip_radius_mm = 0.4;
    spec.backdrop = Backdrop::kDrape;
    spec.drape_rgb = {0.1, green, 0.15};
    Seen seen(spec);
    seen.scene.left.tip_px -=
        kShortPx * (seen.scene.left.tip_px - seen.scene.crotch_px).normalized();
    const BladeView view(seen.photo, seen.scale, seen.scene);
    LocatedBlade upper{true, LocateBlades(view).upper, {}, {}, {}};
    TrimToFree(view, &upper);
    EXPECT_TRUE(upper.end.arc_seen) << green;
    EXPECT_LT((upper.end.point_px - TruthOf(spec).upper.end_px).norm(), kClosePx) << green;
  }
}

// There grey leaves no doubt: the shadow's border is as clear as an edge. Lower sun throws shadows
// more than half as wide as the blades.
TEST(LocateBlades, TakesTheColoursOfLargePhotographsToo) {
  constexpr double kClosePx = 0.3, kLarger = 1.5;
  for (const auto& [elevation_rad, theta_rad] :
       {std::pair(35 * kDegree, 45 * kDegree), std::pair(25 * kDegree, 20 * kDegree)}) {
    SceneSpec spec = BlackBladesInSunOnDrape(0.7);
    spec.light.direction_rad = 135 * kDegree;
    spec.light.elevation_rad = elevation_rad;
    spec.theta_rad = theta_rad;
    spec.width = static_cast<int>(kLarger * spec.width);
    spec.height = static_cast<int>(kLarger * spec.height);
    spec.camera.mm_per_px /= kLarger;
    spec.camera.blur_px *= kLarger;
    const BladeEdges edges = Seen(spec).Locate();
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << elevation_rad;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << elevation_rad;
  }
}

// Shadows fall out of one blade's cutting edge and of the other one's outer side.
SceneSpec SceneWithShadowOnOneSide(double elevation_rad) {
  SceneSpec spec;
  spec.width = 2000;
  spec.height = 1500;
  spec.camera.mm_per_px = 0.134;
  spec.theta_rad = 19 * kDegree;
  spec.heading_rad = 33 * kDegree;
  spec.edge_height_mm = 2.75;
  spec.scissors.width_mm = 7.3;
  spec.light.direction_rad = 170 * kDegree;
  spec.light.elevation_rad = elevation_rad;
  spec.light.shadow = 0.72;
  spec.light.shadow_blur_mm = 0.16;
  spec.light.glint = 1.1;
  return spec;
}

// Grey on grey, colours tell nothing. A shadow as dark as the blade's bevel might be its bevel, but
// the other blade's outer side has none.
TEST(LocateBlades, TakesNoShadowForBladeThatTheOtherBladesOuterSideCastsToo) {
  constexpr double kClosePx = 0.3;
  for (const double elevation_rad : {35 * kDegree, 42 * kDegree, 50 * kDegree}) {
    const SceneSpec spec = SceneWithShadowOnOneSide(elevation_rad);
    const BladeEdges edges = Seen(spec).Locate();
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << elevation_rad;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << elevation_rad;
  }
}

// Black blades are darker than their shadows on paper, which look like bevels.
TEST(LocateBlades, TakesNoBrightShadowForBladeThatTheOtherBladesOuterSideCastsToo) {
  constexpr double kClosePx = 0.3;
  for (const double shadow : {0.85, 0.88}) {
    SceneSpec spec = SceneWithShadowOnOneSide(42 * kDegree);
    spec.finish = Finish::kBlack;
    spec.light.shadow = shadow;
    const BladeEdges edges = Seen(spec).Locate();
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << shadow;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << shadow;
  }
}

// Hard shadows of black blades, 2 to 4 px wide, along the upper edge or the lower one: narrower
// than what can be told from blur by its light. The sides of the scissors that face as the edge
// does cast one, too.
TEST(LocateBlades, LeavesNarrowShadowsOfBlackBlades) {
  constexpr double kClosePx = 0.5, kSigmas = 2;
  for (const auto& [theta_deg, elevation_deg, direction_deg, shadow] :
       {std::tuple(19, 40, 220, 0.85),
        std::tuple(30, 60, 220, 0.75),
        std::tuple(45, 60, 200, 0.75),
        std::tuple(45, 60, 220, 0.85),
        std::tuple(60, 70, 220, 0.75)}) {
    SceneSpec spec = SceneWithShadowOnOneSide(elevation_deg * kDegree);
    spec.finish = Finish::kBlack;
    spec.theta_rad = theta_deg * kDegree;
    spec.light.direction_rad = direction_deg * kDegree;
    spec.light.shadow = shadow;
    spec.light.shadow_blur_mm = 0.08;
    const BladeEdges edges = Seen(spec).Locate();
    const SceneTruth truth = TruthOf(spec);
    for (const auto& [edge, of_blade] :
         {std::pair(&edges.upper, &truth.upper), std::pair(&edges.lower, &truth.lower)}) {
      const double off_px = FarFrom(*of_blade, edge->points);
      EXPECT_LT(off_px, kClosePx) << theta_deg << " " << direction_deg;
      EXPECT_LT(off_px, kSigmas * TotalSigma(*edge)) << theta_deg << " " << direction_deg;
    }
  }
}

// Sun on the upper cutting edge, and a coloured ground.
SceneSpec SceneLitFromItsUpperEdgesSide(double elevation_rad) {
  SceneSpec spec = SceneWithShadowOnOneSide(elevation_rad);
  spec.light.direction_rad += std::numbers::pi;
  spec.backdrop = Backdrop::kDrape;
  spec.drape_rgb = {0.5, 0.33, 0.2};
  spec.texture = 0;
  return spec;
}

// A narrow bevel along the upper edge that mirrors the ground, but darker: `dark` of its grey
// values. It looks like the ground in shadow.
cv::Mat WithDarkBevel(const SceneSpec& spec, double bevel_px, double dark) {
  return RetouchedAlongUpperEdge(
      spec, 0.5, bevel_px, [&](const cv::Vec3d& sheet, double, double) { return dark * sheet; });
}

// Neither its shank nor the other blade's outer side casts one.
TEST(LocateBlades, TakesNoBevelForAShadowThatNothingElseCasts) {
  constexpr double kClosePx = 0.5;
  for (const double bevel_px : {3.0, 4.0}) {
    const SceneSpec spec = SceneLitFromItsUpperEdgesSide(50 * kDegree);
    const BladeEdges edges = Seen(spec, WithDarkBevel(spec, bevel_px, 0.35)).Locate();
    EXPECT_LT(FarFrom(TruthOf(spec).upper, edges.upper.points), kClosePx) << bevel_px;
  }
}

// Catalogue pictures without a shadow: shanks are as dark along their sides as bevels, and tell
// nothing.
TEST(LocateBlades, DoubtsNoBevelWhereTheOtherBladesOuterSideCastsNothing) {
  constexpr double kClosePx = 0.3;
  for (const std::uint64_t seed : {7000027, 7000049}) {
    SceneSpec spec = RandomScene(seed);
    spec.width = 1600;
    spec.height = 1200;
    spec.camera.mm_per_px = 0.16;
    spec.camera.tilt_rad = 0;
    spec.backdrop = Backdrop::kCutOut;
    spec.light.shadow = spec.light.contact_shadow = 0;
    spec.markers.clear();
    const BladeEdges edges = Seen(spec).Locate();
    EXPECT_LE(edges.lower.ambiguity, kAsGood) << seed;
    EXPECT_LT(FarFrom(TruthOf(spec).lower, edges.lower.points), kClosePx) << seed;
  }
}

// A picture on white, not quite overexposed, of slightly bluish steel, whose colour compression has
// taken from along the blades' borders, `smear_px` wide.
cv::Mat WithSmearedColours(const cv::Mat& picture, int smear_px) {
  constexpr double kDimmed = 0.9, kMetal = 215;  // of the grey values; what is darker
  constexpr double kNeutral = 128, kRed = -4, kBlue = 5;
  const int width = 2 * smear_px + 1;
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_ELLIPSE, {width, width});
  cv::Mat luma, blue_inside, smeared;
  cv::cvtColor(kDimmed * picture, luma, cv::COLOR_BGR2GRAY);
  cv::erode(luma < kMetal, blue_inside, window);
  cv::Mat red(luma.size(), CV_8U, cv::Scalar(kNeutral)), blue = red.clone();
  red.setTo(kNeutral + kRed, blue_inside);
  blue.setTo(kNeutral + kBlue, blue_inside);
  cv::merge(std::vector{luma, red, blue}, smeared);
  cv::cvtColor(smeared, smeared, cv::COLOR_YCrCb2BGR);
  return smeared;
}

// In pictures on white, whose colours hardly tell blades from ground, these end further in than
// grey does along the blades' other sides too.
TEST(LocateBlades, TakesNoColoursThatCompressionSmeared) {
  constexpr double kClosePx = 0.3;
  for (const int smear_px : {4, 5}) {
    SceneSpec spec = SceneWithShadowsInTheGap(60 * kDegree);
    spec.backdrop = Backdrop::kCutOut;
    spec.light.shadow = spec.light.contact_shadow = 0;
    const BladeEdges edges =
        Seen(spec, WithSmearedColours(RenderScene(spec).bgr, smear_px)).Locate();
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << smear_px;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << smear_px;
  }
}

// As cameras store it, colours at half the resolution.
Photo CompressedPhoto(const cv::Mat& picture, int quality) {
  const std::filesystem::path file = ProcessFolder() / "compressed.jpg";
  std::ofstream(file, std::ios::binary)
      << Jpeg(picture, {.space = JCS_EXT_BGR, .channels = 3, .quality = quality});
  return Photo::Load(file);
}

// Nor are they told apart to less than a pixel of theirs, two of the photograph's.
TEST(LocateBlades, TakesNoColoursThatEndAPixelFurtherIn) {
  constexpr double kClosePx = 0.3;
  SceneSpec spec = RandomScene(7011);
  spec.markers.clear();
  const BladeEdges edges = Seen(spec, CompressedPhoto(RenderScene(spec).bgr, 90)).Locate();
  EXPECT_LT(FarFrom(TruthOf(spec).upper, edges.upper.points), kClosePx);
}

// A narrow bevel along the upper edge that mirrors a coloured ground, and is brighter. Light falls
// at its border, going outwards, which it does at no shadow's.
TEST(LocateBlades, TakesNoBrightBevelForGround) {
  constexpr double kClosePx = 0.5, kBright = 1.5;  // times the ground's grey values
  for (const double bevel_px : {3.0, 4.0, 5.0}) {
    SceneSpec spec = SceneLitFromItsUpperEdgesSide(50 * kDegree);
    spec.light.shadow = spec.light.contact_shadow = 0;
    const cv::Mat picture =
        RetouchedAlongUpperEdge(spec, 0.5, bevel_px, [&](const cv::Vec3d& sheet, double, double) {
          return kBright * sheet;
        });
    const BladeEdges edges = Seen(spec, picture).Locate();
    EXPECT_LT(FarFrom(TruthOf(spec).upper, edges.upper.points), kClosePx) << bevel_px;
  }
}

// There the blade's outer side casts a shadow, by far wider than the bevel.
TEST(LocateBlades, TakesNoBevelForAShadowOnTheSideThatLightComesFrom) {
  constexpr double kClosePx = 0.5;
  for (const auto& [theta_deg, bevel_px, dark] : {std::tuple(19, 2.5, 0.35),
                                                  std::tuple(19, 2.5, 0.5),
                                                  std::tuple(40, 2.5, 0.6),
                                                  std::tuple(40, 3.0, 0.5),
                                                  std::tuple(40, 4.0, 0.5)}) {
    SceneSpec spec = SceneLitFromItsUpperEdgesSide(40 * kDegree);
    spec.theta_rad = theta_deg * kDegree;
    const BladeEdges edges = Seen(spec, WithDarkBevel(spec, bevel_px, dark)).Locate();
    EXPECT_LT(FarFrom(TruthOf(spec).upper, edges.upper.points), kClosePx) << bevel_px << dark;
  }
}

// Shadows of a high sun, nearly black, that differ by how much of the ground's light blur leaves in
// them.
TEST(LocateBlades, TakesNoShadowForBladeThatTheWholeSideCasts) {
  constexpr double kClosePx = 0.3;
  for (const auto& [theta_deg, direction_deg] :
       {std::pair(19, 150), std::pair(19, 170), std::pair(35, 150), std::pair(35, 170)}) {
    SceneSpec spec = SceneWithShadowOnOneSide(60 * kDegree);
    spec.theta_rad = theta_deg * kDegree;
    spec.light.direction_rad = direction_deg * kDegree;
    spec.light.shadow = 0.95;
    spec.light.shadow_blur_mm = 0.1;
    spec.scissors.bevel_mm = 0;
    spec.backdrop = Backdrop::kDrape;
    spec.drape_rgb = {0.35, 0.35, 0.35};
    const BladeEdges edges = Seen(spec).Locate();
    EXPECT_LT(FarFrom(TruthOf(spec).upper, edges.upper.points), kClosePx) << theta_deg;
  }
}

// Wide open the outer side faces another way and its shadow is narrower; the shank's is as wide.
TEST(LocateBlades, TakesNoShadowForBladeThatItsOwnShankCastsToo) {
  constexpr double kClosePx = 0.3;
  for (const double heading_rad : {33 * kDegree, 45 * kDegree}) {
    SceneSpec spec = SceneWithShadowOnOneSide(35 * kDegree);
    spec.finish = Finish::kBlack;
    spec.light.shadow = 0.85;
    spec.theta_rad = 70 * kDegree;
    spec.heading_rad = heading_rad;
    const BladeEdges edges = Seen(spec).Locate();
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << heading_rad;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << heading_rad;
  }
}

// Light from nearly along one blade casts narrow shadows along the other shank, too: no shading,
// which would fade.
TEST(LocateBlades, TakesNoShadowForBladeThatEndsSharplyAlongItsShank) {
  constexpr double kClosePx = 0.3;
  for (const auto& [theta_deg, direction_deg, elevation_deg] :
       {std::tuple(35, 190, 45), std::tuple(40, 190, 35), std::tuple(40, 200, 45)}) {
    SceneSpec spec = SceneWithShadowOnOneSide(elevation_deg * kDegree);
    spec.theta_rad = theta_deg * kDegree;
    spec.light.direction_rad = direction_deg * kDegree;
    const BladeEdges edges = Seen(spec).Locate();
    EXPECT_LT(FarFrom(TruthOf(spec).upper, edges.upper.points), kClosePx) << theta_deg;
  }
}

// Round shanks are as dark along their sides as the bevels: the first's alike, the second's, black
// ones, on one side and not as far as the bevel, the third's further along one side.
TEST(LocateBlades, TakesNoBevelForAShadowBecauseOfHowItsShankIsShaded) {
  constexpr double kClosePx = 0.3;
  for (const std::uint64_t seed : {7000207, 7000275, 7000543}) {
    const SceneSpec spec = RandomScene(seed);
    const BladeEdges edges = Seen(spec).Locate();
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << seed;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << seed;
  }
}

// As wide as the blur the shadow is no line of its own, and draws the edge to its border.
TEST(LocateBlades, TakesTheColoursWhereAShadowIsNarrow) {
  constexpr double kClosePx = 0.3;
  for (const double theta_rad : {20 * kDegree, 45 * kDegree}) {
    SceneSpec spec = BlackBladesInSunOnDrape(0.9);
    spec.light.direction_rad = 135 * kDegree;
    spec.light.elevation_rad = 70 * kDegree;
    spec.theta_rad = theta_rad;
    const BladeEdges edges = Seen(spec).Locate();
    const SceneTruth truth = TruthOf(spec);
    EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx) << theta_rad;
    EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx) << theta_rad;
  }
}

// An upper blade on green ground with a grey bevel, and beside that a dark band of `band` colour,
// or of the ground's in shadow, whose border was taken for the blade's.
double FarFromBorderBesideBevel(const std::optional<cv::Vec3d>& band) {
  constexpr double kBandPx = 4, kShade = 0.3;
  SceneSpec spec;
  spec.backdrop = Backdrop::kDrape;
  spec.drape_rgb = {0.1, 0.25, 0.17};
  spec.light.glint = spec.light.shadow = 0;
  const cv::Mat picture = RetouchedAlongUpperEdge(
      spec, -kBandPx, kBevelPx, [&](const cv::Vec3d& sheet, double depth, double) -> cv::Vec3d {
        return depth >= 0 ? cv::Vec3d(82, 84, 80) : band.value_or(kShade * sheet);
      });
  const Seen seen(spec, picture);
  const BladeView view(seen.photo, seen.scale, seen.scene);
  BladeEdges edges = Seen(spec).Locate();
  for (LocatedEdgePoint& point : edges.upper.points) {
    point.point_px += kBandPx * point.normal;
    point.trend_px += kBandPx * point.normal;
  }
  for (LocatedEdgePoint& point : edges.lower.points) point.inlier = false;  // else it would tell
  edges.upper.rival_px = -kBandPx - kBevelPx;
  edges.upper.ambiguity = 0.5;
  LeaveCastShadow(view, &edges);
  return FarFrom(TruthOf(spec).upper, edges.upper.points);
}

TEST(LeaveCastShadow, LeavesADarkBandOfTheGroundsColourBesideABevel) {
  constexpr double kClosePx = 0.5, kFarPx = 2;
  EXPECT_LT(FarFromBorderBesideBevel(std::nullopt), kClosePx);
  EXPECT_GT(FarFromBorderBesideBevel(cv::Vec3d(26, 27, 25)), kFarPx) << "its dark facet";
}

// Scene finding may take a piece of the background for blade: its trace has a notch then.
void Notch(std::vector<Eigen::Vector2d>* trace) {
  constexpr double kNotchPx = 10;
  const Eigen::Vector2d along = (trace->back() - trace->front()).normalized();
  for (size_t i = trace->size() * 6 / 10; i < trace->size() * 8 / 10; ++i)
    (*trace)[i] += kNotchPx * Eigen::Vector2d(along.y(), -along.x());
}

TEST(LocateBlades, FollowsTheCurveOfMostOfTheEdgeWhereTheTraceStrays) {
  constexpr double kClosePx = 0.3;
  const SceneSpec spec = testing::SceneWithMarkers();
  Seen seen(spec);
  Notch(&seen.scene.left.inner_px);
  const LocatedEdge edge = seen.Locate().upper;
  size_t inlying = 0;
  for (const LocatedEdgePoint& point : edge.points) inlying += point.inlier;
  EXPECT_GT(inlying, 0.95 * edge.points.size());
  EXPECT_LT(FarFrom(TruthOf(spec).upper, edge.points), kClosePx);
}

// The look along that curve is too narrow to see both sides of a shadow.
TEST(LocateBlades, LeavesAShadowsBorderWhereTheTraceStrays) {
  constexpr double kClosePx = 0.3;
  const SceneSpec spec = SceneWithShadowsInTheGap(45 * kDegree);
  Seen seen(spec);
  Notch(&seen.scene.left.inner_px);
  Notch(&seen.scene.right.inner_px);
  const BladeEdges edges = seen.Locate();
  const SceneTruth truth = TruthOf(spec);
  EXPECT_LT(FarFrom(truth.upper, edges.upper.points), kClosePx);
  EXPECT_LT(FarFrom(truth.lower, edges.lower.points), kClosePx);
}

// Two straight blades that cross, the upper one above its edge, on an even ground.
class PaintedBlades {
 public:
  static constexpr double kUpper = -0.2, kLower = 0.2;  // slopes of the edges
  static constexpr int kHeel = 60, kCrossing = 250, kEnd = 550;
  static constexpr double kBladePx = 70;

  explicit PaintedBlades(uchar ground)
      : fine_(400 * kFiner, 600 * kFiner, CV_8UC3, cv::Scalar::all(ground)) {}

  static Eigen::Vector2d At(double x, double slope, double below_px = 0) {
    return {x, 200 + slope * (x - kCrossing) + below_px};
  }

  void Paint(double slope, double below_px, uchar light) {
    PaintBand(slope, 0, below_px, kEnd, light);
  }

  // The side of the upper blade's shank that faces as its edge does, with a shadow beyond it.
  void PaintShank(uchar light, double shadow_px, uchar shade) {
    PaintBand(kUpper, kShankBelowPx, -kShankPx, kShankEnd, light);
    PaintBand(kUpper, kShankBelowPx, -shadow_px, kShankEnd, shade);
    shank_seen_ = true;
  }

  // Located from traces that begin at `from`: before the crossing both lie on the upper edge.
  [[nodiscard]] BladeEdges Locate(int from, double blur_px) const {
    Scene scene;
    for (SceneBlade* blade : {&scene.left, &scene.right}) {
      const double slope = blade == &scene.left ? kUpper : kLower;
      const double below_px = blade == &scene.left ? -kBladePx : kBladePx;
      for (int x = from; x < kEnd - 5; ++x) {
        blade->inner_px.push_back(At(x, x < kCrossing ? kUpper : slope));
        blade->outer_px.push_back(At(x, slope, below_px));
      }
      blade->tip_px = At(kEnd, slope);
      blade->width_px = kBladePx;
    }
    for (int x = kShankEnd - 5; shank_seen_ && x > kHeel + 5; --x)
      scene.left.shank_px.push_back(At(x, kUpper, kShankBelowPx));
    scene.path_sigma_px = 1;
    ScaleOptions options;
    options.mm_per_px = 0.15;
    cv::Mat bgr;
    cv::resize(fine_, bgr, {}, 1.0 / kFiner, 1.0 / kFiner, cv::INTER_AREA);
    cv::GaussianBlur(bgr, bgr, {}, blur_px);
    const Photo photo = Measured::PhotoOf(bgr);
    const ScaleResult scale = FindScale(photo, options);
    return LocateBlades(BladeView(photo, scale, scene));
  }

  static void ExpectOnEdges(const BladeEdges& edges) {
    constexpr double kOffPx = 0.5;
    for (const LocatedEdge* edge : {&edges.upper, &edges.lower}) {
      const double slope = edge == &edges.upper ? kUpper : kLower;
      for (const LocatedEdgePoint& p : edge->points) {
        if (!p.inlier) continue;
        EXPECT_NEAR(p.trend_px.y(), At(p.trend_px.x(), slope).y(), kOffPx) << p.trend_px.x();
      }
    }
  }

 private:
  static constexpr int kFiner = 8, kShankEnd = 240;
  static constexpr double kShankBelowPx = 130, kShankPx = 30;

  // Between a line some way below a blade's edge and its parallel further below.
  void PaintBand(double slope, double from_px, double below_px, int end, uchar light) {
    std::vector<cv::Point> band;
    for (const auto& [x, below] :
         {std::pair(kHeel, 0.0), {end, 0.0}, {end, below_px}, {kHeel, below_px}}) {
      const Eigen::Vector2d p =
          kFiner * (At(x, slope, from_px + below) + Eigen::Vector2d(0.5, 0.5));
      band.emplace_back(cvRound(p.x()), cvRound(p.y()));
    }
    cv::fillConvexPoly(fine_, band, cv::Scalar::all(light));
  }

  cv::Mat fine_;
  bool shank_seen_ = false;
};

TEST(LocateBlades, LeavesNarrowShadowsInSharpPictures) {
  constexpr double kShadowPx = 3, kBlurPx = 0.3;
  constexpr uchar kGround = 200, kShade = 60, kBlade = 170;
  PaintedBlades blades(kGround);
  blades.Paint(PaintedBlades::kLower, -kShadowPx, kShade);
  blades.Paint(PaintedBlades::kUpper, kShadowPx, kShade);
  blades.Paint(PaintedBlades::kLower, PaintedBlades::kBladePx, kBlade);
  blades.Paint(PaintedBlades::kUpper, -PaintedBlades::kBladePx, kBlade);
  PaintedBlades::ExpectOnEdges(blades.Locate(PaintedBlades::kCrossing + 20, kBlurPx));
}

// A rounded blade is bright along its middle alone. A shadow falls to one side.
TEST(LocateBlades, TakeTheFlankOfARoundBladeForBlade) {
  constexpr double kFlankPx = 22, kBlurPx = 0.8;
  constexpr uchar kGround = 150, kFlank = 60, kRidge = 165;
  for (const double outer_flank_px : {16, 22, 30}) {
    PaintedBlades blades(kGround);
    for (const auto& [blade, side] :
         {std::pair(PaintedBlades::kLower, 1.0), std::pair(PaintedBlades::kUpper, -1.0)}) {
      blades.Paint(blade, side * PaintedBlades::kBladePx, kFlank);
      blades.Paint(blade, side * (PaintedBlades::kBladePx - outer_flank_px), kRidge);
      blades.Paint(blade, side * kFlankPx, kFlank);
    }
    PaintedBlades::ExpectOnEdges(blades.Locate(PaintedBlades::kCrossing + 20, kBlurPx));
  }
}

// About as dark as the ground, the bevel of one blade: only the line where it begins is clear.
TEST(LocateBlades, DoubtAnEdgeWithinABandThatNothingSettles) {
  constexpr double kBevelPx = 22, kBlurPx = 0.8, kWithin = 2.5;  // standard uncertainties
  constexpr uchar kGround = 102, kBevel = 95, kPlate = 165;
  PaintedBlades blades(kGround);
  blades.Paint(PaintedBlades::kLower, PaintedBlades::kBladePx, kPlate);
  blades.Paint(PaintedBlades::kUpper, -PaintedBlades::kBladePx, kPlate);
  blades.Paint(PaintedBlades::kUpper, -kBevelPx, kBevel);
  const LocatedEdge upper = blades.Locate(PaintedBlades::kCrossing + 20, kBlurPx).upper;
  const Eigen::Vector2d middle = upper.points[upper.points.size() / 2].trend_px;
  const double off_px = middle.y() - PaintedBlades::At(middle.x(), PaintedBlades::kUpper).y();
  EXPECT_LT(std::abs(off_px), kWithin * upper.common_sigma_px);
}

// Grey on grey, a dark band along one edge is a bevel if the same side of the shank, which would
// cast the same shadow, casts none.
TEST(LocateBlades, TakeABandForABevelThatIsNoShadowOfTheShanks) {
  constexpr double kBandPx = 22, kBlurPx = 0.8;
  constexpr uchar kGround = 200, kBand = 90, kPlate = 165;
  const auto upper = [&](const std::function<void(PaintedBlades*)>& paint_shank) {
    PaintedBlades blades(kGround);
    blades.Paint(PaintedBlades::kLower, PaintedBlades::kBladePx, kPlate);
    blades.Paint(PaintedBlades::kUpper, -PaintedBlades::kBladePx, kPlate);
    blades.Paint(PaintedBlades::kUpper, -kBandPx, kBand);
    paint_shank(&blades);
    return blades.Locate(PaintedBlades::kCrossing + 20, kBlurPx).upper;
  };
  constexpr double kClear = 0.3, kDoubtful = 0.5;  // ambiguity
  const LocatedEdge no_shank = upper([](PaintedBlades*) {});
  EXPECT_GT(no_shank.ambiguity, kDoubtful) << "something else settles it";
  EXPECT_GT(no_shank.common_sigma_px, 1);
  const LocatedEdge bevel =
      upper([&](PaintedBlades* blades) { blades->PaintShank(kPlate, 0, kBand); });
  EXPECT_LT(bevel.ambiguity, kClear);
  EXPECT_LT(bevel.common_sigma_px, 0.3);
  const Eigen::Vector2d middle = bevel.points[bevel.points.size() / 2].trend_px;
  EXPECT_NEAR(middle.y(), PaintedBlades::At(middle.x(), PaintedBlades::kUpper).y(), 0.5);
  const LocatedEdge shadow =
      upper([&](PaintedBlades* blades) { blades->PaintShank(kPlate, 0.5 * kBandPx, kBand); });
  EXPECT_GT(shadow.ambiguity, kDoubtful);
}

// Twice as narrow along the other blade's outer side, and a little narrower along the shank: either
// alone might be something else.
TEST(LocateBlades, TakeABandForAShadowThatShankAndOtherBladeCastNarrower) {
  constexpr double kBandPx = 18, kShankPx = 15, kOuterPx = 8, kBlurPx = 0.8, kOffPx = 0.5;
  constexpr uchar kGround = 200, kBand = 90, kPlate = 165;
  const auto off_px = [&](double outer_px) {
    PaintedBlades blades(kGround);
    blades.Paint(PaintedBlades::kLower, PaintedBlades::kBladePx + outer_px, kBand);
    blades.Paint(PaintedBlades::kLower, PaintedBlades::kBladePx, kPlate);
    blades.Paint(PaintedBlades::kUpper, kBandPx, kBand);
    blades.Paint(PaintedBlades::kUpper, -PaintedBlades::kBladePx, kPlate);
    blades.PaintShank(kPlate, kShankPx, kBand);
    const LocatedEdge upper = blades.Locate(PaintedBlades::kCrossing + 20, kBlurPx).upper;
    const Eigen::Vector2d middle = upper.points[upper.points.size() / 2].trend_px;
    return middle.y() - PaintedBlades::At(middle.x(), PaintedBlades::kUpper).y();
  };
  EXPECT_GT(off_px(0), kBandPx / 2) << "something else settles it";
  EXPECT_NEAR(off_px(kOuterPx), 0, kOffPx);
}

// A bevel about as dark as the ground seems to part the blades as far as their joint.
TEST(LocateBlades, FollowNoEdgeOnAlongTheOther) {
  constexpr double kBevelPx = 35, kBlurPx = 0.8;
  constexpr uchar kGround = 90, kBevel = 110, kLower = 170, kUpper = 190;
  PaintedBlades blades(kGround);
  blades.Paint(PaintedBlades::kLower, PaintedBlades::kBladePx, kLower);
  blades.Paint(PaintedBlades::kUpper, -PaintedBlades::kBladePx, kUpper);
  blades.Paint(PaintedBlades::kUpper, -kBevelPx, kBevel);
  PaintedBlades::ExpectOnEdges(blades.Locate(PaintedBlades::kHeel + 5, kBlurPx));
}

// The upper edge is what is measured; the lower one tells less, and may be lost.
TEST(LocateBlades, TraceALowerEdgeThatIsNotSeen) {
  constexpr int kSmearedPx = 60;
  const SceneSpec spec;
  cv::Mat picture = RenderScene(spec).bgr;
  const Seen seen(spec, picture);
  EXPECT_FALSE(seen.Locate().lower.traced);
  for (const Eigen::Vector2d& p : CuttingEdgeOf(seen.scene, false).path_px)
    cv::circle(picture, {cvRound(p.x()), cvRound(p.y())}, kSmearedPx, cv::Scalar::all(128), -1);
  const Photo smeared = Measured::PhotoOf(picture);
  const BladeEdges edges = LocateBlades(BladeView(smeared, seen.scale, seen.scene));
  EXPECT_TRUE(edges.lower.traced);
  EXPECT_EQ(edges.lower.ambiguity, 1);
  EXPECT_FALSE(edges.upper.traced);
}

// A soft shadow that begins at the edge looks like blur on both sides where the edge is faint.
TEST(LocateBlades, TakesNoShadowForBlurThatPrintAndTheOtherBladeDoNotShow) {
  constexpr double kSofter = 1.1;   // times the print's blur
  constexpr double kClosePx = 1.1;  // 1.3 to 1.5 if the shadow is taken for blur
  for (const auto& [elevation_rad, direction_rad] :
       {std::pair(62 * kDegree, 315 * kDegree), std::pair(72 * kDegree, 270 * kDegree)}) {
    const Measured measured(SceneWithShadow(elevation_rad, direction_rad, 0.8));
    const LocatedEdge& lower = measured.blades.lower.edge;
    EXPECT_LT(lower.blur_px, kSofter * measured.scale.markers[0].blur_px) << elevation_rad;
    EXPECT_LT(FarFrom(measured.truth.lower, lower.points), kClosePx) << elevation_rad;
  }
}

// Print tells that light rises too slowly there for a blade's border.
TEST(LocateBlades, GoesFromASoftShadowsBorderToWhereTheShadowBegins) {
  constexpr double kClosePx = 0.3;  // the shadow's border lies 1.3 to 1.9 px off
  for (const auto& [elevation_rad, direction_rad] :
       {std::pair(62 * kDegree, 315 * kDegree), std::pair(72 * kDegree, 270 * kDegree)}) {
    const Measured measured(SceneWithShadow(elevation_rad, direction_rad, 0.4));
    EXPECT_LT(FarFrom(measured.truth.lower, measured.blades.lower.edge.points), kClosePx)
        << elevation_rad;
  }
}

// Steel on a drape that is five grey values brighter, in grain that all colours share.
TEST(BladeView, TakesTheColoursWhereGreyShowsAnEdgeFaintly) {
  constexpr int kSide = 300;
  constexpr double kOffset = 200, kBlurPx = 0.8, kGrain = 3, kNoise = 1.5;
  constexpr double kFaintPx = 1, kClosePx = 0.1;
  const Eigen::Vector3d steel(120, 110, 100), drape(155, 105, 113);
  const Eigen::Vector2d normal(std::cos(0.4), std::sin(0.4)), along(-normal.y(), normal.x());
  const auto from_edge = [&](const Eigen::Vector2d& px) { return normal.dot(px) - kOffset; };
  testing::Gaussian random(1);
  cv::Mat bgr(kSide, kSide, CV_8UC3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double ground = testing::Smooth(from_edge(Eigen::Vector2d(x, y)), kBlurPx);
      const Eigen::Vector3d light = steel + ground * (drape - steel);
      const double grain = kGrain * random();
      for (int c = 0; c < 3; ++c)
        bgr.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(light[c] + grain + kNoise * random());
    }
  }
  const Photo photo = Measured::PhotoOf(bgr);
  ScaleResult scale;
  scale.tone = testing::GammaCurve(1);
  const Eigen::Vector2d middle = (kOffset + 2) * normal + 60 * along;
  EdgeGuess guess;
  guess.path_px = {middle - 110 * along, middle + 110 * along};
  guess.blade_on_left = false;
  EXPECT_GT(TypicalSigma(LocateEdge(photo.grey(), scale.tone, guess).points), kFaintPx);
  Scene scene;
  scene.pivot_px = guess.path_px.front();
  scene.left.tip_px = guess.path_px.back();
  scene.left.inner_px = guess.path_px;
  const LocatedEdge edge = BladeView(photo, scale, scene).InGreyOrColours(guess);
  EXPECT_LT(TypicalSigma(edge.points), kClosePx);
  for (const LocatedEdgePoint& point : edge.points) {
    if (point.inlier) {
      EXPECT_NEAR(from_edge(point.point_px), 0, 4 * kClosePx);
    }
  }
}

}  // namespace
}  // namespace bladecurve
