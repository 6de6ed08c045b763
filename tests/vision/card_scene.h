// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "vision/render/render.h"
#include "vision/scale/card.h"
#include "vision/scale/plane_map.h"

namespace bladecurve {

// Scissors on the card, the middle of the card in the middle of the picture; the rings lie on
// markers at the border. A lens that bends.
[[nodiscard]] SceneSpec OnCard(const Card& card, double tilt_rad);

// For --camera; returns the path.
std::filesystem::path SaveCalibration(const SceneTruth& truth, const std::filesystem::path& path);

[[nodiscard]] Eigen::Vector2d ImageOf(const CameraTruth& camera, const Eigen::Vector3d& world_mm);

// Largest error, mm, of lengths of 100 mm at that height, lying in several places and directions
// within the card.
[[nodiscard]] double WorstOf100Mm(const PlaneMap& map, const CameraTruth& camera, double height_mm);

}  // namespace bladecurve
