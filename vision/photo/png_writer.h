// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace bladecurve {

struct PngOptions {
  double dpi = 0;  // stated in the file if positive
};

// Writes CV_8UC1 (grey) or CV_8UC3 (BGR). Throws std::invalid_argument for other types and empty
// pictures, std::runtime_error naming the file where it cannot be written.
void WritePng(const std::filesystem::path& path,
              const cv::Mat& image,
              const PngOptions& options = {});

}  // namespace bladecurve
