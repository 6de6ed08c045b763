// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
//
// Our side of compare_scipy.py. Reads an edge in its blade's frame from standard input: the numbers
// of interior knots, points and evaluations, then the knots, the points "u v sigma", the places to
// evaluate. Prints for each method "name milliseconds" and then the values of the curve, one line a
// method.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "curvefit/choose_knots.h"
#include "curvefit/fit.h"
#include "curvefit/joint_fit.h"
#include "curvefit/linear_spline.h"
#include "stopwatch.h"

namespace bladecurve {
namespace {

struct Job {
  std::vector<double> knots, places;
  std::vector<FlatPoint> points;
};

Job ReadJob(std::istream& in) {
  size_t knots = 0, points = 0, places = 0;
  in >> knots >> points >> places;
  Job job;
  job.knots.resize(knots);
  for (double& k : job.knots) in >> k;
  for (size_t i = 0; i < points; ++i) {
    FlatPoint p;
    double sigma = 1;
    in >> p.u >> p.v >> sigma;
    p.weight = 1 / sigma;
    job.points.push_back(p);
  }
  job.places.resize(places);
  for (double& x : job.places) in >> x;
  return job;
}

using Curve = std::function<double(double)>;

Curve AsCurve(const LinearSpline& spline) {
  return [spline](double u) {
    const BasisRow row = EvalBasis(spline.space, u);
    double v = 0;
    for (int j = 0; j <= spline.space.degree; ++j) {
      v += row.value[j] * spline.coefficients(row.first + j);
    }
    return v;
  };
}

Curve WithKnots(const Job& job) {
  const SplineSpace space = ClampedSpace(3, job.points.front().u, job.points.back().u, job.knots);
  return AsCurve(FitLinearSpline(job.points, space));
}

Curve WithChosenKnots(const Job& job) {
  KnotRequest request;
  request.lower = job.points.front().u;
  request.upper = job.points.back().u;
  request.effective_points = static_cast<double>(job.points.size());
  return AsCurve(ChooseKnots(job.points, request).spline);
}

// y of the fitted edge at x, both in the photograph: the scissors lie turned and shifted in it a
// little.
double InPhotograph(const BladeCurve& curve, const FittedPose& pose, double x) {
  const double c = std::cos(pose.axis_rad), s = std::sin(pose.axis_rad);
  double along = x, y = 0;
  for (int step = 0; step < 4; ++step) {
    const CurveSample sample = curve.Eval(along, pose.theta_rad);
    const double error = pose.pivot_mm.x() + c * along - s * sample.phi_mm - x;
    y = pose.pivot_mm.y() + s * along + c * sample.phi_mm;
    along -= error / (c - s * sample.phi_x);
  }
  return y;
}

EdgePoints PhotographOf(const Job& job) {
  EdgePoints photo;
  photo.photo = "comparison";
  for (const FlatPoint& p : job.points) photo.upper.push_back({{p.u, p.v}, {0, -1}, 1 / p.weight});
  const FlatPoint& end = job.points.back();
  photo.upper_end.point_mm = {end.u, end.v};
  photo.lower_end.point_mm = {end.u, end.v - 20};
  for (LocatedPoint* p : {&photo.upper_end, &photo.lower_end}) p->covariance_mm2.setIdentity();
  return photo;
}

// What odr does, as a part of the whole fit: one curve of given knots, orthogonal distances,
// covariance. The pose is estimated as well.
Curve OneCurve(const Job& job) {
  const FitData data = PrepareFitData({PhotographOf(job)});
  const std::vector<FlatPoint> flat = Flatten(data.photos[0].upper, data.photos[0].start, true);
  std::vector<double> interior = job.knots;
  for (double& k : interior) k /= data.length_mm;
  const SplineSpace space = ClampedSpace(3, flat.front().u, flat.back().u, interior);
  const JointModel model{space, false, Loss::kNone, {false}};
  const JointResult result =
      SolveJointly(data, model, SplineStart(data, FitLinearSpline(flat, space)));
  const JointEstimate estimate = EstimateJointly(data, model, result.state);
  const BladeCurve curve = CurveOf(space, result.state, data.length_mm, {0, 100, 0, 1});
  return [curve, pose = PosesInMm(data, result.state, estimate)[0]](double x) {
    return InPhotograph(curve, pose, x);
  };
}

// The whole fit of one photograph with the same knots: outliers, scatter, pose, both families,
// covariance, tests of the residuals.
Curve WholeFit(const Job& job) {
  FitOptions options;
  options.degree = 3;
  options.knots_mm = job.knots;
  const BladeFit fit = FitBlade({PhotographOf(job)}, options);
  return [curve = fit.recommended.curve, pose = fit.poses[0]](double x) {
    return InPhotograph(curve, pose, x);
  };
}

void Report(const char* name, const Job& job, Curve (*method)(const Job&)) {
  constexpr int kRepeats = 15;
  std::vector<double> ms;
  Curve curve;
  for (int i = 0; i < kRepeats; ++i) {
    const Stopwatch stopwatch;
    curve = method(job);
    ms.push_back(stopwatch.Milliseconds());
  }
  std::printf("%s %.6f", name, *std::min_element(ms.begin(), ms.end()));
  for (const double x : job.places) std::printf(" %.17g", curve(x));
  std::printf("\n");
}

}  // namespace
}  // namespace bladecurve

int main() {
  const bladecurve::Job job = bladecurve::ReadJob(std::cin);
  bladecurve::Report("given-knots", job, bladecurve::WithKnots);
  bladecurve::Report("chosen-knots", job, bladecurve::WithChosenKnots);
  bladecurve::Report("one-curve", job, bladecurve::OneCurve);
  bladecurve::Report("whole-fit", job, bladecurve::WholeFit);
  return 0;
}
