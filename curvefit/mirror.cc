// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/mirror.h"

#include <algorithm>
#include <cmath>

#include "curvefit/linear_spline.h"
#include "curvefit/statistics.h"

namespace bladecurve {
namespace {

constexpr double kOwnShape =
    0.01;  // rms difference of the blades, as a part of their length: another shape
constexpr double kOfPivot = 2;    // coordinates
constexpr double kDoubt = 0.999;  // a difference that noise makes once in a thousand is real

// chi2 of a lower edge against a curve of its own with the same knots.
double OwnChi2(const EdgeSamples& lower, const Pose& pose, const SplineSpace& space) {
  return FitLinearSpline(Flatten(lower, pose, false), space).chi2;
}

struct Comparison {
  double excess = 0;  // chi2 that the mirror image costs beyond a shape of its own
  double rms = 0;     // distance of the edge from the mirror image, no unit
};

Comparison Compare(const PhotoData& photo,
                   const JointModel& model,
                   const JointState& state,
                   const Pose& pose) {
  const std::vector<double> d = Distances(photo.lower, false, model, state, pose);
  double squares = 0;
  for (const double x : d) squares += x * x;
  return {Chi2(photo.lower, d) - OwnChi2(photo.lower, pose, *model.space),
          std::sqrt(squares / photo.lower.size())};
}

// What the lower edge costs elsewhere: how far it pulls upper edge and pose from where these are
// without it.
double CostElsewhere(const PhotoData& photo,
                     const JointModel& model,
                     const JointResult& with,
                     double cost_without) {
  const std::vector<double> d =
      Distances(photo.lower, false, model, with.state, with.state.poses[0]);
  const double chi2 = 2 * (with.minimizer.cost - cost_without) - Chi2(photo.lower, d);
  return std::max(0.0, chi2);
}

// How far the pose is from the pivot that was observed: chi2 of its coordinates.
double PullOnPivot(const PhotoData& photo, const Pose& pose) {
  return (photo.pivot_whitener * Eigen::Vector2d(pose[kPivotX], pose[kPivotY])).squaredNorm();
}

MirrorVerdict JudgePhoto(FitData data, const SplineSpace& space, Loss loss, JointState start) {
  MirrorVerdict verdict;
  PhotoData& photo = data.photos[0];
  if (photo.lower.size() < 3) return verdict;
  JointModel model{space, false, loss, {false}};
  JointResult result = SolveJointly(data, model, std::move(start));
  const double cost_without = result.minimizer.cost;
  const double coefficients = space.size();
  model.mirror = {true};
  verdict.use = true;
  constexpr int kRounds = 10;
  bool differ = false;
  for (int round = 0; round < kRounds; ++round) {
    result = SolveJointly(data, model, result.state);
    const Comparison c = Compare(photo, model, result.state, result.state.poses[0]);
    const double excess = c.excess + CostElsewhere(photo, model, result, cost_without);
    const double pull = PullOnPivot(photo, result.state.poses[0]);
    verdict.use = c.rms <= kOwnShape;
    differ = differ || excess > ChiSquareQuantile(coefficients, kDoubt) ||
             pull > ChiSquareQuantile(kOfPivot, kDoubt);
    const double surplus = std::max(excess / coefficients, pull / kOfPivot);
    if (!verdict.use || !differ || surplus <= 1) break;
    const double scale = std::sqrt(surplus);
    verdict.sigma_scale *= scale;
    for (double& w : photo.lower.weights) w /= scale;
  }
  return verdict;
}

}  // namespace

std::vector<MirrorVerdict> JudgeMirrors(const FitData& data, const SplineSpace& space, Loss loss) {
  std::vector<MirrorVerdict> verdicts;
  for (const PhotoData& photo : data.photos) {
    const FitData alone{data.length_mm, {photo}};
    const LinearSpline upper = FitLinearSpline(Flatten(photo.upper, photo.start, true), space);
    verdicts.push_back(JudgePhoto(alone, space, loss, SplineStart(alone, upper)));
  }
  return verdicts;
}

}  // namespace bladecurve
