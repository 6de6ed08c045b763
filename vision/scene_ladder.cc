// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene_ladder.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "vision/flood.h"
#include "vision/refused.h"
#include "vision/robust_statistics.h"
#include "vision/scene_debug.h"
#include "vision/silhouette.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr int kSmallSide =
    640;  // blades of a sixth of the picture keep 100 px; more costs time, finds no more
constexpr int kFloodSide = 960;  // walls are pixels thick: gaps between blades need more of them
constexpr double kMostEnlarged = 2;  // the same for pictures that are smaller than that
constexpr int kSmallestSide = 120;  // no blade of such a picture has an edge that could be measured
// In units of the background's scatter. Below 2 it is all background, above 64 nothing is left of
// most blades.
constexpr double kThresholds[] = {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};

// What all rungs need to know about the picture.
struct Setting {
  const Photo& photo;
  const std::vector<SeenMarker>& markers;
  const StoredHints& hints;
  Window window;
};

Window WholeOrRoi(const Photo& photo, const StoredHints& hints) {
  const cv::Rect whole({0, 0}, photo.grey().size());
  const cv::Rect area = hints.roi_px ? (*hints.roi_px & whole) : whole;
  return {cv::Rect2d(area), area.size()};
}

cv::Size SmallSize(const Window& window, int longest) {
  const double side = std::max(window.area_px.width, window.area_px.height);
  const double k = std::min(kMostEnlarged, longest / side);
  return {std::max(1, static_cast<int>(std::lround(window.area_px.width * k))),
          std::max(1, static_cast<int>(std::lround(window.area_px.height * k)))};
}

// The window as the small pictures and the background see it: coordinates start at its corner.
Window LocalWindow(const Window& window) {
  return {cv::Rect2d(0, 0, window.area_px.width, window.area_px.height), window.full_size};
}

cv::Mat Resized(const cv::Mat& image, const cv::Size& size) {
  cv::Mat resized;
  const bool enlarges = size.width > image.cols;
  cv::resize(image, resized, size, 0, 0, enlarges ? cv::INTER_CUBIC : cv::INTER_AREA);
  return resized;
}

ScaledImage SmallGrey(const Setting& setting) {
  ScaledImage small;
  small.window = setting.window;
  const cv::Mat reduced = Resized(setting.photo.grey()(cv::Rect(setting.window.area_px)),
                                  SmallSize(setting.window, kSmallSide));
  reduced.convertTo(small.pixels, CV_32FC1, 100.0 / 255);
  return small;
}

// The same window in colour, 8 bit.
cv::Mat SmallColour(const Setting& setting, int longest) {
  const cv::Size full = setting.photo.grey().size();
  const double zoom = std::max(full.width, full.height) /
                      std::max(setting.window.area_px.width, setting.window.area_px.height);
  const cv::Mat colour = setting.photo.DecodeColour(static_cast<int>(std::ceil(longest * zoom)));
  const double k = static_cast<double>(colour.cols) / full.width;
  const cv::Rect2d area(setting.window.area_px.x * k,
                        setting.window.area_px.y * k,
                        setting.window.area_px.width * k,
                        setting.window.area_px.height * k);
  return Resized(colour(cv::Rect(area) & cv::Rect({0, 0}, colour.size())),
                 SmallSize(setting.window, longest));
}

// Non-zero on the printed markers and their white margins, which are not scissors.
cv::Mat MarkerMask(const Setting& setting, const ScaledImage& at) {
  constexpr double kMargin = 1.6;  // side of the paper over that of the marker
  cv::Mat mask;
  if (setting.markers.empty()) return mask;
  mask = cv::Mat::zeros(at.pixels.size(), CV_8UC1);
  for (const SeenMarker& marker : setting.markers) {
    Vector2d center = Vector2d::Zero();
    for (const Vector2d& corner : marker.corners_px) center += 0.25 * corner;
    std::vector<cv::Point> polygon;
    for (const Vector2d& corner : marker.corners_px) {
      const Vector2d p = at.SmallFromFull(center + kMargin * (corner - center));
      polygon.emplace_back(static_cast<int>(std::lround(p.x())),
                           static_cast<int>(std::lround(p.y())));
    }
    cv::fillConvexPoly(mask, polygon, 255);
  }
  return mask;
}

// Median difference between `reach` px outside and inside of a path, in the units of the image.
double TransitionAcross(const cv::Mat& image, const std::vector<Vector2d>& path, double reach) {
  std::vector<double> steps;
  const auto value = [&](const Vector2d& p, int c) {
    const int x = std::clamp(static_cast<int>(std::lround(p.x())), 0, image.cols - 1);
    const int y = std::clamp(static_cast<int>(std::lround(p.y())), 0, image.rows - 1);
    return static_cast<double>(image.ptr<float>(y)[x * image.channels() + c]);
  };
  for (std::size_t i = 3; i + 3 < path.size(); i += 2) {
    const Vector2d along = (path[i + 3] - path[i - 3]).normalized();
    const Vector2d across(reach * along.y(), -reach * along.x());
    double squared = 0;
    for (int c = 0; c < image.channels(); ++c) {
      squared += std::pow(value(path[i] + across, c) - value(path[i] - across, c), 2);
    }
    steps.push_back(std::sqrt(squared));
  }
  return steps.empty() ? 0 : Median(steps);
}

constexpr double kSharpReach = 1.5;  // px of the small picture: all of a sharp border's transition
constexpr double kSoftReach = 5;     // most of a soft shadow's

// Of the two inner edges the weaker: a shadow that passes for a blade has a soft border.
double EdgeStrength(const cv::Mat& image, const BladePair& pair) {
  return std::min(TransitionAcross(image, pair.first.inner, kSharpReach),
                  TransitionAcross(image, pair.second.inner, kSharpReach));
}

// Share of the transition that a sharp border would have there, of the softer inner edge.
double EdgeSharpness(const cv::Mat& image, const BladePair& pair) {
  const auto sharpness = [&](const std::vector<Vector2d>& path) {
    return TransitionAcross(image, path, kSharpReach) /
           std::max(1e-6, TransitionAcross(image, path, kSoftReach));
  };
  return std::min(sharpness(pair.first.inner), sharpness(pair.second.inner));
}

// Shadows that pass for blades reach 0.25, blades on the same photographs have 0.45 and more.
void DoubtSoftEdges(Candidate* candidate) {
  constexpr double kSoft = 0.25;
  constexpr double kSharp = 0.4;
  const double grade = std::clamp((candidate->sharpness - kSoft) / (kSharp - kSoft), 0.0, 1.0);
  candidate->pair.quality *= grade;
  if (grade >= candidate->pair.worst_grade) return;
  candidate->pair.worst_grade = grade;
  candidate->pair.doubt = "an edge is soft like a shadow's";
}

bool AgreesWithHints(const BladePair& pair, const ScaledImage& at, const StoredHints& hints) {
  if (hints.tips_direction) {
    const Vector2d towards = 0.5 * (pair.first.tip + pair.second.tip) - pair.pivot;
    if (towards.normalized().dot(*hints.tips_direction) < 0.5) return false;
  }
  if (hints.pivot_px) {
    const double off = (at.FullFromSmall(pair.pivot) - *hints.pivot_px).norm();
    if (off > 2 * std::max(pair.shank_width, 0.2 * pair.first.length) * at.full_px_per_px())
      return false;
  }
  return true;
}

double SizeOf(const BladePair& pair) { return std::max(pair.first.length, pair.second.length); }

bool SameBlades(const Candidate& a, const Candidate& b) {
  const double near = 0.25 * a.at->full_px_per_px() * SizeOf(a.pair);
  const auto apart = [&](const Vector2d& p, const Vector2d& q) {
    return (a.at->FullFromSmall(p) - b.at->FullFromSmall(q)).norm() > near;
  };
  return !apart(a.pair.pivot, b.pair.pivot) && !apart(a.pair.first.tip, b.pair.first.tip) &&
         !apart(a.pair.second.tip, b.pair.second.tip);
}

// All candidates of one mask.
void CollectFrom(const cv::Mat& mask,
                 const Candidate& like,
                 const cv::Mat& hidden,
                 const StoredHints& hints,
                 std::vector<Candidate>* candidates) {
  constexpr int kMostThings = 4;         // a ruler, a card, a label, and the scissors
  constexpr double kWorthKeeping = 0.2;  // what clutter reaches
  for (const Silhouette& silhouette : FindSilhouettes(mask, kMostThings)) {
    for (BladePair& pair : FindBladePairs(silhouette, hidden)) {
      if (pair.quality < kWorthKeeping || !AgreesWithHints(pair, *like.at, hints)) continue;
      Candidate candidate = like;
      candidate.strength = EdgeStrength(like.at->pixels, pair);
      candidate.sharpness = EdgeSharpness(like.at->pixels, pair);
      candidate.pair = std::move(pair);
      DoubtSoftEdges(&candidate);
      candidate.mask = mask;
      candidates->push_back(std::move(candidate));
      break;  // the best pair of each thing
    }
  }
}

void CountAgreeing(std::vector<Candidate>* candidates) {
  for (Candidate& a : *candidates) {
    a.agreeing = static_cast<int>(
        std::count_if(candidates->begin(), candidates->end(), [&](const Candidate& b) {
          return SameBlades(a, b);
        }));
  }
}

std::vector<Candidate> ThresholdAll(const cv::Mat& distance,
                                    const cv::Mat& hidden,
                                    const Candidate& like,
                                    const StoredHints& hints) {
  cv::Mat smooth;
  cv::GaussianBlur(distance, smooth, {}, 0.8);
  double most = 0;
  cv::minMaxLoc(smooth, nullptr, &most);
  std::vector<Candidate> candidates;
  for (const double threshold : kThresholds) {
    if (threshold > most) break;
    Candidate at_threshold = like;
    at_threshold.threshold = threshold;
    CollectFrom(MaskAbove(smooth, threshold), at_threshold, hidden, hints, &candidates);
  }
  CountAgreeing(&candidates);
  return candidates;
}

// Quality first; among thresholds that see the same blades the one whose contour lies on the
// strongest transition.
double Merit(const Candidate& c) {
  return c.pair.quality *
         std::sqrt(std::min(c.agreeing, 4) * c.strength * SizeOf(c.pair) * c.at->full_px_per_px());
}

LadderResult Choose(const std::vector<Candidate>& candidates) {
  LadderResult result;
  const Candidate* best = nullptr;
  for (const Candidate& c : candidates) {
    if (best == nullptr || Merit(c) > Merit(*best)) best = &c;
  }
  if (best == nullptr) return result;
  const Candidate* strongest = best;
  for (const Candidate& c : candidates) {
    const bool as_good = c.pair.quality > 0.95 * best->pair.quality && SameBlades(c, *best);
    if (as_good && c.strength > strongest->strength) strongest = &c;
    const double apart =
        (c.at->FullFromSmall(c.pair.pivot) - best->at->FullFromSmall(best->pair.pivot)).norm();
    constexpr double kSurelyScissors = 0.8;
    if (c.pair.quality > kSurelyScissors && best->pair.quality > kSurelyScissors &&
        c.agreeing >= 2 && c.method == best->method &&
        apart > SizeOf(best->pair) * best->at->full_px_per_px()) {
      result.several = true;
    }
  }
  result.best = *strongest;
  return result;
}

// Several thresholds must agree; fewer where the outline is as sharp as the lens allows.
bool Consistent(const LadderResult& result) {
  constexpr double kSurelySharp = 0.8;
  const int enough = result.best.sharpness >= kSurelySharp ? 2 : 3;
  return result.best.pair.quality >= 0.9 && result.best.agreeing >= enough;
}

// What one rung of the ladder saw.
struct Rung {
  std::vector<Candidate> candidates;
  cv::Mat distance;  // from the background, or the mask where there is no distance
};

Rung GreyRung(const Setting& setting) {
  const auto at = std::make_shared<ScaledImage>(SmallGrey(setting));
  const cv::Mat ignore = MarkerMask(setting, *at);
  const BackgroundModel background = FitBackground(at->pixels, ignore);
  cv::Mat distance = DistanceFromBackground(at->pixels, background, LocalWindow(setting.window));
  if (!ignore.empty()) distance.setTo(0, ignore);
  return {ThresholdAll(distance, ignore, Candidate{{}, at, {}, "grey"}, setting.hints), distance};
}

struct ColourPictures {
  cv::Mat bgr;  // CV_8UC3
  std::shared_ptr<ScaledImage> lab;
  cv::Mat ignore;
};

ColourPictures MakeColour(const Setting& setting, int longest) {
  ColourPictures colour;
  colour.bgr = SmallColour(setting, longest);
  cv::Mat lab;
  colour.bgr.convertTo(lab, CV_32FC3, 1.0 / 255);
  cv::cvtColor(lab, lab, cv::COLOR_BGR2Lab);
  colour.lab = std::make_shared<ScaledImage>(ScaledImage{lab, setting.window});
  colour.ignore = MarkerMask(setting, *colour.lab);
  return colour;
}

cv::Mat LabDistance(const Setting& setting, const ColourPictures& colour) {
  const BackgroundModel background = FitBackground(colour.lab->pixels, colour.ignore);
  cv::Mat distance =
      DistanceFromBackground(colour.lab->pixels, background, LocalWindow(setting.window));
  if (!colour.ignore.empty()) distance.setTo(0, colour.ignore);
  return distance;
}

Rung ColourRung(const Setting& setting, const ColourPictures& colour) {
  const cv::Mat distance = LabDistance(setting, colour);
  return {
      ThresholdAll(distance, colour.ignore, Candidate{{}, colour.lab, {}, "colour"}, setting.hints),
      distance};
}

Rung ShadowBlindRung(const Setting& setting, const ColourPictures& colour) {
  cv::Mat light;
  colour.bgr.convertTo(light, CV_32FC3, 100.0 / 255);
  const BackgroundModel background = FitBackground(light, colour.ignore);
  cv::Mat distance = DistanceFromShadedBackground(light, background, LocalWindow(setting.window));
  if (!colour.ignore.empty()) distance.setTo(0, colour.ignore);
  return {
      ThresholdAll(
          distance, colour.ignore, Candidate{{}, colour.lab, {}, "shadow-blind"}, setting.hints),
      distance};
}

// What stays dry up to a level, without the specks of grain that cling to it. Walls are thicker
// than what they enclose by half of what was closed, so that much may go.
cv::Mat DryMask(const cv::Mat& levels, double level, int closed_px) {
  cv::Mat mask = levels > level;
  cv::morphologyEx(mask,
                   mask,
                   cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {closed_px, closed_px}));
  cv::erode(mask, mask, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  return mask;
}

Rung FloodRung(const Setting& setting) {
  // In units of the usual gradient. Below, the ground is dry too; above, most metal is wet.
  constexpr double kLevels[] = {1.4, 2, 2.8, 4, 5.6, 8, 11, 16, 22, 32};
  const ColourPictures colour = MakeColour(setting, kFloodSide);
  const cv::Mat distance = LabDistance(setting, colour);
  Rung rung;
  for (const int closed_px : {3, 5}) {  // narrow gaps between blades, and gaps in faint outlines
    rung.distance = FloodLevels(colour.lab->pixels, distance, colour.ignore, closed_px);
    for (const double level : kLevels) {
      CollectFrom(DryMask(rung.distance, level, closed_px),
                  {{}, colour.lab, {}, "flood", level},
                  colour.ignore,
                  setting.hints,
                  &rung.candidates);
    }
  }
  CountAgreeing(&rung.candidates);
  return rung;
}

// Adds what a rung saw to what is known, and draws it where pictures are wanted.
LadderResult Consider(Rung rung,
                      const std::string& name,
                      std::vector<Candidate>* all,
                      StageLog* log) {
  if (log->wants_pictures()) log->Picture(name, DrawRung(rung.distance, rung.candidates));
  std::move(rung.candidates.begin(), rung.candidates.end(), std::back_inserter(*all));
  return Choose(*all);
}

}  // namespace

LadderResult ClimbLadder(const Photo& photo,
                         const std::vector<SeenMarker>& markers,
                         const StoredHints& hints,
                         StageLog* log) {
  const Setting setting{photo, markers, hints, WholeOrRoi(photo, hints)};
  if (std::min(setting.window.area_px.width, setting.window.area_px.height) < kSmallestSide) {
    throw Refused(Reason::kTooSmall,
                  "scene: the picture is less than " + std::to_string(kSmallestSide) +
                      " px high or wide; use a larger photograph");
  }
  std::vector<Candidate> all;
  LadderResult result = Consider(GreyRung(setting), "rung-grey", &all, log);
  log->Ran("scene-grey", "the cheapest look");
  if (Consistent(result)) {
    log->Skipped("scene-colour", "grey gave a consistent scene");
    return result;
  }
  const ColourPictures colour = MakeColour(setting, kSmallSide);
  Consider(ColourRung(setting, colour), "rung-colour", &all, log);
  result = Consider(ShadowBlindRung(setting, colour), "rung-shadow-blind", &all, log);
  log->Ran("scene-colour", "grey did not separate the blades");
  if (Consistent(result)) {
    log->Skipped("scene-flood", "colour gave a consistent scene");
    return result;
  }
  result = Consider(FloodRung(setting), "rung-flood", &all, log);
  log->Ran("scene-flood", "no threshold separates the blades");
  return result;
}

}  // namespace bladecurve
