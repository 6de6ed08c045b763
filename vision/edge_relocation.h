// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/located_blade.h"
#include "vision/photo.h"
#include "vision/pivot.h"
#include "vision/scale.h"
#include "vision/scene.h"

namespace bladecurve {

// A photograph and what is known of it before the edges are compared.
struct RelocationView {
  const Photo& photo;
  const ScaleResult& scale;
  const Scene& scene;
};

// Blades mirror each other about the line through the pivot. Where the edges do not, and markers
// tell the tilt of the view, each is looked for anew where the other one's mirror image lies; if
// one of them stands out more clearly there than where it was, or alone is seen there, outside of
// where it was, it is taken from there, trimmed, and pivot->asymmetry says how alike the two are
// then. Where they do, but one of them is doubtful, that one is looked for, and taken if it is less
// doubtful there.
void RelocateUnlikeEdges(const RelocationView& view, Pivot* pivot, Blades* blades);

}  // namespace bladecurve
