// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Accuracy of the screw's centre beside the Cramer-Rao bound, and the time it takes: drawn heads,
// and heads of rendered scissors, whose rims are rounded (no bound): smooth and brushed blades in
// even light, then brushed ones lit from one side.
#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "stopwatch.h"
#include "vision/pivot/screw.h"
#include "vision/render/render.h"
#include "vision/screw_images.h"

namespace bladecurve {
namespace {

constexpr int kDraws = 40, kScenes = 12;

struct Look {
  std::string name;
  double disc = 0, groove = 0, slot = 0, brushed = 0;  // as in HeadSpec
};

HeadSpec Head(const Look& look, double radius, std::uint32_t seed) {
  Draws draws(seed);
  HeadSpec head;
  head.seed = seed;
  head.side_px = 6 * static_cast<int>(radius) + 21;
  head.center_px = Eigen::Vector2d::Constant(head.side_px / 2.0) +
                   Eigen::Vector2d(draws.Uniform(-1, 1), draws.Uniform(-1, 1));
  head.semi_major_px = radius;
  head.semi_minor_px = radius * draws.Uniform(0.87, 1);
  head.angle_rad = draws.Uniform(0, std::numbers::pi);
  head.slot_angle_rad = draws.Uniform(0, std::numbers::pi);
  head.disc = look.disc;
  head.groove = look.groove;
  head.slot = look.slot;
  head.brushed = look.brushed;
  return head;
}

// A picture of a head, where it is and how well that could be known.
struct Case {
  cv::Mat grey;
  Eigen::Vector2d center_px;
  double bound_px;
};

Case Drawn(const Look& look, double radius, std::uint32_t seed) {
  HeadSpec head = Head(look, radius, seed);
  Case drawn{RenderHead(head), head.center_px, 0};
  head.slot = 0;  // the bound is the rim's: the slot is not used
  drawn.bound_px = CenterBoundPx(head);
  return drawn;
}

// The head of rendered scissors.
Case Rendered(double brushing, double glint, double radius, std::uint32_t seed) {
  Draws draws(seed);
  SceneSpec scene;
  scene.seed = seed;
  scene.camera.mm_per_px = scene.scissors.screw_radius_mm / radius;
  scene.camera.blur_px = 1;
  scene.width = static_cast<int>(96 / scene.camera.mm_per_px);
  scene.height = static_cast<int>(72 / scene.camera.mm_per_px);
  scene.scissors.brushing = brushing;
  scene.light.glint = glint;
  scene.light.direction_rad = draws.Uniform(0, 2 * std::numbers::pi);
  scene.scissors.slot_rad = draws.Uniform(0, std::numbers::pi);
  const RenderedPhoto photo = RenderScene(scene);
  Case head{{}, photo.truth.screw_px, std::nan("")};
  cv::cvtColor(photo.bgr, head.grey, cv::COLOR_BGR2GRAY);
  return head;
}

// draw(seed) gives the cases.
template <typename Draw>
void Measure(const std::string& name, double radius, int count, const Draw& draw) {
  int found = 0, inside = 0;
  double squares = 0, bound_squares = 0, ms = 0;
  for (std::uint32_t seed = 1; seed <= static_cast<std::uint32_t>(count); ++seed) {
    const Case drawn = draw(seed);
    Draws draws(seed + 1000);
    const double angle = draws.Uniform(0, 2 * std::numbers::pi),
                 off = radius * draws.Uniform(0, 1.2);
    ScrewSearch search;
    search.guess_px = drawn.center_px + off * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    search.radius_px = 1.4 * radius;
    search.min_semi_axis_px = 0.5 * radius;
    search.max_semi_axis_px = 1.8 * radius;
    const Stopwatch stopwatch;
    const std::optional<Screw> screw = FindScrew(drawn.grey, SrgbToneCurve(), search);
    ms += stopwatch.Milliseconds();
    bound_squares += drawn.bound_px * drawn.bound_px;
    if (!screw) continue;
    const Eigen::Vector2d error = screw->center_px - drawn.center_px;
    ++found;
    squares += error.squaredNorm() / 2;
    if (error.dot(screw->covariance_px2.inverse() * error) < 5.991) ++inside;
  }
  fmt::print("{:<16} {:>4.0f} {:>7.0f} % {:>9.4f} {:>9.4f} {:>9.0f} % {:>8.2f}\n",
             name,
             radius,
             100.0 * found / count,
             found > 0 ? std::sqrt(squares / found) : std::nan(""),
             std::sqrt(bound_squares / count),
             found > 0 ? 100.0 * inside / found : std::nan(""),
             ms / count);
}

}  // namespace
}  // namespace bladecurve

int main() {
  using bladecurve::Look;
  fmt::print(
      "rms and bound: px, of one coordinate of the centre; blur 1 px, noise 2 grey levels\n");
  fmt::print("{:<16} {:>4} {:>9} {:>9} {:>9} {:>11} {:>8}\n",
             "head",
             "r px",
             "found",
             "rms",
             "bound",
             "in 95 %",
             "ms");
  for (const Look& look : {Look{"disc", 0.2, 0, 0, 0},
                           Look{"groove", 0, -0.2, 0, 0},
                           Look{"slotted disc", -0.12, 0, -0.12, 0},
                           Look{"brushed, slotted", -0.12, 0, -0.12, 0.04}}) {
    for (const double radius : {5.0, 8.0, 15.0, 30.0, 60.0}) {
      bladecurve::Measure(look.name, radius, bladecurve::kDraws, [&](std::uint32_t seed) {
        return bladecurve::Drawn(look, radius, seed);
      });
    }
  }
  struct Light {
    std::string name;
    double brushing, glint;
  };
  for (const Light& light : {Light{"smooth, even", 0, 0},
                             Light{"brushed, even", 1, 0},
                             Light{"lamp", 1, 0.5},
                             Light{"sun", 1, 1.2}}) {
    for (const double radius : {15.0, 30.0, 60.0}) {
      bladecurve::Measure(light.name, radius, bladecurve::kScenes, [&](std::uint32_t seed) {
        return bladecurve::Rendered(light.brushing, light.glint, radius, seed);
      });
    }
  }
}
