// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/validation_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "samples/validation_table.h"

namespace bladecurve {
namespace {

constexpr int kColumns = 4;
constexpr double kPanelWidth = 320, kPanelHeight = 250, kLeft = 62, kTop = 30, kRight = 14,
                 kBottom = 44;
constexpr double kTitleHeight = 34;

// Whole decades around the values.
struct LogAxis {
  double low = 0, high = 1;  // powers of ten

  static LogAxis Around(const std::vector<double>& values) {
    LogAxis axis{.low = 300, .high = -300};
    for (const double value : values) {
      axis.low = std::min(axis.low, std::floor(std::log10(value)));
      axis.high = std::max(axis.high, std::ceil(std::log10(value)));
    }
    if (axis.low > axis.high) return {};
    if (axis.low == axis.high) axis.high += 1;
    return axis;
  }
  [[nodiscard]] double Share(double value) const {
    return (std::log10(value) - low) / (high - low);
  }
};

struct Panel {
  double left = 0, top = 0;  // of the plotting area
  LogAxis x, y;

  [[nodiscard]] double X(double value) const {
    return left + x.Share(value) * (kPanelWidth - kLeft - kRight);
  }
  [[nodiscard]] double Y(double value) const {
    return top + (1 - y.Share(value)) * (kPanelHeight - kTop - kBottom);
  }
};

std::string Grid(const Panel& panel) {
  std::string svg;
  const double x0 = panel.X(std::pow(10, panel.x.low)), x1 = panel.X(std::pow(10, panel.x.high));
  const double y0 = panel.Y(std::pow(10, panel.y.low)), y1 = panel.Y(std::pow(10, panel.y.high));
  for (double power = panel.x.low; power <= panel.x.high; ++power) {
    const double x = panel.X(std::pow(10, power));
    svg += fmt::format(
        "<path class='grid' d='M{:.1f} {:.1f}V{:.1f}'/><text x='{:.1f}' y='{:.1f}' "
        "text-anchor='middle'>{}</text>\n",
        x,
        y0,
        y1,
        x,
        y0 + 15,
        std::pow(10, power));
  }
  for (double power = panel.y.low; power <= panel.y.high; ++power) {
    const double y = panel.Y(std::pow(10, power));
    svg += fmt::format(
        "<path class='grid' d='M{:.1f} {:.1f}H{:.1f}'/><text x='{:.1f}' y='{:.1f}' "
        "text-anchor='end'>{}</text>\n",
        x0,
        y,
        x1,
        x0 - 5,
        y + 4,
        std::pow(10, power));
  }
  return svg;
}

bool Drawable(const ValidationRow& row, Quantity quantity) {
  const double size = row.Of(quantity).size;
  return row.measured() && row.expected == "ok" && row.ms > 0 && size > 0 && std::isfinite(size);
}

std::string DrawPanel(const std::vector<ValidationRow>& rows,
                      Quantity quantity,
                      double left,
                      double top) {
  std::vector<double> ms, sizes;
  for (const ValidationRow& row : rows) {
    if (!Drawable(row, quantity)) continue;
    ms.push_back(row.ms);
    sizes.push_back(row.Of(quantity).size);
  }
  const Panel panel{.left = left + kLeft,
                    .top = top + kTop,
                    .x = LogAxis::Around(ms),
                    .y = LogAxis::Around(sizes)};
  std::string svg = fmt::format("<text class='title' x='{:.1f}' y='{:.1f}'>{} error, {}</text>\n",
                                left + kLeft,
                                top + kTop - 9,
                                QuantityName(quantity),
                                QuantityUnit(quantity)) +
                    Grid(panel);
  for (const ValidationRow& row : rows) {
    if (!Drawable(row, quantity)) continue;
    svg += fmt::format(
        "<circle class='{}' cx='{:.1f}' cy='{:.1f}' r='2.6'><title>scene {}</title></circle>\n",
        row.outcome,
        panel.X(row.ms),
        panel.Y(row.Of(quantity).size),
        row.scene);
  }
  return svg + fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>ms</text>\n",
                           left + kLeft + (kPanelWidth - kLeft - kRight) / 2,
                           top + kPanelHeight - 12);
}

std::string Caption(const std::vector<ValidationRow>& rows) {
  int measured = 0, refused = 0, due = 0;
  for (const ValidationRow& row : rows) {
    if (row.expected != "ok") {
      ++due;
    } else {
      ++(row.measured() ? measured : refused);
    }
  }
  return fmt::format(
      "{} scenes measured (blue: ok, orange: review), {} refused though measurable, {} that must "
      "be refused",
      measured,
      refused,
      due);
}

}  // namespace

std::string WorkPrecisionSvg(const std::vector<ValidationRow>& rows) {
  const double width = kColumns * kPanelWidth;
  const int panel_rows = (kQuantities + kColumns - 1) / kColumns;
  const double height = kTitleHeight + panel_rows * kPanelHeight;
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {} {}' font-family='sans-serif' "
      "font-size='11'>\n"
      "<style>.grid{{stroke:#ddd;fill:none}}.title{{font-weight:bold;font-size:12px}}"
      ".ok{{fill:#0072b2;fill-opacity:.6}}.review{{fill:#d55e00;fill-opacity:.6}}</style>\n"
      "<rect width='100%' height='100%' fill='white'/>\n<text x='{}' y='20' "
      "class='title'>{}</text>\n",
      width,
      height,
      kLeft,
      Caption(rows));
  for (int i = 0; i < kQuantities; ++i) {
    svg += DrawPanel(rows,
                     static_cast<Quantity>(i),
                     i % kColumns * kPanelWidth,
                     kTitleHeight + i / kColumns * kPanelHeight);
  }
  return svg + "</svg>\n";
}

}  // namespace bladecurve
