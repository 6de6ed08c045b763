// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vision/edge/edge.h"
#include "vision/scene/scene.h"
#include "vision/scissors/blade_view.h"
#include "vision/scissors/distal_end.h"

namespace bladecurve {

// A cutting edge as located, and where it rounds off into the tip; stored pixels.
struct LocatedBlade {
  bool on_left = true;
  LocatedEdge edge;
  DistalEnd end;
  std::vector<DistalEnd> rival_ends;   // where it may lie instead
  std::vector<LocatedEdgePoint> used;  // inliers between the crotch and the distal end
  std::string moved = {};              // to where, if the edge was located anew; else empty
};

// Both blades of a pair, trimmed.
struct Blades {
  LocatedBlade upper, lower;
  bool ends_contradict = false;  // one lies further from the pivot than the other, beyond doubt
  bool edges_part = false;       // mirror images but over more than a third of an edge
};

// Finds the distal end and keeps what lies between the crotch, where the other blade's edge is
// near, and that end. Where the edge is lost before its end and no arc of the tip tells where that
// is, it is uncertain by a fifth of the way on. Throws Refused{kEdgeTooShort}.
// `beyond`: where the edge is known to go on towards the tip although it is not seen.
void TrimToFree(const BladeView& view,
                LocatedBlade* blade,
                const std::vector<Eigen::Vector2d>& beyond = {});

// The same for an end that is known. Throws Refused{kEdgeTooShort}.
void KeepFree(const Scene& scene, LocatedBlade* blade);

// Drops what lies before the place where the two edges cross, as they are located: there the blades
// cover each other, which the silhouette does not tell where a shadow fills their crotch. Not where
// less than half of an edge would be left.
void KeepBeyondCrossing(Blades* blades);

// How many of the edge's inliers lie before a place, up to the first beyond it: the index of an end
// there. `along` points towards the tip.
[[nodiscard]] std::size_t InliersBefore(const LocatedEdge& edge,
                                        const Eigen::Vector2d& place_px,
                                        const Eigen::Vector2d& along);

// Moves the distal end across the edge, onto the course of its points: the arc of the tip tells how
// far the edge goes, not where it lies. Sets the end's across_sigma_px.
void PlaceEndOnCourse(LocatedBlade* blade);

// Of the distal end, but for an offset of standard uncertainty `shared_px` that all points and both
// ends share: across the edge like a point of it, along the edge as found. px^2.
[[nodiscard]] Eigen::Matrix2d EndCovariance(const LocatedBlade& blade, double shared_px);

// The points used, without their uncertainties.
[[nodiscard]] std::vector<Eigen::Vector2d> PointsOf(const LocatedBlade& blade);

// NaN for no points.
[[nodiscard]] double MedianSigma(const std::vector<LocatedEdgePoint>& points);
// The same of a blade's edge, what its points have in common counted.
[[nodiscard]] double EdgeSigmaPx(const LocatedBlade& blade);

// The lower edge's points as the fit is to take them, which knows one offset, of both edges, as
// uncertain as the upper one's. Where more is uncertain about either edge than both may share, the
// lower one's points become so uncertain that their mean is as doubtful as the edges' difference.
[[nodiscard]] std::vector<LocatedEdgePoint> DoubtedAlone(const LocatedBlade& lower,
                                                         const LocatedBlade& upper);

}  // namespace bladecurve
