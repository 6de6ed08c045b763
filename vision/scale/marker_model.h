// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace bladecurve {

// What is solved for on a marker. Homography: (u, v) = ((h0 x + h1 y + h2), (h3 x + h4 y + h5)) /
// (h6 x + h7 y + 1), from places of the picture to cells of the marker. Then the light of paper and
// ink, 1 is white, how it falls off, the blur in px, and the retreat: see InkShare.
inline constexpr int kHomography = 8;
enum MarkerParameter {
  kPaper = kHomography,
  kInk,
  kBlur,
  kLampX,
  kLampY,
  kRetreat,
  kMarkerUnknowns
};
using MarkerVector = Eigen::Matrix<double, kMarkerUnknowns, 1>;
using MarkerMatrix = Eigen::Matrix<double, kMarkerUnknowns, kMarkerUnknowns>;

inline constexpr int kMarkerCells = 6;  // on a side: four of pattern, one of border at either end

// Ink by row and column, border included.
using InkCells = std::array<std::array<bool, kMarkerCells>, kMarkerCells>;
[[nodiscard]] InkCells InkCellsOf(int id);

// The frame of the places: px from `middle_px` in units of a cell's mean side. It keeps the
// unknowns alike in size.
struct MarkerFrame {
  Eigen::Vector2d middle_px;
  double cell_px = 1;

  [[nodiscard]] Eigen::Vector2d Place(const Eigen::Vector2d& image_px) const {
    return (image_px - middle_px) / cell_px;
  }
  [[nodiscard]] Eigen::Vector2d Pixel(const Eigen::Vector2d& place) const {
    return middle_px + cell_px * place;
  }
};

// A corner, clockwise from the top left, in cells: (0, 0), (6, 0), (6, 6), (0, 6).
[[nodiscard]] Eigen::Vector2d CornerInCells(int corner);

// A place, and how it moves per unit of the homography.
struct MarkerCorner {
  Eigen::Vector2d place;
  Eigen::Matrix<double, 2, kHomography> jacobian;
};
[[nodiscard]] MarkerCorner CornerOf(const MarkerVector& at, int corner);

// The light of a printed marker: paper and ink lit by a lamp that may fall off, blurred, and cut
// off at white. The pixel's box counts as a Gaussian of its variance: what its shape adds is even
// on both sides of a border and moves none.
//
// Overexposed paper, a tone curve that is not quite known, ink that has run: each moves all borders
// between ink and paper alike, into the ink or out of it. The share s of ink that a pixel sees
// becomes s / (s + e^retreat (1 - s)), which moves a straight border by retreat / 1.6 sigmas of its
// blur. Borders of the pattern face both ways, so that they tell this from the marker's size.
class MarkerModel {
 public:
  MarkerModel(const InkCells& ink, const MarkerFrame& frame, const MarkerVector& at);

  // Light, 0 to 1, and its derivatives; those are zero where it is cut off.
  [[nodiscard]] double Light(const Eigen::Vector2d& place, MarkerVector* gradient) const;

  // A place of the picture in cells from the first corner.
  [[nodiscard]] Eigen::Vector2d InCells(const Eigen::Vector2d& place) const;

  // Whether both ink and paper lie within so many cells, fewer than half of one; in rows and
  // columns.
  [[nodiscard]] bool IsNearBorder(const Eigen::Vector2d& cells, double reach) const;

  // Number of the cell that a place lies in, row by row, the paper all round included.
  static constexpr int kCellsAcross = kMarkerCells + 2;
  [[nodiscard]] static int CellOf(const Eigen::Vector2d& cells);

  [[nodiscard]] double total_blur_px() const { return total_blur_px_; }

 private:
  const InkCells& ink_;
  const MarkerVector& at_;
  double total_blur_px_;  // with the pixel's box
  double sigma_;          // the same in cells
};

// Cells from a place to the nearest line between cells, or to the marker if it lies outside.
[[nodiscard]] double CellsToLine(const Eigen::Vector2d& cells);

}  // namespace bladecurve
