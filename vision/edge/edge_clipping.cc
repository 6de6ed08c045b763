// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_clipping.h"

#include <algorithm>

namespace bladecurve {
namespace {

constexpr int kStretch = 16;          // samples judged together
constexpr float kWhite = 0.96F;       // linear; grey value 250: compression takes a few off 255
constexpr double kMostlyWhite = 0.5;  // share of a side's pixels; a glint is less
constexpr double kFewest = 12;        // pixels; fewer say nothing of a side

// How many pixels of a side are seen, and how many of them are white.
struct Count {
  double seen = 0, white = 0;

  void Add(float light) {
    ++seen;
    white += light >= kWhite;
  }
  [[nodiscard]] bool MostlyWhite() const { return seen >= kFewest && white > kMostlyWhite * seen; }
};

}  // namespace

Overexposure::Overexposure(const PixelBand& band) {
  for (int first = 0; first < band.size(); first += kStretch) {
    const int last = std::min(first + kStretch, band.size());
    Count blade, ground;
    for (int p = band.begin[static_cast<size_t>(first)]; p < band.begin[static_cast<size_t>(last)];
         ++p) {
      const BandPixel& pixel = band.pixels[static_cast<size_t>(p)];
      if (pixel.across < -kNear && pixel.across > -kFar) blade.Add(pixel.light);
      if (pixel.across > kNear && pixel.across < kFar) ground.Add(pixel.light);
    }
    stretches_.push_back({blade.MostlyWhite(), ground.MostlyWhite()});
  }
}

const Overexposure::Stretch* Overexposure::At(int sample) const {
  if (stretches_.empty()) return nullptr;
  return &stretches_[std::min(static_cast<size_t>(sample / kStretch), stretches_.size() - 1)];
}

bool Overexposure::OfBlade(int sample) const {
  const Stretch* stretch = At(sample);
  return stretch != nullptr && stretch->blade;
}

bool Overexposure::OfGround(int sample) const {
  const Stretch* stretch = At(sample);
  return stretch != nullptr && stretch->ground;
}

double Overexposure::Share() const {
  if (stretches_.empty()) return 0;
  const auto count = std::count_if(
      stretches_.begin(), stretches_.end(), [](const Stretch& s) { return s.blade || s.ground; });
  return static_cast<double>(count) / static_cast<double>(stretches_.size());
}

}  // namespace bladecurve
