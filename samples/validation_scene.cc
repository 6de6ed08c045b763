// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/validation_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "vision/pivot/head_place.h"
#include "vision/render/render.h"
#include "vision/scale/scale.h"

namespace bladecurve {
namespace {

constexpr int kRefusalEvery = 10;

void Close(SceneSpec* spec) {
  spec->theta_rad =
      -3 * std::numbers::pi / 180;  // the blades have passed each other, as in a drawer
}

// Moves the scissors along their axis until their tips are a quarter of a blade outside; further
// where they open so wide, or the camera leans so much, that both stay in the picture.
void CutOffTips(SceneSpec* spec) {
  const Eigen::Vector2d ahead(std::cos(spec->heading_rad), std::sin(spec->heading_rad));
  const double half_width_mm = 0.5 * spec->width * spec->camera.mm_per_px;
  const double half_height_mm = 0.5 * spec->height * spec->camera.mm_per_px;
  const double to_border_mm =
      std::min(half_width_mm / std::abs(ahead.x()), half_height_mm / std::abs(ahead.y()));
  spec->pivot_mm = (to_border_mm - 0.75 * spec->scissors.length_mm) * ahead;
  constexpr double kFurther = 0.1;  // of a blade
  while (TruthOf(*spec).tips_in_frame)
    spec->pivot_mm += kFurther * spec->scissors.length_mm * ahead;
}

// Box and Muller 1958; the distributions of the standard library differ from one to the next.
double DrawNormal(std::mt19937_64* random) {
  const auto uniform = [&] { return (static_cast<double>((*random)() >> 11) + 0.5) * 0x1p-53; };
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

// Heads stand as high and slots are cut as far off their centre as the program takes it that they
// may.
void VaryScrew(std::mt19937_64* random, ScissorsSpec* scissors) {
  constexpr double kLeastMm = 0.5;  // a head that does not sink into the blade
  scissors->screw_mm = std::max(kLeastMm, kHeadMm + kHeadSigmaMm * DrawNormal(random));
  scissors->slot_off.x() = kEndsOffCentre * DrawNormal(random);
  scissors->slot_off.y() = kSlotOffCentre * DrawNormal(random);
}

void MisstateKnowledge(ValidationScene* scene) {
  std::mt19937_64 random(scene->spec.seed);
  scene->focal_error = kCalibratedFocalSigma * DrawNormal(&random);
  scene->k1_error = kCalibratedK1Sigma * DrawNormal(&random);
  scene->height_error_mm = kGivenHeightSigmaMm * DrawNormal(&random);
  VaryScrew(&random, &scene->spec.scissors);
  // Photographs that were sent to and fro have lost their EXIF data, and few cameras are
  // calibrated.
  constexpr std::uint64_t kOneIn = 4;
  scene->camera_known = random() % kOneIn != 0;
}

}  // namespace

ValidationScene MakeValidationScene(int number, std::uint64_t seed, Difficulty difficulty) {
  constexpr std::uint64_t kApart = 1000003;  // a prime: neighbouring seeds share no scenes
  ValidationScene scene;
  scene.number = number;
  scene.spec = RandomScene(seed * kApart + static_cast<std::uint64_t>(number), difficulty);
  MisstateKnowledge(&scene);
  if (number % kRefusalEvery != kRefusalEvery - 1) return scene;
  switch (number / kRefusalEvery % 3) {
    case 0:
      Close(&scene.spec);
      scene.refuse = Reason::kClosed;
      break;
    case 1:
      CutOffTips(&scene.spec);
      scene.refuse = Reason::kBladesNotVisible;
      break;
    default:
      scene.spec.with_scissors = false;
      scene.refuse = Reason::kNotScissors;
  }
  return scene;
}

}  // namespace bladecurve
