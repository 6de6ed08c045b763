// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/card.h"

#include <algorithm>
#include <cmath>

namespace bladecurve {
namespace {

// Sixteen mm: 2.7 mm a cell, eight pixels of a 2000 pixel photograph of the whole sheet.
constexpr double kMarkerMm = 16;
// Printers leave 4 to 6.4 mm blank; a marker needs one cell of white around it.
constexpr double kMarginMm = 8;

// Evenly from the first to the last, both included.
std::vector<double> Spread(double first, double last, int count) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back(first + (last - first) * i / (count - 1));
  return places;
}

// Thirteen markers clockwise from the top left: five above, two down each side, four below with a
// gap in the middle for the check bar.
std::vector<Eigen::Vector2d> Ring(double width_mm, double height_mm) {
  const double edge = kMarginMm + 0.5 * kMarkerMm;
  const std::vector<double> x = Spread(edge, width_mm - edge, 5),
                            y = Spread(edge, height_mm - edge, 4);
  return {{x[0], y[3]},
          {x[1], y[3]},
          {x[2], y[3]},
          {x[3], y[3]},
          {x[4], y[3]},
          {x[4], y[2]},
          {x[4], y[1]},
          {x[4], y[0]},
          {x[3], y[0]},
          {x[1], y[0]},
          {x[0], y[0]},
          {x[0], y[1]},
          {x[0], y[2]}};
}

}  // namespace

const Card::Marker* Card::Find(int id) const {
  const auto found = std::find_if(
      markers.begin(), markers.end(), [id](const Marker& marker) { return marker.id == id; });
  return found == markers.end() ? nullptr : &*found;
}

std::array<Eigen::Vector2d, 4> Card::MarkerCorners(const Marker& marker) const {
  const double h = 0.5 * marker_mm;
  const Eigen::Vector2d& c = marker.centre_mm;
  return {c + Eigen::Vector2d(-h, h),
          c + Eigen::Vector2d(h, h),
          c + Eigen::Vector2d(h, -h),
          c + Eigen::Vector2d(-h, -h)};
}

Card BuiltInCard(Paper paper) {
  const bool a4 = paper == Paper::kA4;
  Card card;
  card.name = a4 ? "a4" : "letter";
  card.width_mm = a4 ? 297 : 279.4;
  card.height_mm = a4 ? 210 : 215.9;
  card.marker_mm = kMarkerMm;
  int id = a4 ? 24 : 37;
  for (const Eigen::Vector2d& centre : Ring(card.width_mm, card.height_mm))
    card.markers.push_back({id++, centre});
  // The title between the first two markers, bar and instructions in the gap below.
  const double left = card.markers[0].centre_mm.x() + 0.5 * kMarkerMm,
               right = card.markers[1].centre_mm.x() - 0.5 * kMarkerMm;
  const double bar_left = card.markers[9].centre_mm.x() + 0.5 * kMarkerMm,
               bar_right = card.markers[8].centre_mm.x() - 0.5 * kMarkerMm;
  card.print_mm = {{left + 2, card.height_mm - kMarginMm - kMarkerMm, right - left - 4, kMarkerMm},
                   {bar_left + 2, kMarginMm, bar_right - bar_left - 4, kMarkerMm}};
  return card;
}

std::optional<Card> CardInView(const std::vector<Card>& cards,
                               const std::vector<SeenMarker>& markers) {
  std::optional<Card> best;
  long most = 0;
  for (const Card& card : cards) {
    const long count = std::count_if(markers.begin(), markers.end(), [&](const SeenMarker& seen) {
      return std::isfinite(seen.corner_sigma_px) && card.Find(seen.id) != nullptr;
    });
    if (count > most) most = count, best = card;
  }
  return best;
}

}  // namespace bladecurve
