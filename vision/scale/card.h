// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/scale/scale.h"

namespace bladecurve {

// A sheet with DICT_4X4_50 markers all round a free field. Sheet frame: mm, origin at the bottom
// left, x right, y up; all markers upright and of the same size.
struct Card {
  struct Marker {
    int id = 0;
    Eigen::Vector2d centre_mm;
  };
  std::string name;  // "a4", "letter"
  double width_mm = 0, height_mm = 0;
  double marker_mm = 0;
  std::vector<Marker> markers;
  std::vector<std::array<double, 4>>
      print_mm;  // x, y, width, height of other print: title, check bar, instructions

  // nullptr if the card has no such marker.
  [[nodiscard]] const Marker* Find(int id) const;
  // Clockwise from the top left.
  [[nodiscard]] std::array<Eigen::Vector2d, 4> MarkerCorners(const Marker& marker) const;
};

enum class Paper { kA4, kLetter };

// The cards that `bladecurve card` prints. They share no marker with each other, nor with the first
// 24 markers, which people print loose.
[[nodiscard]] Card BuiltInCard(Paper paper);

// {"format":"bladecurve-card/1","name","width_mm","height_mm","marker_mm","markers":[{"id","x_mm","y_mm"}],"print_mm"}
[[nodiscard]] std::string CardText(const Card& card);
// Throws std::invalid_argument naming file and field.
[[nodiscard]] Card ReadCard(const std::filesystem::path& path);

// The card of `cards` of which most markers are located; std::nullopt if none is.
[[nodiscard]] std::optional<Card> CardInView(const std::vector<Card>& cards,
                                             const std::vector<SeenMarker>& markers);

}  // namespace bladecurve
