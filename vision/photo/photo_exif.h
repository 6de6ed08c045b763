// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace bladecurve {

// The EXIF tags that bear on geometry and scale; absent ones stay empty.
struct ExifFacts {
  std::optional<int> orientation;  // 1 to 8
  std::optional<double>
      focal_length_35mm;  // mm, referred to the 43.27 mm diagonal of 35 mm film (CIPA DCG-001)
  std::optional<double> focal_length_mm;
  std::optional<double> focal_plane_px_per_mm;
  std::optional<double> focal_plane_width_px;  // the width that the former refers to
  std::optional<double> dpi;                   // X and Y resolution, if equal
  bool exposure_tags = false;  // exposure time, aperture, ISO or focal length: taken by a camera
};

// `tiff_block`: the EXIF block without its "Exif\0\0" prefix. What cannot be read counts as absent.
[[nodiscard]] ExifFacts ReadExif(std::string_view tiff_block);

// Focal length in pixels of a picture of this size, if the tags say; about 2 % uncertain, as mm are
// rounded.
[[nodiscard]] std::optional<double> FocalLengthPx(const ExifFacts& exif, int width, int height);

}  // namespace bladecurve
