// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_markers.h"

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace bladecurve::render {
namespace {

// DICT_4X4_50: the inner 4 x 4 cells of each marker, row by row from the top left, 1 = white, the
// first cell on top.
constexpr std::array<std::uint16_t, 50> kPatterns = {
    0xb532, 0x0f9a, 0x332d, 0x9946, 0x549e, 0x79cd, 0x9e2e, 0xc4f2, 0xfeda, 0xcf56,
    0xf991, 0x11a7, 0x0eb7, 0x2a0f, 0x24b1, 0x263e, 0x4665, 0x6600, 0x6c5e, 0x76af,
    0x868b, 0xb02b, 0xccd5, 0xdd82, 0xfe47, 0x9471, 0xace4, 0xa554, 0x2123, 0x346f,
    0x4415, 0x57b2, 0x9ecf, 0xf0cb, 0x08ae, 0x0929, 0x1875, 0x04ff, 0x0df6, 0x1c5a,
    0x1718, 0x2a28, 0x328c, 0x38b2, 0x24e8, 0x2eeb, 0x2d3f, 0x4b64, 0x502e, 0x5013,
};
constexpr int kCells = 6;  // the four inner ones and the black border on both sides

// Marker coordinates are cells, x right and y down from the top left corner of the black square.
Eigen::Vector3d WorldFromMarker(const MarkerSpec& marker, const Eigen::Vector2d& cells) {
  const Eigen::Vector2d centered(cells.x() - 0.5 * kCells, 0.5 * kCells - cells.y());
  const Eigen::Vector2d world_mm = marker.center_mm + Eigen::Rotation2Dd(marker.angle_rad) *
                                                          (centered * (marker.size_mm / kCells));
  return {world_mm.x(), world_mm.y(), 0};
}

// An axis-parallel rectangle of the marker; its sides are split so that they follow the lens.
Ring ProjectRectangle(const MarkerSpec& marker,
                      const Camera& camera,
                      const Eigen::Vector2d& low,
                      const Eigen::Vector2d& high) {
  constexpr int kPiecesPerSide = 16;
  const std::array<Eigen::Vector2d, 4> corners = {
      low, Eigen::Vector2d(high.x(), low.y()), high, Eigen::Vector2d(low.x(), high.y())};
  Ring ring;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d step = (corners[(i + 1) % corners.size()] - corners[i]) / kPiecesPerSide;
    for (int j = 0; j < kPiecesPerSide; ++j) {
      ring.push_back(camera.PixelFromWorld(WorldFromMarker(marker, corners[i] + j * step)));
    }
  }
  return ring;
}

bool IsWhite(int id, int row, int col) {
  return (kPatterns[static_cast<std::size_t>(id)] >> (15 - 4 * row - col) & 1) != 0;
}

}  // namespace

MarkerPolygons ProjectMarker(const MarkerSpec& marker, const Camera& camera) {
  if (marker.id < 0 || marker.id >= static_cast<int>(kPatterns.size())) {
    throw std::invalid_argument("MarkerSpec: id = " + std::to_string(marker.id) +
                                " must be 0 to 49");
  }
  MarkerPolygons polygons;
  const double margin = marker.margin_mm * kCells / marker.size_mm;
  const Eigen::Vector2d low(0, 0), high(kCells, kCells), rim(margin, margin);
  polygons.paper.push_back(ProjectRectangle(marker, camera, low - rim, high + rim));
  polygons.black.push_back(ProjectRectangle(marker, camera, low, high));
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 4; ++col) {
      if (!IsWhite(marker.id, row, col)) continue;
      const Eigen::Vector2d cell(1 + col, 1 + row);
      polygons.white.push_back(
          ProjectRectangle(marker, camera, cell, cell + Eigen::Vector2d::Ones()));
    }
  }
  return polygons;
}

MarkerTruth MarkerTruthOf(const MarkerSpec& marker, const Camera& camera) {
  const std::array<Eigen::Vector2d, 4> corners = {Eigen::Vector2d(0, 0),
                                                  Eigen::Vector2d(kCells, 0),
                                                  Eigen::Vector2d(kCells, kCells),
                                                  Eigen::Vector2d(0, kCells)};
  MarkerTruth truth{.id = marker.id, .size_mm = marker.size_mm, .corners_px = {}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    truth.corners_px[i] = camera.PixelFromWorld(WorldFromMarker(marker, corners[i]));
  }
  return truth;
}

}  // namespace bladecurve::render
