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

void Widen(double scale, EdgeSamples& edge) {
  for (double& w : edge.weights) w /= scale;
}

// One round: the lower edges that cost too much get larger sigmas, or are left out. False if
// nothing changed.
bool Adjust(double rest_per_edge, const JointModel& model, FitData& data, MirrorVerdict& verdict) {
  const double coefficients = model.space->size();
  bool changed = false;
  for (size_t p = 0; p < data.photos.size(); ++p) {
    if (!verdict.use[p]) continue;
    const Comparison c = Compare(data.photos[p], model, verdict.state, verdict.state.poses[p]);
    const double excess = c.excess + rest_per_edge;
    if (c.rms > kOwnShape) {
      verdict.use[p] = false;
      changed = true;
    } else if (excess > ChiSquareQuantile(coefficients, kDoubt)) {
      const double scale = std::sqrt(excess / coefficients);
      Widen(scale, data.photos[p].lower);
      verdict.sigma_scale[p] *= scale;
      changed = true;
    }
  }
  return changed;
}

// What the lower edges cost elsewhere: how far they pull upper edges and poses from where these
// would be alone.
double CostElsewhere(const JointModel& model,
                     const FitData& data,
                     const JointResult& with,
                     double alone) {
  double elsewhere = 2 * (with.minimizer.cost - alone);
  for (size_t p = 0; p < data.photos.size(); ++p) {
    if (!model.mirror[p]) continue;
    const Pose& pose = with.state.poses[p];
    const EdgeSamples& lower = data.photos[p].lower;
    elsewhere -= Chi2(lower, Distances(lower, false, model, with.state, pose));
  }
  return std::max(0.0, elsewhere);
}

}  // namespace

MirrorVerdict JudgeMirror(const FitData& given,
                          const SplineSpace& space,
                          Loss loss,
                          const JointState& start) {
  FitData data = given;
  const size_t photos = data.photos.size();
  MirrorVerdict verdict{std::vector<bool>(photos, false), std::vector<double>(photos, 1.0), {}};
  JointModel model{space, false, loss, verdict.use};
  const JointResult alone = SolveJointly(data, model, start);
  verdict.state = alone.state;
  double edges = 0;
  for (size_t p = 0; p < photos; ++p) {
    verdict.use[p] = data.photos[p].lower.size() >= 3;
    edges += verdict.use[p] ? 1 : 0;
  }
  constexpr int kRounds = 6;
  for (int round = 0; edges > 0 && round < kRounds; ++round) {
    model.mirror = verdict.use;
    const JointResult with = SolveJointly(data, model, verdict.state);
    verdict.state = with.state;
    const double elsewhere = CostElsewhere(model, data, with, alone.minimizer.cost);
    if (!Adjust(elsewhere / edges, model, data, verdict)) break;
  }
  return verdict;
}

}  // namespace bladecurve
