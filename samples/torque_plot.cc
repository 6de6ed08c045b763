// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/torque_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace bladecurve {
namespace {

constexpr double kDegPerRad = 180 / std::numbers::pi;
constexpr double kWidth = 920, kHeight = 540;
constexpr double kLeft = 78, kRight = 30, kTop = 96, kBottom = 66;

struct PhaseStyle {
  Phase phase;
  const char* colour;  // told apart also by readers who do not see red from green (Okabe and Ito)
  const char* label;
};
constexpr std::array<PhaseStyle, 5> kStyles = {{{Phase::kNone, "#8a8a8a", "no contact"},
                                                {Phase::kDeformation, "#0072b2", "deformation"},
                                                {Phase::kCutting, "#d55e00", "cutting"},
                                                {Phase::kRelaxation, "#009e73", "relaxation"},
                                                {Phase::kThrough, "#b5b5b5", "through"}}};

struct Axis {
  double from = 0, to = 1, step = 1;  // value at the left or lower end, at the other, between ticks
};

struct Frame {
  Axis x, y;

  [[nodiscard]] double X(double value) const {
    return kLeft + (value - x.from) / (x.to - x.from) * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double Y(double value) const {
    return kHeight - kBottom - (value - y.from) / (y.to - y.from) * (kHeight - kTop - kBottom);
  }
};

// 1, 2 or 5 times a power of ten, so that about `count` of them fill the range.
double TickStep(double range, int count) {
  const double raw = range / count;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10 * power;
}

// Closing runs to the right, whichever way the motion begins.
Axis AngleAxis(const CutRun& run) {
  double low = run.rows.front().motion.theta_deg, high = low;
  for (const CutRow& row : run.rows) {
    low = std::min(low, row.motion.theta_deg);
    high = std::max(high, row.motion.theta_deg);
  }
  if (high - low < 1e-6) high = low + 1;  // a motion of the pivot alone
  return {high, low, TickStep(high - low, 8)};
}

Axis TorqueAxis(const CutRun& run) {
  double high = 0;
  for (const CutRow& row : run.rows) high = std::max(high, row.cut.torque_nmm);
  if (high <= 0) high = 1;
  const double step = TickStep(1.05 * high, 6);
  return {0, std::ceil(1.05 * high / step) * step, step};
}

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

// Ticks are multiples of the step: rounding hides the binary tail of 0.1 + 0.2.
std::string TickText(double value) {
  return fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

std::string AxesSvg(const Frame& frame) {
  std::string svg = "<g class='axes'>\n";
  const double bottom = frame.Y(frame.y.from), right = kWidth - kRight;
  const int rows = static_cast<int>(std::lround((frame.y.to - frame.y.from) / frame.y.step));
  for (int i = 0; i <= rows; ++i) {
    const double value = frame.y.from + i * frame.y.step;
    svg +=
        fmt::format("<path class='grid' d='M{:.1f} {:.1f}H{:.1f}'/>", kLeft, frame.Y(value), right);
    svg += fmt::format("<text class='tick' x='{:.1f}' y='{:.1f}' text-anchor='end'>{}</text>\n",
                       kLeft - 10,
                       frame.Y(value) + 4.5,
                       TickText(value));
  }
  const double low = std::min(frame.x.from, frame.x.to), high = std::max(frame.x.from, frame.x.to);
  const double first = std::ceil(low / frame.x.step - 1e-9) * frame.x.step;
  for (double value = first; value <= high + 1e-9 * frame.x.step; value += frame.x.step) {
    svg += fmt::format("<path class='mark' d='M{:.1f} {:.1f}v6'/>", frame.X(value), bottom);
    svg += fmt::format("<text class='tick' x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                       frame.X(value),
                       bottom + 22,
                       TickText(value));
  }
  svg += fmt::format("<path class='mark' d='M{:.1f} {:.1f}H{:.1f}'/>\n", kLeft, bottom, right);
  svg += fmt::format(
      "<text class='name' x='{:.1f}' y='{:.1f}' text-anchor='middle'>opening angle θ, degrees "
      "(closing →)</text>\n",
      0.5 * (kLeft + right),
      kHeight - 16);
  svg += fmt::format(
      "<text class='name' transform='translate(24 {:.1f}) rotate(-90)' text-anchor='middle'>torque "
      "τ, "
      "N·mm</text>\n</g>\n",
      0.5 * (kTop + bottom));
  return svg;
}

const PhaseStyle& StyleOf(Phase phase) {
  return *std::find_if(
      kStyles.begin(), kStyles.end(), [phase](const PhaseStyle& s) { return s.phase == phase; });
}

// The line of one phase from row `first` on; `end` becomes the row where the next phase begins.
// Points nearer than a third of a pixel to the one before are left out.
std::string PhaseLine(const CutRun& run, const Frame& frame, std::size_t first, std::size_t end) {
  constexpr double kNear_px = 0.33;
  std::string points;
  double last_x = -1e9, last_y = -1e9;
  const auto add = [&](double theta_deg, double torque_nmm, bool always) {
    const double x = frame.X(theta_deg), y = frame.Y(torque_nmm);
    if (!always && std::hypot(x - last_x, y - last_y) < kNear_px) return;
    points += fmt::format("{:.2f},{:.2f} ", x, y);
    last_x = x;
    last_y = y;
  };
  for (std::size_t i = first; i < end; ++i) {
    add(run.rows[i].motion.theta_deg, run.rows[i].cut.torque_nmm, i == first || i + 1 == end);
  }
  return fmt::format(
      "<polyline stroke='{}' points='{}'/>\n", StyleOf(run.rows[first].cut.phase).colour, points);
}

// A thin line from the last sample of a phase to the first of the next: the jumps.
std::string JoinLine(const CutRow& before, const CutRow& after, const Frame& frame) {
  return fmt::format("<path class='join' stroke='{}' d='M{:.2f} {:.2f}L{:.2f} {:.2f}'/>\n",
                     StyleOf(after.cut.phase).colour,
                     frame.X(before.motion.theta_deg),
                     frame.Y(before.cut.torque_nmm),
                     frame.X(after.motion.theta_deg),
                     frame.Y(after.cut.torque_nmm));
}

std::string CurveSvg(const CutRun& run, const Frame& frame) {
  std::string svg = "<g class='curve'>\n";
  for (std::size_t first = 0, end = 0; first < run.rows.size(); first = end) {
    while (end < run.rows.size() && run.rows[end].cut.phase == run.rows[first].cut.phase) ++end;
    svg += PhaseLine(run, frame, first, end);
    if (end < run.rows.size()) svg += JoinLine(run.rows[end - 1], run.rows[end], frame);
  }
  return svg + "</g>\n";
}

std::string EventsSvg(const CutRun& run, const Frame& frame) {
  constexpr std::size_t kMostMarks = 40;  // more would hide the curve
  if (run.events.size() > kMostMarks) return "";
  std::string svg = "<g class='event'>\n";
  for (const TorqueEvent& event : run.events) {
    const double x = frame.X(event.theta_rad * kDegPerRad);
    svg +=
        fmt::format("<circle cx='{:.2f}' cy='{:.2f}' r='4'><title>θ = {:.4f}°</title></circle>\n",
                    x,
                    frame.Y(std::max(event.torque_before_nmm, event.torque_after_nmm)),
                    event.theta_rad * kDegPerRad);
  }
  return svg + "</g>\n";
}

std::string LegendSvg(const CutRun& run) {
  std::string svg = "<g class='legend'>\n";
  double x = kLeft;
  for (const PhaseStyle& style : kStyles) {
    const auto has = [&](const CutRow& row) { return row.cut.phase == style.phase; };
    if (std::none_of(run.rows.begin(), run.rows.end(), has)) continue;
    svg += fmt::format(
        "<path d='M{:.0f} 66h26' stroke='{}' stroke-width='4'/><text x='{:.0f}' y='71'>{}</text>\n",
        x,
        style.colour,
        x + 34,
        style.label);
    x += 60 + 8.2 * static_cast<double>(std::string_view(style.label).size());
  }
  return svg + "</g>\n";
}

constexpr const char* kStyleSheet = R"(<style>
text{font-family:system-ui,'Helvetica Neue',Arial,sans-serif;fill:#222}
.title{font-size:19px;font-weight:600}.name{font-size:15px}.tick,.legend text{font-size:14px}
.grid{stroke:#e4e4e4}.mark{stroke:#444}.axes path,.curve *,.legend path{fill:none}
.curve polyline{stroke-width:2.6;stroke-linejoin:round;stroke-linecap:round}
.curve .join{stroke-width:1.4;stroke-dasharray:4 3}.event circle{fill:#fff;stroke:#222;stroke-width:1.6}
</style>
)";

}  // namespace

std::string TorquePlotSvg(const CutRun& run, const std::string& title) {
  const Frame frame{AngleAxis(run), TorqueAxis(run)};
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:.0f} {1:.0f}' width='{0:.0f}' "
      "height='{1:.0f}'>\n",
      kWidth,
      kHeight);
  svg += kStyleSheet;
  svg += "<rect width='100%' height='100%' fill='#fff'/>\n";
  svg += fmt::format("<text class='title' x='{:.0f}' y='36'>{}</text>\n", kLeft, Escaped(title));
  return svg + LegendSvg(run) + AxesSvg(frame) + CurveSvg(run, frame) + EventsSvg(run, frame) +
         "</svg>\n";
}

}  // namespace bladecurve
