// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "samples/torque_plot.h"
#include "samples/torque_plot_frame.h"

namespace bladecurve {
namespace {

constexpr double kScale = 2;  // pixels of the bitmap per pixel of the SVG: sharp on paper
constexpr int kSubPixelBits = 4;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
const cv::Scalar kInk(34, 34, 34), kGrid(228, 228, 228), kPaper(255, 255, 255);

cv::Point Pixel(const PlotPoint& p) {
  const double scale = kScale * (1 << kSubPixelBits);
  return {static_cast<int>(std::lround(p.x * scale)), static_cast<int>(std::lround(p.y * scale))};
}

cv::Scalar ColourOf(const PhaseStyle& style) {
  return {static_cast<double>(style.rgb & 255),
          static_cast<double>(style.rgb >> 8 & 255),
          static_cast<double>(style.rgb >> 16)};
}

void DrawLine(
    cv::Mat& image, PlotPoint from, PlotPoint to, const cv::Scalar& colour, double width) {
  const int thickness = std::max(1, static_cast<int>(std::lround(width * kScale)));
  cv::line(image, Pixel(from), Pixel(to), colour, thickness, cv::LINE_AA, kSubPixelBits);
}

// `align`: 0 begins at the place, 0.5 is centred about it, 1 ends there.
void DrawText(cv::Mat& image, const std::string& text, PlotPoint at, double size, double align) {
  const double scale = size * kScale / 30;  // Hershey letters are some 30 pixels high at scale 1
  const int width = cv::getTextSize(text, kFont, scale, 2, nullptr).width;
  const cv::Point place(static_cast<int>(at.x * kScale - align * width),
                        static_cast<int>(at.y * kScale));
  cv::putText(image, text, place, kFont, scale, kInk, 2, cv::LINE_AA);
}

// Along the torque axis, upwards.
void DrawTorqueName(cv::Mat& image, const PlotFrame& frame) {
  cv::Mat strip(40, static_cast<int>(kScale * (frame.Y(0) - kPlotTop)), CV_8UC3, kPaper);
  DrawText(strip, "torque, N mm", {0.5 * strip.cols / kScale, 15}, 15, 0.5);
  cv::rotate(strip, strip, cv::ROTATE_90_COUNTERCLOCKWISE);
  strip.copyTo(image(cv::Rect(16, static_cast<int>(kScale * kPlotTop), strip.cols, strip.rows)));
}

void DrawAxes(cv::Mat& image, const PlotFrame& frame) {
  const double bottom = frame.Y(0), right = kPlotWidth - kPlotRight;
  for (const double value : frame.torque_nmm.Ticks()) {
    DrawLine(image, {kPlotLeft, frame.Y(value)}, {right, frame.Y(value)}, kGrid, 0.5);
    DrawText(image, TickText(value), {kPlotLeft - 10, frame.Y(value) + 4.5}, 14, 1);
  }
  for (const double value : frame.angle_deg.Ticks()) {
    DrawLine(image, {frame.X(value), bottom}, {frame.X(value), bottom + 6}, kInk, 0.5);
    DrawText(image, TickText(value), {frame.X(value), bottom + 22}, 14, 0.5);
  }
  DrawLine(image, {kPlotLeft, bottom}, {right, bottom}, kInk, 0.5);
  DrawText(image,
           "opening angle, degrees (closing to the right)",
           {0.5 * (kPlotLeft + right), kPlotHeight - 16},
           15,
           0.5);
  DrawTorqueName(image, frame);
}

void DrawCurve(cv::Mat& image, const std::vector<PlotStretch>& stretches) {
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    const cv::Scalar colour = ColourOf(StyleOf(stretches[k].phase));
    const std::vector<PlotPoint>& points = stretches[k].points;
    if (k > 0) DrawLine(image, stretches[k - 1].points.back(), points.front(), colour, 0.7);
    for (std::size_t i = 1; i < points.size(); ++i)
      DrawLine(image, points[i - 1], points[i], colour, 2.5);
  }
}

void DrawLegend(cv::Mat& image, const std::vector<PhaseStyle>& legend) {
  double x = kPlotLeft;
  for (const PhaseStyle& style : legend) {
    DrawLine(image, {x, 66}, {x + 26, 66}, ColourOf(style), 4);
    DrawText(image, style.label, {x + 34, 71}, 14, 0);
    x += 60 + 9 * static_cast<double>(std::string_view(style.label).size());
  }
}

void DrawEvents(cv::Mat& image, const std::vector<PlotPoint>& places) {
  const int radius = static_cast<int>(4 * kScale) << kSubPixelBits;
  for (const PlotPoint& place : places) {
    cv::circle(image, Pixel(place), radius, kPaper, cv::FILLED, cv::LINE_AA, kSubPixelBits);
    cv::circle(image, Pixel(place), radius, kInk, 3, cv::LINE_AA, kSubPixelBits);
  }
}

}  // namespace

cv::Mat TorquePlotBitmap(const CutRun& run, const std::string& title) {
  const PlotFrame frame = FrameOf(run);
  cv::Mat image(static_cast<int>(kScale * kPlotHeight),
                static_cast<int>(kScale * kPlotWidth),
                CV_8UC3,
                kPaper);
  DrawText(image, title, {kPlotLeft, 36}, 19, 0);
  DrawLegend(image, LegendOf(run));
  DrawAxes(image, frame);
  DrawCurve(image, StretchesOf(run, frame));
  DrawEvents(image, EventPlaces(run, frame));
  return image;
}

}  // namespace bladecurve
