// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/square_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "vision/blurred_step.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr int kSides = 4;
// Offset along the normal, px, and angle of each side, then:
enum Unknown { kPaper = 2 * kSides, kInk, kBlur, kLampX, kLampY, kUnknowns };
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

constexpr double kComplete = 6;  // sigmas from a step to where it lacks less than 1e-9

struct SquarePixel {
  Vector2d place_px;
  double light;  // linear, 0 to 1
  int piece;     // of the square's outline
};

// A side as the fit has moved it.
struct MovedSide {
  MovedSide(const StraightEdge& from, double offset, double angle)
      : side(from), offset_px(offset), cosine(std::cos(angle)), sine(std::sin(angle)) {}

  const StraightEdge& side;
  double offset_px, cosine, sine;
};

// Distance of a point into the square from a side, and its place along it.
struct FromSide {
  double inwards = 0, along = 0;
};

FromSide Measure(const MovedSide& moved, const Vector2d& place) {
  const StraightEdge& side = moved.side;
  const Vector2d from = place - side.middle_px;
  const double along = side.direction.dot(from);
  const double x = 2 * along / side.length_px, bow = side.bow_px * (1 - x * x);
  const double across = side.normal().dot(from) - bow;
  return {across * moved.cosine - along * moved.sine - moved.offset_px, along};
}

std::array<MovedSide, kSides> MovedSides(const SquareSides& sides, const Unknowns& at) {
  return {MovedSide(sides[0], at[0], at[1]),
          MovedSide(sides[1], at[2], at[3]),
          MovedSide(sides[2], at[4], at[5]),
          MovedSide(sides[3], at[6], at[7])};
}

Vector2d MiddleOf(const SquareSides& sides) {
  return 0.25 * (sides[0].middle_px + sides[1].middle_px + sides[2].middle_px + sides[3].middle_px);
}

// The light of a pixel: paper and ink, lit by a lamp that may fall off. The pixel's box counts as a
// Gaussian of its variance, which a product over sides at right angles needs to hold at corners;
// what its shape adds is even on both sides of an edge and moves none.
class SquareModel {
 public:
  SquareModel(const SquareSides& sides, const Unknowns& at)
      : sides_(MovedSides(sides, at)),
        at_(at),
        middle_(MiddleOf(sides)),
        per_px_(1 / sides[0].length_px),
        sigma_(std::sqrt(TotalBlurVariance(at[kBlur]))) {}

  // Light minus model and the model's derivatives. Light beyond white is stored as white.
  double Residual(const SquarePixel& pixel, Unknowns* gradient) const {
    const Steps steps = StepsAt(pixel.place_px);
    const double inside = Product(steps.value, kSides);
    const Vector2d place = (pixel.place_px - middle_) * per_px_;
    const double lamp = 1 + at_[kLampX] * place.x() + at_[kLampY] * place.y();
    const double depth = at_[kInk] - at_[kPaper], light = at_[kPaper] + depth * inside;
    gradient->setZero();
    if (lamp * light >= 1) return pixel.light - 1;
    for (size_t k = 0; k < kSides; ++k) {
      const double rise = lamp * depth * Product(steps.value, k);
      const auto offset = static_cast<Eigen::Index>(2 * k);
      (*gradient)[offset] = -rise * steps.slope[k];
      (*gradient)[offset + 1] = (*gradient)[offset] * steps.along[k];
      (*gradient)[kBlur] += rise * steps.softening[k];
    }
    (*gradient)[kPaper] = lamp * (1 - inside);
    (*gradient)[kInk] = lamp * inside;
    (*gradient)[kLampX] = light * place.x();
    (*gradient)[kLampY] = light * place.y();
    return pixel.light - lamp * light;
  }

 private:
  // The step of each side at a place: 1 deep inside; per px of distance; per px of blur.
  struct Steps {
    std::array<double, kSides> value{}, slope{}, softening{}, along{};
  };

  [[nodiscard]] Steps StepsAt(const Vector2d& place_px) const {
    Steps steps;
    for (size_t k = 0; k < kSides; ++k) {
      const FromSide from = Measure(sides_[k], place_px);
      const double z = from.inwards / sigma_;
      steps.along[k] = from.along;
      steps.value[k] = 1;
      if (z > kComplete) continue;
      steps.value[k] = 0.5 * std::erfc(-z / std::numbers::sqrt2);
      steps.slope[k] = std::exp(-0.5 * z * z) / (std::sqrt(2 * std::numbers::pi) * sigma_);
      steps.softening[k] = -steps.slope[k] * z * at_[kBlur] / sigma_;
    }
    return steps;
  }

  // Of all values but one.
  static double Product(const std::array<double, kSides>& values, size_t without) {
    double product = 1;
    for (size_t i = 0; i < kSides; ++i) product *= i == without ? 1 : values[i];
    return product;
  }

  std::array<MovedSide, kSides> sides_;
  const Unknowns& at_;
  Vector2d middle_;
  double per_px_, sigma_;
};

// Pieces of the outline some 8 px long: within them the noise may be correlated.
int PieceOf(size_t side, double along) {
  constexpr double kPiecePx = 8;
  constexpr int kMostPieces = 1000;  // of a side
  return static_cast<int>(side) * kMostPieces + static_cast<int>(std::floor(along / kPiecePx)) +
         kMostPieces / 2;
}

std::vector<SquarePixel> PixelsAbout(const cv::Mat& grey,
                                     const ToneCurve& tone,
                                     const SquareSides& sides,
                                     double reach_px) {
  const Vector2d middle = MiddleOf(sides);
  const std::array<MovedSide, kSides> unmoved = MovedSides(sides, Unknowns::Zero());
  double radius = 0;
  for (const StraightEdge& side : sides)
    radius = std::max(radius, std::hypot((side.middle_px - middle).norm(), side.length_px));
  radius += 2 * reach_px;
  const cv::Rect picture(0, 0, grey.cols, grey.rows);
  const cv::Rect box = cv::Rect(static_cast<int>(std::floor(middle.x() - radius)),
                                static_cast<int>(std::floor(middle.y() - radius)),
                                static_cast<int>(2 * radius) + 2,
                                static_cast<int>(2 * radius) + 2) &
                       picture;
  std::vector<SquarePixel> pixels;
  for (int y = box.y; y < box.y + box.height; ++y) {
    for (int x = box.x; x < box.x + box.width; ++x) {
      const Vector2d place(x, y);
      FromSide nearest{radius, 0};
      size_t side = 0;
      for (size_t k = 0; k < kSides; ++k) {
        const FromSide from = Measure(unmoved[k], place);
        if (from.inwards < nearest.inwards) nearest = from, side = k;
      }
      if (std::abs(nearest.inwards) > reach_px) continue;
      pixels.push_back({place, tone.linear[grey.at<uchar>(y, x)], PieceOf(side, nearest.along)});
    }
  }
  return pixels;
}

struct Equations {
  Information information = Information::Zero();
  Unknowns gradient = Unknowns::Zero();
  double sum_square = 0;
};

Equations Accumulate(const std::vector<SquarePixel>& pixels, const SquareModel& model) {
  Equations equations;
  Unknowns derivative;
  for (const SquarePixel& pixel : pixels) {
    const double residual = model.Residual(pixel, &derivative);
    equations.information.selfadjointView<Eigen::Lower>().rankUpdate(derivative);
    equations.gradient += residual * derivative;
    equations.sum_square += residual * residual;
  }
  equations.information = equations.information.selfadjointView<Eigen::Lower>();
  return equations;
}

// Sandwich estimate with the pieces of the outline as clusters, as for a single edge.
Information ClusteredCovariance(const std::vector<SquarePixel>& pixels,
                                const SquareModel& model,
                                const Information& information) {
  std::map<int, Unknowns> scores;
  Unknowns derivative;
  for (const SquarePixel& pixel : pixels) {
    const double residual = model.Residual(pixel, &derivative);
    scores.try_emplace(pixel.piece, Unknowns::Zero()).first->second += residual * derivative;
  }
  Information middle = Information::Zero();
  for (const auto& [piece, score] : scores) middle += score * score.transpose();
  const Information inverse = information.ldlt().solve(Information::Identity());
  const auto pieces = static_cast<double>(scores.size());
  // A piece feeds the two unknowns of its side and those of all.
  const double correction = pieces / std::max(1.0, pieces - static_cast<double>(kUnknowns));
  return correction * inverse * middle * inverse;
}

// The sides as they are; paper and ink by what is brighter or darker than their difference alone.
Unknowns StartFrom(const SquareSides& sides, const std::vector<SquarePixel>& pixels) {
  Unknowns start = Unknowns::Zero();
  for (const StraightEdge& side : sides) {
    start[kInk] += side.contrast / kSides;
    start[kBlur] += side.blur_px / kSides;
  }
  Unknowns unused;
  double sum = 0;
  const SquareModel model(sides, start);
  for (const SquarePixel& pixel : pixels) sum += model.Residual(pixel, &unused);
  const double paper = sum / static_cast<double>(pixels.size());
  start[kPaper] += paper;
  start[kInk] += paper;
  return start;
}

// The sides are good to a tenth of a pixel before; a square that moves them further is none.
bool Plausible(const Unknowns& at, const SquareSides& sides) {
  constexpr double kMostPx = 0.5;
  bool near = at.allFinite() && at[kBlur] >= kMinBlurPx && at[kBlur] <= kMaxBlurPx;
  for (int k = 0; k < kSides; ++k) {
    const double turned = std::abs(at[2 * k + 1]) * sides[static_cast<size_t>(k)].length_px / 2;
    near = near && std::abs(at[2 * k]) + turned < kMostPx;
  }
  return near;
}

// Gauss-Newton. The start is near enough that it needs no damping.
bool Minimise(const std::vector<SquarePixel>& pixels, const SquareSides& sides, Unknowns* at) {
  constexpr int kMostSteps = 12;
  constexpr double kDonePx = 1e-5;
  for (int step = 0; step < kMostSteps; ++step) {
    const Equations now = Accumulate(pixels, SquareModel(sides, *at));
    const Unknowns change = now.information.ldlt().solve(now.gradient);
    *at += change;
    if (!Plausible(*at, sides)) return false;
    if (change.head<2 * kSides>().cwiseAbs().maxCoeff() < kDonePx) return true;
  }
  return false;
}

StraightEdge Moved(const StraightEdge& side, double offset, double angle) {
  StraightEdge moved = side;
  moved.direction = std::cos(angle) * side.direction + std::sin(angle) * side.normal();
  moved.middle_px = side.middle_px + offset * moved.normal();
  return moved;
}

}  // namespace

std::optional<SquareSides> FitSquare(const cv::Mat& grey,
                                     const ToneCurve& tone,
                                     const SquareSides& sides,
                                     double free_px) {
  constexpr size_t kFewestPixels = 10 * kUnknowns;
  constexpr double kWhole = 0.99;  // used of a side; less is covered
  for (const StraightEdge& side : sides) {
    if (side.used < kWhole) return std::nullopt;
  }
  const std::vector<SquarePixel> pixels = PixelsAbout(grey, tone, sides, free_px);
  if (pixels.size() < kFewestPixels) return std::nullopt;
  Unknowns at = StartFrom(sides, pixels);
  if (!Minimise(pixels, sides, &at)) return std::nullopt;
  const SquareModel model(sides, at);
  const Equations there = Accumulate(pixels, model);
  const Information covariance = ClusteredCovariance(pixels, model, there.information);
  SquareSides fitted;
  for (int k = 0; k < kSides; ++k) {
    const auto i = static_cast<size_t>(k);
    fitted[i] = Moved(sides[i], at[2 * k], at[2 * k + 1]);
    fitted[i].covariance = covariance.block<2, 2>(2 * k, 2 * k);
    fitted[i].blur_px = at[kBlur];
    fitted[i].contrast = at[kInk] - at[kPaper];
    fitted[i].bright = at[kPaper];
    fitted[i].noise = std::sqrt(there.sum_square / static_cast<double>(pixels.size() - kUnknowns));
  }
  return fitted;
}

}  // namespace bladecurve
