// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/stage_log.h"

#include <regex>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "vision/photo/png_writer.h"

namespace bladecurve {

namespace {

namespace fs = std::filesystem;

// Pictures of an earlier run would mix with this one's.
bool IsStagePicture(const fs::path& file) {
  static const std::regex kName("[0-9][0-9]_[a-z-]+\\.png");
  return std::regex_match(file.filename().string(), kName);
}

void PrepareFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    throw std::runtime_error("debug: cannot make the folder " + folder.string() + ": " +
                             (error ? error.message() : "it is a file") + "; name another one");
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (IsStagePicture(entry.path())) fs::remove(entry.path());
  }
}

}  // namespace

StageLog::StageLog(std::optional<std::filesystem::path> debug_dir, Plan plan)
    : debug_dir_(std::move(debug_dir)), plan_(plan), start_(Clock::now()), last_(start_) {
  if (debug_dir_) PrepareFolder(*debug_dir_);
}

void StageLog::Ran(const std::string& stage, const std::string& why) {
  const Clock::time_point now = Clock::now();
  records_.push_back(
      {stage, true, why, std::chrono::duration<double, std::milli>(now - last_).count()});
  last_ = now;
}

void StageLog::Skipped(const std::string& stage, const std::string& why) {
  records_.push_back({stage, false, why, 0});
}

void StageLog::Picture(const std::string& name, const std::function<cv::Mat()>& draw) {
  if (!debug_dir_) return;
  const Clock::time_point begin = Clock::now();
  const std::string number = std::to_string(100 + ++pictures_).substr(1);  // two digits: they sort
  WritePng(*debug_dir_ / (number + "_" + name + ".png"), draw());
  const Clock::duration drawing = Clock::now() - begin;
  start_ += drawing;
  last_ += drawing;
}

double StageLog::total_ms() const {
  return std::chrono::duration<double, std::milli>(last_ - start_).count();
}

}  // namespace bladecurve
