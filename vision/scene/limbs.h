// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/scene/silhouette.h"

namespace bladecurve {

// One blade as the contour shows it, in pixels of the mask. `inner` runs from the crotch to the
// tip: the cutting edge.
struct BladeContour {
  std::vector<Eigen::Vector2d> inner;
  std::vector<Eigen::Vector2d> outer;  // from the tip back to the concavity beside the pivot
  // The side of the blade's own shank on which the cutting edge lies, from the joint on.
  std::vector<Eigen::Vector2d> shank;
  Eigen::Vector2d tip{0, 0};
  double length = 0;  // crotch to tip
  double width = 0;   // half way along
  double taper = 0;   // width near the tip over width half way; a ring or a cut-off shank has > 1
  double bend = 0;    // sag of the inner side over its length
  double roughness = 0;  // rms of the inner side about a parabola, over its length
  bool cut_off = false;  // the end touches the frame
};

// Of 11 path-traced pairs whose handles the frame cuts, no blade's taper exceeds 0.71; shanks reach
// 0.94 both. A mask may lose one of a pair in part.
inline constexpr double kTapers = 0.85;

// A deep inlet of the contour: between the hull points `start` and `end`, deepest at `far` (indices
// into the contour).
struct Inlet {
  int start = 0, far = 0, end = 0;
  double depth = 0;
};

// A closed contour whose indices wrap round.
class Outline {
 public:
  explicit Outline(const std::vector<cv::Point>& contour) : points_(contour) {}

  [[nodiscard]] int size() const { return static_cast<int>(points_.size()); }
  [[nodiscard]] int Wrap(int i) const {
    const bool within = i >= 0 && i < size();  // mostly; a division takes longer than the rest
    return within ? i : ((i % size()) + size()) % size();
  }
  [[nodiscard]] Eigen::Vector2d At(int i) const {
    const cv::Point& p = points_[static_cast<std::size_t>(Wrap(i))];
    return {p.x, p.y};
  }
  // Points from index `from` on, forwards, up to and with `to`.
  [[nodiscard]] std::vector<Eigen::Vector2d> Arc(int from, int to) const {
    std::vector<Eigen::Vector2d> arc;
    const int steps = Wrap(to - from);
    arc.reserve(static_cast<std::size_t>(steps) + 1);
    for (int k = 0; k <= steps; ++k) arc.push_back(At(from + k));
    return arc;
  }

 private:
  const std::vector<cv::Point>& points_;
};

// The inlets that are too deep for ragged borders and the waists of rings, in contour order.
[[nodiscard]] std::vector<Inlet> FindInlets(const std::vector<cv::Point>& contour);

// Of those, so many at most.
[[nodiscard]] std::vector<Inlet> DeepestInlets(const std::vector<cv::Point>& contour,
                                               std::size_t most);

// Whether any of the points lies at the frame, or where something hides what goes on (`hidden`, may
// be empty).
[[nodiscard]] bool RunsOutOfSight(const std::vector<Eigen::Vector2d>& points,
                                  const cv::Mat& hidden,
                                  const cv::Size& size);

// Which way along an outline.
enum class Way { kOn, kBack };

// The end of the limb whose outline leaves a crotch, the point `from`, that way towards the other
// one, `to`: index of the point furthest from there, among those that lie ahead of it in
// `direction`, before the outline comes back to beside the other crotch; -1 if none does. What
// touches another limb is no part of it, however far ahead that reaches.
[[nodiscard]] int LimbEnd(
    const Outline& outline, int from, int to, Way way, const Eigen::Vector2d& direction);

// A piece of a line that lies in a silhouette, px along the line.
struct Run {
  double from = 0, to = 0;
  [[nodiscard]] double Length() const { return to - from; }
};

// The pieces of the line through `center` along the unit vector `across`, up to `reach` px to
// either side, to half a pixel.
[[nodiscard]] std::vector<Run> RunsAcross(const cv::Mat& filled,
                                          const Eigen::Vector2d& center,
                                          const Eigen::Vector2d& across,
                                          double reach);

// How far a limb may lie off the line from its root to its end, of its length: RunsAcross's reach.
inline constexpr double kLimbReach = 0.35;

// Width of the limb along the line from-to at the share `t` of its length, not of another one in
// reach.
[[nodiscard]] double WidthAcross(const cv::Mat& filled,
                                 const Eigen::Vector2d& from,
                                 const Eigen::Vector2d& to,
                                 double t);

// The blade on one side of the crotch. `inner` from crotch to tip, `outer` from the tip on to the
// next concavity.
[[nodiscard]] BladeContour DescribeBlade(const Silhouette& silhouette,
                                         std::vector<Eigen::Vector2d> inner,
                                         std::vector<Eigen::Vector2d> outer);

// The free end of a shank: a ring, or where the frame cuts it off.
struct ShankEnd {
  double length = 0;
  double flare = 0;  // widest near the end over the narrowest before; a ring has > 1.5
  bool cut_off = false;
};

// The shank between `shank_crotch` and its end at `point`. `arc`: the contour about it, which may
// begin as early as at the tip of the blade beside it.
[[nodiscard]] ShankEnd DescribeShank(const Silhouette& silhouette,
                                     const cv::Mat& hidden,
                                     const std::vector<Eigen::Vector2d>& arc,
                                     const Eigen::Vector2d& point,
                                     const Eigen::Vector2d& shank_crotch);

}  // namespace bladecurve
