// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/family_fit.h"

#include <algorithm>
#include <cmath>

#include "curvefit/diagnostics.h"
#include "curvefit/finer_curve.h"
#include "curvefit/linear_spline.h"
#include "curvefit/spline_frame.h"
#include "curvefit/spline_shape.h"
#include "curvefit/statistics.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

// One fit with the sigmas as they are, and how well it explains the upper edges.
struct Attempt {
  FitData data;
  JointResult result;
  EdgeResiduals residuals;
};

Attempt Solve(FitData data, const JointModel& model, const JointState& start) {
  Attempt attempt{std::move(data), {}, {}};
  attempt.result = SolveJointly(attempt.data, model, start);
  const bool finite = std::isfinite(attempt.result.minimizer.cost);
  if (!finite || attempt.result.minimizer.termination.starts_with("failed")) {
    throw Refused(Reason::kFitFailed, "fit: " + attempt.result.minimizer.termination);
  }
  attempt.residuals = UpperResiduals(attempt.data, model, attempt.result.state);
  return attempt;
}

// Observations less parameters: of the edges as many as are independent, and of the poses.
double Freedom(const FitData& data, const JointModel& model, size_t parameters) {
  double freedom = -static_cast<double>(parameters);
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const PhotoData& photo = data.photos[p];
    freedom += photo.upper.effective() + (model.mirror[p] ? photo.lower.effective() : 0);
    freedom += 6 + (photo.lower_end ? 1 : 0) + (photo.theta ? 1 : 0);
  }
  return freedom;
}

// By how much the sigmas of the edges must grow until they hold what this family misses. The misses
// come in long waves: each stretch of one sign is worth two samples.
double MisfitScale(const EdgeResiduals& residuals, double coefficients) {
  const double freedom = residuals.effective - coefficients;
  if (freedom < 1 || residuals.chi2 <= ChiSquareQuantile(freedom, 0.999)) return 1;
  const double worth = std::min(residuals.effective, 2.0 * CountRuns(residuals).runs);
  return std::sqrt(residuals.chi2 / freedom * residuals.effective / worth);
}

FitData Widened(FitData data, double scale) {
  for (PhotoData& photo : data.photos) {
    for (double& w : photo.upper.weights) w /= scale;
    for (double& w : photo.lower.weights) w /= scale;
  }
  return data;
}

// A second fit with honest sigmas where the family misses the edge: poses then stay where they were
// observed.
Attempt SolveHonestly(const FamilyInput& input,
                      const JointModel& model,
                      const JointState& start,
                      FamilyFit& fit) {
  Attempt first = Solve(input.data, model, start);
  const auto coefficients = static_cast<double>(start.shape.size() + 1);
  fit.chi2 = 2 * first.result.minimizer.cost;
  const double scale = MisfitScale(first.residuals, coefficients);
  fit.sigma_scale = scale;
  if (scale == 1) return first;
  return Solve(Widened(input.data, scale), model, first.result.state);
}

void RecordMinimizer(const MinimizerReport& minimizer, FamilyFit& fit) {
  fit.iterations = minimizer.iterations;
  fit.converged = minimizer.converged;
  fit.termination = minimizer.termination;
  fit.trace = minimizer.trace;
}

void RecordCriteria(const FitData& data, const JointModel& model, FamilyFit& fit) {
  const auto k = static_cast<double>(fit.num_parameters);
  double n = fit.freedom + k;
  fit.bic = fit.chi2 + k * std::log(std::max(n, 2.0));
  fit.aicc = n > k + 1 ? fit.chi2 + 2 * k * n / (n - k - 1) : kNotSet;
  fit.effective_points = 0;
  for (const PhotoData& photo : data.photos) {
    fit.effective_points += photo.upper.effective();
    fit.inliers += photo.upper.size();
  }
  fit.points = fit.inliers;
  if (model.loss == Loss::kNone && model.space) fit.limits.emplace_back("loss: none was asked for");
}

void RecordPoses(const Attempt& attempt, const JointEstimate& joint, FamilyFit& fit) {
  fit.poses = PosesInMm(attempt.data, attempt.result.state, joint);
  double sum = 0;
  size_t count = 0;
  for (size_t p = 0; p < fit.poses.size(); ++p) {
    const std::vector<double>& d = attempt.residuals.distances[p];
    double squares = 0;
    for (const double x : d) squares += x * x;
    fit.poses[p].rms_mm =
        attempt.data.length_mm * std::sqrt(squares / static_cast<double>(d.size()));
    sum += squares;
    count += d.size();
  }
  fit.rms_mm = attempt.data.length_mm * std::sqrt(sum / static_cast<double>(count));
}

void RecordEstimate(const JointEstimate& joint,
                    const std::vector<std::string>& names,
                    FamilyFit& fit) {
  fit.condition_number = joint.estimate.condition_number;
  fit.rank = joint.estimate.rank;
  for (const Eigen::VectorXd& direction : joint.estimate.undetermined) {
    fit.undetermined.push_back(Describe(direction, names));
  }
}

std::vector<std::string> JointNames(std::vector<std::string> names,
                                    const FitData& data,
                                    const JointEstimate& joint) {
  const size_t reaches = joint.num_reaches;
  for (size_t i = 0; i < reaches; ++i) names.emplace_back("reach_mm");
  const auto first_pose = static_cast<size_t>(joint.first_pose);
  while (names.size() < first_pose) names.emplace_back("theta_zero_rad");
  for (size_t p = 0; p < data.photos.size(); ++p) {
    for (const char* name :
         {"pivot_x_mm", "pivot_y_mm", "upper_rad", "lower_rad", "scale", "offset_mm"}) {
      names.push_back(std::string("photo").append(std::to_string(p)).append(".").append(name));
    }
  }
  return names;
}

// How much worse the upper edges fit together than each alone, poses free: rms in sigmas of a
// point.
double Disagreement(const FitData& data, const JointModel& model, const JointState& state) {
  double excess = 0, effective = 0;
  const EdgeResiduals joint = UpperResiduals(data, model, state);
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const std::vector<FlatPoint> alone = Flatten(data.photos[p].upper, state.poses[p], true);
    const SplineSpace space =
        model.space ? *model.space : ClampedSpace(1, alone.front().u, alone.back().u, {});
    excess -= FitLinearSpline(alone, space).chi2;
    effective += data.photos[p].upper.effective();
  }
  return std::sqrt(std::max(0.0, excess + joint.chi2) / effective);
}

void Record(const FamilyInput& input,
            const JointModel& model,
            const Attempt& attempt,
            const JointEstimate& joint,
            const std::vector<std::string>& names,
            FamilyFit& fit) {
  const std::vector<std::string> all = JointNames(names, input.data, joint);
  fit.num_parameters = static_cast<int>(all.size());
  fit.freedom = Freedom(input.data, model, all.size());
  RecordMinimizer(attempt.result.minimizer, fit);
  RecordCriteria(input.data, model, fit);
  RecordPoses(attempt, joint, fit);
  RecordEstimate(joint, all, fit);
  fit.pose_chi2 = PoseChi2(input.data, model, attempt.result.state);
  if (input.data.photos.size() > 1) {
    fit.disagreement = Disagreement(input.data, model, attempt.result.state);
  }
  fit.residual_tests = TestResiduals(attempt.residuals);
  fit.residual_tests.chi2_per_freedom = fit.chi2 / std::max(fit.freedom, 1.0);
}

// The rays to the ends alone say theta with an honest uncertainty, but a wide one, even where light
// falsifies a part of an edge; that part draws the fit, whose own covariance knows nothing of it.
// So this part of the square by which the fit moved theta counts as well: 1.96 sigma then hold 95 %
// of photoreal scenes. Several photographs check each other.
void DoubtMovedTheta(const FitData& data, std::vector<FittedPose>& poses) {
  constexpr double kOfMove = 0.6;
  if (poses.size() > 1) return;
  FittedPose& pose = poses.front();
  const double moved = pose.theta_rad - data.photos.front().ObservedTheta();
  pose.theta_sigma_rad = std::hypot(pose.theta_sigma_rad, std::sqrt(kOfMove) * moved);
}

// From the fit's parameters to the spline's coefficients, mm^2. The first photograph's pose counts,
// because the blade's frame goes with it.
Eigen::MatrixXd SplineCovariance(const JointEstimate& joint,
                                 const SplineSpace& space,
                                 const JointState& state,
                                 bool zero_is_free,
                                 double length_mm) {
  const double reach = state.reaches[0], zero = state.zeros[0];
  const Eigen::Vector2d end = EndInBlade(reach, zero);
  const SplineCoefficients c = CoefficientsOf(space, state.shape.data(), end);
  const PlacedPoint placed = PlacePoint(state.poses[0], state.poses[0].data(), end);
  const Eigen::MatrixXd by_end = c.jacobian.rightCols(2);
  const Eigen::MatrixXd by_ends = by_end * EndJacobian(reach, zero);
  const Eigen::MatrixXd by_pose =
      by_end * placed.by_first + FrameJacobian(space, c.value, state.poses[0]);

  const int n = space.size();
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(n, joint.estimate.covariance.cols());
  map.leftCols(n - 1) = c.jacobian.leftCols(n - 1);
  map.col(n - 1) = by_ends.col(0);
  if (zero_is_free) map.col(n) = by_ends.col(1);
  constexpr std::array<int, 4> kOfFirst = {kPivotX, kPivotY, kUpperAngle, kScale};
  for (int k = 0; k < 4; ++k) map.col(joint.first_pose + kOfFirst[k]) = by_pose.col(k);
  return length_mm * length_mm * map * joint.estimate.covariance * map.transpose();
}

JointState TaperedStart(const FitData& data, double gain) {
  JointState state = StartingState(data);
  state.gain = gain;
  const PhotoData& photo = data.photos.front();
  Pose axis = photo.start;
  axis[kUpperAngle] = (photo.start[kUpperAngle] + photo.start[kLowerAngle]) / 2;
  const BladeFrame frame(axis, true);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : photo.upper.points) mean += frame(p);
  mean /= photo.upper.size();
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : photo.upper.points) {
    const Eigen::Vector2d d = frame(p) - mean;
    moments += d * d.transpose();
  }
  const double slope = moments(0, 1) / moments(0, 0);
  const double half = (photo.start[kUpperAngle] - photo.start[kLowerAngle]) / 2;
  state.shape = {mean.y() - slope * mean.x(), slope - gain * std::tan(half)};
  return state;
}

}  // namespace

FamilyFit FitSpline(const FamilyInput& input,
                    const SplineSpace& space,
                    const JointState& start,
                    Loss loss) {
  const JointModel model{space, false, loss, input.mirror};
  FamilyFit fit;
  const Attempt attempt = SolveHonestly(input, model, start, fit);
  const JointState& state = attempt.result.state;
  const JointEstimate joint = EstimateJointly(attempt.data, model, state);
  const double length_mm = attempt.data.length_mm;
  fit.curve = CurveOf(space, state, length_mm, input.domain);
  fit.covariance = SplineCovariance(joint, space, state, attempt.data.theta_given(), length_mm);
  fit.finer = RefineCurve(attempt.data, model, state, fit.covariance);
  std::vector<std::string> free_names;
  for (int j = 0; j < space.size(); ++j) {
    fit.parameter_names.push_back(std::string("c").append(std::to_string(j)).append("_mm"));
    if (j + 1 < space.size()) free_names.push_back(fit.parameter_names.back());
  }
  Record(input, model, attempt, joint, free_names, fit);
  DoubtMovedTheta(attempt.data, fit.poses);
  fit.influence = InfluenceOf(attempt.data, model, state, attempt.residuals);
  return fit;
}

FamilyFit FitTapered(const FamilyInput& input, const std::optional<double>& gain) {
  JointModel model{std::nullopt, !gain, Loss::kNone, input.mirror};
  FamilyFit fit;
  const JointState start = TaperedStart(input.data, gain.value_or(0.5));
  fit.parameter_names = {"a_mm", "b"};
  if (model.free_gain) {
    const JointEstimate joint = EstimateJointly(input.data, model, start);
    fit.parameter_names.emplace_back("gain");
    if (!joint.estimate.undetermined.empty()) {
      RecordEstimate(joint, JointNames(fit.parameter_names, input.data, joint), fit);
      fit.limits.emplace_back("gain: held at 1/2, photographs at one angle do not determine it");
      model.free_gain = false;
      fit.parameter_names.pop_back();
    }
  }
  const Attempt attempt = SolveHonestly(input, model, start, fit);
  const JointState& state = attempt.result.state;
  const JointEstimate joint = EstimateJointly(attempt.data, model, state);
  const double length_mm = attempt.data.length_mm;
  fit.curve = BladeCurve(TaperedRectangle{state.shape[0] * length_mm, state.shape[1], state.gain},
                         input.domain);
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(joint.shape_columns);
  unit(0) = length_mm;
  fit.covariance = unit.asDiagonal() *
                   joint.estimate.covariance.topLeftCorner(unit.size(), unit.size()) *
                   unit.asDiagonal();
  Record(input, model, attempt, joint, fit.parameter_names, fit);
  fit.influence = InfluenceOf(attempt.data, model, state, attempt.residuals);
  return fit;
}

GainFinding FindGain(const FamilyInput& input) {
  const JointModel model{std::nullopt, true, Loss::kNone, input.mirror};
  FamilyFit fit;
  const Attempt attempt = SolveHonestly(input, model, TaperedStart(input.data, 0.5), fit);
  const JointEstimate joint = EstimateJointly(attempt.data, model, attempt.result.state);
  GainFinding finding;
  if (!joint.estimate.undetermined.empty()) return finding;
  const auto parameters = static_cast<size_t>(joint.estimate.covariance.cols());
  constexpr Eigen::Index kGain = 2;  // after a and b
  finding.gain = attempt.result.state.gain;
  finding.sigma = std::sqrt(joint.estimate.covariance(kGain, kGain));
  finding.chi2_per_freedom = fit.chi2 / std::max(Freedom(input.data, model, parameters), 1.0);
  return finding;
}

}  // namespace bladecurve
