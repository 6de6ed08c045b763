// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vision/edge/edge.h"
#include "vision/photo/photo.h"
#include "vision/scale/scale.h"
#include "vision/scene/scene.h"
#include "vision/scissors/blade_view.h"
#include "vision/stage_log.h"

namespace bladecurve {

// Locates both edges beside the traces of the scene, at full resolution along the blades only. Dark
// bands along both are taken for shadows, and edges at which light alone changes are left for where
// the ground's colour ends, or doubted. The lower edge may be the trace itself where nothing
// better is to be had: ambiguity 1, sigma as large as the trace's. Throws Refused as LocateEdge
// does for the upper edge.
[[nodiscard]] BladeEdges LocateBlades(const Photo& photo,
                                      const ScaleResult& scale,
                                      const Scene& scene,
                                      Plan plan = Plan::kAsNeeded);

// The cutting edge along `guess`, in grey or else in colours. Throws Refused as LocateEdge does.
[[nodiscard]] LocatedEdge LocateBladeAlong(const Photo& photo,
                                           const ScaleResult& scale,
                                           const Scene& scene,
                                           const EdgeGuess& guess);

// The same where a shadow begins at the edge: nothing if no fall of light is seen along `guess`.
[[nodiscard]] std::optional<LocatedEdge> LocateBladeInShadow(const Photo& photo,
                                                             const ScaleResult& scale,
                                                             const Scene& scene,
                                                             const EdgeGuess& guess,
                                                             Shadow shadow);

// The same along the inner side of a dark band beside `edge`, if it is seen there: a shadow may
// have been taken for the blade.
[[nodiscard]] std::optional<LocatedEdge> LocateBladeWithinBand(const Photo& photo,
                                                               const ScaleResult& scale,
                                                               const Scene& scene,
                                                               const LocatedEdge& edge,
                                                               bool blade_on_left);

}  // namespace bladecurve
