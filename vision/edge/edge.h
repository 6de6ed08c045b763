// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/image/tone_curve.h"

namespace bladecurve {

// Roughly where an edge runs, as scene finding knows it: a few px, sometimes ten, off.
struct EdgeGuess {
  std::vector<Eigen::Vector2d> path_px;  // polyline in stored pixels, from crotch to distal end
  bool blade_on_left =
      true;              // side of the blade, walking along the path, y down: left is at (dy, -dx)
  double search_px = 6;  // how far across the path the edge may lie
};

struct EdgeOptions {
  std::optional<double>
      blur_px;  // known from another edge of the photograph; an overexposed blade hides its own
  // What print beside it shows: a shadow along the edge looks like more blur.
  double most_blur_px = std::numeric_limits<double>::infinity();
  bool may_be_softer = true;  // the bound is lifted where the blade's side is as soft
};

struct LocatedEdgePoint {
  Eigen::Vector2d point_px;  // from the pixels nearest to it alone: for fitting
  Eigen::Vector2d trend_px =
      Eigen::Vector2d::Zero();  // from some 50 px of edge about it: for showing
  Eigen::Vector2d normal;       // unit, out of the blade
  double sigma_px = 0;          // of this point by itself, along the normal
  double contrast = 0;          // background minus blade, linear light
  bool inlier = true;
};

struct LocatedEdge {
  std::vector<LocatedEdgePoint> points;  // ordered along the path; outliers stay, marked
  double blur_px =
      std::numeric_limits<double>::quiet_NaN();  // Gaussian sigma of the edge, pixel box apart
  // What it would be if nothing bounded it; NaN in a mixture of colours, whose edges are softer.
  double unbound_blur_px = std::numeric_limits<double>::quiet_NaN();
  bool traced = false;        // never located: as the scene's outline has it
  double overexposed = 0;     // share of its length beside which blade or background is plain white
  double correlation_px = 0;  // neighbours closer than this are not independent
  double common_sigma_px = 0;  // offset all points share: tone curve, ambiguity of bevel and shadow
  double rival_sigma_px = 0;   // the part of it that the rival makes
  double alone_sigma_px = 0;   // the part of it that the pair's other edge surely does not share
  double slope_sigma_px = 0;   // the part of it that light makes which slopes beside the edge
  double ambiguity =
      0;                // 0: one clear transition; towards 1: several about as good (bevel, shadow)
  double rival_px = 0;  // from the edge to the other transition, positive out of the blade
  std::vector<Eigen::Vector2d> rival_path_px;  // the other transition, to a few px
};

// Medians over the points that count: background minus blade, linear light; sigma_px.
[[nodiscard]] double TypicalContrast(const LocatedEdge& edge);
[[nodiscard]] double TypicalSigma(const std::vector<LocatedEdgePoint>& points);
// The same with what they share counted.
[[nodiscard]] double TotalSigma(const LocatedEdge& edge);

// Its blur, or what is usual where none was measured.
[[nodiscard]] double BlurOr(const LocatedEdge& edge, double usual_px);

// Of the point whose trend lies nearest to a place, in `points`.
[[nodiscard]] std::size_t NearestPoint(const LocatedEdge& edge, const Eigen::Vector2d& place_px);
// How far from that trend the place is.
[[nodiscard]] double DistanceTo(const LocatedEdge& edge, const Eigen::Vector2d& place_px);

// The longest stretch of points that do not count, as a share of the edge.
[[nodiscard]] double LongestStray(const LocatedEdge& edge);

// Locates the silhouette of the blade along `guess`, in linear light, by maximum likelihood on raw
// pixels in a narrow band. Of several transitions (bevel line, glint, shadow border) it takes the
// blade's outer border. Throws Refused{kLowContrast, kBlurred, kEdgeTooShort}.
[[nodiscard]] LocatedEdge LocateEdge(const cv::Mat& grey,
                                     const ToneCurve& tone,
                                     const EdgeGuess& guess,
                                     const EdgeOptions& options = {});

// The same beyond the line of a bevel, so near that its border makes no step of its own: about
// `width_px` further out, the line being modelled as what it is. Two steps look like one that is
// softer unless options.blur_px is known.
[[nodiscard]] LocatedEdge LocateEdgeBeyond(const LocatedEdge& line,
                                           double width_px,
                                           bool blade_on_left,
                                           const cv::Mat& grey,
                                           const ToneCurve& tone,
                                           const EdgeOptions& options = {});

// How a shadow beside a blade compares with it.
enum class Shadow { kDarker, kBrighter };

// The same where a shadow begins at the blade's border, so that light falls there, going outwards,
// or rises by less than at the shadow's border, sharply or slowly: along the clearest such step.
[[nodiscard]] LocatedEdge LocateEdgeInShadow(const cv::Mat& grey,
                                             const ToneCurve& tone,
                                             const EdgeGuess& guess,
                                             Shadow shadow,
                                             const EdgeOptions& options = {});

}  // namespace bladecurve
