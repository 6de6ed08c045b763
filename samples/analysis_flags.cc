// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/analysis_flags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <stdexcept>
#include <utility>

#include "model/degrees.h"
#include "samples/flag_values.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

std::optional<double> Positive(const std::string& flag, const std::optional<std::string>& text) {
  if (!text) return std::nullopt;
  const double value = ParseNumber(flag, *text);
  RequirePositive(flag, value);
  return value;
}

std::optional<double> Within(const std::string& flag,
                             const std::optional<std::string>& text,
                             const Bounds& bounds) {
  if (!text) return std::nullopt;
  const double value = ParseNumber(flag, *text);
  if (bounds.least > 0) RequirePositive(flag, value);
  RequireWithin(flag, value, bounds);
  return value;
}

std::filesystem::path RequireFile(const std::string& flag, const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw std::invalid_argument(
        fmt::format("{}: there is no file {}; name one that is there", flag, path));
  }
  return path;
}

// The flag that sets the scale; "" if none does. Two could contradict each other, and which one
// held would be a guess.
std::string ScaleFlag(const AnalysisFlags& flags) {
  const std::initializer_list<std::pair<const char*, bool>> scales = {
      {"--card", flags.card.has_value()},
      {"--marker-mm", flags.marker_mm.has_value()},
      {"--mm-per-px", flags.mm_per_px.has_value()},
      {"--dpi", flags.dpi.has_value()},
      {"--length-mm", flags.length_mm.has_value()},
      {"--units px", flags.units == "px"}};
  std::string first;
  for (const auto& [name, given] : scales) {
    if (!given) continue;
    if (!first.empty()) {
      throw std::invalid_argument(
          fmt::format("{} and {} each set the scale; give one of them", first, name));
    }
    first = name;
  }
  return first;
}

// What a flag says must not be passed over in silence. Without any scale a card may be in view.
void RequireOneOf(const char* flag,
                  const std::string& scale,
                  std::initializer_list<const char*> scales,
                  const char* why) {
  if (scale.empty() || std::find(scales.begin(), scales.end(), scale) != scales.end()) return;
  throw std::invalid_argument(fmt::format("{}: {}; {} has no use for it; leave it out, or give {}",
                                          flag,
                                          why,
                                          scale,
                                          fmt::join(scales, " or ")));
}

void RequireUsed(const AnalysisFlags& flags) {
  const std::string scale = ScaleFlag(flags);
  if (flags.print_scale)
    RequireOneOf("--print-scale", scale, {"--card"}, "says how large a card was printed");
  if (flags.plane_height_mm) {
    RequireOneOf("--plane-height-mm",
                 scale,
                 {"--card", "--marker-mm"},
                 "is the height of the blades over a printed sheet");
  }
  if (flags.camera) {
    RequireOneOf("--camera",
                 scale,
                 {"--card", "--marker-mm", "--mm-per-px", "--length-mm"},
                 "says how a lens bends a photograph");
  }
}

// A ratio near 1; the bar's length in mm is what people type.
double PrintScale(const std::string& text) {
  constexpr Bounds kPrinters = {0.7, 1.5};  // from A4 on A5 to A5 on A4
  const double value = ParseNumber("--print-scale", text);
  if (value > 100 * kPrinters.least && value < 100 * kPrinters.most) {
    throw std::invalid_argument(fmt::format(
        "--print-scale: is the bar's length over 100 mm; did you mean {}?", value / 100));
  }
  RequireWithin("--print-scale", value, kPrinters);
  return value;
}

ScaleOptions ScaleFromFlags(const AnalysisFlags& flags) {
  RequireUsed(flags);
  ScaleOptions scale;
  scale.mm_per_px = Within("--mm-per-px", flags.mm_per_px, {1e-5, 100});
  scale.dpi = Within("--dpi", flags.dpi, {1, 1e5});
  scale.length_mm = Within("--length-mm", flags.length_mm, {0.1, 1e4});
  scale.marker_mm = Within("--marker-mm", flags.marker_mm, {0.1, 1e4});
  if (flags.card)
    scale.card = *flags.card == "default" ? "default" : RequireFile("--card", *flags.card);
  if (flags.print_scale) scale.print_scale = PrintScale(*flags.print_scale);
  scale.plane_height_mm = Within("--plane-height-mm", flags.plane_height_mm, {-100, 1000});
  if (flags.camera) scale.camera = RequireFile("--camera", *flags.camera);
  scale.pixels = flags.units == "px";
  return scale;
}

ImageDirection DirectionFromName(const std::string& name) {
  if (name == "right") return ImageDirection::kRight;
  if (name == "left") return ImageDirection::kLeft;
  return name == "up" ? ImageDirection::kUp : ImageDirection::kDown;
}

SceneHints HintsFromFlags(const AnalysisFlags& flags) {
  SceneHints hints;
  if (flags.pivot) {
    const auto xy = ParseNumbers("--pivot", *flags.pivot, 2, "X,Y");
    hints.pivot_px = Eigen::Vector2d(xy[0], xy[1]);
  }
  if (flags.roi) {
    const auto box = ParseNumbers("--roi", *flags.roi, 4, "X,Y,W,H");
    RequirePositive("--roi width", box[2]);
    RequirePositive("--roi height", box[3]);
    hints.roi_px = {box[0], box[1], box[2], box[3]};
  }
  if (flags.tips_toward) hints.tips_toward = DirectionFromName(*flags.tips_toward);
  return hints;
}

std::vector<double> ThetaFromFlag(const std::optional<std::string>& theta_deg) {
  if (!theta_deg) return {};
  std::vector<double> theta_rad = ParseNumbers("--theta-deg", *theta_deg);
  for (double& angle : theta_rad) {
    RequireWithin("--theta-deg", angle, {0.1, 150});
    angle *= kRadPerDeg;
  }
  return theta_rad;
}

int DegreeFromFlag(const std::string& text) {
  const int degree = ParseWholeNumber("--degree", text);
  if (degree < 1 || degree > 5) {
    throw std::invalid_argument(fmt::format("--degree: must be 1 to 5, got {}", degree));
  }
  return degree;
}

// k inner knots part the edge into k + 1 polynomial pieces.
int SpansFromFlag(const std::string& text) {
  const int knots = ParseWholeNumber("--knots", text);
  if (knots < 0 || knots > 1000) {
    throw std::invalid_argument(fmt::format("--knots: must be 0 to 1000, got {}", knots));
  }
  return knots + 1;
}

FitOptions FitFromFlags(const AnalysisFlags& flags) {
  FitOptions fit;
  if (flags.family == "tapered-rectangle") fit.family = Family::kTaperedRectangle;
  if (flags.family == "rigid-spline") fit.family = Family::kRigidSpline;
  fit.gain = flags.gain == "free" ? std::nullopt : Positive("--gain", flags.gain);
  if (flags.degree) fit.degree = DegreeFromFlag(*flags.degree);
  if (flags.knots != "auto") fit.num_spans = SpansFromFlag(flags.knots);
  fit.loss = flags.loss;
  return fit;
}

int ThreadsFromFlag(const std::optional<std::string>& text) {
  if (!text) return UsableThreads();
  const int threads = ParseWholeNumber("--threads", *text);
  RequirePositive("--threads", threads);
  return threads;
}

void AddScaleFlags(CLI::App& command, AnalysisFlags* flags) {
  const char* group =
      "Scale (without any: a marker of the card if one is seen, else the file's own dpi)";
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->group(group);
  };
  add("--card", flags->card, "The printed card in the picture: FILE, or 'default'");
  add("--marker-mm",
      flags->marker_mm,
      "Side of the DICT_4X4_50 markers in the picture, mm: six of their cells");
  add("--mm-per-px", flags->mm_per_px, "Millimetres a pixel, as from a calibrated stand");
  add("--dpi", flags->dpi, "Pixels an inch of a flatbed scan");
  add("--length-mm", flags->length_mm, "Pivot to distal end of the upper blade, mm");
  add("--print-scale",
      flags->print_scale,
      "Measured length of the card's check bar over 100 mm, such as 0.985");
  add("--plane-height-mm",
      flags->plane_height_mm,
      "Height of the cutting edges above the sheet; without it: plane_height_unknown, 0 +- 2 mm");
  add("--camera", flags->camera, "CALIB.json: width, height, K, dist, as OpenCV means them");
  add("--units", flags->units, "mm, or px: measure in pixels and say so")
      ->check(CLI::IsMember({"mm", "px"}));
}

void AddHintFlags(CLI::App& command, AnalysisFlags* flags) {
  const char* group =
      "Hints (pixels of the picture as it is shown; all but --theta-deg hold for every PHOTO)";
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->group(group);
  };
  add("--theta-deg", flags->theta_deg, "Opening angle by protractor or encoder: T[,T...]");
  add("--pivot", flags->pivot, "The screw's centre: X,Y");
  add("--tips-toward", flags->tips_toward, "Where the tips point")
      ->check(CLI::IsMember({"right", "left", "up", "down"}));
  add("--roi", flags->roi, "The scissors to look at: X,Y,W,H");
  command
      .add_flag("--upper-is-left",
                flags->upper_is_left,
                "The upper blade is the left one, seen from the pivot: it always is (for scripts)")
      ->group(group);
}

void AddFitFlags(CLI::App& command, AnalysisFlags* flags) {
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->group("Fit");
  };
  add("--family", flags->family, "auto, tapered-rectangle or rigid-spline")
      ->check(CLI::IsMember({"auto", "tapered-rectangle", "rigid-spline"}));
  add("--gain", flags->gain, "Gain of the tapered form, or 'free' (two angles or more)");
  add("--degree", flags->degree, "Degree of the spline, 1 to 5");
  add("--knots", flags->knots, "Inner knots of the spline, or 'auto'");
  add("--loss", flags->loss, "none, huber, cauchy or tukey")
      ->check(CLI::IsMember({"none", "huber", "cauchy", "tukey"}));
}

}  // namespace

void AddAnalysisFlags(CLI::App& command, AnalysisFlags* flags) {
  AddScaleFlags(command, flags);
  AddHintFlags(command, flags);
  AddFitFlags(command, flags);
  command.add_option("--plan", flags->plan, "auto: leave out what a scene does not need; full")
      ->check(CLI::IsMember({"auto", "full"}));
}

AnalysisSettings SettingsFromFlags(const AnalysisFlags& flags) {
  AnalysisSettings settings;
  settings.measure.scale = ScaleFromFlags(flags);
  settings.measure.hints = HintsFromFlags(flags);
  if (flags.plan == "full") settings.measure.plan = Plan::kFull;
  if (flags.debug) settings.measure.debug_dir = *flags.debug;
  settings.theta_rad = ThetaFromFlag(flags.theta_deg);
  settings.fit = FitFromFlags(flags);
  settings.num_threads = ThreadsFromFlag(flags.threads);
  return settings;
}

std::vector<std::string> GivenArguments(const CLI::App& command) {
  // A fresh command knows which of the flags are analysis flags, and their order.
  CLI::App known;
  AnalysisFlags unused;
  AddAnalysisFlags(known, &unused);
  std::vector<std::string> arguments;
  for (const CLI::Option* option : std::as_const(known).get_options()) {
    const std::string name = option->get_name();
    const CLI::Option* given = command.get_option_no_throw(name);
    if (given == nullptr || given->count() == 0) continue;
    const bool is_switch = given->get_items_expected_max() == 0;
    arguments.push_back(is_switch ? name : name + "=" + given->results().front());
  }
  return arguments;
}

AnalysisFlags FlagsFromArguments(const std::vector<std::string>& arguments) {
  CLI::App command;
  AnalysisFlags flags;
  AddAnalysisFlags(command, &flags);
  try {
    // CLI11 takes arguments last one first.
    command.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument(
        fmt::format("flags '{}': {}", fmt::join(arguments, " "), error.what()));
  }
  return flags;
}

}  // namespace bladecurve
