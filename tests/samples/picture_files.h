// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace bladecurve {

// Picture files in forms that cameras, scanners and editors write. All return the bytes of the
// file.

// JPEG of CV_8UC1 (grey), CV_8UC3 (BGR) or CV_8UC4 (CMYK as Adobe stores it: inverted).
[[nodiscard]] std::string JpegFile(const cv::Mat& picture);

// The same bytes with an EXIF block that says how the picture is to be turned, 1 to 8.
[[nodiscard]] std::string WithOrientation(const std::string& jpeg, int orientation);

// What a camera held that way stores: turning it by `orientation` gives `shown` back.
[[nodiscard]] cv::Mat StoredFor(const cv::Mat& shown, int orientation);

enum class PngKind { kGrey8, kGrey16, kRgb8, kRgb16, kRgba8, kGreyAlpha8, kPalette };

// PNG of a CV_8UC3 (BGR) picture, converted. Alpha is opaque; the palette holds 216 colours.
[[nodiscard]] std::string PngFile(const cv::Mat& bgr, PngKind kind);

}  // namespace bladecurve
