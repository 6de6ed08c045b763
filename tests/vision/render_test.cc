// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "tests/degree.h"
#include "vision/photo/photo.h"
#include "vision/render/render_camera.h"
#include "vision/render/render_outline.h"
#include "vision/render/render_sensor.h"

namespace bladecurve {
namespace {

SceneSpec SmallScene() {
  SceneSpec scene;
  scene.width = 640;
  scene.height = 480;
  scene.camera.mm_per_px = 0.45;
  return scene;
}

// Linear output, no noise, even light: what is left is geometry.
SceneSpec BareScene() {
  SceneSpec scene = SmallScene();
  scene.sensor = {.srgb = false, .gamma = 1, .noise_grey = 0};
  scene.texture = 0;
  scene.light.falloff = 0;
  scene.light.shadow = 0;
  scene.light.contact_shadow = 0;
  return scene;
}

bool SamePicture(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

TEST(RenderScene, GivesTheSameBytesForTheSameSpec) {
  SceneSpec scene = SmallScene();
  const cv::Mat first = RenderScene(scene).bgr;
  EXPECT_TRUE(SamePicture(first, RenderScene(scene).bgr));
  scene.seed += 1;
  EXPECT_FALSE(SamePicture(first, RenderScene(scene).bgr));
}

TEST(RenderScene, NamesTheFieldThatCannotBe) {
  SceneSpec scene = SmallScene();
  scene.camera.mm_per_px = -1;
  try {
    static_cast<void>(RenderScene(scene));
    FAIL() << "a negative scale was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("camera.mm_per_px"), std::string::npos)
        << error.what();
  }
}

TEST(RenderScene, DarkensTheAreaOfAMarkersInk) {
  SceneSpec scene = BareScene();
  scene.with_scissors = false;
  scene.camera.tilt_rad = 0;
  scene.markers = {
      {.id = 7, .size_mm = 40, .center_mm = {3.3, -5.1}, .angle_rad = 0.3, .margin_mm = 40}};
  const RenderedPhoto photo = RenderScene(scene);
  const double side_px = 40 / scene.camera.mm_per_px;
  constexpr double kPaper = 0.95, kInk = 0.045;
  const double exposure = 255 * scene.light.exposure;
  const auto& corners = photo.truth.markers[0].corners_px;
  const Eigen::Vector2d center = 0.5 * (corners[0] + corners[2]);
  double lost = 0;
  int pixels = 0;
  for (int r = 0; r < scene.height; ++r) {
    for (int c = 0; c < scene.width; ++c) {
      if ((Eigen::Vector2d(c, r) - center).cwiseAbs().maxCoeff() > 0.8 * side_px) continue;
      lost += kPaper * exposure - photo.bgr.at<cv::Vec3b>(r, c)[1];
      ++pixels;
    }
  }
  constexpr double kInkCells = 36 - 8;  // number 7 has 8 white cells: 1100 0100 1111 0010
  const double ink_px = kInkCells / 36 * side_px * side_px;
  constexpr double kRounding = 0.1;  // grey levels: 188.95 and 8.95 are stored as 189 and 9
  EXPECT_NEAR(lost / ((kPaper - kInk) * exposure), ink_px, kRounding * pixels / exposure);
}

// Distance by which the picture's edge lies beyond the true one, out of the metal, from the light
// along the normal.
double MeanOffsetPx(const cv::Mat1f& light, const EdgeTruth& edge, double inwards_sign) {
  constexpr int kReach = 5, kPerPixel = 8;
  double sum = 0;
  int count = 0;
  for (std::size_t i = edge.px.size() / 2; i + 30 < edge.px.size(); i += 3) {
    const Eigen::Vector2d along = (edge.px[i + 1] - edge.px[i - 1]).normalized();
    const Eigen::Vector2d inwards = inwards_sign * Eigen::Vector2d(along.y(), -along.x());
    const auto at = [&](double d) {
      cv::Mat1f value;
      const Eigen::Vector2d p = edge.px[i] + d * inwards;
      cv::getRectSubPix(light, cv::Size(1, 1), cv::Point2d(p.x(), p.y()), value);
      return static_cast<double>(value(0, 0));
    };
    const double outside = at(-kReach), inside = at(kReach);
    double covered = 0;
    for (int k = -kReach * kPerPixel; k < kReach * kPerPixel; ++k) {
      covered += (at((k + 0.5) / kPerPixel) - outside) / (inside - outside) / kPerPixel;
    }
    sum += covered - kReach;
    ++count;
  }
  return sum / count;
}

TEST(RenderScene, PutsBothEdgesWhereTheTruthSays) {
  SceneSpec scene = BareScene();
  scene.width = 1600;
  scene.height = 1200;
  scene.finish = Finish::kBlack;
  scene.backdrop = Backdrop::kPaper;
  scene.light.glint = 0;
  scene.scissors.bevel_mm = 0;
  scene.camera = {.mm_per_px = 0.17,
                  .distance_mm = 300,
                  .tilt_rad = 8 * kDegree,
                  .tilt_azimuth_rad = 0.7,
                  .k1 = -0.02};
  scene.theta_rad = 40 * kDegree;
  const RenderedPhoto photo = RenderScene(scene);
  cv::Mat green;
  cv::extractChannel(photo.bgr, green, 1);
  cv::Mat1f light;
  green.convertTo(light, CV_32F);
  constexpr double kMetalIsNotEven = 0.01;  // px; the levels beside the edge are single samples
  EXPECT_NEAR(MeanOffsetPx(light, photo.truth.upper, 1), 0, kMetalIsNotEven);
  EXPECT_NEAR(MeanOffsetPx(light, photo.truth.lower, -1), 0, kMetalIsNotEven);
}

// Pinhole camera and distortion written out anew: K [R | t], x (1 + k1 r^2).
Eigen::Vector2d Project(const CameraTruth& camera, const Eigen::Vector3d& world_mm) {
  const Eigen::Vector3d p = camera.camera_from_world * world_mm + camera.world_in_camera_mm;
  const double x = p.x() / p.z(), y = p.y() / p.z(), bend = 1 + camera.k1 * (x * x + y * y);
  return (camera.k * Eigen::Vector3d(x * bend, y * bend, 1)).head<2>();
}

TEST(TruthOf, EdgesInMillimetresProjectToEdgesInPixels) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const SceneSpec scene = RandomScene(seed, Difficulty::kHard);
    const SceneTruth truth = TruthOf(scene);
    for (const EdgeTruth* edge : {&truth.upper, &truth.lower}) {
      for (std::size_t i = 0; i < edge->px.size(); i += 40) {
        const Eigen::Vector2d world =
            scene.pivot_mm + Eigen::Rotation2Dd(scene.heading_rad) * edge->scissors_mm[i];
        const Eigen::Vector2d px =
            Project(truth.camera, {world.x(), world.y(), truth.edge_height_mm});
        EXPECT_LT((px - edge->px[i]).norm(), 1e-8) << "seed " << seed;
      }
    }
  }
}

TEST(TruthOf, ThetaIsTheAngleBetweenTheDistalEnds) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const SceneTruth truth = TruthOf(RandomScene(seed, Difficulty::kHard));
    const Eigen::Vector2d up = truth.upper.scissors_mm.back(), low = truth.lower.scissors_mm.back();
    const double angle = std::atan2(up.y(), up.x()) - std::atan2(low.y(), low.x());
    EXPECT_NEAR(angle, truth.theta_rad, 1e-12) << "seed " << seed;
  }
}

TEST(TruthOf, TheFreeEdgeStartsWhereTheEdgesCross) {
  SceneSpec scene;
  scene.scissors.bow_mm = 0;
  const SceneTruth truth = TruthOf(scene);
  // A straight edge v = m (u - L) turned by theta/2 meets its mirror image where y = 0.
  const double m = scene.scissors.inclination, tan_half = std::tan(scene.theta_rad / 2);
  const double u = m * scene.scissors.length_mm / (m + tan_half);
  constexpr double kOutlineSagittaMm = 1e-4;
  EXPECT_NEAR(truth.upper.free_from_mm, u, kOutlineSagittaMm);
  EXPECT_NEAR(truth.lower.free_from_mm, u, kOutlineSagittaMm);
}

TEST(TruthOf, ScaleAlongTheAxisIsTheRatioOfLengths) {
  SceneSpec scene;
  scene.camera.tilt_rad = 15 * kDegree;
  const SceneTruth truth = TruthOf(scene);
  const Eigen::Vector2d direction(std::cos(scene.heading_rad), std::sin(scene.heading_rad));
  constexpr double kShortMm = 0.01;
  const auto at = [&](double mm) {
    const Eigen::Vector2d p = scene.pivot_mm + mm * direction;
    return Project(truth.camera, {p.x(), p.y(), truth.edge_height_mm});
  };
  EXPECT_NEAR(truth.mm_per_px, 2 * kShortMm / (at(kShortMm) - at(-kShortMm)).norm(), 1e-7);
}

TEST(EdgeShape, SlopeIsTheDerivative) {
  const EdgeShape shape{.from_mm = 7, .to_mm = 58, .bernstein_mm = {-3.2, -1.4, -1.1, 0}};
  constexpr double kDelta = 1e-5;
  for (const double u : {2.0, 8.0, 30.0, 57.0, 70.0}) {
    const double central = (shape.At(u + kDelta) - shape.At(u - kDelta)) / (2 * kDelta);
    EXPECT_NEAR(shape.SlopeAt(u), central, 1e-9) << "u " << u;
  }
}

TEST(EdgeShapeOf, HasTheBowOfTheSpecAtItsMiddle) {
  ScissorsSpec spec;
  spec.bow_mm = 0.7;
  spec.curve_mm = 0.5;
  const double middle = 0.5 * (spec.heel_mm + spec.length_mm);
  const double chord = spec.inclination * (middle - spec.length_mm);
  EXPECT_NEAR(render::EdgeShapeOf(spec, true).At(middle), chord + 1.2, 1e-12);
  EXPECT_NEAR(render::EdgeShapeOf(spec, false).At(middle), chord + 0.2, 1e-12);
  EXPECT_EQ(render::EdgeShapeOf(spec, true).At(spec.length_mm), 0);
}

TEST(Camera, WorldFromPixelInvertsPixelFromWorld) {
  const render::Camera camera(
      {.mm_per_px = 0.2, .distance_mm = 260, .tilt_rad = 0.4, .tilt_azimuth_rad = 2, .k1 = 0.08},
      1600,
      1200);
  for (const Eigen::Vector2d& px :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(799.5, 599.5), Eigen::Vector2d(1599, 300)}) {
    const Eigen::Vector2d world = camera.WorldFromPixel(px, 3.5);
    EXPECT_LT((camera.PixelFromWorld({world.x(), world.y(), 3.5}) - px).norm(), 1e-9);
  }
}

TEST(Encode, KnowsTheCurves) {
  EXPECT_NEAR(render::Encode(0.21404114, {.srgb = true}), 0.5, 1e-7);
  EXPECT_NEAR(render::Encode(0.002, {.srgb = true}), 0.002 * 12.92, 1e-12);
  EXPECT_NEAR(render::Encode(0.25, {.srgb = false, .gamma = 2}), 0.5, 1e-12);
  EXPECT_NEAR(render::Encode(3.0, {}), 1, 1e-12);
}

TEST(Develop, RoundsTheEncodedLight) {
  cv::Mat3f ramp(1, 4001);
  for (int i = 0; i <= 4000; ++i) ramp(0, i) = cv::Vec3f::all(static_cast<float>(i) / 4000);
  const SensorSpec sensor{.noise_grey = 0};
  const cv::Mat3b picture = render::Develop(ramp, sensor, 1);
  for (int i = 0; i <= 4000; ++i) {
    EXPECT_NEAR(picture(0, i)[0], 255 * render::Encode(i / 4000.0, sensor), 0.502) << "light " << i;
  }
}

TEST(Develop, AddsNoiseOfTheStatedSize) {
  const cv::Mat3f grey(300, 300, cv::Vec3f::all(0.3f));
  const cv::Mat3b picture = render::Develop(grey, {.noise_grey = 2.5}, 3);
  cv::Scalar mean, deviation;
  cv::meanStdDev(picture, mean, deviation);
  constexpr double kRounding = 1.0 / 12, kFourSigmas = 4 / std::sqrt(2.0 * 90000);
  EXPECT_NEAR(deviation[1], std::sqrt(2.5 * 2.5 + kRounding), 2.5 * kFourSigmas);
}

TEST(EncodeJpeg, ComesBackNearlyUnchanged) {
  const cv::Mat bgr = RenderScene(SmallScene()).bgr;
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / "bladecurve_render_test.jpg";
  std::ofstream(path, std::ios::binary) << EncodeJpeg(bgr, 95);
  const Photo photo = Photo::Load(path);
  std::filesystem::remove(path);
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  ASSERT_EQ(photo.grey().size(), grey.size());
  constexpr double kQuantisation = 1.5;  // grey levels rms at quality 95
  EXPECT_LT(cv::norm(photo.grey(), grey, cv::NORM_L2) / std::sqrt(grey.total()), kQuantisation);
}

TEST(EncodeJpeg, RejectsWhatIsNoPicture) {
  EXPECT_THROW(static_cast<void>(EncodeJpeg(cv::Mat(), 90)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(EncodeJpeg(cv::Mat3b(2, 2), 0)), std::invalid_argument);
}

TEST(RandomScene, CanBeMeasured) {
  for (const Difficulty difficulty :
       {Difficulty::kClean, Difficulty::kStandard, Difficulty::kHard, Difficulty::kSun}) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const SceneSpec scene = RandomScene(seed, difficulty);
      const SceneTruth truth = TruthOf(scene);
      EXPECT_TRUE(truth.tips_in_frame) << "seed " << seed;
      const bool has_scale = truth.markers.size() >= 3 || scene.backdrop == Backdrop::kCutOut;
      EXPECT_TRUE(has_scale) << "seed " << seed << ", markers " << truth.markers.size();
      const double length = truth.upper.shape.to_mm;
      EXPECT_LT(truth.upper.free_from_mm, 0.6 * length) << "seed " << seed;
      for (const MarkerTruth& marker : truth.markers) {
        for (const Eigen::Vector2d& corner : marker.corners_px) {
          EXPECT_TRUE(corner.minCoeff() > 2 && corner.x() < scene.width - 3 &&
                      corner.y() < scene.height - 3)
              << "seed " << seed << ", marker " << marker.id;
        }
      }
    }
  }
}

TEST(RandomScene, CastsHardShadowsInTheSun) {
  constexpr int kScenes = 100;
  int black = 0, large = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const SceneSpec scene = RandomScene(seed, Difficulty::kSun);
    EXPECT_GE(scene.light.shadow, 0.5) << seed;
    EXPECT_LE(scene.light.shadow_blur_mm, 0.6) << seed;
    EXPECT_NE(scene.backdrop, Backdrop::kLightTable) << seed;
    EXPECT_NE(scene.backdrop, Backdrop::kCutOut) << seed;
    EXPECT_EQ(scene.height * 4, scene.width * 3) << seed;
    if (scene.finish == Finish::kBlack) ++black;
    if (scene.width > 4000) ++large;
  }
  EXPECT_GT(black, kScenes / 5);
  EXPECT_GT(large, kScenes / 20);
}

TEST(RandomScene, DependsOnItsSeedAlone) {
  EXPECT_EQ(RandomScene(4).theta_rad, RandomScene(4).theta_rad);
  EXPECT_NE(RandomScene(4).theta_rad, RandomScene(5).theta_rad);
}

}  // namespace
}  // namespace bladecurve
