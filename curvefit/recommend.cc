// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/recommend.h"

#include <algorithm>
#include <cmath>

#include "curvefit/compare_families.h"
#include "curvefit/linear_spline.h"
#include "curvefit/statistics.h"
#include "model/degrees.h"

namespace bladecurve {
namespace {

constexpr double kSeveralAngles =
    2 * kRadPerDeg;                  // angles closer than this say nothing about the families
constexpr double kTorquePart = 0.1;  // the paper's own model is off by about as much
constexpr double kGivenApart = 1 * kRadPerDeg;  // a given theta further from the ends' is doubtful

double AngleSpread(const std::vector<FittedPose>& poses) {
  const auto less = [](const FittedPose& a, const FittedPose& b) {
    return a.theta_rad < b.theta_rad;
  };
  const auto [low, high] = std::minmax_element(poses.begin(), poses.end(), less);
  return high->theta_rad - low->theta_rad;
}

bool TaperedPreferred(const FitOptions& options,
                      const FamilyFit& spline,
                      const FamilyFit& tapered,
                      std::string& why) {
  if (options.family != Family::kAuto) {
    why = "asked for";
    return options.family == Family::kTaperedRectangle;
  }
  if (AngleSpread(spline.poses) < kSeveralAngles) {
    why = "photographs at one angle: a rigid turn of the edge seen is assumed";
    return false;
  }
  const bool tapered_explains = tapered.bic <= spline.bic;
  why = tapered_explains ? "the tapered form explains several angles as well, with fewer parameters"
                         : "the rigid spline explains the edges at several angles better";
  return tapered_explains;
}

// One shape does not explain all photographs, or their pivots, ends and angles contradict each
// other.
bool PhotographsDisagree(const FamilyInput& input, const FamilyFit& fit) {
  const auto photos = static_cast<double>(input.data.photos.size());
  if (photos < 2) return false;
  constexpr double kVisible = 0.5;  // less than half the scatter of the points matters to nobody
  constexpr double kNoAccident =
      1 - 1e-6;  // of consistent photographs one set in a million is called torn
  constexpr double kObservations = 7;  // of a pose
  return fit.disagreement > kVisible ||
         fit.pose_chi2 > ChiSquareQuantile(kObservations * photos, kNoAccident);
}

// The given theta is not the angle between the distal ends: another definition, or a slip.
bool GivenThetaApart(const FitData& data) {
  const std::vector<double> zeros = StartingState(data).zeros;
  return std::any_of(
      zeros.begin(), zeros.end(), [](double zero) { return std::abs(zero) > kGivenApart; });
}

// The families part, at angles of the photographs, and these do not say clearly which is right:
// what is recommended, or asked for, is then one of two answers.
bool FamilyInDoubt(const FamilyDifference& difference,
                   const FamilyFit& recommended,
                   const FamilyFit& other) {
  if (AngleSpread(recommended.poses) < kSeveralAngles) return false;  // nothing to decide by
  constexpr double kClearly = 10;  // "very strong" evidence (Kass and Raftery 1995)
  if (other.bic - recommended.bic >= kClearly) return false;
  constexpr double kPart = 0.01;  // of the blade's length: as far as blades of a pair may differ
  return difference.photographed_torque > kTorquePart ||
         difference.photographed_mm > kPart * recommended.curve.domain().x_max_mm;
}

void Warn(const FamilyInput& input, const FamilyFit& other, BladeFit& report) {
  const auto warn = [&](const char* code) { report.warnings.emplace_back(code); };
  if (PhotographsDisagree(input, report.recommended)) warn("photographs_disagree");
  if (FamilyInDoubt(report.difference, report.recommended, other)) {
    warn("families_part");
  } else if (report.difference.largest_torque > kTorquePart) {
    report.notes.emplace_back("families_part");
  }
  if (GivenThetaApart(input.data)) warn("theta_given_differs");
  if (!report.recommended.converged) warn("not_converged");
}

std::vector<double> AnglesOf(const FamilyFit& fit) {
  std::vector<double> angles;
  for (const FittedPose& pose : fit.poses) angles.push_back(pose.theta_rad);
  return angles;
}

}  // namespace

void Recommend(const FamilyInput& input,
               const FitOptions& options,
               FamilyFit spline,
               FamilyFit tapered,
               BladeFit& report) {
  const bool take_tapered = TaperedPreferred(options, spline, tapered, report.why_recommended);
  report.recommended = take_tapered ? tapered : spline;
  report.alternatives = {take_tapered ? std::move(spline) : std::move(tapered)};
  report.poses = report.recommended.poses;
  const FamilyFit& other = report.alternatives[0];
  report.difference =
      CompareFamilies(report.recommended.curve, other.curve, AnglesOf(report.recommended));
  report.largest_difference_mm = report.difference.largest_mm;
  report.largest_difference_torque = report.difference.largest_torque;
  if (AngleSpread(report.poses) >= kSeveralAngles) report.gain = FindGain(input);
  Warn(input, other, report);
}

}  // namespace bladecurve
