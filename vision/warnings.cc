// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/warnings.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/scale/marker_paper.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Several transitions about as good, or one that changes to another line on the way: at its ends
// other things may cover an edge, but seldom so much of it.
bool IsAmbiguous(const LocatedEdge& edge) {
  constexpr double kSeveralTransitions = 0.5, kOtherLine = 0.3;  // of the edge
  return edge.ambiguity > kSeveralTransitions || LongestStray(edge) > kOtherLine;
}

// How far a blade is beyond white nobody knows; the further, the further out its edge seems to lie.
bool IsOverexposed(const LocatedBlade& blade) {
  constexpr double kShare = 0.3;     // of the edge
  constexpr double kKnownPx = 0.25;  // as where the other edge tells how sharp this one is
  const bool glares = blade.edge.overexposed > kShare && TypicalContrast(blade.edge) < 0;
  return glares && EdgeSigmaPx(blade) > kKnownPx;
}

// Whether a marker hid the distal end from scene finding, or a good part of the edge.
bool IsBesideMarker(const LocatedBlade& blade, const std::vector<SeenMarker>& markers) {
  constexpr double kShare = 0.1;  // of the edge
  return std::any_of(markers.begin(), markers.end(), [&](const SeenMarker& marker) {
    std::vector<cv::Point2f> paper;
    for (const Vector2d& corner : PaperOf(marker))
      paper.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()));
    const auto lies_on_it = [&](const Vector2d& point_px) {
      return cv::pointPolygonTest(paper, cv::Point2d(point_px.x(), point_px.y()), false) >= 0;
    };
    const auto hidden =
        std::count_if(blade.used.begin(), blade.used.end(), [&](const LocatedEdgePoint& point) {
          return lies_on_it(point.point_px);
        });
    return lies_on_it(blade.end.point_px) ||
           static_cast<double>(hidden) > kShare * static_cast<double>(blade.used.size());
  });
}

// Whether the edges pass the pivot less alike than those of scissors do. Where nobody knows the
// tilt of the view, that may part them as well, but then what is told of them is as far off: about
// a screw that is seen, it counts. Where somebody points to the pivot is not known as well.
bool PassUnlike(const Pivot& pivot, const ScaleResult& scale) {
  constexpr double kSlanted = 0.04;
  if (scale.sheet) return AreUnlike(pivot.asymmetry);
  if (pivot.source == "screw") return AreSuspect(pivot.asymmetry);
  return std::abs(pivot.asymmetry) > kSlanted;
}

}  // namespace

std::vector<std::string> WarningsOf(const Scene& scene,
                                    const ScaleResult& scale,
                                    const PlaneMap& map,
                                    const Pivot& pivot,
                                    const Blades& blades) {
  constexpr double kVaguePx = 1;
  std::vector<std::string> warnings = scene.warnings;
  warnings.insert(warnings.end(), map.warnings().begin(), map.warnings().end());
  const auto warn_if = [&](bool doubtful, const char* doubt) {
    if (doubtful) warnings.emplace_back(doubt);
  };
  warn_if(pivot.source == "geometry", "pivot_not_seen");
  warn_if(pivot.screw && IsHardlySeen(*pivot.screw), "pivot_faint");
  warn_if(pivot.off_screw, "pivot_off_screw");
  warn_if(PassUnlike(pivot, scale) || blades.edges_part, "blades_asymmetric");
  warn_if(pivot.bent, "blades_bent");  // neither edge confirms the other
  warn_if(blades.ends_contradict, "ends_unlike");
  warn_if(IsAmbiguous(blades.upper.edge), "upper_edge_ambiguous");
  warn_if(IsAmbiguous(blades.lower.edge), "lower_edge_ambiguous");
  warn_if(EdgeSigmaPx(blades.upper) > kVaguePx, "upper_edge_vague");
  warn_if(IsOverexposed(blades.upper), "upper_edge_overexposed");
  const bool beside_marker =
      IsBesideMarker(blades.upper, scale.markers) || IsBesideMarker(blades.lower, scale.markers);
  warn_if(beside_marker, "marker_near_blade");
  return warnings;
}

}  // namespace bladecurve
