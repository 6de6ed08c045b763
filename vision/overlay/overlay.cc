// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/overlay/overlay.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "vision/overlay/overlay_canvas.h"
#include "vision/overlay/overlay_detail.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Sizes within the picture, px; text and panels grow with its width.
struct Layout {
  int photo_width = 0, photo_height = 0;
  double photo_scale = 1;  // picture pixels a displayed pixel
  double text = 16;        // height of capitals
  int title_height = 0, detail_height = 0, margin = 0;
};

Layout LayOut(const Photo& photo) {
  const double longest = std::max(photo.displayed_width(), photo.displayed_height());
  Layout layout;
  // Small photographs are enlarged so that the writing has room, large ones reduced to what a
  // screen shows.
  layout.photo_scale = std::clamp(longest, 1000.0, 2000.0) / longest;
  layout.photo_width = static_cast<int>(std::lround(photo.displayed_width() * layout.photo_scale));
  layout.photo_height =
      static_cast<int>(std::lround(photo.displayed_height() * layout.photo_scale));
  layout.text = std::clamp(layout.photo_width / 95.0, 9.0, 18.0);
  layout.margin = static_cast<int>(layout.text);
  layout.title_height = static_cast<int>(2.6 * layout.text);
  layout.detail_height = static_cast<int>(16 * layout.text);
  return layout;
}

// The photograph as it is shown: one affine map both turns it by its EXIF orientation and scales
// it.
void PaintPhoto(const Photo& photo, const Layout& layout, cv::Mat image) {
  // Linear interpolation reduces by a quarter without losing pixels; a tenth fewer hardly show, and
  // may be half of the photograph's.
  constexpr double kSlack = 1.25, kLeast = 0.9;
  const cv::Mat colour =
      photo.DecodeColour(std::max(layout.photo_width, layout.photo_height), kSlack, kLeast);
  const Vector2d displayed_size(photo.displayed_width(), photo.displayed_height());
  const bool turned = photo.metadata().orientation >= 5;
  const Vector2d stored_size =
      turned ? Vector2d(displayed_size.y(), displayed_size.x()) : displayed_size;
  const Vector2d reduction = stored_size.cwiseQuotient(Vector2d(colour.cols, colour.rows));
  const auto colour_from_picture = [&](const Vector2d& at) -> cv::Point2f {
    const Vector2d displayed =
        (at + Vector2d::Constant(0.5)) / layout.photo_scale - Vector2d::Constant(0.5);
    const Vector2d stored = photo.StoredFromDisplayed(displayed);
    const Vector2d reduced =
        (stored + Vector2d::Constant(0.5)).cwiseQuotient(reduction) - Vector2d::Constant(0.5);
    return {static_cast<float>(reduced.x()), static_cast<float>(reduced.y())};
  };
  const cv::Point2f picture[] = {{0, 0}, {100, 0}, {0, 100}};
  const cv::Point2f source[] = {
      colour_from_picture({0, 0}), colour_from_picture({100, 0}), colour_from_picture({0, 100})};
  cv::warpAffine(colour,
                 image,
                 cv::getAffineTransform(picture, source),
                 image.size(),
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
}

View PhotoView(const Layout& layout, cv::Mat image) {
  View view{image};
  view.scale *= layout.photo_scale;
  view.shift = Vector2d::Constant(0.5 * layout.photo_scale - 0.5);
  view.stroke = std::max(1.0, layout.text / 9);
  return view;
}

// Direction at `angle_rad` from the axis, counter-clockwise as seen; y points down.
Vector2d Turned(const Vector2d& axis_px, double angle_rad) {
  const Vector2d upwards(axis_px.y(), -axis_px.x());
  return std::cos(angle_rad) * axis_px + std::sin(angle_rad) * upwards;
}

double ReachPx(const Overlay& overlay) { return (overlay.upper_end_px - overlay.pivot_px).norm(); }

std::string Text(const char* format, double a, double b) {
  char text[80];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

// Where the writing of the angle begins: beyond the ends, or aside of the box around the blades
// where the picture ends too soon.
Vector2d PlaceForAngle(const View& view,
                       const Vector2d& beyond_ends,
                       const Vector2d& axis_px,
                       const Eigen::AlignedBox2d& blades,
                       double width,
                       double text) {
  const Vector2d first(text, 2 * text);
  const Vector2d last =
      first.cwiseMax(Vector2d(view.image.cols - text - width, view.image.rows - text));
  const auto within = [&](const Vector2d& at) -> Vector2d {
    return at.cwiseMax(first).cwiseMin(last);
  };
  const Vector2d ahead = within(
      beyond_ends + Vector2d(-0.5 * (1 - axis_px.x()) * width, 0.5 * (1 + axis_px.y()) * text));
  const bool lies = std::abs(axis_px.x()) > std::abs(axis_px.y());
  const Vector2d after = lies ? Vector2d(ahead.x(), blades.max().y() + 1.5 * text)
                              : Vector2d(blades.max().x() + text, ahead.y());
  const Vector2d before = lies ? Vector2d(ahead.x(), blades.min().y() - 0.5 * text)
                               : Vector2d(blades.min().x() - width - text, ahead.y());
  for (const Vector2d& at : {ahead, within(after)}) {
    const Eigen::AlignedBox2d writing(at - Vector2d(0, text), at + Vector2d(width, 0));
    if (!writing.intersects(blades)) return at;
  }
  return within(before);
}

void DrawAngle(View& view, const Overlay& overlay, double text) {
  const double reach = ReachPx(overlay);
  const double half = overlay.theta_rad / 2;
  for (const double side : {half, -half}) {
    const Vector2d end = overlay.pivot_px + reach * Turned(overlay.axis_px, side);
    DrawDashed(view, overlay.pivot_px, end, kFrameColour);
  }
  std::vector<Vector2d> arc;
  constexpr int kSteps = 48;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = half * (2.0 * i / kSteps - 1);
    arc.push_back(overlay.pivot_px + 1.12 * reach * Turned(overlay.axis_px, angle));
  }
  DrawPath(view, arc, kFrameColour, 1);
  const double degrees = 180 / std::numbers::pi;
  const std::string label =
      Text("%.2f +- %.2f deg", overlay.theta_rad * degrees, overlay.theta_sigma_rad * degrees);
  constexpr double kBackRad = 0.12;  // from the edge to the back of a blade
  Eigen::AlignedBox2d blades(view.ViewFromPhoto(overlay.pivot_px));
  for (const Vector2d& point : arc) blades.extend(view.ViewFromPhoto(point));
  for (const double side : {half + kBackRad, -half - kBackRad})
    blades.extend(view.ViewFromPhoto(overlay.pivot_px + reach * Turned(overlay.axis_px, side)));
  const Vector2d at =
      PlaceForAngle(view,
                    view.ViewFromPhoto(overlay.pivot_px + 1.16 * reach * overlay.axis_px),
                    overlay.axis_px,
                    blades,
                    TextWidth(label, text),
                    text);
  DrawText(view, label, at, text, kFrameColour);
}

void DrawPivot(View& view, const Overlay& overlay, double text) {
  const Vector2d back = overlay.pivot_px - 0.15 * ReachPx(overlay) * overlay.axis_px;
  DrawDashed(
      view, back, overlay.pivot_px + 1.12 * ReachPx(overlay) * overlay.axis_px, kPaperColour);
  const double arm = 0.6 * text / view.scale.norm() * std::numbers::sqrt2;
  const Vector2d right(arm, 0), down(0, arm);
  DrawPath(view, {overlay.pivot_px - right, overlay.pivot_px + right}, kFrameColour, 1);
  DrawPath(view, {overlay.pivot_px - down, overlay.pivot_px + down}, kFrameColour, 1);
  std::vector<Vector2d> ring;
  for (int i = 0; i <= 64; ++i) {
    const double angle = 2 * std::numbers::pi * i / 64;
    ring.push_back(overlay.pivot_px +
                   2 * overlay.pivot_sigma_px * Vector2d(std::cos(angle), std::sin(angle)));
  }
  DrawPath(view, ring, kFrameColour, 1);
  // Behind the pivot, between the shanks, where nothing is measured.
  const std::string label = Text("pivot +- %.2g px", overlay.pivot_sigma_px, 0);
  Vector2d at = view.ViewFromPhoto(back - 0.03 * ReachPx(overlay) * overlay.axis_px);
  at.x() -= 0.5 * (1 + overlay.axis_px.x()) * TextWidth(label, text);
  at.y() += 0.5 * text;
  DrawText(view, label, at, text, kFrameColour);
}

void DrawEdges(View& view, const Overlay& overlay) {
  if (overlay.lower_edge_px.size() > 1) DrawPath(view, overlay.lower_edge_px, kLowerColour, 1);
  DrawPath(view, overlay.upper_edge_px, kLocatedColour, 2.5);
  DrawPath(view, overlay.fitted_edge_px, kFittedColour, 1);
  DrawDot(view, overlay.upper_end_px, 2.5 * view.stroke, kLocatedColour);
  DrawDot(view, overlay.lower_end_px, 2.5 * view.stroke, kLowerColour);
}

// The largest of 1, 2, 5 times a power of ten that is at most `limit`.
double RoundLength(double limit) {
  const double decade = std::pow(10.0, std::floor(std::log10(limit)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * decade <= limit) return digit * decade;
  }
  return decade;
}

void DrawScaleBar(View& view, const Overlay& overlay, const Layout& layout) {
  const double unit_per_view_px = overlay.unit_per_px / layout.photo_scale;
  const double length = RoundLength(0.25 * layout.photo_width * unit_per_view_px);
  View plain{view.image};
  plain.stroke = view.stroke;
  const Vector2d left(2.0 * layout.margin, layout.photo_height - 2.0 * layout.margin);
  const Vector2d right = left + Vector2d(length / unit_per_view_px, 0);
  const Vector2d tick(0, 0.5 * layout.text);
  DrawPath(plain, {left - tick, left, right, right - tick}, kPaperColour, 1.5);
  const std::string label = Text("%g ", length, 0) + overlay.unit;
  DrawText(plain,
           label,
           left + Vector2d(layout.text / 2.0, -0.5 * layout.text),
           layout.text,
           kPaperColour);
}

void DrawTitle(const Overlay& overlay, const Layout& layout, cv::Mat image) {
  image.setTo(overlay.doubtful ? cv::Scalar(0, 90, 160) : cv::Scalar(60, 110, 30));
  View view{image};
  const double fitting =
      layout.text * (image.cols - 2.0 * layout.margin) / TextWidth(overlay.title, layout.text);
  const double height = std::min(layout.text, fitting);
  DrawText(
      view, overlay.title, {layout.margin * 1.0, (image.rows + height) / 2}, height, kPaperColour);
}

void DrawDetails(const Photo& photo, const Overlay& overlay, const Layout& layout, cv::Mat image) {
  constexpr double kHalfBandPx =
      6;  // shows an error of a tenth of a pixel and still the whole blur
  constexpr double kHalfPlacePx = 12;
  image.setTo(cv::Scalar(40, 40, 40));
  const int head = 2 * layout.margin + layout.margin / 2;
  const int size = image.rows - head - layout.margin;
  const int strip_width = image.cols - size - 3 * layout.margin;
  const cv::Rect strip(layout.margin, head, strip_width, size);
  const cv::Rect place(strip.br().x + layout.margin, head, size, size);
  DrawStraightenedEdge(photo, overlay, kHalfBandPx, image(strip));
  DrawWorstPlace(photo, overlay, kHalfPlacePx, image(place));
  const std::size_t worst = WorstPoint(overlay);
  const double off = (overlay.upper_edge_px[worst] - overlay.fitted_edge_px[worst]).norm();
  View view{image};
  const double base = layout.margin * 1.8;
  DrawText(view,
           Text("upper edge straightened, %g px to either side: ", kHalfBandPx, 0),
           {strip.x * 1.0, base},
           layout.text,
           kPaperColour);
  double x =
      strip.x + TextWidth(Text("upper edge straightened, %g px to either side: ", kHalfBandPx, 0),
                          layout.text);
  DrawText(view, "located", {x, base}, layout.text, kLocatedColour);
  x += TextWidth("located  ", layout.text) + layout.text;
  DrawText(view, "fitted", {x, base}, layout.text, kFittedColour);
  DrawText(view, Text("worst: %.2f px", off, 0), {place.x * 1.0, base}, layout.text, kPaperColour);
}

void DrawOnPhoto(const Photo& photo,
                 const Overlay& overlay,
                 const Layout& layout,
                 const cv::Mat& image) {
  PaintPhoto(photo, layout, image);
  View view = PhotoView(layout, image);
  DrawPivot(view, overlay, layout.text);
  DrawAngle(view, overlay, layout.text);
  DrawEdges(view, overlay);  // last: these are to be checked
  DrawScaleBar(view, overlay, layout);
}

void RequireDrawable(const Overlay& overlay) {
  if (overlay.upper_edge_px.size() < 2 ||
      overlay.upper_edge_px.size() != overlay.fitted_edge_px.size()) {
    throw std::invalid_argument(
        "overlay: upper and fitted edge need the same number of points, two at least");
  }
}

}  // namespace

cv::Mat DrawOverlay(const Photo& photo, const Overlay& overlay) {
  RequireDrawable(overlay);
  const Layout layout = LayOut(photo);
  const int width = layout.photo_width;
  cv::Mat picture(layout.title_height + layout.photo_height + layout.detail_height, width, CV_8UC3);
  DrawTitle(overlay, layout, picture(cv::Rect(0, 0, width, layout.title_height)));
  const cv::Rect shown(0, layout.title_height, width, layout.photo_height);
  const cv::Rect below(0, shown.br().y, width, layout.detail_height);
  ParallelAside([&] { DrawOnPhoto(photo, overlay, layout, picture(shown)); },
                [&] { DrawDetails(photo, overlay, layout, picture(below)); });
  return picture;
}

}  // namespace bladecurve
