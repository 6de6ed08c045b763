// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/image/block_means.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

constexpr double kBlurPx =
    1.0;  // smooths noise; a seventh of the smallest rim, so its curvature survives
constexpr float kHalfScore = 2.5F;  // a sector this many times its usual response counts one half
// Derivatives a flat 8-bit picture has by rounding alone: no rim fainter than that is believed.
constexpr float kLeastEdge = 0.25F;
constexpr float kLeastLine = 0.15F;
constexpr int kUsualGrid = 6;  // (2 n + 1)^2 places tell what is usual

// Unit vectors of all samples, anticlockwise as x and y go.
std::array<Eigen::Vector2d, RimField::kSamples> MakeSampleDirections() {
  std::array<Eigen::Vector2d, RimField::kSamples> directions;
  for (std::size_t sample = 0; sample < directions.size(); ++sample) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(sample) / RimField::kSamples;
    directions[sample] = {std::cos(angle), std::sin(angle)};
  }
  return directions;
}

const Eigen::Vector2d& SampleDirection(int sample) {
  static const std::array<Eigen::Vector2d, RimField::kSamples> directions = MakeSampleDirections();
  return directions[static_cast<std::size_t>(sample)];
}

RimField::CircleOffsets OffsetsOf(double radius) {
  RimField::CircleOffsets offsets;
  for (int sample = 0; sample < RimField::kSamples; ++sample) {
    const Eigen::Vector2d offset = radius * SampleDirection(sample);
    offsets[static_cast<std::size_t>(sample)] = {static_cast<int>(std::lround(offset.x())),
                                                 static_cast<int>(std::lround(offset.y()))};
  }
  return offsets;
}

constexpr float kHalfScoreSquared = kHalfScore * kHalfScore;

float SectorScore(float q_squared) { return q_squared / (q_squared + kHalfScoreSquared); }

// The sum of two, with one division.
float SectorScores(float p_squared, float q_squared) {
  const float p = p_squared + kHalfScoreSquared, q = q_squared + kHalfScoreSquared;
  return (p_squared * q + q_squared * p) / (p * q);
}

float MedianOf(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The weight 1/usual^2 of a sector's summed response.
float WeightFrom(std::vector<float>& absolute_sums, float least) {
  const float usual = static_cast<float>(kSigmaPerMedian) * MedianOf(absolute_sums);
  const float floor = 2 * least;
  return 1.F / std::max(usual * usual, floor * floor);
}

// The largest circle whose rim is sought, over the typical one, and what rounding may add.
constexpr double kLargestCircle = 1.5, kRoundingPx = 6;

cv::Rect WithinReach(const Eigen::Vector2d& center, double reach) {
  const int side = 2 * static_cast<int>(reach + kRoundingPx) + 1;
  return {
      static_cast<int>(center.x()) - side / 2, static_cast<int>(center.y()) - side / 2, side, side};
}

// Between the four pixels about a point; beyond the grid its border repeats.
template <typename Value>
Value Interpolated(const std::vector<Value>& grid,
                   const cv::Size& size,
                   const Eigen::Vector2d& at) {
  const float x =
      std::clamp(static_cast<float>(at.x()), 0.F, static_cast<float>(size.width) - 1.01F);
  const float y =
      std::clamp(static_cast<float>(at.y()), 0.F, static_cast<float>(size.height) - 1.01F);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const float right = x - static_cast<float>(column), down = y - static_cast<float>(row);
  const Value* upper = grid.data() + static_cast<std::ptrdiff_t>(row) * size.width + column;
  const Value* lower = upper + size.width;
  return (1 - down) * ((1 - right) * upper[0] + right * upper[1]) +
         down * ((1 - right) * lower[0] + right * lower[1]);
}

// Columns of a row that lie in the largest disc within a rectangle.
cv::Range RowOfDisc(int row, const cv::Size& size) {
  const double radius = 0.5 * std::min(size.width, size.height);
  const double below = row + 0.5 - 0.5 * size.height;
  const double half = std::sqrt(std::max(0.0, radius * radius - below * below));
  return {static_cast<int>(std::floor(0.5 * size.width - half)),
          static_cast<int>(std::ceil(0.5 * size.width + half))};
}

cv::Mat Derivative(const cv::Mat& image, int dx, int dy) {
  cv::Mat result;
  cv::Sobel(image, result, CV_32F, dx, dy, 3, 1.0 / 8.0, 0, cv::BORDER_REPLICATE);
  return result;
}

}  // namespace

ScaledWindow CutWindow(const cv::Mat& grey,
                       const Eigen::Vector2d& center_px,
                       double half_px,
                       double scale) {
  const int side = 2 * static_cast<int>(std::ceil(half_px)) + 1;
  const cv::Rect wanted(static_cast<int>(std::lround(center_px.x())) - side / 2,
                        static_cast<int>(std::lround(center_px.y())) - side / 2,
                        side,
                        side);
  const cv::Rect inside = wanted & cv::Rect(0, 0, grey.cols, grey.rows);
  ScaledWindow window;
  if (inside.empty()) return window;
  cv::Mat piece;
  cv::copyMakeBorder(grey(inside),
                     piece,
                     inside.y - wanted.y,
                     wanted.br().y - inside.br().y,
                     inside.x - wanted.x,
                     wanted.br().x - inside.br().x,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  // Whole factors first: what remains has a fraction of the pixels, and the same mean over them.
  const int whole = std::max(1, static_cast<int>(scale));
  window.grey = BlockMeans(piece, whole);
  window.scale = scale;
  // cv::resize keeps the outer borders of the pictures together, so pixel centres shift by half a
  // pixel of each.
  window.origin = Eigen::Vector2d(wanted.x, wanted.y).array() + 0.5 * (scale - 1);
  const double rest = scale / whole;
  if (rest != 1) {
    const int method = rest > 1 ? cv::INTER_AREA : cv::INTER_CUBIC;
    cv::Mat resized;
    cv::resize(window.grey, resized, cv::Size(), 1 / rest, 1 / rest, method);
    window.grey = resized;
  }
  return window;
}

RimField::RimField(const cv::Mat& window,
                   const Eigen::Vector2d& center,
                   double half_range,
                   double typical_radius)
    : size_(window.size()) {
  cv::Mat smooth;
  cv::GaussianBlur(window, smooth, cv::Size(7, 7), kBlurPx, kBlurPx, cv::BORDER_REPLICATE);
  const cv::Mat gx = Derivative(smooth, 1, 0), gy = Derivative(smooth, 0, 1);
  const cv::Mat hxx = Derivative(gx, 1, 0), hxy = Derivative(gx, 0, 1), hyy = Derivative(gy, 0, 1);
  derivatives_.resize(gx.total());
  const auto *x = gx.ptr<float>(), *y = gy.ptr<float>();
  const auto *xx = hxx.ptr<float>(), *xy = hxy.ptr<float>(), *yy = hyy.ptr<float>();
  for (std::size_t i = 0; i < derivatives_.size(); ++i) {
    derivatives_[i] << x[i], y[i], xx[i], xy[i], yy[i], 0, 0, 0;
  }
  inner_ =
      WithinReach(center, half_range + kLargestCircle * typical_radius) & cv::Rect({0, 0}, size_);
  Planes planes{gx, gy, hxx, hxy, hyy};
  for (cv::Mat& plane : planes) plane = plane(inner_).clone();
  ResolveDirections(planes);
  MeasureUsual(center, half_range, typical_radius);
}

void RimField::ResolveDirections(const Planes& planes) {
  const float *x = planes[0].ptr<float>(), *y = planes[1].ptr<float>();
  const float *xx = planes[2].ptr<float>(), *xy = planes[3].ptr<float>(),
              *yy = planes[4].ptr<float>();
  const std::size_t count = planes[0].total();
  for (std::size_t direction = 0; direction < kDirections; ++direction) {
    const Eigen::Vector2f n = SampleDirection(static_cast<int>(direction)).cast<float>();
    const float nxx = n.x() * n.x(), nxy = 2 * n.x() * n.y(), nyy = n.y() * n.y();
    edge_[direction].create(inner_.size(), CV_32F);
    line_[direction].create(inner_.size(), CV_32F);
    auto* edge = edge_[direction].ptr<float>();
    for (std::size_t i = 0; i < count; ++i) edge[i] = n.x() * x[i] + n.y() * y[i];
    auto* line = line_[direction].ptr<float>();
    for (std::size_t i = 0; i < count; ++i) line[i] = nxx * xx[i] + nxy * xy[i] + nyy * yy[i];
  }
}

void RimField::MeasureUsual(const Eigen::Vector2d& center, double half_range, double radius) {
  std::array<std::vector<float>, kSectors / 2> edge, line;
  const CircleOffsets offsets = OffsetsOf(radius);
  for (int row = -kUsualGrid; row <= kUsualGrid; ++row) {
    for (int column = -kUsualGrid; column <= kUsualGrid; ++column) {
      const double step = half_range / kUsualGrid;
      const cv::Point place = cv::Point(static_cast<int>(center.x() + step * column + 0.5),
                                        static_cast<int>(center.y() + step * row + 0.5)) -
                              inner_.tl();
      for (std::size_t sector = 0; sector < kSectors; ++sector) {
        const std::size_t first = 2 * sector, second = first + 1;
        const cv::Point p = place + offsets[first], q = place + offsets[second];
        const std::size_t d = first % kDirections;
        edge[sector % (kSectors / 2)].push_back(
            std::abs(edge_[d].at<float>(p) + edge_[d + 1].at<float>(q)));
        line[sector % (kSectors / 2)].push_back(
            std::abs(line_[d].at<float>(p) + line_[d + 1].at<float>(q)));
      }
    }
  }
  for (std::size_t sector = 0; sector < edge.size(); ++sector) {
    edge_weight_[sector] = WeightFrom(edge[sector], kLeastEdge);
    line_weight_[sector] = WeightFrom(line[sector], kLeastLine);
  }
}

RimField::SectorResponses RimField::Responses(const RimEllipse& rim) const {
  return ResponsesAside(rim, 0);
}

RimField::SectorResponses RimField::ResponsesAside(const RimEllipse& rim, double share) const {
  SectorResponses responses{};
  const Eigen::Matrix2d inverse_shape = rim.shape.inverse();
  for (int sector = 0; sector < kSectors; ++sector) {
    float edge = 0, line = 0;
    for (int sample = 2 * sector; sample < 2 * sector + 2; ++sample) {
      const Eigen::Vector2d& u = SampleDirection(sample);
      const Eigen::Vector2f n = (inverse_shape * u).cast<float>();
      const float scale = 1 / n.squaredNorm();
      const Eigen::Vector2d tangent(-u.y(), u.x());
      const Derivatives d = Interpolated(derivatives_, size_, rim.PointAt(u + share * tangent));
      edge += std::sqrt(scale) * (n.x() * d[0] + n.y() * d[1]);
      line += scale * (n.x() * n.x() * d[2] + 2 * n.x() * n.y() * d[3] + n.y() * n.y() * d[4]);
    }
    const auto half_sector = static_cast<std::size_t>(sector % (kSectors / 2));
    responses[static_cast<std::size_t>(sector)] =
        edge * edge * edge_weight_[half_sector] + line * line * line_weight_[half_sector];
  }
  return responses;
}

double RimField::Score(const RimEllipse& rim) const {
  double sum = 0;
  for (const float q_squared : Responses(rim)) sum += SectorScore(q_squared);
  return sum / kSectors;
}

double RimField::ScoreWithoutTangents(const RimEllipse& rim) const {
  // There the tangent is 0.22 radii off the rim: clear of it, but not yet elsewhere.
  constexpr double kAside = 0.7;
  const SectorResponses own = Responses(rim);
  const SectorResponses after = ResponsesAside(rim, kAside), before = ResponsesAside(rim, -kAside);
  double sum = 0;
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    sum += SectorScore(std::max(0.F, own[sector] - std::max(after[sector], before[sector])));
  }
  return sum / kSectors;
}

RimField::SectorRows RimField::RowsOf(std::size_t sector,
                                      const CircleOffsets& offsets,
                                      const cv::Point& start) const {
  const std::size_t first = 2 * sector, d = first % kDirections;
  const cv::Point p = start + offsets[first], q = start + offsets[first + 1];
  return {edge_[d].ptr<float>(p.y) + p.x,
          edge_[d + 1].ptr<float>(q.y) + q.x,
          line_[d].ptr<float>(p.y) + p.x,
          line_[d + 1].ptr<float>(q.y) + q.x};
}

void RimField::AddSector(std::size_t sector,
                         const CircleOffsets& offsets,
                         const cv::Rect& centers,
                         const cv::Range& rows,
                         cv::Mat* sums) const {
  const float edge_weight = edge_weight_[sector], line_weight = line_weight_[sector];
  for (int row = rows.start; row < rows.end; ++row) {
    const cv::Range within = RowOfDisc(row, centers.size());
    const cv::Point start = cv::Point(centers.x + within.start, centers.y + row) - inner_.tl();
    const SectorRows a = RowsOf(sector, offsets, start);
    const SectorRows b = RowsOf(sector + kSectors / 2, offsets, start);  // opposite
    const int count = within.size();
    float* const out = sums->ptr<float>(row) + within.start;
    for (int i = 0; i < count; ++i) {
      const float edge = a.edge[i] + a.next_edge[i], line = a.line[i] + a.next_line[i];
      const float far_edge = b.edge[i] + b.next_edge[i], far_line = b.line[i] + b.next_line[i];
      out[i] += SectorScores(edge * edge * edge_weight + line * line * line_weight,
                             far_edge * far_edge * edge_weight + far_line * far_line * line_weight);
    }
  }
}

std::vector<cv::Mat> RimField::ScoreCircles(const cv::Rect& centers,
                                            const std::vector<double>& radii) const {
  constexpr int kRowsAtOnce = 16;  // what one sector of these looks at stays in the cache
  std::vector<CircleOffsets> offsets;
  std::vector<cv::Mat> scores;
  for (const double radius : radii) {
    offsets.push_back(OffsetsOf(radius));
    scores.push_back(cv::Mat::zeros(centers.size(), CV_32F));
  }
  for (int first = 0; first < centers.height; first += kRowsAtOnce) {
    const cv::Range rows(first, std::min(first + kRowsAtOnce, centers.height));
    for (std::size_t sector = 0; sector < kSectors / 2; ++sector) {
      for (std::size_t i = 0; i < radii.size(); ++i)
        AddSector(sector, offsets[i], centers, rows, &scores[i]);
    }
  }
  for (cv::Mat& score : scores) score *= 1.0 / kSectors;
  return scores;
}

}  // namespace bladecurve
