// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vision/photo.h"
#include "vision/plane_map.h"
#include "vision/scale.h"
#include "vision/sheet_pose.h"

namespace bladecurve {

// What the camera is known to be: CALIB.json, else EXIF's focal length, else what most cameras are.
[[nodiscard]] CameraKnowledge KnowCamera(const Photo& photo, const ScaleOptions& options);

// Map of the plane of the cutting edges from a solved sheet, with its uncertainty and its warnings.
struct SheetMapOptions {
  std::optional<double> plane_height_mm;
  int width = 0, height = 0;  // of the stored picture
  std::string source;         // "marker", "card"
};
[[nodiscard]] PlaneMap SheetMap(const SheetSolution& solution, const SheetMapOptions& options);

}  // namespace bladecurve
