// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/sheet_pose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <stdexcept>

#include "vision/refused.h"
#include "vision/scale/sheet_model.h"

namespace bladecurve {
namespace {

using sheet::Corners;
using sheet::kLogFocal;
using sheet::kSpread;
using sheet::kSquares;

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Minimum {
  VectorXd x;
  double cost = 0;  // sum of squares
};

// How many steps a search may take. Ten do, from a focal length twice too long as well; a single
// marker that is seen from straight above, and so tells hardly anything of it, takes some hundred.
constexpr int kPatient = 1000, kQuick = 60;

// Levenberg-Marquardt from a start; nothing where it does not come to an end.
std::optional<Minimum> Minimise(const SheetProblem& problem,
                                VectorXd start,
                                const std::vector<int>& free,
                                int max_steps) {
  constexpr double kStuck = 1e9;  // damping: no direction leads down any more
  Minimum at{std::move(start), 0};
  at.cost = sheet::Residuals(problem, at.x).squaredNorm();
  double damping = 1e-3;
  for (int step = 0; step < max_steps; ++step) {
    const MatrixXd jacobian = sheet::Jacobian(problem, at.x, free);
    MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1 + damping;
    const VectorXd change =
        normal.ldlt().solve(-jacobian.transpose() * sheet::Residuals(problem, at.x));
    Minimum next = at;
    for (size_t c = 0; c < free.size(); ++c) next.x[free[c]] += change[static_cast<long>(c)];
    next.cost = sheet::Residuals(problem, next.x).squaredNorm();
    if (!(next.cost <= at.cost)) {
      damping *= 10;
      if (damping > kStuck) return at;
      continue;
    }
    const bool done = at.cost - next.cost < 1e-12 * (1 + at.cost);
    at = next;
    if (done) return at;
    damping = std::max(0.1 * damping, 1e-12);
  }
  return std::nullopt;
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

// Pose from a homography (Zhang 2000): K^-1 H = lambda [r1 r2 t], made orthonormal; for a focal
// length that is longer by a factor of exp(log_focal).
VectorXd StartFrom(const SheetProblem& problem, const Matrix3d& homography, double log_focal) {
  Matrix3d k = problem.knowledge.camera.k;
  k.diagonal().head<2>() *= std::exp(log_focal);
  Matrix3d columns = k.inverse() * homography;
  columns *= 2 / (columns.col(0).norm() + columns.col(1).norm());
  if (columns(2, 2) < 0) columns = -columns;  // the sheet lies before the camera
  Matrix3d rotation;
  rotation << columns.col(0), columns.col(1), columns.col(0).cross(columns.col(1));
  const Eigen::JacobiSVD<Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const int others =
      sheet::LiesAnywhere(problem) ? static_cast<int>(problem.squares.size()) - 1 : 0;
  VectorXd start = VectorXd::Zero(kSquares + 3 * others);
  start[kLogFocal] = log_focal;
  sheet::SetPose(svd.matrixU() * svd.matrixV().transpose(), columns.col(2), &start);
  const Matrix3d sheet_from_image = homography.inverse();
  for (int i = 0; i < others; ++i) {
    Corners mm = problem.squares[static_cast<size_t>(i) + 1].corners_px;
    for (Vector2d& p : mm) {
      p = (sheet_from_image * Undistorted(problem.knowledge.camera, p).homogeneous()).hnormalized();
    }
    const Vector2d across = mm[1] - mm[0];
    start.segment<3>(kSquares + 3 * i) << sheet::Centre(mm), std::atan2(across.y(), across.x());
  }
  return start;
}

// The best of some focal lengths, as far as they are not known.
VectorXd BestStart(const SheetProblem& problem) {
  const Matrix3d homography = SheetHomography(problem);
  VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (const double sigmas : {0.0, -1.0, -0.5, 0.5, 1.0}) {
    const VectorXd start =
        StartFrom(problem, homography, sigmas * problem.knowledge.log_focal_sigma);
    const double cost = sheet::Residuals(problem, start).squaredNorm();
    if (best.size() > 0 && !(cost < least)) continue;
    best = start;
    least = cost;
  }
  return best;
}

// In the middle of all squares that lie at known places.
Vector2d Middle(const SheetProblem& problem) {
  if (sheet::LiesAnywhere(problem)) return Vector2d::Zero();
  Vector2d sum = Vector2d::Zero();
  for (const SquareObservation& square : problem.squares) sum += sheet::Centre(*square.corners_mm);
  return sum / static_cast<double>(problem.squares.size());
}

// A plane seen with little perspective looks the same tilted the other way: the normal mirrored at
// the line of sight to the middle, which stays where it is.
VectorXd TiltedTheOtherWay(const SheetProblem& problem, const VectorXd& x) {
  const SheetPose pose = sheet::PoseOf(problem, x);
  const Vector3d middle(Middle(problem).x(), Middle(problem).y(), 0);
  const Vector3d seen = pose.camera_from_sheet * middle + pose.sheet_in_camera_mm;
  const Vector3d sight = seen.normalized();
  const Vector3d normal = pose.camera_from_sheet.col(2);
  // Half a turn about the normal, then one about the line of sight: turns the normal in their
  // plane.
  const auto half_turn = [](const Vector3d& axis) -> Matrix3d {
    return 2 * axis * axis.transpose() - Matrix3d::Identity();
  };
  const Matrix3d rotation = half_turn(sight) * half_turn(normal) * pose.camera_from_sheet;
  VectorXd other = x;
  sheet::SetPose(rotation, seen - rotation * middle, &other);
  return other;
}

void AddSigmaPoints(const SheetProblem& problem,
                    const VectorXd& x,
                    const std::vector<int>& free,
                    SheetSolution* solution) {
  const MatrixXd jacobian = sheet::Jacobian(problem, x, free);
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
    VectorXd plus = x, minus = x;
    for (long c = 0; c < kept; ++c) {
      plus[free[static_cast<size_t>(c)]] += length * axes.eigenvectors()(c, axis);
      minus[free[static_cast<size_t>(c)]] -= length * axes.eigenvectors()(c, axis);
    }
    solution->shifted.emplace_back(sheet::PoseOf(problem, plus), sheet::PoseOf(problem, minus));
  }
  if (free.front() == kLogFocal) solution->log_focal_sigma = std::sqrt(covariance(0, 0));
}

SheetSolution Describe(const SheetProblem& problem,
                       const Minimum& best,
                       const std::vector<int>& free) {
  const std::vector<SquareObservation>& squares = problem.squares;
  SheetSolution solution;
  solution.pose = sheet::PoseOf(problem, best.x);
  const VectorXd residuals = sheet::Residuals(problem, best.x);
  double square_px = 0;
  for (size_t i = 0; i < squares.size(); ++i) {
    const double sum = residuals.segment<8>(static_cast<long>(8 * i)).squaredNorm() *
                       squares[i].sigma_px * squares[i].sigma_px;
    solution.square_rms_px.push_back(std::sqrt(sum / 8));
    square_px += sum;
  }
  const long corners = static_cast<long>(8 * squares.size());
  const VectorXd priors = sheet::PriorSigmas(problem, static_cast<int>(best.x.size()));
  const long with_prior =
      std::count_if(free.begin(), free.end(), [&](int i) { return priors[i] > 0; });
  solution.surplus = static_cast<int>(corners - static_cast<long>(free.size()));
  const long degrees = solution.surplus + with_prior;
  solution.rms_px = std::sqrt(square_px / static_cast<double>(corners));
  solution.reduced_chi2 = degrees > 0 ? best.cost / static_cast<double>(degrees) : std::nan("");
  AddSigmaPoints(problem, best.x, free, &solution);
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

[[noreturn]] void RefusePose() {
  throw Refused(
      Reason::kNoScale,
      "scale: the markers' corners fit no camera above the sheet; is the picture mirrored "
      "or cut?");
}

}  // namespace

SheetSolution SolveSheet(const SheetProblem& given) {
  CheckProblem(given);
  SheetProblem problem = given;
  // The square that carries the sheet frame should be the one seen best.
  const size_t frame = sheet::LiesAnywhere(problem) ? LargestSquare(problem.squares) : 0;
  std::swap(problem.squares.front(), problem.squares[frame]);
  const VectorXd start = BestStart(problem);
  const std::vector<int> free = sheet::FreeUnknowns(problem, static_cast<int>(start.size()));
  const std::optional<Minimum> one = Minimise(problem, start, free, kPatient);
  if (!one) RefusePose();
  const std::optional<Minimum> other =
      Minimise(problem, TiltedTheOtherWay(problem, one->x), free, kQuick);
  const bool turned = other && other->cost < one->cost;
  const Minimum& best = turned ? *other : *one;
  SheetSolution solution = Describe(problem, best, free);
  std::swap(solution.square_rms_px.front(), solution.square_rms_px[frame]);
  if (!best.x.allFinite() || !(solution.pose.CameraHeightMm() > 0)) RefusePose();
  // The two tilts explain the corners about equally well: lengths are as uncertain as they differ.
  const Minimum& rival = turned || !other ? *one : *other;
  const double odds = std::exp(0.5 * (best.cost - rival.cost));
  solution.rival = sheet::PoseOf(problem, rival.x);
  solution.rival_share = odds / (1 + odds);
  return solution;
}

}  // namespace bladecurve
