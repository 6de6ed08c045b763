// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/joint_fit.h"

#include <ceres/problem.h>

#include <cmath>
#include <memory>

namespace bladecurve {
namespace {

// The problem refers to the parameters in `state`, which must stay where it is.
std::unique_ptr<ceres::Problem> NewProblem(const FitData& data,
                                           const JointModel& model,
                                           JointState& state) {
  auto problem = std::make_unique<ceres::Problem>();
  for (size_t p = 0; p < data.photos.size(); ++p) {
    const PhotoData& photo = data.photos[p];
    double* pose = state.poses[p].data();
    if (model.space) {
      problem->AddResidualBlock(NewSplineEdges(photo, *model.space, model.loss, model.mirror[p]),
                                nullptr,
                                {state.shape.data(), &state.reach, &state.zero, pose});
    } else {
      problem->AddResidualBlock(NewTaperedEdges(photo, model.mirror[p]),
                                nullptr,
                                {state.shape.data(), &state.gain, pose});
    }
    problem->AddResidualBlock(
        NewPoseObservations(photo), nullptr, {&state.reach, &state.zero, pose});
  }
  if (!data.theta_given()) problem->SetParameterBlockConstant(&state.zero);
  if (!model.space && !model.free_gain) problem->SetParameterBlockConstant(&state.gain);
  return problem;
}

bool HasGain(const JointModel& model) { return !model.space && model.free_gain; }

}  // namespace

JointResult SolveJointly(const FitData& data, const JointModel& model, JointState start) {
  JointResult result{std::move(start), {}};
  const std::unique_ptr<ceres::Problem> problem = NewProblem(data, model, result.state);
  result.minimizer = Minimize(*problem);
  return result;
}

JointEstimate EstimateJointly(const FitData& data, const JointModel& model, JointState state) {
  const std::unique_ptr<ceres::Problem> problem = NewProblem(data, model, state);
  std::vector<double*> blocks = {state.shape.data()};
  if (HasGain(model)) blocks.push_back(&state.gain);
  blocks.push_back(&state.reach);
  if (data.theta_given()) blocks.push_back(&state.zero);
  for (Pose& pose : state.poses) blocks.push_back(pose.data());
  JointEstimate joint{EstimateFrom(JacobianBy(*problem, blocks)), 0, 0};
  joint.shape_columns = static_cast<Eigen::Index>(state.shape.size()) + (HasGain(model) ? 1 : 0);
  joint.first_pose = joint.shape_columns + 1 + (data.theta_given() ? 1 : 0);
  return joint;
}

JointState StartingState(const FitData& data) {
  JointState state;
  double reach = 0, zero = 0, given = 0;
  for (const PhotoData& photo : data.photos) {
    state.poses.push_back(photo.start);
    reach += photo.upper_end.norm();
    if (!photo.theta_given) continue;
    const double ray = std::atan2(photo.upper_end.y(), photo.upper_end.x());
    zero += 2 * std::remainder(photo.start[kUpperAngle] - ray, 2 * std::acos(-1.0));
    ++given;
  }
  state.reach = reach / static_cast<double>(data.photos.size());
  state.zero = given > 0 ? zero / given : 0;
  return state;
}

std::vector<double> Distances(const EdgeSamples& edge,
                              bool is_upper,
                              const JointModel& model,
                              const JointState& state,
                              const Pose& pose) {
  std::vector<double> distances;
  distances.reserve(edge.points.size());
  if (model.space) {
    const Eigen::VectorXd c =
        CoefficientsOf(*model.space, state.shape.data(), state.reach, state.zero).value;
    for (const Eigen::Vector2d& point : edge.points) {
      const Eigen::Vector2d p = ToBladeFrame(pose, point, is_upper);
      distances.push_back(DistanceFrom(*model.space, c.data(), p).d + pose[kOffset]);
    }
    return distances;
  }
  const double half = (pose[kUpperAngle] - pose[kLowerAngle]) / 2;
  const double slope = state.shape[1] + state.gain * std::tan(half);
  Pose axis = pose;
  axis[kUpperAngle] = axis[kLowerAngle] = (pose[kUpperAngle] + pose[kLowerAngle]) / 2;
  for (const Eigen::Vector2d& point : edge.points) {
    const Eigen::Vector2d p = ToBladeFrame(axis, point, is_upper);
    const double above = p.y() - state.shape[0] - slope * p.x();
    distances.push_back(above / std::sqrt(1 + slope * slope) + pose[kOffset]);
  }
  return distances;
}

double Chi2(const EdgeSamples& edge, const std::vector<double>& distances) {
  double sum = 0;
  for (int i = 0; i < edge.size(); ++i) sum += std::pow(edge.weights[i] * distances[i], 2);
  return sum;
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
    out.pivot_sigma_mm = data.length_mm * std::sqrt((c(0, 0) + c(1, 1)) / 2);
    out.axis_sigma_rad = std::sqrt(std::max(0.0, sum + cross)) / 2;
    out.theta_sigma_rad = std::sqrt(std::max(0.0, sum - cross));
    out.scale_relative = pose[kScale];
    out.offset_mm = data.length_mm * pose[kOffset];
    poses.push_back(out);
  }
  return poses;
}

}  // namespace bladecurve
