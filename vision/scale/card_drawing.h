// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "vision/scale/card.h"

namespace bladecurve {

// A card as simple shapes, for any kind of file. mm, origin at the bottom left, y up.
struct CardDrawing {
  struct Rectangle {
    double x_mm, y_mm, width_mm, height_mm;
    bool black;  // else paper
  };
  struct Text {
    Eigen::Vector2d baseline_mm;  // left end
    double size_mm;               // of the letters' em
    std::string text;             // plain ASCII
  };
  double width_mm = 0, height_mm = 0;
  std::vector<Rectangle> rectangles;  // later ones lie over earlier ones
  std::vector<Text> texts;
};

// Markers, check bar, title and instructions.
[[nodiscard]] CardDrawing DrawCard(const Card& card);

[[nodiscard]] std::string CardSvg(const CardDrawing& drawing);
[[nodiscard]] std::string CardPdf(const CardDrawing& drawing);  // one page, PDF 1.4, Helvetica
// CV_8UC1; each pixel as dark as the share of it that is covered, so that sides keep their place to
// a hundredth of a pixel.
[[nodiscard]] cv::Mat CardPicture(const CardDrawing& drawing, double dpi);

}  // namespace bladecurve
