// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/torque_realtime.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "model/degrees.h"
#include "samples/flag_values.h"

namespace bladecurve {
namespace {

using Clock = std::chrono::steady_clock;
using Microseconds = std::chrono::duration<double, std::micro>;

constexpr double kMostTicks = 1e7;  // 160 MB of times
constexpr double kPlay_mm = 0.05;   // of the handle before it slides: far below what a hand feels

// The hand, and the scissors in it.
class HeldModel {
 public:
  HeldModel(TorqueModel model, const std::vector<MotionSample>& wanted, const RealTimeOptions& o)
      : model_(std::move(model)),
        wanted_(wanted),
        radius_mm_(o.radius_mm),
        tick_s_(1 / o.rate_hz),
        hand_(o.hand, tick_s_),
        friction_(o.friction) {}

  [[nodiscard]] bool is_through_path() const { return tick_ == wanted_.size(); }
  [[nodiscard]] MotionSample now() const {
    return {static_cast<double>(tick_) * tick_s_, theta_rad() * kDegPerRad};
  }

  void TakeNewPlate() {
    model_.Reset();
    stick_slide_.Reset();
    handle_ = {};
    tick_ = 0;
  }

  // The step of the model, which is what has to be fast.
  void Step() noexcept {
    force_n_ = model_.Step(theta_rad(), 0, tick_s_).torque_nmm / radius_mm_;
    if (friction_) force_n_ += stick_slide_.Step(handle_.place_mm, CoulombLevel());
  }

  void MoveHand() noexcept {
    const double closed_rad = wanted_.front().theta_rad() - wanted_[tick_].theta_rad();
    handle_ = hand_.After(handle_, closed_rad * radius_mm_, force_n_);
    ++tick_;
  }

 private:
  [[nodiscard]] double theta_rad() const noexcept {
    return wanted_.front().theta_rad() - handle_.place_mm / radius_mm_;
  }

  [[nodiscard]] double CoulombLevel() const noexcept {
    const bool closes = handle_.speed_mm_per_s >= 0;
    return closes ? friction_->Closing(theta_rad()) : -friction_->Opening(theta_rad());
  }

  TorqueModel model_;
  const std::vector<MotionSample>& wanted_;
  double radius_mm_, tick_s_;
  HandMotion hand_;
  HandleState handle_;
  std::optional<FrictionCurve> friction_;
  StickSlide stick_slide_{kPlay_mm};
  double force_n_ = 0;
  std::size_t tick_ = 0;
};

double AtShare(const std::vector<double>& ascending, double share) {
  const double place = share * static_cast<double>(ascending.size());
  return ascending[std::min(static_cast<std::size_t>(place), ascending.size() - 1)];
}

std::string PercentileLine(const char* name, const std::vector<double>& ascending) {
  return fmt::format("  {:<15} p50 {:.4g}, p99 {:.4g}, p99.9 {:.4g}, max {:.4g} us\n",
                     name,
                     AtShare(ascending, 0.5),
                     AtShare(ascending, 0.99),
                     AtShare(ascending, 0.999),
                     ascending.back());
}

// Counts between 1, 2 and 5 times powers of ten; empty ends are left out.
std::string HistogramLines(const std::vector<double>& ascending) {
  std::string lines;
  auto next = ascending.begin();
  for (double power = 1e-3; next != ascending.end(); power *= 10) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const auto end = std::lower_bound(next, ascending.end(), factor * power);
      if (end != next)
        lines += fmt::format("    below {:>6.4g} us  {}\n", factor * power, end - next);
      next = end;
    }
  }
  return lines;
}

std::string TimeLines(const char* name, std::vector<double> times_us) {
  if (times_us.empty()) return "";
  std::sort(times_us.begin(), times_us.end());
  return PercentileLine(name, times_us) + HistogramLines(times_us);
}

}  // namespace

RealTimeRun RunRealTime(TorqueModel model,
                        const std::vector<MotionSample>& wanted,
                        const RealTimeOptions& options) {
  RequirePositive("--radius-mm", options.radius_mm);
  const double asked = std::round(options.seconds * options.rate_hz);
  if (asked > kMostTicks) throw std::invalid_argument("--seconds: more than ten million ticks");
  const auto ticks = asked > 0 ? static_cast<std::size_t>(asked) : wanted.size();
  RealTimeRun run;
  for (std::vector<double>* times : {&run.period_us, &run.compute_us}) times->reserve(ticks);
  run.motion.reserve(wanted.size());
  HeldModel held(std::move(model), wanted, options);
  const auto period = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(1 / options.rate_hz));
  Clock::time_point due = Clock::now() + period, last_wake;
  for (std::size_t tick = 0; tick < ticks; ++tick, due += period) {
    std::this_thread::sleep_until(due);
    const Clock::time_point wake = Clock::now();
    held.Step();
    const Clock::time_point done = Clock::now();
    if (tick > 0) run.period_us.push_back(Microseconds(wake - last_wake).count());
    run.compute_us.push_back(Microseconds(done - wake).count());
    run.missed += done > due + period;
    last_wake = wake;
    if (run.motion.size() < wanted.size()) run.motion.push_back(held.now());
    held.MoveHand();
    if (held.is_through_path()) held.TakeNewPlate();
  }
  return run;
}

std::string RealTimeSummary(const RealTimeRun& run,
                            const RealTimeOptions& options,
                            double stable_n_per_mm,
                            double stiffness_n_per_mm) {
  std::string text = fmt::format("  loop            {} ticks at {} Hz, {} missed deadlines\n",
                                 run.compute_us.size(),
                                 options.rate_hz,
                                 run.missed);
  text += TimeLines("compute", run.compute_us) + TimeLines("period", run.period_us);
  text += fmt::format(
      "  stability       plates up to k = {:.4g} N/mm at {} Hz with {:.4g} N s/m of damping; this "
      "one has {:.4g}: {}\n",
      stable_n_per_mm,
      options.rate_hz,
      1000 * options.hand.damping_n_s_per_mm,
      stiffness_n_per_mm,
      stiffness_n_per_mm <= stable_n_per_mm ? "stable" : "the handle will buzz");
  return text;
}

}  // namespace bladecurve
