// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "curvefit/choose_knots.h"
#include "curvefit/clean_edge.h"
#include "curvefit/compare_families.h"
#include "curvefit/family_fit.h"
#include "curvefit/mirror.h"
#include "curvefit/recommend.h"
#include "model/degrees.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

constexpr int kThinned = 256;  // points an edge for choosing knots and judging the mirror image

void CheckOptions(const std::vector<EdgePoints>& photos, const FitOptions& options) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument("fit: " + what); };
  if (photos.empty()) refuse("no photograph was given");
  if (options.degree && (*options.degree < 1 || *options.degree > kMaxSplineDegree)) {
    refuse("degree is " + std::to_string(*options.degree) + "; it must be 1 to 5");
  }
  if (options.num_spans && *options.num_spans < 1) {
    refuse("num_spans is " + std::to_string(*options.num_spans) + "; it must be at least 1");
  }
  if (options.gain && !std::isfinite(*options.gain)) refuse("gain is not finite");
  if (options.num_threads < 1) {
    refuse("num_threads is " + std::to_string(options.num_threads) + "; it must be at least 1");
  }
  const std::vector<double> knots = options.knots_mm.value_or(std::vector<double>{});
  for (size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i]) || (i > 0 && knots[i] <= knots[i - 1])) {
      refuse("knots_mm must be finite and increasing; entry " + std::to_string(i) + " is not");
    }
  }
}

// Outliers out, sigmas honest; what was done goes into the report.
void Clean(bool reject, FitData& data, BladeFit& report) {
  for (size_t p = 0; p < data.photos.size(); ++p) {
    PhotoData& photo = data.photos[p];
    for (const bool is_upper : {true, false}) {
      EdgeSamples& edge = is_upper ? photo.upper : photo.lower;
      if (edge.empty()) continue;
      const CleanReport clean = CleanEdge(edge, photo.start, is_upper, reject);
      EdgeFinding finding;
      finding.photo = static_cast<int>(p);
      finding.is_upper = is_upper;
      finding.sigma_scale = clean.sigma_scale;
      finding.correlation_points = clean.correlation_points;
      finding.rejected = static_cast<int>(clean.rejected.size());
      finding.points = edge.size() + finding.rejected;
      report.edges.push_back(finding);
      for (const CleanReport::Rejected& r : clean.rejected) {
        report.rejected.push_back({finding.photo, is_upper, r.index, r.sigmas});
      }
    }
  }
}

FitData ThinnedData(const FitData& data) {
  FitData thin{data.length_mm, {}};
  for (PhotoData photo : data.photos) {
    photo.upper = Thinned(photo.upper, kThinned);
    photo.lower = Thinned(photo.lower, kThinned);
    thin.photos.push_back(std::move(photo));
  }
  return thin;
}

std::vector<FlatPoint> FlatUpperEdges(const FitData& data) {
  std::vector<FlatPoint> all;
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const PhotoData& photo = data.photos[p];
    const std::vector<FlatPoint> flat =
        Flatten(photo.upper, photo.start, true, static_cast<int>(p));
    all.insert(all.end(), flat.begin(), flat.end());
  }
  SortAlong(all);
  return all;
}

double Farthest(const std::vector<double>& reaches) {
  return *std::max_element(reaches.begin(), reaches.end());
}

// Starting poses at which the upper edges of all photographs lie on one plain cubic: where pivots
// are hardly known, edges as observed lie beside each other, and knots would be chosen for that.
void AlignPhotographs(FitData& data) {
  if (data.photos.size() < 2) return;
  const FitData thin = ThinnedData(data);
  const std::vector<FlatPoint> points = FlatUpperEdges(thin);
  constexpr size_t kFewest = 12;  // a cubic through fewer explains anything
  const SplineSpace space =
      ClampedSpace(points.size() < kFewest ? 1 : 3, points.front().u, points.back().u, {});
  // No loss: what a cubic misses are no outliers.
  const JointModel model{space, false, Loss::kNone, std::vector<bool>(data.photos.size(), false)};
  const JointState start = SplineStart(thin, FitLinearSpline(points, space));
  const JointResult aligned = SolveJointly(thin, model, start);
  if (!aligned.minimizer.converged) return;
  for (size_t p = 0; p < data.photos.size(); ++p) data.photos[p].start = aligned.state.poses[p];
}

KnotChoice ChooseSpace(const FitData& data, const FitData& thin, const FitOptions& options) {
  const std::vector<FlatPoint> points = FlatUpperEdges(thin);
  KnotRequest request;
  request.degree = options.degree;
  request.num_spans = options.num_spans;
  request.lower = points.front().u;
  request.upper = std::max(points.back().u, Farthest(StartingState(data).reaches));
  if (options.knots_mm) {
    request.interior.emplace();
    for (const double k : *options.knots_mm) {
      const double knot = k / data.length_mm;
      if (knot > request.lower && knot < request.upper) request.interior->push_back(knot);
    }
  }
  for (const PhotoData& photo : data.photos) request.effective_points += photo.upper.effective();
  return ChooseKnots(points, request);
}

// The lower edges' points beyond the spline's ends have nothing to be compared with.
void CutLowerEdges(const SplineSpace& space, FitData& data) {
  for (PhotoData& photo : data.photos) {
    const BladeFrame frame(photo.start, false);
    EdgeSamples kept;
    kept.inflation = photo.lower.inflation;
    for (int i = 0; i < photo.lower.size(); ++i) {
      const double u = frame(photo.lower.points[i]).x();
      if (u < space.lower() || u > space.upper()) continue;
      kept.points.push_back(photo.lower.points[i]);
      kept.weights.push_back(photo.lower.weights[i]);
      kept.indices.push_back(photo.lower.indices[i]);
    }
    photo.lower = std::move(kept);
  }
}

std::vector<bool> ApplyVerdicts(const std::vector<MirrorVerdict>& verdicts,
                                FitData& data,
                                BladeFit& report) {
  for (EdgeFinding& edge : report.edges) {
    if (edge.is_upper) continue;
    const auto p = static_cast<size_t>(edge.photo);
    edge.used = verdicts[p].use;
    edge.sigma_scale *= verdicts[p].sigma_scale;
    for (double& w : data.photos[p].lower.weights) w /= verdicts[p].sigma_scale;
  }
  std::vector<bool> use;
  for (const MirrorVerdict& verdict : verdicts) use.push_back(verdict.use);
  return use;
}

// x from the first free edge point, at the widest photographed angle, to the last one's reach when
// closed.
CurveDomain DomainOf(const FitData& data, const SplineSpace& space) {
  CurveDomain domain;
  double x_min = space.upper(), widest = 0;
  for (const PhotoData& photo : data.photos) {
    const double theta = photo.start[kUpperAngle] - photo.start[kLowerAngle];
    widest = std::max(widest, theta);
    Pose axis = photo.start;
    axis[kUpperAngle] -= theta / 2;
    const BladeFrame frame(axis, true);
    for (const Eigen::Vector2d& p : photo.upper.points) x_min = std::min(x_min, frame(p).x());
  }
  domain.x_min_mm = x_min * data.length_mm;
  domain.x_max_mm = space.upper() * data.length_mm;
  domain.theta_min_rad = 0;
  // Beyond 170 deg a turned edge is hardly a graph over x any more.
  domain.theta_max_rad = std::clamp(1.25 * widest, 60 * kRadPerDeg, 170 * kRadPerDeg);
  return domain;
}

// A curve at an angle that may be two thirds less or more is of no use.
void RefuseUnknownTheta(const FitData& data, const std::vector<FittedPose>& poses) {
  constexpr double kMost = 1.0 / 3;  // standard uncertainty over the angle
  for (size_t p = 0; p < poses.size(); ++p) {
    const FittedPose& pose = poses[p];
    if (data.photos[p].theta_given || pose.theta_sigma_rad < kMost * std::abs(pose.theta_rad))
      continue;
    std::array<char, 60> theta{};
    std::snprintf(theta.data(),
                  theta.size(),
                  "%.1f +- %.1f deg",
                  pose.theta_rad / kRadPerDeg,
                  pose.theta_sigma_rad / kRadPerDeg);
    throw Refused(Reason::kFitFailed,
                  "fit: " + data.photos[p].name + ": theta is " + theta.data() +
                      ", as the tip of a blade is lost; show both tips clearly, or give theta");
  }
}

void CountRejected(const BladeFit& report, FamilyFit& fit) {
  for (const RejectedPoint& point : report.rejected) fit.points += point.is_upper ? 1 : 0;
}

}  // namespace

BladeFit FitBlade(const std::vector<EdgePoints>& photos, const FitOptions& options) {
  CheckOptions(photos, options);
  const Loss loss = LossNamed(options.loss);
  FitData data = PrepareFitData(photos);
  BladeFit report;
  report.theta_definition = data.theta_given() ? "given" : "distal-ends";
  Clean(loss != Loss::kNone, data, report);
  AlignPhotographs(data);

  const KnotChoice choice = ChooseSpace(data, ThinnedData(data), options);
  const SplineSpace& space = choice.spline.space;
  CutLowerEdges(space, data);
  const std::vector<MirrorVerdict> verdicts = JudgeMirrors(ThinnedData(data), space, loss);
  const std::vector<bool> mirror = ApplyVerdicts(verdicts, data, report);

  const FamilyInput input{data, mirror, DomainOf(data, space)};
  const JointResult rough = SolveJointly(
      ThinnedData(data), {space, false, loss, mirror}, SplineStart(data, choice.spline));
  FamilyFit spline = FitSpline(input, space, rough.state, loss);
  if (choice.limited_by_data)
    spline.limits.emplace_back("knots: fewer than asked for, the points support no more");
  FamilyFit tapered = FitTapered(input, options.gain);
  CountRejected(report, spline);
  CountRejected(report, tapered);
  report.knots_tried = choice.tried;
  Recommend(input, options, std::move(spline), std::move(tapered), report);
  RefuseUnknownTheta(data, report.poses);
  return report;
}

}  // namespace bladecurve
