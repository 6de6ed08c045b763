// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/synthetic_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <random>

#include "vision/render/render_camera.h"
#include "vision/render/render_outline.h"

namespace bladecurve {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Own distributions: those of the standard library differ from one library to the next.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double Between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  bool Chance(double probability) { return Between(0, 1) < probability; }
  template <typename T>
  T OneOf(std::initializer_list<T> choices) {
    const auto index = static_cast<std::size_t>(Between(0, static_cast<double>(choices.size())));
    return *(choices.begin() + std::min(index, choices.size() - 1));
  }
  std::uint64_t Bits() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

// Proportions of three common patterns, mm, varied by a sixth.
ScissorsSpec RandomScissors(Dice* dice, Difficulty difficulty) {
  ScissorsSpec s;  // Mayo
  switch (dice->OneOf({0, 1, 2})) {
    case 0:
      break;
    case 1:  // Metzenbaum
      s = {.length_mm = 48,
           .heel_mm = 6,
           .joint_mm = 10,
           .width_mm = 7.5,
           .tip_radius_mm = 1.0,
           .shank_mm = 4.4,
           .shank_length_mm = 98,
           .ring_mm = 25,
           .screw_radius_mm = 2.1};
      break;
    case 2:  // iris
      s = {.length_mm = 30,
           .heel_mm = 5,
           .bow_mm = 0.15,
           .joint_mm = 7,
           .width_mm = 6.5,
           .tip_radius_mm = 0.45,
           .bevel_mm = 1.0,
           .shank_mm = 3.6,
           .shank_length_mm = 50,
           .ring_mm = 20,
           .screw_radius_mm = 1.7};
      break;
  }
  const double size = dice->Between(0.92, 1.15);
  s.length_mm *= size * dice->Between(0.93, 1.08);
  s.width_mm *= size;
  s.joint_mm *= size * dice->Between(0.85, 1.2);
  s.shank_length_mm *= size;
  s.inclination = dice->Between(0.05, 0.11);
  s.bow_mm = dice->Between(-0.3, 0.9) * s.length_mm / 58;
  s.skew_mm = dice->Chance(0.5) ? dice->Between(-0.25, 0.25) * s.length_mm / 58 : 0;
  s.tip_radius_mm *= dice->Between(0.8, 1.3);
  s.bevel_mm *= dice->Between(0.6, 1.4);
  s.slot_rad = dice->Between(0, std::numbers::pi);
  s.upper_on_top = dice->Chance(0.5);
  s.screw_visible = difficulty == Difficulty::kClean || dice->Chance(0.85);
  if (difficulty == Difficulty::kHard && dice->Chance(0.25)) {
    s.curve_mm = dice->Between(-0.04, 0.04) * s.length_mm;
  }
  return s;
}

// Puts the middle of the scissors near the middle of the picture, large enough to use it, small
// enough to fit.
void Frame(Dice* dice, SceneSpec* scene) {
  const ScissorsSpec& s = scene->scissors;
  const double behind_mm = s.shank_length_mm + s.ring_mm + 4, ahead_mm = s.length_mm;
  const double half_mm = 0.5 * (ahead_mm + behind_mm);
  const double half_angle = 0.5 * scene->theta_rad;
  const double across_mm = behind_mm * std::sin(half_angle) + 0.6 * s.ring_mm;
  const double cos_heading = std::abs(std::cos(scene->heading_rad));
  const double sin_heading = std::abs(std::sin(scene->heading_rad));
  const double x_mm = half_mm * cos_heading + across_mm * sin_heading;
  const double y_mm = half_mm * sin_heading + across_mm * cos_heading;
  const double fill = dice->Between(0.72, 0.88);
  scene->camera.mm_per_px = 2 * std::max(x_mm / scene->width, y_mm / scene->height) / fill;
  scene->pivot_mm = 0.5 * (behind_mm - ahead_mm) *
                    Eigen::Vector2d(std::cos(scene->heading_rad), std::sin(scene->heading_rad));
  scene->pivot_mm +=
      scene->camera.mm_per_px * Eigen::Vector2d(dice->Between(-25, 25), dice->Between(-25, 25));
}

void Photograph(Dice* dice, Difficulty difficulty, SceneSpec* scene) {
  CameraSpec& camera = scene->camera;
  camera.distance_mm = dice->Between(300, 650);
  camera.blur_px = dice->Between(0.6, difficulty == Difficulty::kHard ? 1.6 : 1.1);
  scene->sensor.noise_grey = dice->Between(0.6, difficulty == Difficulty::kHard ? 3.5 : 1.8);
  if (difficulty == Difficulty::kClean) return;
  camera.tilt_rad = dice->Between(0, difficulty == Difficulty::kHard ? 18 : 8) * kDegree;
  camera.tilt_azimuth_rad = dice->Between(0, 2 * std::numbers::pi);
  camera.k1 = dice->Between(-0.03, 0.03);
}

void Light(Dice* dice, Difficulty difficulty, SceneSpec* scene) {
  LightSpec& light = scene->light;
  light.direction_rad = dice->Between(0, 2 * std::numbers::pi);
  light.elevation_rad = dice->Between(45, 75) * kDegree;
  light.exposure = dice->Between(0.55, 0.85);
  light.falloff = dice->Between(0, 0.25);
  light.glint = dice->Between(0.1, 0.6);
  light.shadow = dice->Between(0, 0.3);
  light.shadow_blur_mm = dice->Between(1.5, 4);
  light.contact_shadow = dice->Between(0, 0.2);
  if (difficulty != Difficulty::kHard) return;
  light.glint = dice->Between(0.2, 1.3);
  light.shadow = dice->Between(0, 0.5);
  light.shadow_blur_mm = dice->Between(0.5, 4);
}

void Lay(Dice* dice, Difficulty difficulty, SceneSpec* scene) {
  const Eigen::Vector3d blue(0.08, 0.20, 0.45), green(0.07, 0.32, 0.22), violet(0.24, 0.14, 0.40);
  scene->drape_rgb = dice->OneOf({blue, green, violet}) * dice->Between(0.7, 1.3);
  scene->texture = dice->Between(0.5, 1.1);
  if (difficulty == Difficulty::kClean) return;
  if (dice->Chance(0.3)) {
    scene->backdrop = dice->OneOf({Backdrop::kCloth, Backdrop::kDrape, Backdrop::kLightTable});
  }
  if (difficulty != Difficulty::kHard) return;
  scene->backdrop = dice->OneOf({Backdrop::kPaper,
                                 Backdrop::kCloth,
                                 Backdrop::kDrape,
                                 Backdrop::kWood,
                                 Backdrop::kBlack,
                                 Backdrop::kLightTable,
                                 Backdrop::kCutOut});
  scene->finish = dice->Chance(0.2) ? Finish::kGold : Finish::kSteel;
}

std::vector<Eigen::Vector2d> MetalOutline(const SceneSpec& scene) {
  std::vector<Eigen::Vector2d> world_mm;
  for (const bool upper : {true, false}) {
    const render::BladeOutline outline = render::MakeBladeOutline(scene.scissors, upper);
    for (const render::Ring* ring : {&outline.body, &outline.ring_outer}) {
      for (const Eigen::Vector2d& p : *ring) {
        world_mm.push_back(
            render::WorldFromScissors(render::ScissorsFromBlade(p, upper, scene.theta_rad), scene));
      }
    }
  }
  return world_mm;
}

// A catalogue picture: cut out, no shadow, seen squarely, its scale known from elsewhere.
void CutOut(SceneSpec* scene) {
  scene->light.shadow = 0;
  scene->light.contact_shadow = 0;
  scene->camera.tilt_rad = 0;
  scene->camera.k1 = 0;
}

// Some photographs show no rings: the camera is nearer, the tips keep their distance from the
// border.
void CropHandles(SceneSpec* scene) {
  constexpr double kNearer = 0.72;
  const double before = scene->camera.mm_per_px;
  scene->camera.mm_per_px *= kNearer;
  const Eigen::Vector2d ahead(std::cos(scene->heading_rad), std::sin(scene->heading_rad));
  const double cropped_mm = (1 - kNearer) * before * scene->width *
                            std::min(0.5 / std::max(std::abs(ahead.x()), 1e-9),
                                     0.375 / std::max(std::abs(ahead.y()), 1e-9));
  scene->pivot_mm -= cropped_mm * ahead;
}

// Up to four markers along the border of the picture, clear of the metal.
void AddMarkers(Dice* dice, SceneSpec* scene) {
  const render::Camera camera(scene->camera, scene->width, scene->height);
  const std::vector<Eigen::Vector2d> metal = MetalOutline(*scene);
  constexpr double kShareOfPicture = 0.075;  // of its width: 120 px of 1600
  const double size_mm = std::round(kShareOfPicture * scene->width * scene->camera.mm_per_px);
  const double margin_mm = 0.2 * size_mm;
  const double reach_mm = std::numbers::sqrt2 * (0.5 * size_mm + margin_mm);
  constexpr double kCorner = 0.42, kSide = 0.41;  // from the middle, in pictures
  constexpr std::array<std::array<double, 2>, 8> kPlaces = {{{-kCorner, -kCorner},
                                                             {kCorner, kCorner},
                                                             {kCorner, -kCorner},
                                                             {-kCorner, kCorner},
                                                             {0, -kSide},
                                                             {0, kSide},
                                                             {-kSide, 0},
                                                             {kSide, 0}}};
  for (const auto& place : kPlaces) {
    const double inset_px = reach_mm / scene->camera.mm_per_px + 8;
    const Eigen::Vector2d px(
        std::clamp((0.5 + place[0]) * scene->width, inset_px, scene->width - inset_px),
        std::clamp((0.5 + place[1]) * scene->height, inset_px, scene->height - inset_px));
    const Eigen::Vector2d center_mm = camera.WorldFromPixel(px, 0);
    const double clearance_mm = reach_mm + scene->edge_height_mm + 2;
    const bool clear = std::none_of(metal.begin(), metal.end(), [&](const Eigen::Vector2d& p) {
      return (p - center_mm).norm() < clearance_mm;
    });
    if (!clear) continue;
    scene->markers.push_back({.id = static_cast<int>(scene->markers.size()),
                              .size_mm = size_mm,
                              .center_mm = center_mm,
                              .angle_rad = dice->Between(-0.25, 0.25),
                              .margin_mm = margin_mm});
    if (scene->markers.size() == 4) break;
  }
}

// The same photograph, by a camera of another resolution.
void TakeWithWidth(int width, SceneSpec* scene) {
  const double finer = static_cast<double>(width) / scene->width;
  scene->width = width;
  scene->height = width * 3 / 4;
  scene->camera.mm_per_px /= finer;
  if (finer > 1) scene->camera.blur_px *= std::sqrt(finer);  // smaller pixels, the same lens
}

// Shadows with borders as sharp as the sun's, of instruments of any colour, seen by any camera.
void LieInSun(Dice* dice, SceneSpec* scene) {
  LightSpec& light = scene->light;
  light.shadow = dice->Between(0.5, 0.95);
  light.shadow_blur_mm = dice->Between(0.1, 0.6);
  light.elevation_rad = dice->Between(20, 65) * kDegree;
  light.contact_shadow = dice->Between(0, 0.3);
  scene->finish =
      dice->OneOf({Finish::kBlack, Finish::kBlack, Finish::kSteel, Finish::kSteel, Finish::kGold});
  if (scene->backdrop == Backdrop::kLightTable || scene->backdrop == Backdrop::kCutOut)
    scene->backdrop = dice->OneOf({Backdrop::kWood, Backdrop::kDrape});
  if (dice->Chance(0.5)) TakeWithWidth(dice->OneOf({1000, 2400, 4032}), scene);
}

}  // namespace

SceneSpec RandomScene(std::uint64_t seed, Difficulty difficulty) {
  const bool sun = difficulty == Difficulty::kSun;
  const Difficulty range = sun ? Difficulty::kHard : difficulty;
  Dice dice(seed);
  SceneSpec scene;
  scene.width = dice.OneOf({1600, 2000});
  scene.height = scene.width * 3 / 4;
  scene.scissors = RandomScissors(&dice, range);
  const bool hard = range == Difficulty::kHard;
  scene.theta_rad = dice.Between(hard ? 8 : 14, hard ? 70 : 45) * kDegree;
  scene.heading_rad = dice.Between(0, 2 * std::numbers::pi);
  scene.edge_height_mm = dice.Between(1.0, 3.5);
  Photograph(&dice, range, &scene);
  Frame(&dice, &scene);
  Light(&dice, range, &scene);
  Lay(&dice, range, &scene);
  if (sun) LieInSun(&dice, &scene);
  scene.seed = dice.Bits();
  if (scene.backdrop == Backdrop::kCutOut) {
    CutOut(&scene);
    return scene;
  }
  if (hard && dice.Chance(0.2)) CropHandles(&scene);
  AddMarkers(&dice, &scene);
  return scene;
}

}  // namespace bladecurve
