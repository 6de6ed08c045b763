// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Accuracy of the screw's centre beside the Cramer-Rao bound, and the time it takes.
#include <fmt/format.h>

#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include "vision/screw.h"
#include "vision/screw_images.h"

namespace bladecurve {
namespace {

constexpr int kDraws = 40;

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

void Measure(const Look& look, double radius) {
  int found = 0, inside = 0;
  double squares = 0, bound_squares = 0, ms = 0;
  for (std::uint32_t seed = 1; seed <= kDraws; ++seed) {
    HeadSpec head = Head(look, radius, seed);
    const cv::Mat grey = RenderHead(head);
    Draws draws(seed + 1000);
    const double angle = draws.Uniform(0, 2 * std::numbers::pi),
                 off = radius * draws.Uniform(0, 1.2);
    ScrewSearch search;
    search.guess_px = head.center_px + off * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    search.radius_px = 1.4 * radius;
    search.min_semi_axis_px = 0.5 * radius;
    search.max_semi_axis_px = 1.8 * radius;
    const auto start = std::chrono::steady_clock::now();
    const std::optional<Screw> screw = FindScrew(grey, SrgbToneCurve(), search);
    ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    head.slot = 0;  // the bound is the rim's: the slot is not used
    const double bound = CenterBoundPx(head);
    bound_squares += bound * bound;
    if (!screw) continue;
    const Eigen::Vector2d error = screw->center_px - head.center_px;
    ++found;
    squares += error.squaredNorm() / 2;
    if (error.dot(screw->covariance_px2.inverse() * error) < 5.991) ++inside;
  }
  fmt::print("{:<16} {:>4.0f} {:>7.0f} % {:>9.4f} {:>9.4f} {:>9.0f} % {:>8.2f}\n",
             look.name,
             radius,
             100.0 * found / kDraws,
             found > 0 ? std::sqrt(squares / found) : std::nan(""),
             std::sqrt(bound_squares / kDraws),
             found > 0 ? 100.0 * inside / found : std::nan(""),
             ms / kDraws);
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
    for (const double radius : {5.0, 8.0, 15.0, 30.0, 60.0}) bladecurve::Measure(look, radius);
  }
}
