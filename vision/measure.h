// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vision/edge_points.h"
#include "vision/hints.h"
#include "vision/photo/photo.h"
#include "vision/scale/scale.h"
#include "vision/stage_log.h"

namespace bladecurve {

struct MeasureOptions {
  ScaleOptions scale;
  SceneHints hints;
  Plan plan = Plan::kAsNeeded;                     // --plan
  bool keep_photo = false;                         // for pictures of the result
  std::optional<std::filesystem::path> debug_dir;  // pictures of every stage
};

// All that one photograph gives. Pixels are displayed pixels.
struct PhotoMeasurement {
  std::string file, sha256;
  int width = 0, height = 0;
  Eigen::Vector2d pivot_px{0, 0};
  double pivot_sigma_px = std::numeric_limits<double>::quiet_NaN();
  std::string pivot_source;                   // "screw", "geometry", "hint"
  Eigen::Vector2d axis_px{0, 0};              // unit direction of +x in the image, at the pivot
  double theta_rad = 0, theta_sigma_rad = 0;  // the sigma of a given one is NaN: nobody said
  std::string theta_source;                   // "distal-ends", "given"
  double seen_theta_rad = 0, seen_theta_sigma_rad = 0;  // by the distal ends, given or not
  double mm_per_px = 0, mm_per_px_sigma = 0;            // along the axis, at the pivot
  std::string scale_source;
  std::vector<Eigen::Vector2d> upper_edge_px, lower_edge_px;
  std::vector<Eigen::Vector2d> upper_edge_mm;  // in the frame of `edges`
  double upper_edge_sigma_px = 0;
  Eigen::Vector2d upper_end_px{0, 0}, lower_end_px{0, 0};
  std::vector<std::string> warnings;  // each makes the result `review`
  std::vector<StageRecord> plan;
  double ms_total = 0;
  EdgePoints edges;                    // the same in mm, for the curve fit
  std::shared_ptr<const Photo> photo;  // if it was to be kept
};

// decode -> scale -> scene -> pivot -> edges -> pose. Throws Refused.
[[nodiscard]] PhotoMeasurement MeasurePhoto(const std::filesystem::path& path,
                                            const MeasureOptions& options);

}  // namespace bladecurve
