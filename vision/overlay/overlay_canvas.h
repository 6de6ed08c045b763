// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "vision/photo/photo.h"

namespace bladecurve {

// Colours, BGR: apart from each other also for colour-blind eyes, and from steel, drapes and paper
// by their halo.
inline const cv::Scalar kLocatedColour(255, 200, 0);
inline const cv::Scalar kFittedColour(180, 0, 255);
inline const cv::Scalar kLowerColour(0, 150, 255);
inline const cv::Scalar kFrameColour(0, 230, 255);
inline const cv::Scalar kHaloColour(25, 25, 25);
inline const cv::Scalar kPaperColour(255, 255, 255);

// A rectangle of the picture that shows photograph pixels by an affine map: drawing into it takes
// displayed pixels of the photograph.
struct View {
  cv::Mat image;                                        // CV_8UC3, part of the whole picture
  Eigen::Matrix2d scale = Eigen::Matrix2d::Identity();  // view = scale * displayed + shift
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double stroke = 1;  // width of thin lines, view pixels
  [[nodiscard]] Eigen::Vector2d ViewFromPhoto(const Eigen::Vector2d& displayed_px) const;
};

// Antialiased lines with a dark halo, so that they show on white as on black.
void DrawPath(View& view,
              const std::vector<Eigen::Vector2d>& path_px,
              const cv::Scalar& colour,
              double width);
void DrawDashed(View& view,
                const Eigen::Vector2d& from_px,
                const Eigen::Vector2d& to_px,
                const cv::Scalar& colour);
void DrawDot(View& view, const Eigen::Vector2d& at_px, double radius, const cv::Scalar& colour);

// Text at a place of the view, its left end on the base line there; height of capitals in view
// pixels.
void DrawText(View& view,
              const std::string& text,
              const Eigen::Vector2d& at,
              double height,
              const cv::Scalar& colour);
[[nodiscard]] double TextWidth(const std::string& text, double height);

// Grey value at a displayed pixel, bilinear; the border is continued outwards.
[[nodiscard]] double GreyAt(const Photo& photo, const Eigen::Vector2d& displayed_px);

}  // namespace bladecurve
