// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/scene_rungs.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "vision/image/disk.h"
#include "vision/image/nearest_pixel.h"
#include "vision/image/smoothed.h"
#include "vision/parallel.h"
#include "vision/scene/finger_rings.h"
#include "vision/scene/flood.h"
#include "vision/scene/graph_cut.h"
#include "vision/scene/region_merging.h"
#include "vision/scene/shadow_caster.h"
#include "vision/scene/sharp_gradient.h"
#include "vision/scene/silhouette.h"

namespace bladecurve {
namespace {

// In units of the background's scatter. Below 2 it is all background, above 64 nothing is left of
// most blades. The likely ones first.
constexpr double kThresholds[] = {8, 16, 4, 24, 32, 6, 12, 3, 2, 48, 64};

// So many thresholds show the same good blades that more of them would change nothing.
constexpr int kEnough = 4;

bool Settled(const std::vector<Candidate>& candidates) {
  constexpr double kGood = 0.9;
  constexpr double kSharp = 0.5;
  return std::any_of(candidates.begin(), candidates.end(), [](const Candidate& c) {
    return c.agreeing >= kEnough && c.pair.quality >= kGood && c.sharpness >= kSharp;
  });
}

std::vector<double> ThresholdsUpTo(const cv::Mat& distance) {
  double most = 0;
  cv::minMaxLoc(distance, nullptr, &most);
  std::vector<double> thresholds(std::begin(kThresholds), std::end(kThresholds));
  std::erase_if(thresholds, [&](double threshold) { return threshold > most; });
  return thresholds;
}

// Threshold after threshold until they settle. How many are looked at together changes nothing.
Rung ThresholdAll(const cv::Mat& distance,
                  const cv::Mat& hidden,
                  const Candidate& like,
                  const StoredHints& hints) {
  const cv::Mat smooth = Smoothed(distance, 0.8);
  const std::vector<double> thresholds = ThresholdsUpTo(smooth);
  const int all = static_cast<int>(thresholds.size());
  Rung rung;
  rung.method = like.method;
  rung.distance = distance;
  for (int first = 0; first < all && !Settled(rung.candidates);) {
    const int count = std::min(all - first, first == 0 ? kEnough : UsableThreads());
    std::vector<Rung> seen = ParallelMap(count, [&](int i) {
      Candidate at_threshold = like;
      at_threshold.threshold = thresholds[static_cast<std::size_t>(first + i)];
      const cv::Mat mask = MaskAbove(smooth, at_threshold.threshold);
      Rung seen = SeenIn(mask, at_threshold, hidden, hints);
      seen.rings = CountFingerRings(mask);
      return seen;
    });
    for (Rung& mask : seen) {
      if (Settled(rung.candidates)) break;
      Add(std::move(mask), &rung);
    }
    first += count;
  }
  return rung;
}

cv::Mat LabDistance(const ColourPictures& colour) {
  const BackgroundModel background = FitBackground(colour.lab->pixels, colour.ignore);
  cv::Mat distance = DistanceFromBackground(colour.lab->pixels, background);
  if (!colour.ignore.empty()) distance.setTo(0, colour.ignore);
  return distance;
}

cv::Mat ShadowBlindDistance(const ColourPictures& colour) {
  cv::Mat light;
  colour.bgr.convertTo(light, CV_32FC3, 100.0 / 255);
  const BackgroundModel background = FitBackground(light, colour.ignore);
  cv::Mat distance = DistanceFromShadedBackground(light, background);
  if (!colour.ignore.empty()) distance.setTo(0, colour.ignore);
  return distance;
}

// What is broader than printed lines, and the slender ends of that.
cv::Mat WithoutLines(const cv::Mat& distance) {
  constexpr int kLinePx = 7, kEndsPx = 4;
  const cv::Mat line = Disk(kLinePx);
  const cv::Mat neighbours = Disk(3);
  cv::Mat broad;
  cv::morphologyEx(distance, broad, cv::MORPH_OPEN, line);
  for (int grown = 0; grown < kEndsPx; ++grown) {
    cv::dilate(broad, broad, neighbours);
    cv::min(broad, distance, broad);
  }
  return broad;
}

// What lies above a level, without the specks of grain that cling to it, and without its outermost
// pixel, which is outline.
cv::Mat MaskAboveLevel(const cv::Mat& levels, double level, int speck_px) {
  cv::Mat mask = levels > level;
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, Disk(speck_px));
  cv::erode(mask, mask, Disk(3));
  return mask;
}

// Adds what shows above levels that are in units of the usual gradient. Below the lowest all is
// apart; above the highest, most metal is background.
void AddLevels(const cv::Mat& levels,
               int speck_px,
               const Candidate& like,
               const SceneView& view,
               const cv::Mat& ignore,
               Rung* rung) {
  constexpr double kLevels[] = {1.4, 2, 2.8, 4, 5.6, 8, 11, 16, 22, 32};
  std::vector<Rung> seen = ParallelMap(static_cast<int>(std::size(kLevels)), [&](int i) {
    Candidate at_level = like;
    at_level.threshold = kLevels[i];
    return SeenIn(
        MaskAboveLevel(levels, at_level.threshold, speck_px), at_level, ignore, view.hints);
  });
  for (Rung& mask : seen) Add(std::move(mask), rung);
  rung->distance = levels;
}

// As level(walls) gives them for each of the walls.
template <typename Level>
std::vector<cv::Mat> LevelsOf(const Outlines& outlines, const Level& level) {
  return ParallelMap(static_cast<int>(outlines.closed.size()), [&](int i) {
    return level(outlines.closed[static_cast<std::size_t>(i)].walls);
  });
}

}  // namespace

GreyPicture GreyOnGround(const SceneView& view) {
  GreyPicture grey;
  grey.at = std::make_shared<const ScaledImage>(SmallGrey(view, kSmallSide));
  grey.ignore = view.MarkerMask(*grey.at);
  grey.background = FitBackground(grey.at->pixels, grey.ignore);
  return grey;
}

GreyPicture LightnessOf(const ColourPictures& colour) {
  GreyPicture grey;
  cv::Mat lightness;
  cv::extractChannel(colour.lab->pixels, lightness, 0);
  grey.background = FitBackground(lightness, colour.ignore);
  grey.at = std::make_shared<const ScaledImage>(ScaledImage{lightness, colour.lab->area_px});
  grey.ignore = colour.ignore;
  return grey;
}

cv::Mat DistanceIn(const GreyPicture& grey) {
  cv::Mat distance = DistanceFromBackground(grey.at->pixels, grey.background);
  if (!grey.ignore.empty()) distance.setTo(0, grey.ignore);
  return distance;
}

Rung GreyRung(const SceneView& view, const GreyPicture& grey) {
  return ThresholdAll(
      DistanceIn(grey), grey.ignore, Candidate{{}, grey.at, {}, "grey"}, view.hints);
}

Rung CasterRung(const SceneView& view,
                const GreyPicture& grey,
                const cv::Mat& things,
                const cv::Mat& coloured) {
  const Candidate like{{}, grey.at, {}, "caster"};
  Rung rung;
  rung.method = like.method;
  const cv::Mat lightness = AboveBackground(grey.at->pixels, grey.background);
  rung.distance = cv::abs(lightness);
  const std::vector<cv::Mat> masks = MasksOfShadowCaster(lightness, things, coloured);
  std::vector<Rung> seen = ParallelMap(static_cast<int>(masks.size()), [&](int i) {
    return SeenIn(masks[static_cast<std::size_t>(i)], like, grey.ignore, view.hints);
  });
  for (Rung& mask : seen) {
    // There are few masks: one in which the blades are lost confirms none of the others.
    std::erase_if(mask.candidates,
                  [](const Candidate& c) { return c.pair.quality < kAcceptedQuality; });
    Add(std::move(mask), &rung);
  }
  return rung;
}

Rung ColourRung(const SceneView& view, const ColourPictures& colour) {
  const Candidate like{{}, colour.lab, {}, "colour"};
  return ThresholdAll(LabDistance(colour), colour.ignore, like, view.hints);
}

Rung ShadowBlindRung(const SceneView& view, const ColourPictures& colour) {
  const Candidate like{{}, colour.lab, {}, "shadow-blind"};
  return ThresholdAll(ShadowBlindDistance(colour), colour.ignore, like, view.hints);
}

Rung BroadRung(const SceneView& view, const ColourPictures& colour, const cv::Mat& distance) {
  const Candidate like{{}, colour.lab, {}, "broad"};
  return ThresholdAll(WithoutLines(distance), colour.ignore, like, view.hints);
}

Rung CutRung(const SceneView& view, const ColourPictures& colour) {
  constexpr double kAbout = 0.025;  // of the longest side; metal about --pivot
  constexpr int kLinePx = 3;        // no wider ones are left of a pattern
  Candidate like{{}, colour.lab, {}, "cut"};
  like.patterned = true;
  const double longest = std::max(colour.bgr.cols, colour.bgr.rows);
  const cv::Point place = NearestPixel(colour.lab->SmallFromFull(*view.hints.pivot_px));
  cv::Mat mask = CutOut(colour.bgr, {place, kAbout * longest});
  if (!colour.ignore.empty()) mask.setTo(0, colour.ignore);
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, Disk(kLinePx));
  Rung rung;
  rung.method = like.method;
  mask.convertTo(rung.distance, CV_32F);
  Add(SeenIn(mask, like, colour.ignore, view.hints), &rung);
  return rung;
}

Outlines OutlinesIn(const SceneView& view) {
  Outlines outlines{SmallColour(view, kOutlineSide), {}, {}};
  const ColourPictures& colour = outlines.colour;
  cv::Mat sharp_gradient;
  ParallelFor(2, [&](int part) {
    if (part == 0) {
      outlines.ground = GroundAtFrame(LabDistance(colour));
    } else {
      sharp_gradient = SharpGradient(colour.lab->pixels);
    }
  });
  constexpr std::array kClosedPx{3, 5};
  outlines.closed = ParallelMap(static_cast<int>(kClosedPx.size()), [&](int i) {
    const int closed_px = kClosedPx[static_cast<std::size_t>(i)];
    return Outlines::ClosedWalls{closed_px, Walls(sharp_gradient, closed_px, colour.ignore)};
  });
  return outlines;
}

Rung FloodRung(const SceneView& view, const Outlines& outlines) {
  const ColourPictures& colour = outlines.colour;
  const Candidate like{{}, colour.lab, {}, "flood"};
  Rung rung;
  rung.method = like.method;
  const std::vector<cv::Mat> levels = LevelsOf(outlines, [&](const cv::Mat& walls) {
    cv::Mat flooded = FloodLevels(walls, outlines.ground);
    if (!colour.ignore.empty()) flooded.setTo(0, colour.ignore);
    return flooded;
  });
  for (std::size_t i = 0; i < levels.size(); ++i) {
    // Walls are thicker than what they enclose by half of what was closed, so that much may go.
    const int speck_px = outlines.closed[i].closed_px;
    AddLevels(levels[i], speck_px, like, view, colour.ignore, &rung);
  }
  return rung;
}

Rung RegionRung(const SceneView& view, const Outlines& outlines) {
  constexpr int kSpeckPx = 5;
  const ColourPictures& colour = outlines.colour;
  cv::Mat ground = outlines.ground.clone();
  if (!colour.ignore.empty()) ground.setTo(255, colour.ignore);
  Candidate like{{}, colour.lab, {}, "regions"};
  like.outlined = true;
  Rung rung;
  rung.method = like.method;
  const std::vector<cv::Mat> levels =
      LevelsOf(outlines, [&](const cv::Mat& walls) { return MergingLevels(walls, ground); });
  for (const cv::Mat& merged : levels)
    AddLevels(merged, kSpeckPx, like, view, colour.ignore, &rung);
  return rung;
}

}  // namespace bladecurve
