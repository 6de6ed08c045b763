// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/torque_plot.h"

#include <fmt/format.h>

#include "samples/torque_plot_frame.h"

namespace bladecurve {
namespace {

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

std::string ColourOf(Phase phase) { return fmt::format("#{:06x}", StyleOf(phase).rgb); }

std::string TorqueAxisSvg(const PlotFrame& frame) {
  const double right = kPlotWidth - kPlotRight;
  std::string svg;
  for (const double value : frame.torque_nmm.Ticks()) {
    svg += fmt::format(
        "<path class='grid' d='M{:.1f} {:.1f}H{:.1f}'/>", kPlotLeft, frame.Y(value), right);
    svg += fmt::format("<text class='tick' x='{:.1f}' y='{:.1f}' text-anchor='end'>{}</text>\n",
                       kPlotLeft - 10,
                       frame.Y(value) + 4.5,
                       TickText(value));
  }
  svg += fmt::format(
      "<text class='name' transform='translate(24 {:.1f}) rotate(-90)' text-anchor='middle'>torque "
      "τ, N·mm</text>\n",
      0.5 * (kPlotTop + frame.Y(0)));
  return svg;
}

std::string AngleAxisSvg(const PlotFrame& frame) {
  const double bottom = frame.Y(0), right = kPlotWidth - kPlotRight;
  std::string svg;
  for (const double value : frame.angle_deg.Ticks()) {
    svg += fmt::format("<path class='mark' d='M{:.1f} {:.1f}v6'/>", frame.X(value), bottom);
    svg += fmt::format("<text class='tick' x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                       frame.X(value),
                       bottom + 22,
                       TickText(value));
  }
  svg += fmt::format("<path class='mark' d='M{:.1f} {:.1f}H{:.1f}'/>\n", kPlotLeft, bottom, right);
  svg += fmt::format(
      "<text class='name' x='{:.1f}' y='{:.1f}' text-anchor='middle'>opening angle θ, degrees "
      "(closing →)</text>\n",
      0.5 * (kPlotLeft + right),
      kPlotHeight - 16);
  return svg;
}

std::string StretchSvg(const PlotStretch& stretch) {
  std::string points;
  for (const PlotPoint& p : stretch.points) points += fmt::format("{:.2f},{:.2f} ", p.x, p.y);
  return fmt::format("<polyline stroke='{}' points='{}'/>\n", ColourOf(stretch.phase), points);
}

// A thin line from the last sample of a phase to the first of the next: the jumps.
std::string JoinSvg(const PlotStretch& before, const PlotStretch& after) {
  const PlotPoint from = before.points.back(), to = after.points.front();
  return fmt::format("<path class='join' stroke='{}' d='M{:.2f} {:.2f}L{:.2f} {:.2f}'/>\n",
                     ColourOf(after.phase),
                     from.x,
                     from.y,
                     to.x,
                     to.y);
}

std::string CurveSvg(const std::vector<PlotStretch>& stretches) {
  std::string svg = "<g class='curve'>\n";
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    if (i > 0) svg += JoinSvg(stretches[i - 1], stretches[i]);
    svg += StretchSvg(stretches[i]);
  }
  return svg + "</g>\n";
}

std::string EventsSvg(const std::vector<PlotPoint>& places) {
  std::string svg = "<g class='event'>\n";
  for (const PlotPoint& p : places)
    svg += fmt::format("<circle cx='{:.2f}' cy='{:.2f}' r='4'/>\n", p.x, p.y);
  return svg + "</g>\n";
}

std::string LegendSvg(const std::vector<PhaseStyle>& legend) {
  std::string svg = "<g class='legend'>\n";
  double x = kPlotLeft;
  for (const PhaseStyle& style : legend) {
    svg += fmt::format(
        "<path d='M{:.0f} 66h26' stroke='{}' stroke-width='4'/><text x='{:.0f}' y='71'>{}</text>\n",
        x,
        ColourOf(style.phase),
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
  const PlotFrame frame = FrameOf(run);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:.0f} {1:.0f}' width='{0:.0f}' "
      "height='{1:.0f}'>\n",
      kPlotWidth,
      kPlotHeight);
  svg += kStyleSheet;
  svg += "<rect width='100%' height='100%' fill='#fff'/>\n";
  svg +=
      fmt::format("<text class='title' x='{:.0f}' y='36'>{}</text>\n", kPlotLeft, Escaped(title));
  svg += LegendSvg(LegendOf(run));
  svg += "<g class='axes'>\n" + TorqueAxisSvg(frame) + AngleAxisSvg(frame) + "</g>\n";
  return svg + CurveSvg(StretchesOf(run, frame)) + EventsSvg(EventPlaces(run, frame)) + "</svg>\n";
}

}  // namespace bladecurve
