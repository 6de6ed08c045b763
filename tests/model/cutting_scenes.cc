// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "tests/model/cutting_scenes.h"

#include <algorithm>

namespace bladecurve {
namespace {

constexpr CurveDomain kWholeBlade{0, 200, 0, 1.2};

}  // namespace

BladeCurve SmallMetzenbaum() { return {TaperedRectangle{-11, 0.14, 0.5}, kWholeBlade}; }
BladeCurve LargeMetzenbaum() { return {TaperedRectangle{-11, 0.12, 0.5}, kWholeBlade}; }

std::vector<Material> PaperMaterials() {
  return {{"paper", 4.9, 0.1, ForceDeflection(5)},
          {"plastic", 3.17, 0.1, ForceDeflection(20)},
          {"cloth", 2.43, 0.3, ForceDeflection(3)},
          {"chicken skin", 2.8, 1.0, ForceDeflection(8)}};
}

BladeCurve CurvedBlade() {
  const RigidSpline spline{
      3, {5, 5, 5, 5, 30, 55, 80, 80, 80, 80}, {-6.5, -6.2, -4.8, -2.4, -0.7, 0}};
  return {spline, {8, 79, 0, 1.2}};
}

BladeCurve RandomWavyBlade(std::mt19937& random) {
  const double dip_mm = Uniform(random, 0, 4);
  return {RigidSpline{3,
                      {5, 5, 5, 5, 25, 40, 55, 80, 80, 80, 80},
                      {-6, -5.6, Uniform(random, -4.2, -3), -1.6, -1.6 - dip_mm, -1.2, 0}},
          {8, 79, 0, 1.2}};
}

std::vector<Pose> RandomMotion(std::uint32_t seed, int samples, bool slicing) {
  std::mt19937 random(seed);
  std::vector<Pose> motion = {{30 * kDegree, 0}};
  double speed_deg = -0.3, pivot_speed_mm = 0;
  for (int i = 1; i < samples; ++i) {
    if (Uniform(random, 0, 1) < 0.08) speed_deg = Uniform(random, -0.9, 0.45);
    if (motion.back().theta_rad < 1 * kDegree) speed_deg = Uniform(random, 0.1, 0.3);
    if (slicing && Uniform(random, 0, 1) < 0.08) pivot_speed_mm = Uniform(random, -0.2, 0.3);
    Pose pose = motion.back();
    pose.theta_rad = std::min(pose.theta_rad + speed_deg * kDegree, 35 * kDegree);
    pose.pivot_mm = std::clamp(pose.pivot_mm + pivot_speed_mm, -5.0, 15.0);
    motion.push_back(pose);
  }
  return motion;
}

std::vector<Pose> StraightMotion(double from_deg, double to_deg, int steps) {
  std::vector<Pose> motion;
  for (int i = 0; i <= steps; ++i)
    motion.push_back({(from_deg + (to_deg - from_deg) * i / steps) * kDegree, 0});
  return motion;
}

std::vector<TorqueSample> Replay(TorqueModel& model, const std::vector<Pose>& motion, double dt_s) {
  std::vector<TorqueSample> samples;
  samples.reserve(motion.size());
  for (const Pose& pose : motion)
    samples.push_back(model.Step(pose.theta_rad, pose.pivot_mm, dt_s));
  return samples;
}

}  // namespace bladecurve
