// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "samples/cut_run.h"

namespace bladecurve {

// What the pictures of a torque curve share, whatever they are drawn on. Lengths in pixels of an
// SVG; a bitmap has more.
constexpr double kPlotWidth = 920, kPlotHeight = 540;
constexpr double kPlotLeft = 78, kPlotRight = 30, kPlotTop = 96, kPlotBottom = 66;

struct PhaseStyle {
  Phase phase;
  unsigned rgb;  // told apart also by readers who do not see red from green (Okabe and Ito)
  const char* label;
};
constexpr std::array<PhaseStyle, 5> kPhaseStyles = {{{Phase::kNone, 0x8a8a8a, "no contact"},
                                                     {Phase::kDeformation, 0x0072b2, "deformation"},
                                                     {Phase::kCutting, 0xd55e00, "cutting"},
                                                     {Phase::kRelaxation, 0x009e73, "relaxation"},
                                                     {Phase::kThrough, 0xb5b5b5, "through"}}};
[[nodiscard]] const PhaseStyle& StyleOf(Phase phase);

struct PlotAxis {
  double from = 0, to = 1, step = 1;  // value at the left or lower end, at the other, between ticks
  [[nodiscard]] std::vector<double> Ticks() const;
};

struct PlotPoint {
  double x = 0, y = 0;
};

// The opening angle runs to the right as the scissors close, whichever way the motion begins; the
// torque upwards from 0.
struct PlotFrame {
  PlotAxis angle_deg, torque_nmm;

  [[nodiscard]] double X(double theta_deg) const;
  [[nodiscard]] double Y(double torque_nmm) const;
  [[nodiscard]] PlotPoint Place(const CutRow& row) const;
};
[[nodiscard]] PlotFrame FrameOf(const CutRun& run);

// A part of the curve within one phase. Points nearer than a third of a pixel to the one before are
// left out.
struct PlotStretch {
  Phase phase = Phase::kNone;
  std::vector<PlotPoint> points;
};
[[nodiscard]] std::vector<PlotStretch> StretchesOf(const CutRun& run, const PlotFrame& frame);

// Where the events are; none if there are so many that they would hide the curve.
[[nodiscard]] std::vector<PlotPoint> EventPlaces(const CutRun& run, const PlotFrame& frame);

// The phases that the run passes.
[[nodiscard]] std::vector<PhaseStyle> LegendOf(const CutRun& run);

// "0.3", where binary sums of steps would give "0.30000000000000004".
[[nodiscard]] std::string TickText(double value);

}  // namespace bladecurve
