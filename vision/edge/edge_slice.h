// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "vision/edge/edge_levels.h"
#include "vision/edge/edge_windows.h"

namespace bladecurve {

// A raw pixel beside an edge with what the model of edge_levels.h needs of it. weight: inverse
// variance of its noise; 0 leaves it out.
struct PreparedPixel {
  double light = 0, weight = 0;
  LevelVector terms;
};

// What the pixels nearest to one sample of the path say, levels and blur being known from many.
struct EdgeSlice {
  int sample = 0;        // of the path
  double offset_px = 0;  // of the edge from the path, positive out of the blade
  double sigma_px = 0;   // from the pixels' noise, the levels paid for
  double contrast = 0;   // background minus blade
  double ground = 0;     // background at the edge
  double slope = 0;      // of the light beside the edge, both sides together, per px
  double held = 0;       // weight of the expectation that offset_px is zero, 0 to 1
};

// How far blade and background of one slice stray from the levels of their window, standard
// deviations: brushed metal, wood grain and threads that cross the edge.
struct SliceTexture {
  double blade = 0, ground = 0;
};

// Residuals of the plain pixels of one side of a slice.
struct SideRest {
  double mean = 0, pixels = 0;
};

// Variance of the slices' own level: what their means scatter beyond what `noise` of the pixels
// explains.
[[nodiscard]] double TextureSigma(const std::vector<SideRest>& slices, double noise);

// The plain pixels of a slice: less than 2 % of the other side.
struct SliceRests {
  SideRest blade, ground;
};
[[nodiscard]] SliceRests RestsOf(std::span<const PreparedPixel> pixels, const LevelVector& levels);

// Offset of the edge in a slice, its two levels being those of the window give or take texture;
// a slice that strays further, a facet or a stain, is freed as far as its plain pixels ask for.
// kept: share of the information left after paying for the window's levels.
[[nodiscard]] EdgeSlice SolveSlice(std::span<const PreparedPixel> pixels,
                                   const LevelVector& levels,
                                   const SliceTexture& texture,
                                   double kept);

// One slice in `stride` samples of the path, and the noise of a pixel on plain blade and ground.
struct SliceSampling {
  int stride = 1;
  double noise_blade = 0, noise_ground = 0;
};

// Moves slices that say little to what those within some 50 px say together, not to the path: a
// slice of weight w keeps its share, so that sums over many slices are as if none had been held.
// spacing_px: of the slices.
void HoldToNeighbours(double spacing_px, std::vector<EdgeSlice>* slices);

// All slices of an edge, the texture measured from what they leave over.
[[nodiscard]] std::vector<EdgeSlice> SolveSlices(
    const std::vector<std::vector<PreparedPixel>>& slices,
    const SliceSampling& sampling,
    const EdgeWindows& windows);

}  // namespace bladecurve
