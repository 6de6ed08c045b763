// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/shadow_caster.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "vision/image/disk.h"
#include "vision/parallel.h"
#include "vision/scene/moved_image.h"
#include "vision/scene/parted_members.h"
#include "vision/scene/tones.h"

namespace bladecurve {
namespace {

constexpr double kBeyondAll = std::numeric_limits<double>::infinity();

cv::Mat Opened(const cv::Mat& mask) {
  cv::Mat opened;
  cv::morphologyEx(mask, opened, cv::MORPH_OPEN, Disk(3));
  return opened;
}

struct Band {
  double from = -kBeyondAll, to = kBeyondAll;  // lightness
};

// What stands out, within the box about it.
struct Things {
  cv::Mat lightness, mask, flat;
  cv::Mat coloured;  // of them, as no shadow is
  Tones tones;       // of the others
};

// What is of these tones, but for borders that have them on their way between others, and what is
// coloured.
cv::Mat In(const Band& band, const Things& things) {
  const cv::Mat in = (things.lightness > band.from) & (things.lightness < band.to) & things.mask;
  cv::Mat core = in & things.flat;
  cv::dilate(Opened(core), core, Disk(5));
  return Opened(core & in) | things.coloured;
}

// Where the lightness changes by less than half of what parts the tones.
cv::Mat FlatIn(const cv::Mat& lightness, const Tones& tones) {
  double least = kBeyondAll;
  for (std::size_t k = 1; k < tones.peaks.size(); ++k)
    least = std::min(least, tones.peaks[k] - tones.peaks[k - 1]);
  cv::Mat range;
  cv::morphologyEx(lightness, range, cv::MORPH_GRADIENT, Disk(3));
  return range < 0.5 * least;
}

// Tones that follow each other, from `first` to `last`.
struct Run {
  std::size_t first = 0, last = 0;
};

// Its borders, nearer to the tones beyond by `wider` of the way to them.
Band BandOf(const Run& run, const Tones& tones, double wider) {
  const auto border = [&](std::size_t valley, double up) {
    const double at = tones.valleys[valley];
    return at + std::abs(up) * (tones.peaks[valley + (up > 0 ? 1 : 0)] - at);
  };
  Band band;
  if (run.first > 0) band.from = border(run.first - 1, -wider);
  if (run.last < tones.valleys.size()) band.to = border(run.last, wider);
  return band;
}

// All but the one of all tones.
std::vector<Run> RunsOf(std::size_t tones) {
  std::vector<Run> runs;
  for (std::size_t first = 0; first < tones; ++first) {
    for (std::size_t last = first; last < tones; ++last) {
      if (last - first + 1 < tones) runs.push_back({first, last});
    }
  }
  return runs;
}

struct Cast {
  Run run;  // of what casts the shadow
  MovedImage image;
};

// How well one shadow that is cast by these tones explains the others.
Cast CastBy(const Run& run, const Things& things) {
  constexpr double kLeastCaster = 0.2, kLeastShadow = 0.05;  // of the things
  const double area_px = cv::countNonZero(things.mask);
  const cv::Mat caster = In(BandOf(run, things.tones, 0), things);
  const cv::Mat other = Opened(things.mask & ~caster);
  const bool may_be = cv::mean(things.lightness, other)[0] < 0 &&
                      cv::countNonZero(caster) >= kLeastCaster * area_px &&
                      cv::countNonZero(other) >= kLeastShadow * area_px;
  return {run, may_be ? BestMovedImage(caster, other) : MovedImage{}};
}

// The best explanation of all tones by one shadow.
Cast Explain(const Things& things) {
  const std::vector<Run> runs = RunsOf(things.tones.peaks.size());
  const std::vector<Cast> casts = ParallelMap(static_cast<int>(runs.size()), [&](int i) {
    return CastBy(runs[static_cast<std::size_t>(i)], things);
  });
  return *std::ranges::max_element(
      casts, {}, [](const Cast& cast) { return cast.image.agreement; });
}

}  // namespace

std::vector<cv::Mat> MasksOfShadowCaster(const cv::Mat& lightness,
                                         const cv::Mat& things,
                                         const cv::Mat& coloured) {
  constexpr double kExplains = 0.6;  // without shadows things have less than half in common
  constexpr double kWider[] = {0, -0.25, 0.25};
  const Tones tones = TonesOf(lightness, things & ~coloured);
  if (tones.peaks.size() < 2) return {};
  const cv::Rect box = cv::boundingRect(things);
  const Things in_box{lightness(box),
                      things(box),
                      FlatIn(lightness(box), tones),
                      things(box) & coloured(box),
                      tones};
  const Cast cast = Explain(in_box);
  if (cast.image.agreement < kExplains) return {};
  return ParallelMap(static_cast<int>(std::size(kWider)), [&](int i) {
    cv::Mat caster = In(BandOf(cast.run, tones, kWider[i]), in_box);
    JoinPartedMembers(cast.image.shift_px, &caster);
    cv::Mat mask = cv::Mat::zeros(things.size(), CV_8UC1);
    caster.copyTo(mask(box));
    return mask;
  });
}

}  // namespace bladecurve
