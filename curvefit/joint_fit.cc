// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/joint_fit.h"

#include <ceres/cost_function.h>
#include <ceres/problem.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "curvefit/span_table.h"
#include "curvefit/spline_frame.h"
#include "curvefit/spline_shape.h"
#include "vision/refused.h"

namespace bladecurve {
namespace {

Eigen::VectorXd SplineCoefficientsOf(const JointModel& model, const JointState& state) {
  const Eigen::Vector2d end = EndInBlade(state.reaches[0], state.zeros[0]);
  return CoefficientsOf(*model.space, state.shape.data(), end).value;
}

// Reaches, then zeros: those that the model has.
std::vector<double*> EndBlocks(const FitData& data, const JointModel& model, JointState& state) {
  std::vector<double*> blocks;
  const size_t count = model.space ? 1 : data.photos.size();
  for (size_t p = 0; p < count; ++p) blocks.push_back(&state.reaches[p]);
  for (size_t p = 0; p < count; ++p) {
    const bool given = model.space ? data.theta_given() : data.photos[p].theta_given;
    if (given) blocks.push_back(&state.zeros[p]);
  }
  return blocks;
}

// The problem refers to the parameters in `state`, which must stay where it is.
std::unique_ptr<ceres::Problem> NewProblem(const FitData& data,
                                           const JointModel& model,
                                           JointState& state) {
  auto problem = std::make_unique<ceres::Problem>();
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const PhotoData& photo = data.photos[p];
    double* pose = state.poses[p].data();
    double* reach = &state.reaches[model.space ? 0 : p];
    double* zero = &state.zeros[model.space ? 0 : p];
    if (model.space) {
      SplineEdgesStart start{SplineCoefficientsOf(model, state), state.poses[0], std::nullopt};
      std::vector<double*> blocks = {state.shape.data(), reach, zero, state.poses[0].data()};
      if (p > 0) {
        start.own_pose = state.poses[p];
        blocks.push_back(pose);
      }
      problem->AddResidualBlock(
          NewSplineEdges(photo, *model.space, model.loss, model.mirror[p], start), nullptr, blocks);
    } else {
      problem->AddResidualBlock(NewTaperedEdges(photo, model.mirror[p]),
                                nullptr,
                                {state.shape.data(), &state.gain, pose});
    }
    problem->AddResidualBlock(NewPoseObservations(photo), nullptr, {reach, zero, pose});
  }
  const std::vector<double*> free = EndBlocks(data, model, state);
  for (double& zero : state.zeros) {
    const bool is_free = std::find(free.begin(), free.end(), &zero) != free.end();
    if (!is_free && problem->HasParameterBlock(&zero)) problem->SetParameterBlockConstant(&zero);
  }
  if (!model.space && !model.free_gain) problem->SetParameterBlockConstant(&state.gain);
  return problem;
}

// The spline that was fitted where it lay at the start, as the fitted blade's frame has it. Returns
// how far the frame moved.
double MoveIntoBladeFrame(const SplineSpace& space, const Pose& held, JointState& state) {
  const double* first_pose = state.poses[0].data();
  const BladeMotion motion = MotionFrom(held, first_pose);
  const Eigen::Vector2d end = EndInBlade(state.reaches[0], state.zeros[0]);
  const Eigen::VectorXd fitted =
      CoefficientsOf(space, state.shape.data(), PlacePoint(held, first_pose, end).point).value;
  state.shape = FreeCoefficients(space, InBladeFrame(space, fitted, motion));
  return motion.shift.norm() + std::abs(motion.turn) + std::abs(motion.growth - 1);
}

// A minimisation that went on where the last one ended.
void Append(MinimizerReport next, MinimizerReport& report) {
  next.iterations += report.iterations;
  for (IterationRecord& step : next.trace) step.iteration += report.iterations;
  next.trace.insert(next.trace.begin(), report.trace.begin(), report.trace.end());
  report = std::move(next);
}

bool HasGain(const JointModel& model) { return !model.space && model.free_gain; }

}  // namespace

JointResult SolveJointly(const FitData& data, const JointModel& model, JointState start) {
  JointResult result{std::move(start), {}};
  // Of the blade's length, or rad; what a turn of the frame bends in the spline is a hundredth of
  // it.
  constexpr double kSettled = 2e-8;
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    const Pose held = result.state.poses[0];
    const std::unique_ptr<ceres::Problem> problem = NewProblem(data, model, result.state);
    Append(Minimize(*problem), result.minimizer);
    if (!model.space) break;
    const double moved = MoveIntoBladeFrame(*model.space, held, result.state);
    if (!result.minimizer.converged || moved < kSettled) break;
  }
  return result;
}

JointEstimate EstimateJointly(const FitData& data, const JointModel& model, JointState state) {
  const std::unique_ptr<ceres::Problem> problem = NewProblem(data, model, state);
  std::vector<double*> blocks = {state.shape.data()};
  if (HasGain(model)) blocks.push_back(&state.gain);
  const std::vector<double*> ends = EndBlocks(data, model, state);
  blocks.insert(blocks.end(), ends.begin(), ends.end());
  for (Pose& pose : state.poses) blocks.push_back(pose.data());
  JointEstimate joint{EstimateFrom(JacobianBy(*problem, blocks))};
  joint.shape_columns = static_cast<Eigen::Index>(state.shape.size()) + (HasGain(model) ? 1 : 0);
  joint.num_reaches = model.space ? 1 : data.photos.size();
  joint.first_pose = joint.shape_columns + static_cast<Eigen::Index>(ends.size());
  return joint;
}

JointState StartingState(const FitData& data) {
  JointState state;
  for (const PhotoData& photo : data.photos) {
    state.poses.push_back(photo.start);
    const Eigen::Vector2d end = BladeFrame(photo.start, true)(photo.upper_end);
    state.reaches.push_back(photo.theta_given ? end.x() : end.norm());
    state.zeros.push_back(photo.theta_given ? -2 * std::atan2(end.y(), end.x()) : 0);
  }
  return state;
}

JointState SplineStart(const FitData& data, const LinearSpline& spline) {
  FitData moved = data;
  for (size_t p = 0; p < data.photos.size(); ++p) {
    // The pose at which the edge lies on the spline: (u, v) of the blade turned back by the turn,
    // moved by the shift and back by the offset.
    const Eigen::Vector3d& motion = spline.motions[p];
    Pose& pose = moved.photos[p].start;
    pose[kUpperAngle] += motion(1);
    pose[kLowerAngle] += motion(1);
    const Eigen::Vector2d by =
        Eigen::Rotation2Dd(pose[kUpperAngle]) * Eigen::Vector2d(motion(2), -motion(0));
    pose[kPivotX] -= by.x();
    pose[kPivotY] -= by.y();
  }
  JointState start = StartingState(moved);
  start.shape = FreeCoefficients(spline.space, spline.coefficients);
  return start;
}

std::vector<double> Distances(const EdgeSamples& edge,
                              bool is_upper,
                              const JointModel& model,
                              const JointState& state,
                              const Pose& pose) {
  std::vector<double> distances;
  distances.reserve(edge.points.size());
  if (model.space) {
    const Eigen::VectorXd c = SplineCoefficientsOf(model, state);
    const std::vector<Span> spans = SpansOf(*model.space);
    const std::vector<Piece> pieces = PiecesOf(spans, model.space->degree, c);
    const BladeFrame frame(pose, is_upper);
    size_t span = 0;
    for (const Eigen::Vector2d& point : edge.points) {
      const Eigen::Vector2d p = frame(point);
      span = FindSpan(spans, p.x(), span);
      const double t = (p.x() - spans[span].centre) * spans[span].scale;
      const double slope = Horner<kMaxSplineDegree>(pieces[span].slope, t);
      const double above = p.y() - Horner<kMaxSplineDegree>(pieces[span].value, t);
      const double d = above / std::sqrt(1 + slope * slope);
      distances.push_back((d + pose[kOffset]) / (1 + pose[kScale]));
    }
    return distances;
  }
  const double half = (pose[kUpperAngle] - pose[kLowerAngle]) / 2;
  const double slope = state.shape[1] + state.gain * std::tan(half);
  Pose axis = pose;
  axis[kUpperAngle] = axis[kLowerAngle] = (pose[kUpperAngle] + pose[kLowerAngle]) / 2;
  const BladeFrame frame(axis, is_upper);
  for (const Eigen::Vector2d& point : edge.points) {
    const Eigen::Vector2d p = frame(point);
    const double above = p.y() - state.shape[0] - slope * p.x();
    const double d = above / std::sqrt(1 + slope * slope);
    distances.push_back((d + pose[kOffset]) / (1 + pose[kScale]));
  }
  return distances;
}

double Chi2(const EdgeSamples& edge, const std::vector<double>& distances) {
  double sum = 0;
  for (int i = 0; i < edge.size(); ++i) sum += std::pow(edge.weights[i] * distances[i], 2);
  return sum;
}

double PoseChi2(const FitData& data, const JointModel& model, const JointState& state) {
  double chi2 = 0;
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const std::unique_ptr<ceres::CostFunction> observations(NewPoseObservations(data.photos[p]));
    const size_t end = model.space ? 0 : p;
    const std::array<const double*, 3> parameters = {
        &state.reaches[end], &state.zeros[end], state.poses[p].data()};
    Eigen::VectorXd residuals(observations->num_residuals());
    observations->Evaluate(parameters.data(), residuals.data(), nullptr);
    chi2 += residuals.squaredNorm();
  }
  return chi2;
}

RigidSpline SplineInMm(const SplineSpace& space,
                       const Eigen::VectorXd& coefficients,
                       double length_mm) {
  RigidSpline spline;
  spline.degree = space.degree;
  for (const double k : space.knots) spline.knots_mm.push_back(k * length_mm);
  for (const double value : coefficients) spline.coefficients_mm.push_back(value * length_mm);
  return spline;
}

BladeCurve CurveOf(const SplineSpace& space,
                   const JointState& state,
                   double length_mm,
                   const CurveDomain& domain) {
  const Eigen::Vector2d end = EndInBlade(state.reaches[0], state.zeros[0]);
  const Eigen::VectorXd c = CoefficientsOf(space, state.shape.data(), end).value;
  constexpr double kRunaway = 100;  // blade lengths off the axis: the minimiser lost the edge
  if (!c.allFinite() || c.cwiseAbs().maxCoeff() > kRunaway) {
    throw Refused(Reason::kFitFailed, "fit: the spline ran away from the edge");
  }
  return {SplineInMm(space, c, length_mm), domain};
}

std::vector<FittedPose> PosesInMm(const FitData& data,
                                  const JointState& state,
                                  const JointEstimate& joint) {
  std::vector<FittedPose> poses;
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const Pose& pose = state.poses[p];
    const Eigen::Index first = joint.first_pose + static_cast<Eigen::Index>(p) * kPoseSize;
    const Eigen::MatrixXd c = joint.estimate.covariance.block<kPoseSize, kPoseSize>(first, first);
    const double sum = c(kUpperAngle, kUpperAngle) + c(kLowerAngle, kLowerAngle);
    const double cross = 2 * c(kUpperAngle, kLowerAngle);
    FittedPose out;
    out.pivot_mm = data.photos[p].origin_mm + data.length_mm / (1 + pose[kScale]) *
                                                  Eigen::Vector2d(pose[kPivotX], pose[kPivotY]);
    out.axis_rad = (pose[kUpperAngle] + pose[kLowerAngle]) / 2;
    out.theta_rad = pose[kUpperAngle] - pose[kLowerAngle];
    out.pivot_covariance_mm2 = data.length_mm * data.length_mm * c.topLeftCorner<2, 2>();
    out.pivot_sigma_mm = std::sqrt(out.pivot_covariance_mm2.trace() / 2);
    out.axis_sigma_rad = std::sqrt(std::max(0.0, sum + cross)) / 2;
    // What the view does to the angle between the blades, no point of them tells.
    out.theta_sigma_rad =
        std::hypot(std::sqrt(std::max(0.0, sum - cross)), data.photos[p].view_theta_sigma);
    out.scale_relative = pose[kScale];
    out.offset_mm = data.length_mm * pose[kOffset];
    poses.push_back(out);
  }
  return poses;
}

}  // namespace bladecurve
