// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/pivot/screw_ellipse.h"

namespace bladecurve {

// A square piece of a picture at another scale: picture = origin + scale * pixel. Beyond the
// picture its border repeats.
struct ScaledWindow {
  cv::Mat grey;  // CV_32F, encoded grey values
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  double scale = 1;
};
[[nodiscard]] ScaledWindow CutWindow(const cv::Mat& grey,
                                     const Eigen::Vector2d& center_px,
                                     double half_px,
                                     double scale);

// How strongly the rim of an ellipse would show in a window: first and second derivatives along its
// normals, summed over sectors and divided by what is usual in that direction around here. So a
// brushed or woven ground, which has strong derivatives across its grain everywhere, earns nothing
// by them.
class RimField {
 public:
  static constexpr int kSectors = 16;
  static constexpr int kSamples = 2 * kSectors;
  using SectorResponses = std::array<float, kSectors>;
  using CircleOffsets = std::array<cv::Point, kSamples>;  // of the samples from the centre

  // What is usual is taken from circles of typical_radius centred within half_range of `center`;
  // all in window pixels.
  RimField(const cv::Mat& window,
           const Eigen::Vector2d& center,
           double half_range,
           double typical_radius);

  // Squared response over its usual size, first and second derivative together, sector by sector.
  [[nodiscard]] SectorResponses Responses(const RimEllipse& rim) const;
  // 0 to 1: mean over the sectors of q^2 / (q^2 + k^2). One strong sector, a shank's edge say,
  // counts no more than 1/16.
  [[nodiscard]] double Score(const RimEllipse& rim) const;
  // The same less what goes on straight along the tangents: of a rim nothing does, of the edges of
  // a shank that happen to touch the ellipse all.
  [[nodiscard]] double ScoreWithoutTangents(const RimEllipse& rim) const;
  // The same for circles centred on the pixels of `centers` that lie in the largest disc there is
  // room for, as CV_32F, 0 elsewhere; whole-pixel accuracy.
  // One picture for each radius.
  [[nodiscard]] std::vector<cv::Mat> ScoreCircles(const cv::Rect& centers,
                                                  const std::vector<double>& radii) const;

 private:
  static constexpr int kDirections = kSamples / 2;  // opposite samples share theirs
  using Derivatives = Eigen::Array<float, 8, 1>;    // g_x, g_y, h_xx, h_xy, h_yy, three times 0

  // Derivatives along the normals at the two samples of a sector, for centres along a row.
  struct SectorRows {
    const float *edge, *next_edge, *line, *next_line;
  };

  using Planes = std::array<cv::Mat, 5>;  // g_x, g_y, h_xx, h_xy, h_yy within inner_

  void ResolveDirections(const Planes& planes);
  void MeasureUsual(const Eigen::Vector2d& center, double half_range, double radius);
  [[nodiscard]] SectorRows RowsOf(std::size_t sector,
                                  const CircleOffsets& offsets,
                                  const cv::Point& start) const;
  // Adds the scores of a sector and the opposite one to some rows of ScoreCircles' sums.
  void AddSector(std::size_t sector,
                 const CircleOffsets& offsets,
                 const cv::Rect& centers,
                 const cv::Range& rows,
                 cv::Mat* sums) const;
  // Responses with every place moved along its tangent by that share of the mean radius.
  [[nodiscard]] SectorResponses ResponsesAside(const RimEllipse& rim, double share) const;

  cv::Size size_;
  std::vector<Derivatives> derivatives_;
  cv::Rect inner_;                                // what the circles' rims may reach
  std::array<cv::Mat, kDirections> edge_, line_;  // there, along the directions of the samples
  std::array<float, kSectors / 2> edge_weight_{},
      line_weight_{};  // 1 / usual squared sum over a sector
};

}  // namespace bladecurve
