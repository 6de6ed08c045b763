// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "curvefit/finer_curve.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "curvefit/span_sums.h"
#include "curvefit/span_table.h"
#include "curvefit/spline_frame.h"
#include "curvefit/spline_shape.h"

namespace bladecurve {
namespace {

// Keeps the equations solvable where a basis function meets no point.
constexpr double kRidge = 1e-10;

// Every span in equal pieces, so that no piece is longer than a 24th of the whole: a wave that
// escapes these is not worth a band.
SplineSpace Refined(const SplineSpace& space) {
  constexpr double kPieces = 24;
  const double longest = (space.upper() - space.lower()) / kPieces;
  std::vector<double> ends = InteriorKnots(space), knots;
  ends.push_back(space.upper());
  double last = space.lower();
  for (const double end : ends) {
    const int pieces = std::max(1, static_cast<int>(std::ceil((end - last) / longest - 1e-9)));
    for (int k = 1; k < pieces; ++k) knots.push_back(last + (end - last) * k / pieces);
    knots.push_back(end);
    last = end;
  }
  knots.pop_back();
  return ClampedSpace(space.degree, space.lower(), space.upper(), knots);
}

// The jumps of the highest derivative at all interior knots, each over the root of the distance to
// its neighbours: white noise, were that derivative a random walk.
Eigen::MatrixXd JumpsOf(const SplineSpace& space) {
  const std::vector<Span> spans = SpansOf(space);
  const int degree = space.degree;
  Eigen::MatrixXd jumps = Eigen::MatrixXd::Zero(space.size() - degree - 1, space.size());
  for (Eigen::Index i = 0; i < jumps.rows(); ++i) {
    const Span &left = spans[static_cast<size_t>(i)], &right = spans[static_cast<size_t>(i) + 1];
    const double root = std::sqrt((right.end - left.begin) / 2);
    for (int j = 0; j <= degree; ++j) {
      jumps(i, i + j) -= std::pow(left.scale, degree) * left.basis[j][degree] / root;
      jumps(i, i + j + 1) += std::pow(right.scale, degree) * right.basis[j][degree] / root;
    }
  }
  return jumps;
}

// From the coefficients of a space to those of a finer one that holds it.
Eigen::MatrixXd Insertion(const SplineSpace& space, const SplineSpace& finer) {
  const std::vector<double> places = GrevilleAbscissae(finer);
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(finer.size(), space.size());
  for (int i = 0; i < finer.size(); ++i) {
    const BasisRow row = EvalBasis(space, places[i]);
    for (int j = 0; j <= space.degree; ++j) values(i, row.first + j) = row.value[j];
  }
  return SplineThrough(finer, values);
}

// Normal equations of the edges' points for the coefficients, poses held.
struct EdgeEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

template <int Degree>
void AddEdge(const EdgeSamples& edge,
             bool is_upper,
             const Pose& pose,
             const std::vector<Span>& spans,
             const std::vector<Piece>& pieces,
             EdgeEquations& equations) {
  constexpr int kBasis = Degree + 1;
  const BladeFrame frame(pose, is_upper);
  std::vector<SpanSums<Degree, 1>> sums(spans.size());
  size_t span = 0;
  for (int i = 0; i < edge.size(); ++i) {
    const Eigen::Vector2d p = frame(edge.points[i]);
    span = FindSpan(spans, p.x(), span);
    const double t = (p.x() - spans[span].centre) * spans[span].scale;
    const double slope = Horner<Degree - 1>(pieces[span].slope, t);
    const double cosine = 1 / std::sqrt(1 + slope * slope);
    const double d = cosine * (p.y() - Horner<Degree>(pieces[span].value, t));
    sums[span].Add(t, edge.weights[i] * cosine, {edge.weights[i] * (d + pose[kOffset])});
  }
  for (size_t s = 0; s < spans.size(); ++s) {
    const Eigen::MatrixXd basis = BasisOf(spans[s], Degree);
    const Eigen::MatrixXd products = sums[s].AllProducts();
    const auto first = static_cast<Eigen::Index>(s);
    equations.matrix.block(first, first, kBasis, kBasis) +=
        basis.transpose() * products.topLeftCorner(kBasis, kBasis) * basis;
    equations.right.segment<kBasis>(first) +=
        basis.transpose() * products.col(kBasis).head<kBasis>();
  }
}

EdgeEquations EquationsOf(const FitData& data,
                          const JointModel& model,
                          const JointState& state,
                          const SplineSpace& finer,
                          const Eigen::VectorXd& coefficients) {
  const std::vector<Span> spans = SpansOf(finer);
  const std::vector<Piece> pieces = PiecesOf(spans, finer.degree, coefficients);
  EdgeEquations equations{Eigen::MatrixXd::Zero(finer.size(), finer.size()),
                          Eigen::VectorXd::Zero(finer.size())};
  WithDegree(finer.degree, [&](auto degree) {
    for (size_t p = 0; p < data.photos.size(); ++p) {
      const PhotoData& photo = data.photos[p];
      AddEdge<degree()>(photo.upper, true, state.poses[p], spans, pieces, equations);
      if (!model.mirror[p]) continue;
      AddEdge<degree()>(photo.lower, false, state.poses[p], spans, pieces, equations);
    }
  });
  equations.matrix.diagonal().array() += kRidge * equations.matrix.diagonal().maxCoeff();
  equations.right += equations.matrix * coefficients;
  return equations;
}

// The curve through an edge if the jumps at its knots are noise of the likeliest size.
struct SmoothSpline {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;
  double effective = 0;  // coefficients that the points determine
};

// -2 log likelihood of the whitened values, each of variance 1 + variance * ratio (Laplace's
// evidence).
double Badness(const Eigen::VectorXd& values, const Eigen::VectorXd& ratio, double variance) {
  const Eigen::ArrayXd spread = 1 + variance * ratio.array();
  return (spread.log() + values.array().square() / spread).sum();
}

// The likeliest variance of the jumps, to 2 %: the band must not depend on where a grid happens to
// lie. 0 where none are seen.
double LikeliestVariance(const Eigen::VectorXd& values, const Eigen::VectorXd& ratio) {
  constexpr double kStep = 0.25, kFinest = 0.01;  // decades
  constexpr int kSteps = 60;
  // From jumps that hide in the noise of the best-seen direction on.
  const double first = std::log10(0.01 / ratio.maxCoeff());
  const auto badness = [&](double decade) { return Badness(values, ratio, std::pow(10, decade)); };
  double best = first, least = badness(first);
  for (int k = 1; k < kSteps; ++k) {
    const double decade = first + k * kStep, here = badness(decade);
    if (here < least) least = here, best = decade;
  }
  for (double step = kStep / 2; step > kFinest; step /= 2) {
    for (const double decade : {best - step, best + step}) {
      const double here = badness(decade);
      if (here < least) least = here, best = decade;
    }
  }
  return least < Badness(values, ratio, 0) ? std::pow(10, best) : 0;
}

// In the directions w in which both the edges' information and that of the jumps are diagonal:
// shares from 1, where the edges decide, to 0, where the jumps' smallness does. By singular values:
// their squares lie many more decades apart than an eigensolver resolves.
SmoothSpline Smooth(const EdgeEquations& equations, const Eigen::MatrixXd& jumps) {
  const Eigen::Index size = equations.right.size(), further = jumps.rows();
  const Eigen::LLT<Eigen::MatrixXd> llt(equations.matrix);
  const Eigen::MatrixXd white = llt.matrixL().solve(jumps.transpose());
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::FullPivHouseholderQRPreconditioner> svd(
      white, Eigen::ComputeFullU);
  const Eigen::MatrixXd w = llt.matrixU().solve(svd.matrixU());
  const Eigen::VectorXd values = w.transpose() * equations.right;
  constexpr double kRounding = 1e-15;  // of the largest; what lies below cannot be told from zero
  const Eigen::VectorXd& singular = svd.singularValues();
  const Eigen::VectorXd ratio =
      singular.cwiseMax(kRounding * singular[0]).cwiseAbs2().cwiseInverse();
  const double variance = LikeliestVariance(values.head(further), ratio);
  Eigen::VectorXd share = Eigen::VectorXd::Ones(size);
  share.head(further) = (variance * ratio).array() / (1 + variance * ratio.array());
  return {w * share.cwiseProduct(values), w * share.asDiagonal() * w.transpose(), share.sum()};
}

}  // namespace

FinerCurve RefineCurve(const FitData& data,
                       const JointModel& model,
                       const JointState& state,
                       const Eigen::MatrixXd& covariance) {
  const SplineSpace& space = *model.space;
  const SplineSpace finer = Refined(space);
  const Eigen::MatrixXd insertion = Insertion(space, finer);
  const Eigen::Vector2d end = EndInBlade(state.reaches[0], state.zeros[0]);
  const Eigen::VectorXd fitted = insertion * CoefficientsOf(space, state.shape.data(), end).value;
  const EdgeEquations equations = EquationsOf(data, model, state, finer, fitted);
  const SmoothSpline smooth = Smooth(equations, JumpsOf(finer));

  // Of the given covariance, what the edges leave the coefficients with poses held; the rest is the
  // poses' and stays.
  const Eigen::MatrixXd coarse = insertion.transpose() * equations.matrix * insertion;
  const Eigen::MatrixXd chosen =
      insertion * coarse.ldlt().solve(Eigen::MatrixXd(insertion.transpose()));
  // The distance from the smooth spline lies to one side: with this part of its square, 1.96 sigma
  // hold 95 % where it is two sigma.
  constexpr double kOneSided = 0.6;
  const Eigen::VectorXd apart = smooth.coefficients - fitted;
  const double length_mm = data.length_mm;
  FinerCurve result;
  result.curve = SplineInMm(finer, fitted, length_mm);
  result.covariance =
      insertion * covariance * insertion.transpose() +
      length_mm * length_mm * (smooth.covariance - chosen + kOneSided * apart * apart.transpose());
  result.effective_coefficients = smooth.effective;
  return result;
}

}  // namespace bladecurve
