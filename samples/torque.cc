// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/torque.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "model/blade_file.h"
#include "model/degrees.h"
#include "samples/commands.h"
#include "samples/cut_run.h"
#include "samples/flag_values.h"
#include "samples/material_choice.h"
#include "samples/torque_plot.h"
#include "samples/torque_realtime.h"
#include "vision/photo/png_writer.h"
#include "vision/photo/whole_file.h"

namespace bladecurve {
namespace {

constexpr double kSampleWidth_mm = 23;  // of the plates that the paper cut

struct TorqueCommand {
  std::string blade, material, policy = "constant", close_deg, motion, friction, csv, plot;
  double rate_deg_per_s = 3;  // the paper's
  double rate_hz = 1000;      // a haptic loop's
  std::optional<double> x_edge_mm, x_end_mm, radius_mm;
  Fluctuation fluctuation;
  double seconds = 0;            // of --realtime; 0: one closing
  double damping_n_s_per_m = 5;  // of a relaxed finger and a light device
  bool is_real_time = false, quiet = false;
};

std::vector<double> ParseAngles(const std::string& text) {
  std::string commas = text;
  for (char& c : commas) c = c == ':' ? ',' : c;
  return ParseNumbers("--close-deg", commas);
}

std::vector<MotionSample> MotionOf(const TorqueCommand& command, double radius_mm) {
  if (command.motion.empty() == command.close_deg.empty()) {
    throw std::invalid_argument("give either --close-deg A:B or --motion FILE.csv");
  }
  if (!command.motion.empty()) return ReadMotion(command.motion, radius_mm);
  return CloseAtRate(ParseAngles(command.close_deg), command.rate_deg_per_s, command.rate_hz);
}

// Where the plate lies if nobody says: the blade touches its edge after a tenth of the first
// stretch of motion, so that every phase of a cut can be seen.
double DefaultPlateEdge(const BladeCurve& blade,
                        double thickness_mm,
                        const std::vector<MotionSample>& motion) {
  std::size_t turn = 1;
  while (turn + 1 < motion.size() && motion[turn + 1].theta_deg < motion[turn].theta_deg) ++turn;
  turn = std::min(turn, motion.size() - 1);
  const double theta_rad = std::lerp(motion.front().theta_rad(), motion[turn].theta_rad(), 0.1);
  std::array<double, 1> x_mm;
  if (blade.Contacts(0.5 * thickness_mm, theta_rad, x_mm) < 1 || x_mm[0] <= 0) {
    throw std::invalid_argument(
        fmt::format("--x-edge-mm: the blade meets no plate at {:.4g} deg; say how far from the "
                    "pivot the plate begins",
                    theta_rad / kRadPerDeg));
  }
  return x_mm[0];
}

PlateSpan SpanOf(const TorqueCommand& command,
                 const BladeCurve& blade,
                 const Material& material,
                 const std::vector<MotionSample>& motion) {
  const double edge_mm = command.x_edge_mm.value_or(std::numeric_limits<double>::quiet_NaN());
  PlateSpan span;
  span.edge_mm =
      command.x_edge_mm ? edge_mm : DefaultPlateEdge(blade, material.thickness_mm, motion);
  span.end_mm = command.x_end_mm.value_or(span.edge_mm + kSampleWidth_mm);
  return span;
}

TorqueOptions OptionsOf(const TorqueCommand& command) {
  TorqueOptions options;
  options.delta_policy =
      command.policy == "criterion" ? DeltaPolicy::kCriterion : DeltaPolicy::kConstant;
  options.longest_step_s = std::numeric_limits<double>::infinity();  // a file tells its whole path
  options.fluctuation = command.fluctuation;
  return options;
}

std::string HeadLine(const BladeFile& blade,
                     const Material& material,
                     const PlateSpan& span,
                     const std::string& policy) {
  return fmt::format(
      "{} through {} (J_c {} kJ/m2, h {} mm), plate from {:.6g} to {:.6g} mm, delta policy {}\n",
      blade.name,
      material.name,
      material.toughness_n_per_mm,
      material.thickness_mm,
      span.edge_mm,
      span.end_mm,
      policy);
}

void Deliver(const std::string& file, const std::string& text) {
  if (file.empty()) return;
  if (file == "-") {
    std::cout << text;
  } else {
    WriteFileWhole(file, text);
  }
}

void Plot(const std::string& file, const CutRun& run, const std::string& title) {
  if (file.ends_with(".png")) {
    WritePng(file, TorquePlotBitmap(run, title));
  } else {
    Deliver(file, TorquePlotSvg(run, title));
  }
}

// Drives the model in real time and gives the motion that the simulated hand made of the wanted
// one.
std::vector<MotionSample> MotionInRealTime(const TorqueCommand& command,
                                           const TorqueModel& model,
                                           const PlateSpan& span,
                                           const std::optional<FrictionCurve>& friction,
                                           const std::vector<MotionSample>& wanted) {
  RealTimeOptions options;
  options.friction = friction;
  options.rate_hz = command.rate_hz;
  options.seconds = command.seconds;
  options.radius_mm = command.radius_mm.value_or(0);
  options.hand.damping_n_s_per_mm = command.damping_n_s_per_m / 1000;
  const Material& material = model.material();
  const HeldScissors held{model.blade(), span, material.thickness_mm, options.radius_mm};
  RealTimeRun run = RunRealTime(model, wanted, options);
  if (!command.quiet) {
    std::cerr << RealTimeSummary(run,
                                 options,
                                 LargestStableStiffness(held, options.hand, options.rate_hz),
                                 material.force_deflection.initial_stiffness_n_per_mm());
  }
  return run.motion;
}

void RequirePossible(const TorqueCommand& command) {
  if (command.radius_mm) RequirePositive("--radius-mm", *command.radius_mm);
  const std::string& plot = command.plot;
  if (!plot.empty() && !plot.ends_with(".svg") && !plot.ends_with(".png"))
    throw std::invalid_argument("--plot: give a name that ends in .svg or .png, not " + plot);
  if (!command.is_real_time) return;
  RequirePositive("--damping-n-s-per-m", command.damping_n_s_per_m);
  if (command.seconds != 0) RequirePositive("--seconds", command.seconds);
  if (!command.radius_mm)
    throw std::invalid_argument("--realtime: a hand holds a handle; give --radius-mm");
  if (!command.motion.empty())
    throw std::invalid_argument("--realtime: the hand makes the motion; give --close-deg");
}

void RunTorque(const TorqueCommand& command) {
  RequirePossible(command);
  const double radius_mm = command.radius_mm.value_or(std::numeric_limits<double>::quiet_NaN());
  const BladeFile blade = ReadBladeFile(command.blade);
  RequireMillimetres(blade);
  const Material material = ChooseMaterial(command.material);
  std::vector<MotionSample> motion = MotionOf(command, radius_mm);
  const PlateSpan span = SpanOf(command, blade.curve, material, motion);
  std::optional<FrictionCurve> friction;
  if (!command.friction.empty()) friction = FrictionOfTable(ReadNumberTable(command.friction));
  const TorqueModel model(blade.curve, material, span, OptionsOf(command));

  if (!command.quiet) std::cerr << HeadLine(blade, material, span, command.policy);
  if (command.is_real_time) motion = MotionInRealTime(command, model, span, friction, motion);
  const CutRun run = RunCut(model, motion, radius_mm, friction);
  if (!command.quiet) std::cerr << CutSummary(run);
  Deliver(command.csv, CutCsv(run));
  Plot(command.plot, run, blade.name + " through " + material.name);
}

void AddPlateFlags(CLI::App& sub, TorqueCommand& command) {
  constexpr const char* kGroup = "Blade and plate";
  std::string names;
  for (const std::string& name : MaterialNames()) names += (names.empty() ? "" : ", ") + name;
  sub.add_option("BLADE", command.blade, "NAME.blade.json, or a plugin exported from one")
      ->required();
  sub.add_option("--material", command.material, names + ", or a material file")
      ->required()
      ->group(kGroup);
  sub.add_option("--x-edge-mm",
                 command.x_edge_mm,
                 "from the pivot to where the plate begins (default: touched after a tenth of the "
                 "way)")
      ->group(kGroup);
  sub.add_option("--x-end-mm", command.x_end_mm, "to where it ends (default: 23 mm further)")
      ->group(kGroup);
  sub.add_option("--policy",
                 command.policy,
                 "the plate's deflection while it is cut: constant (default) or criterion")
      ->check(CLI::IsMember({"constant", "criterion"}))
      ->group(kGroup);
}

void AddHandleFlags(CLI::App& sub, TorqueCommand& command) {
  constexpr const char* kGroup = "Handle";
  sub.add_option("--radius-mm",
                 command.radius_mm,
                 "from the pivot to the handle; without it force_n stays empty")
      ->group(kGroup);
  sub.add_option("--friction",
                 command.friction,
                 "CSV of the empty scissors: theta_deg, closing_n, perhaps opening_n")
      ->group(kGroup);
}

void AddFluctuationFlags(CLI::App& sub, Fluctuation& fluctuation) {
  constexpr const char* kGroup = "Fluctuation of the cutting torque";
  sub.add_option("--rupture-mm", fluctuation.rupture_mm, "mean length of a rupture (default: none)")
      ->group(kGroup);
  sub.add_option("--rupture-spread",
                 fluctuation.spread,
                 "ruptures vary by up to this share of their mean, below 1")
      ->capture_default_str()
      ->group(kGroup);
  sub.add_option("--seed", fluctuation.seed, "of the ruptures")
      ->capture_default_str()
      ->group(kGroup);
}

void AddMotionFlags(CLI::App& sub, TorqueCommand& command) {
  constexpr const char* kGroup = "Motion: one of the first two";
  sub.add_option("--close-deg",
                 command.close_deg,
                 "opening angles A:B to close from and to; A:B:C opens again")
      ->group(kGroup);
  sub.add_option("--motion",
                 command.motion,
                 "CSV of a recorded motion: t_s, theta_deg, perhaps pivot_mm; a force_n or "
                 "torque_nmm in it is compared with the predicted one")
      ->group(kGroup);
  sub.add_option("--rate-deg-per-s", command.rate_deg_per_s, "how fast to close")
      ->capture_default_str()
      ->group(kGroup);
  sub.add_option("--rate-hz", command.rate_hz, "samples a second")
      ->capture_default_str()
      ->group(kGroup);
}

void AddRealTimeFlags(CLI::App& sub, TorqueCommand& command) {
  constexpr const char* kGroup = "Real time";
  sub.add_flag("--realtime",
               command.is_real_time,
               "close by a simulated hand against the clock, at --rate-hz; tells times, missed "
               "deadlines and the stiffest plate that is stable")
      ->group(kGroup);
  sub.add_option("--seconds",
                 command.seconds,
                 "how long, through one plate after the other (default: one closing)")
      ->group(kGroup);
  sub.add_option("--damping-n-s-per-m", command.damping_n_s_per_m, "of hand and device")
      ->capture_default_str()
      ->group(kGroup);
}

void AddOutputFlags(CLI::App& sub, TorqueCommand& command) {
  constexpr const char* kGroup = "Output";
  sub.add_option("--csv", command.csv, "the curve as CSV; - for standard output")->group(kGroup);
  sub.add_option("--plot", command.plot, "the curve as a picture, FILE.svg or FILE.png")
      ->group(kGroup);
  sub.add_flag("--quiet", command.quiet, "no summary")->group(kGroup);
}

}  // namespace

void AddTorque(CLI::App& app, int* exit_code) {
  auto command = std::make_shared<TorqueCommand>();
  CLI::App* sub = app.add_subcommand("torque", "Cut a plate and tell the torque");
  AddPlateFlags(*sub, *command);
  AddMotionFlags(*sub, *command);
  AddHandleFlags(*sub, *command);
  AddFluctuationFlags(*sub, command->fluctuation);
  AddRealTimeFlags(*sub, *command);
  AddOutputFlags(*sub, *command);
  sub->callback([command, exit_code] {
    RunTorque(*command);
    *exit_code = kExitOk;
  });
}

}  // namespace bladecurve
