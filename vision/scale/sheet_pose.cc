// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/sheet_pose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

#include "vision/refused.h"
#include "vision/scale/sheet_model.h"

namespace bladecurve {
namespace {

using sheet::Base;
using sheet::Corners;
using sheet::kK1;
using sheet::kLogFocal;
using sheet::kPlace;
using sheet::kSpread;
using sheet::kSquares;
using sheet::kTurn;

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Minimum {
  Base base;
  VectorXd x;
  double cost = 0;  // sum of squares
};

// Levenberg-Marquardt from a start; the turn is folded into the base after every step.
Minimum Minimise(Minimum at, const std::vector<int>& free) {
  constexpr int kMaxSteps = 60;
  double damping = 1e-3;
  at.cost = sheet::Residuals(at.base, at.x).squaredNorm();
  for (int step = 0; step < kMaxSteps && damping < 1e9; ++step) {
    const MatrixXd jacobian = sheet::Jacobian(at.base, at.x, free);
    MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1 + damping;
    const VectorXd change =
        normal.ldlt().solve(-jacobian.transpose() * sheet::Residuals(at.base, at.x));
    Minimum next = at;
    for (size_t c = 0; c < free.size(); ++c) next.x[free[c]] += change[static_cast<long>(c)];
    next.base.rotation = sheet::Rotation(next.x.segment<3>(kTurn)) * at.base.rotation;
    next.x.segment<3>(kTurn).setZero();
    next.cost = sheet::Residuals(next.base, next.x).squaredNorm();
    if (!(next.cost <= at.cost)) {
      damping *= 10;
      continue;
    }
    const bool done = at.cost - next.cost < 1e-12 * (1 + at.cost);
    // Members one by one: the base refers to its problem.
    at.base.rotation = next.base.rotation;
    at.x = next.x;
    at.cost = next.cost;
    damping = std::max(0.1 * damping, 1e-12);
    if (done) break;
  }
  return at;
}

Matrix3d HomographyFrom(const std::vector<Vector2d>& sheet_mm,
                        const std::vector<Vector2d>& image_px) {
  std::vector<cv::Point2d> from, to;
  for (const Vector2d& p : sheet_mm) from.emplace_back(p.x(), p.y());
  for (const Vector2d& p : image_px) to.emplace_back(p.x(), p.y());
  const cv::Mat h = cv::findHomography(from, to, 0);
  if (h.empty())
    throw Refused(
        Reason::kNoScale,
        "scale: the marker's corners do not span a plane; take the photograph from above");
  Matrix3d homography;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) homography(r, c) = h.at<double>(r, c);
  }
  return homography;
}

size_t LargestSquare(const std::vector<SquareObservation>& squares) {
  size_t largest = 0;
  double longest = 0;
  for (size_t i = 0; i < squares.size(); ++i) {
    const double diagonal = (squares[i].corners_px[0] - squares[i].corners_px[2]).norm();
    if (diagonal > longest) longest = diagonal, largest = i;
  }
  return largest;
}

Matrix3d SheetHomography(const SheetProblem& problem) {
  std::vector<Vector2d> mm, px;
  for (const SquareObservation& square : problem.squares) {
    const Corners corners =
        square.corners_mm ? *square.corners_mm : sheet::SquareCorners(problem.side_mm);
    for (size_t k = 0; k < 4; ++k) {
      mm.push_back(corners[k]);
      px.push_back(Undistorted(problem.knowledge.camera, square.corners_px[k]));
    }
    if (!square.corners_mm) break;  // the others lie at unknown places
  }
  return HomographyFrom(mm, px);
}

// Pose from a homography (Zhang 2000): K^-1 H = lambda [r1 r2 t], made orthonormal.
Minimum StartFrom(const SheetProblem& problem, const Matrix3d& homography) {
  Matrix3d columns = problem.knowledge.camera.k.inverse() * homography;
  columns *= 2 / (columns.col(0).norm() + columns.col(1).norm());
  if (columns(2, 2) < 0) columns = -columns;  // the sheet lies before the camera
  Matrix3d rotation;
  rotation << columns.col(0), columns.col(1), columns.col(0).cross(columns.col(1));
  const Eigen::JacobiSVD<Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const int others =
      sheet::LiesAnywhere(problem) ? static_cast<int>(problem.squares.size()) - 1 : 0;
  Minimum start{{problem, svd.matrixU() * svd.matrixV().transpose()},
                VectorXd::Zero(kSquares + 3 * others)};
  start.x.segment<3>(kPlace) = columns.col(2);
  const Matrix3d sheet_from_image = homography.inverse();
  for (int i = 0; i < others; ++i) {
    Corners mm = problem.squares[static_cast<size_t>(i) + 1].corners_px;
    for (Vector2d& p : mm) {
      p = (sheet_from_image * Undistorted(problem.knowledge.camera, p).homogeneous()).hnormalized();
    }
    const Vector2d across = mm[1] - mm[0];
    start.x.segment<3>(kSquares + 3 * i) << sheet::Centre(mm), std::atan2(across.y(), across.x());
  }
  return start;
}

// A plane seen with little perspective looks the same tilted the other way: the normal mirrored at
// the line of sight.
Minimum TiltedTheOtherWay(const Minimum& minimum) {
  const Vector3d sight = minimum.x.segment<3>(kPlace).normalized();
  const Vector3d normal = minimum.base.rotation.col(2);
  const Vector3d mirrored = 2 * normal.dot(sight) * sight - normal;
  Minimum other = minimum;
  other.base.rotation =
      Eigen::Quaterniond::FromTwoVectors(normal, mirrored) * minimum.base.rotation;
  return other;
}

void AddSigmaPoints(const Minimum& at, const std::vector<int>& free, SheetSolution* solution) {
  const MatrixXd jacobian = sheet::Jacobian(at.base, at.x, free);
  const MatrixXd information = jacobian.transpose() * jacobian;
  const long count = static_cast<long>(free.size());
  const MatrixXd covariance = information.ldlt().solve(MatrixXd::Identity(count, count));
  // Where the sheet's own squares lie does not matter to lengths.
  const long kept = std::count_if(free.begin(), free.end(), [](int i) { return i < kSpread; });
  const Eigen::SelfAdjointEigenSolver<MatrixXd> axes(covariance.topLeftCorner(kept, kept));
  const double surplus_scale =
      std::sqrt(std::max(1.0, std::isnan(solution->reduced_chi2) ? 1.0 : solution->reduced_chi2));
  for (long axis = 0; axis < kept; ++axis) {
    const double length =
        kPoseShift * surplus_scale * std::sqrt(std::max(0.0, axes.eigenvalues()[axis]));
    VectorXd plus = at.x, minus = at.x;
    for (long c = 0; c < kept; ++c) {
      plus[free[static_cast<size_t>(c)]] += length * axes.eigenvectors()(c, axis);
      minus[free[static_cast<size_t>(c)]] -= length * axes.eigenvectors()(c, axis);
    }
    solution->shifted.emplace_back(sheet::PoseOf(at.base, plus), sheet::PoseOf(at.base, minus));
  }
  if (free.front() == kLogFocal) solution->log_focal_sigma = std::sqrt(covariance(0, 0));
}

SheetSolution Describe(const Minimum& best, const std::vector<int>& free) {
  const std::vector<SquareObservation>& squares = best.base.problem.squares;
  SheetSolution solution;
  solution.pose = sheet::PoseOf(best.base, best.x);
  const VectorXd residuals = sheet::Residuals(best.base, best.x);
  double square_px = 0;
  for (size_t i = 0; i < squares.size(); ++i) {
    const double sum = residuals.segment<8>(static_cast<long>(8 * i)).squaredNorm() *
                       squares[i].sigma_px * squares[i].sigma_px;
    solution.square_rms_px.push_back(std::sqrt(sum / 8));
    square_px += sum;
  }
  const long corners = static_cast<long>(8 * squares.size());
  const VectorXd priors = sheet::PriorSigmas(best.base.problem, static_cast<int>(best.x.size()));
  const long with_prior =
      std::count_if(free.begin(), free.end(), [&](int i) { return priors[i] > 0; });
  solution.surplus = static_cast<int>(corners - static_cast<long>(free.size()));
  const long degrees = solution.surplus + with_prior;
  solution.rms_px = std::sqrt(square_px / static_cast<double>(corners));
  solution.reduced_chi2 = degrees > 0 ? best.cost / static_cast<double>(degrees) : std::nan("");
  solution.spread_mm = best.x[kSpread];
  AddSigmaPoints(best, free, &solution);
  return solution;
}

void CheckProblem(const SheetProblem& problem) {
  if (problem.squares.empty()) throw std::invalid_argument("SolveSheet: no squares");
  if (!(problem.side_mm > 0)) throw std::invalid_argument("SolveSheet: side_mm must be positive");
  for (const SquareObservation& square : problem.squares) {
    if (square.corners_mm.has_value() != problem.squares.front().corners_mm.has_value()) {
      throw std::invalid_argument("SolveSheet: corners_mm must be known of all squares or of none");
    }
    if (!(square.sigma_px > 0))
      throw std::invalid_argument("SolveSheet: sigma_px must be positive");
  }
}

}  // namespace

SheetSolution SolveSheet(const SheetProblem& given) {
  CheckProblem(given);
  SheetProblem problem = given;
  // The square that carries the sheet frame should be the one seen best.
  const size_t frame = sheet::LiesAnywhere(problem) ? LargestSquare(problem.squares) : 0;
  std::swap(problem.squares.front(), problem.squares[frame]);
  const Minimum start = StartFrom(problem, SheetHomography(problem));
  const std::vector<int> free = sheet::FreeUnknowns(problem, static_cast<int>(start.x.size()));
  const Minimum one = Minimise(start, free);
  const Minimum other = Minimise(TiltedTheOtherWay(one), free);
  const Minimum& best = other.cost < one.cost ? other : one;
  SheetSolution solution = Describe(best, free);
  std::swap(solution.square_rms_px.front(), solution.square_rms_px[frame]);
  if (!best.x.allFinite() || !(solution.pose.CameraHeightMm() > 0)) {
    throw Refused(Reason::kNoScale,
                  "scale: the markers' corners fit no camera above the sheet; is the picture "
                  "mirrored or cut?");
  }
  // The two tilts explain the corners about equally well: lengths are as uncertain as they differ.
  const Minimum& rival = &best == &one ? other : one;
  const double odds = std::exp(0.5 * (best.cost - rival.cost));
  solution.rival = sheet::PoseOf(rival.base, rival.x);
  solution.rival_share = odds / (1 + odds);
  return solution;
}

}  // namespace bladecurve
