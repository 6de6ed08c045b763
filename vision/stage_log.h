// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace bladecurve {

// One line of "plan" in the result: what ran, what was left out, and why.
struct StageRecord {
  std::string stage;
  bool ran = false;
  std::string why;
  double ms = 0;
};

enum class Plan { kAsNeeded, kFull };  // leave out what a scene does not need, or nothing

// The plan of one measurement: whether stages may be left out. Collects what each did and how long
// it took, and, if asked for, a picture of it.
class StageLog {
 public:
  // Makes the folder, and clears it of pictures of an earlier run. Throws std::runtime_error.
  explicit StageLog(std::optional<std::filesystem::path> debug_dir = std::nullopt,
                    Plan plan = Plan::kAsNeeded);

  [[nodiscard]] Plan plan() const { return plan_; }

  void Ran(const std::string& stage,
           const std::string& why);  // the time since the last record is its time
  void Skipped(const std::string& stage, const std::string& why);

  // If pictures are asked for, writes what `draw` makes to DIR/NN_name.png; no stage's time.
  void Picture(const std::string& name, const std::function<cv::Mat()>& draw);

  [[nodiscard]] const std::vector<StageRecord>& records() const { return records_; }
  [[nodiscard]] double total_ms() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<std::filesystem::path> debug_dir_;
  Plan plan_;
  int pictures_ = 0;
  std::vector<StageRecord> records_;
  Clock::time_point start_;
  Clock::time_point last_;
};

}  // namespace bladecurve
