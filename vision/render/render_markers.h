// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/render/render_camera.h"
#include "vision/render/render_coverage.h"
#include "vision/render/synthetic_scene.h"

namespace bladecurve::render {

// A marker in the picture: white paper, on it the black square, on that the white cells; each one
// printed flat on the sheet.
struct MarkerPolygons {
  Polygon paper, black, white;  // pixels
};

[[nodiscard]] MarkerPolygons ProjectMarker(const MarkerSpec& marker, const Camera& camera);

[[nodiscard]] MarkerTruth MarkerTruthOf(const MarkerSpec& marker, const Camera& camera);

}  // namespace bladecurve::render
