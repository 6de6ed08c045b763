// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/card_drawing.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/photo/photo.h"
#include "vision/scale/marker_detector.h"

namespace bladecurve {
namespace {

using Rectangle = CardDrawing::Rectangle;

constexpr int kCells = 4;
constexpr double kBarMm = 100;
constexpr double kSmallMm = 2.3;  // keeps the widest common sans serif off the markers

// White cells as few rectangles as a greedy cover gives, none over another: row, column, rows,
// columns.
std::vector<std::array<int, 4>> WhiteBlocks(std::array<bool, 16> cells) {
  const auto white = [&](int row, int column) -> bool& {
    return cells[static_cast<size_t>(kCells * row + column)];
  };
  std::vector<std::array<int, 4>> blocks;
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      if (!white(row, column)) continue;
      int columns = 1, rows = 1;
      while (column + columns < kCells && white(row, column + columns)) ++columns;
      const auto row_is_white = [&](int r) {
        for (int c = 0; c < columns; ++c) {
          if (!white(r, column + c)) return false;
        }
        return true;
      };
      while (row + rows < kCells && row_is_white(row + rows)) ++rows;
      for (int k = 0; k < rows * columns; ++k)
        white(row + k / columns, column + k % columns) = false;
      blocks.push_back({row, column, rows, columns});
    }
  }
  return blocks;
}

void DrawMarker(const Card& card, const Card::Marker& marker, std::vector<Rectangle>* out) {
  const double side = card.marker_mm, cell = side / (kCells + 2);
  const double left = marker.centre_mm.x() - 0.5 * side, top = marker.centre_mm.y() + 0.5 * side;
  out->push_back({left, top - side, side, side, true});
  for (const auto& [row, column, rows, columns] : WhiteBlocks(MarkerCells(marker.id))) {
    out->push_back({left + (column + 1) * cell,
                    top - (row + rows + 1) * cell,
                    columns * cell,
                    rows * cell,
                    false});
  }
}

// A bar with ticks every 10 mm, the middles of the outermost 100 mm apart, along the top of `area`.
void DrawCheckBar(const std::array<double, 4>& area, std::vector<Rectangle>* out) {
  constexpr double kLineMm = 0.3, kTickMm = 1.6, kEndTickMm = 3;
  const double left = area[0] + 0.5 * (area[2] - kBarMm) - 0.5 * kLineMm, top = area[1] + area[3];
  out->push_back({left, top - 0.5 * kEndTickMm - 0.5 * kLineMm, kBarMm + kLineMm, kLineMm, true});
  for (int i = 0; i <= 10; ++i) {
    const double height = i % 10 == 0 ? kEndTickMm : kTickMm;
    const double x = left + i * kBarMm / 10;
    out->push_back({x, top - 0.5 * kEndTickMm - 0.5 * height, kLineMm, height, true});
  }
}

void DrawLines(const std::vector<std::string>& lines,
               Eigen::Vector2d first_mm,
               double size_mm,
               CardDrawing* drawing) {
  constexpr double kLeading = 1.25;
  for (const std::string& line : lines) {
    drawing->texts.push_back({first_mm, size_mm, line});
    first_mm.y() -= kLeading * size_mm;
  }
}

std::string Millimetres(double mm) {
  const double rounded = std::round(10 * mm) / 10;
  const std::string text = std::to_string(rounded);
  return text.substr(0, rounded == std::floor(rounded) ? text.find('.') : text.find('.') + 2);
}

void DrawTitle(const Card& card, CardDrawing* drawing) {
  std::string name = card.name;
  name[0] = static_cast<char>(std::toupper(name[0]));
  const auto& area = card.print_mm[0];
  DrawLines({"bladecurve card " + name}, {area[0], area[1] + area[3] - 3.5}, 3.2, drawing);
  DrawLines({Millimetres(card.width_mm) + " x " + Millimetres(card.height_mm) + " mm, markers " +
                 Millimetres(card.marker_mm) + " mm",
             "Print at 100 %: no \"fit to page\"."},
            {area[0], area[1] + area[3] - 7.5},
            kSmallMm,
            drawing);
}

void DrawInstructions(const Card& card, CardDrawing* drawing) {
  const auto& area = card.print_mm[1];
  DrawLines({"Measure from end tick to end tick, middle to middle: not 100 mm? Add --print-scale "
             "LENGTH/100.",
             "Lay the sheet flat, the blades open inside the ring of markers. Photograph the whole",
             "sheet from straight above and 300 mm or more away, sharp and not overexposed.",
             "bladecurve fit PHOTO --plane-height-mm (cutting edge above the sheet)"},
            {area[0], area[1] + area[3] - 6},
            kSmallMm,
            drawing);
}

// Share of the pixel from `index` to the next that lies between two ends.
double Overlap(int index, double from, double to) {
  return std::clamp(std::min(to, index + 1.0) - std::max(from, 1.0 * index), 0.0, 1.0);
}

// Shares of black and white add up: rectangles of one colour never overlap, white lies on black
// only.
cv::Mat Light(const CardDrawing& drawing, double px_per_mm) {
  cv::Mat light(static_cast<int>(std::lround(drawing.height_mm * px_per_mm)),
                static_cast<int>(std::lround(drawing.width_mm * px_per_mm)),
                CV_32FC1,
                cv::Scalar(1));
  for (const Rectangle& r : drawing.rectangles) {
    const double left = r.x_mm * px_per_mm, right = (r.x_mm + r.width_mm) * px_per_mm;
    const double bottom = (drawing.height_mm - r.y_mm) * px_per_mm,
                 top = bottom - r.height_mm * px_per_mm;
    const int last_y = std::min(light.rows, static_cast<int>(std::ceil(bottom)));
    const int last_x = std::min(light.cols, static_cast<int>(std::ceil(right)));
    for (int y = std::max(0, static_cast<int>(top)); y < last_y; ++y) {
      for (int x = std::max(0, static_cast<int>(left)); x < last_x; ++x) {
        const double cover = Overlap(y, top, bottom) * Overlap(x, left, right);
        light.at<float>(y, x) += static_cast<float>(r.black ? -cover : cover);
      }
    }
  }
  return light;
}

uchar StoredGrey(double light) {
  const double v = std::clamp(light, 0.0, 1.0);
  return cv::saturate_cast<uchar>(
      255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055));
}

void PutText(const CardDrawing::Text& text,
             double sheet_height_mm,
             double px_per_mm,
             cv::Mat* picture) {
  constexpr double kHersheyUnitsPerEm =
      40;  // OpenCV's simplex font at scale 1, set as wide as Helvetica
  const cv::Point at(
      static_cast<int>(std::lround(text.baseline_mm.x() * px_per_mm)),
      static_cast<int>(std::lround((sheet_height_mm - text.baseline_mm.y()) * px_per_mm)));
  cv::putText(*picture,
              text.text,
              at,
              cv::FONT_HERSHEY_SIMPLEX,
              text.size_mm * px_per_mm / kHersheyUnitsPerEm,
              cv::Scalar(0),
              std::max(1, static_cast<int>(std::lround(0.2 * px_per_mm))),
              cv::LINE_AA);
}

}  // namespace

CardDrawing DrawCard(const Card& card) {
  CardDrawing drawing{card.width_mm, card.height_mm, {}, {}};
  for (const Card::Marker& marker : card.markers) DrawMarker(card, marker, &drawing.rectangles);
  if (card.print_mm.size() >= 2) {
    DrawTitle(card, &drawing);
    DrawCheckBar(card.print_mm[1], &drawing.rectangles);
    DrawInstructions(card, &drawing);
  }
  return drawing;
}

cv::Mat CardPicture(const CardDrawing& drawing, double dpi) {
  const double px_per_mm = dpi / kMmPerInch;
  const cv::Mat light = Light(drawing, px_per_mm);
  cv::Mat picture(light.size(), CV_8UC1);
  for (int y = 0; y < light.rows; ++y) {
    for (int x = 0; x < light.cols; ++x)
      picture.at<uchar>(y, x) = StoredGrey(light.at<float>(y, x));
  }
  for (const CardDrawing::Text& text : drawing.texts)
    PutText(text, drawing.height_mm, px_per_mm, &picture);
  return picture;
}

}  // namespace bladecurve
