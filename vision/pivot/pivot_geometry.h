// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/scale/scale.h"
#include "vision/scene/scene.h"

namespace bladecurve {

// The two cutting edges, from the crotch to the distal end. Traced: one of them was never located,
// and is as the scene's outline has it.
struct EdgePair {
  std::vector<Eigen::Vector2d> left_px, right_px;
  bool traced = false;
};

// The same as seen from straight above, if markers say how the camera stands: only so do the edges
// of two blades mirror each other. `about_px` stays where it is, lengths there as they are.
[[nodiscard]] EdgePair SeenFromAbove(const ScaleResult& scale,
                                     EdgePair edges,
                                     const Eigen::Vector2d& about_px);

// The line about which the two edges mirror each other: a point, where they cross if they do, and a
// unit direction towards the tips. Of the edges only the proximal 60 % count, before a curved blade
// bends away.
struct EdgeMirror {
  Eigen::Vector2d point_px, direction;
  double sine = 0;       // of the angle between each edge and the line; 0: nearly parallel
  double length_px = 0;  // from the point to the blades' ends, mean; negative: it lies beyond them
};
[[nodiscard]] EdgeMirror MirrorOf(const EdgePair& edges);

// How differently the two edges pass by the pivot: the left one's distance from it less the right
// one's, over the length of the blades. Blades in one plane pass alike (within 0.1); angled ones
// (Lister, Potts) do not.
[[nodiscard]] double EdgeAsymmetry(const EdgePair& edges, const Eigen::Vector2d& pivot_px);

// Whether the edges of two blades in one plane pass the pivot so differently that one of them is in
// doubt (far unlike: that one of them, or the pivot, is wrong), or that it is worth a look whether
// one is, or as nearly alike as those of rendered scissors. Between the two nothing is said.
[[nodiscard]] bool AreFarUnlike(double asymmetry);
[[nodiscard]] bool AreUnlike(double asymmetry);
[[nodiscard]] bool AreSuspect(double asymmetry);
[[nodiscard]] bool AreAlike(double asymmetry);

// Whether they pass it so differently that no view of blades in one plane accounts for it.
[[nodiscard]] bool LieInNoPlane(double asymmetry);

// Whether both blades are bent to one side, as those of "curved" scissors may be: what their edges
// differ by, about the line between their ends, is a parabola from the ends to about the heels. One
// that is something else's border parts from its place otherwise. Outlines show no bend.
[[nodiscard]] bool AreBentToOneSide(const EdgePair& edges, const Eigen::Vector2d& pivot_px);

// How unlike the two edges are in shape: root mean square of what their distances from the line
// between their ends differ by, over the length of the blades, but for a straight line, which is
// all that a pivot aside or a slanted view adds. NaN where too little of them lies abreast to tell.
[[nodiscard]] double EdgeUnlikeness(const EdgePair& edges, const Eigen::Vector2d& pivot_px);

// EdgeOverlap of scissors, usually and at least; below, they are jaws.
inline constexpr double kUsualOverlap = 0.045, kSlenderestOverlap = 0.03;

// How far the two edges, continued, pass by the pivot on the other blade's side: mean of the two
// distances over the length of the blades. Blades that shear overlap by 0.055 to 0.125 (Mayo,
// Metzenbaum, iris; straight and curved), slender rendered ones by 0.03; the jaws of clamps,
// forceps and needle holders meet, and do not: about 0.
[[nodiscard]] double EdgeOverlap(const EdgePair& edges, const Eigen::Vector2d& pivot_px);

// A quantity and its standard uncertainty.
struct Estimate {
  double value = 0, sigma = 0;
};

// How far behind the mirror's point the place lies where the members cross, px: all that a
// silhouette says of the pivot.
[[nodiscard]] Estimate BehindByWaist(const Scene& scene, const EdgeMirror& mirror);

// The same, held where the edges overlap as those of scissors do.
[[nodiscard]] Estimate BehindByGeometry(const Scene& scene, const EdgeMirror& mirror);

}  // namespace bladecurve
