// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/torque_plot_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/degrees.h"

namespace bladecurve {
namespace {

// 1, 2 or 5 times a power of ten, so that about `count` of them fill the range.
double TickStep(double range, int count) {
  const double raw = range / count;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10 * power;
}

PlotAxis AngleAxis(const CutRun& run) {
  double low = run.rows.front().motion.theta_deg, high = low;
  for (const CutRow& row : run.rows) {
    low = std::min(low, row.motion.theta_deg);
    high = std::max(high, row.motion.theta_deg);
  }
  if (high - low < 1e-6) high = low + 1;  // a motion of the pivot alone
  return {high, low, TickStep(high - low, 8)};
}

PlotAxis TorqueAxis(const CutRun& run) {
  double high = 0;
  for (const CutRow& row : run.rows) high = std::max(high, row.cut.torque_nmm);
  if (high <= 0) high = 1;
  const double step = TickStep(1.05 * high, 6);
  return {0, std::ceil(1.05 * high / step) * step, step};
}

PlotStretch StretchOf(const CutRun& run,
                      const PlotFrame& frame,
                      std::size_t first,
                      std::size_t end) {
  constexpr double kNear_px = 0.33;
  PlotStretch stretch{run.rows[first].cut.phase, {}};
  for (std::size_t i = first; i < end; ++i) {
    const PlotPoint place = frame.Place(run.rows[i]);
    const bool is_end = i == first || i + 1 == end;
    if (!is_end && std::hypot(place.x - stretch.points.back().x,
                              place.y - stretch.points.back().y) < kNear_px) {
      continue;
    }
    stretch.points.push_back(place);
  }
  return stretch;
}

}  // namespace

const PhaseStyle& StyleOf(Phase phase) {
  return *std::find_if(kPhaseStyles.begin(), kPhaseStyles.end(), [phase](const PhaseStyle& s) {
    return s.phase == phase;
  });
}

std::vector<double> PlotAxis::Ticks() const {
  const double low = std::min(from, to), high = std::max(from, to);
  std::vector<double> ticks;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    ticks.push_back(i * step);
  return ticks;
}

double PlotFrame::X(double theta_deg) const {
  const double share = (theta_deg - angle_deg.from) / (angle_deg.to - angle_deg.from);
  return kPlotLeft + share * (kPlotWidth - kPlotLeft - kPlotRight);
}

double PlotFrame::Y(double torque) const {
  const double share = (torque - torque_nmm.from) / (torque_nmm.to - torque_nmm.from);
  return kPlotHeight - kPlotBottom - share * (kPlotHeight - kPlotTop - kPlotBottom);
}

PlotPoint PlotFrame::Place(const CutRow& row) const {
  return {X(row.motion.theta_deg), Y(row.cut.torque_nmm)};
}

PlotFrame FrameOf(const CutRun& run) { return {AngleAxis(run), TorqueAxis(run)}; }

std::vector<PlotStretch> StretchesOf(const CutRun& run, const PlotFrame& frame) {
  std::vector<PlotStretch> stretches;
  for (std::size_t first = 0, end = 0; first < run.rows.size(); first = end) {
    while (end < run.rows.size() && run.rows[end].cut.phase == run.rows[first].cut.phase) ++end;
    stretches.push_back(StretchOf(run, frame, first, end));
  }
  return stretches;
}

std::vector<PlotPoint> EventPlaces(const CutRun& run, const PlotFrame& frame) {
  constexpr std::size_t kMostMarks = 40;
  if (run.events.size() > kMostMarks) return {};
  std::vector<PlotPoint> places;
  places.reserve(run.events.size());
  for (const TorqueEvent& event : run.events) {
    const double torque_nmm = std::max(event.torque_before_nmm, event.torque_after_nmm);
    places.push_back({frame.X(event.theta_rad * kDegPerRad), frame.Y(torque_nmm)});
  }
  return places;
}

std::vector<PhaseStyle> LegendOf(const CutRun& run) {
  std::vector<PhaseStyle> legend;
  for (const PhaseStyle& style : kPhaseStyles) {
    const auto has = [&](const CutRow& row) { return row.cut.phase == style.phase; };
    if (std::any_of(run.rows.begin(), run.rows.end(), has)) legend.push_back(style);
  }
  return legend;
}

std::string TickText(double value) {
  return fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

}  // namespace bladecurve
