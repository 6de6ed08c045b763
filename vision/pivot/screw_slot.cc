// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/pivot/screw_slot.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "vision/image/bilinear.h"
#include "vision/image/covariance.h"
#include "vision/image/robust_statistics.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// All lengths are of the head's radius. Slots are a fifth to a quarter of it wide.
constexpr double kHalfWidth = 0.1;
constexpr double kReach = 0.7;        // along: clear of the rim
constexpr double kMostOff = 0.2;      // of the slot from where the rim's fit puts the centre
constexpr int kSections = 9;          // along the slot
constexpr double kLeastRadiusPx = 6;  // smaller heads show no slot that could be told from a speck

// The head in its own frame: (0, 0) its centre, 1 its radius, x along `along`.
class HeadFrame {
 public:
  HeadFrame(const cv::Mat& grey,
            const ToneCurve& tone,
            const Vector2d& center_px,
            double radius_px,
            double angle_rad)
      : grey_(grey),
        tone_(tone),
        center_px_(center_px),
        along_px_(radius_px * Vector2d(std::cos(angle_rad), std::sin(angle_rad))) {}

  [[nodiscard]] Vector2d Place(double along, double across) const {
    return center_px_ + along * along_px_ + across * Vector2d(-along_px_.y(), along_px_.x());
  }

  // Linear light, bilinear; the picture's border repeats.
  [[nodiscard]] double Light(double along, double across) const {
    return Bilinear<uchar>(
        grey_, Place(along, across), [this](uchar grey) { return tone_.linear[grey]; });
  }

 private:
  const cv::Mat& grey_;
  const ToneCurve& tone_;
  Vector2d center_px_, along_px_;
};

// What of a slot is dark.
struct DarkBar {
  double centre = 0;  // of its darkness
  double width = 0;   // of a bar as dark as its darkest with all its darkness
};

// Light across the slot, averaged along part of it; one value each kStep.
class CrossProfile {
 public:
  static constexpr double kStep = 0.05, kHalf = 0.55;

  CrossProfile(const HeadFrame& head, double middle, double half_length, int places) {
    for (int i = 0; i < kCount; ++i) {
      for (int k = 0; k < places; ++k) {
        const double along = middle + half_length * ((2 * k + 1.0) / places - 1);
        light_[static_cast<std::size_t>(i)] += head.Light(along, Across(i)) / places;
      }
    }
  }

  // How dark a slot at `across` is beside the darker of its sides: 0 not at all, 1 black.
  [[nodiscard]] double Darkness(double across) const {
    Mean inside;
    ForEachWithin(kHalfWidth + 1e-9, across, [&](int i) { inside.Add(At(i)); });
    const double beside = Beside(across);
    return beside > 0 ? 1 - inside.Value() / beside : 0;
  }

  // All about `across` that is clearly darker than the head: floor and walls, as far as they are
  // not lit.
  [[nodiscard]] DarkBar BarAbout(double across) const {
    constexpr double kWidest = 2.2 * kHalfWidth;
    double darkest = std::numeric_limits<double>::infinity();
    ForEachWithin(kWidest, across, [&](int i) { darkest = std::min(darkest, At(i)); });
    constexpr double kClearly = 0.2;  // of the depth
    const double beside = Beside(across), clearly = beside - kClearly * (beside - darkest);
    double darkness = 0, moment = 0;
    ForEachWithin(kWidest, across, [&](int i) {
      const double dark = std::max(0.0, clearly - At(i));
      darkness += dark;
      moment += dark * Across(i);
    });
    if (!(darkness > 0)) return {across, 0};
    return {moment / darkness, kStep * darkness / (clearly - darkest)};
  }

 private:
  struct Mean {
    double sum = 0;
    int count = 0;
    void Add(double value) {
      sum += value;
      ++count;
    }
    [[nodiscard]] double Value() const { return count > 0 ? sum / count : 0; }
  };
  // Light on the darker of both sides, clear of walls and blur.
  [[nodiscard]] double Beside(double across) const {
    constexpr double kGap = 1.3 * kHalfWidth, kSide = 2.8 * kHalfWidth;
    Mean before, after;
    ForEachWithin(kSide, across, [&](int i) {
      if (Across(i) < across - kGap) before.Add(At(i));
      if (Across(i) > across + kGap) after.Add(At(i));
    });
    return std::min(before.Value(), after.Value());
  }
  template <typename Visit>
  static void ForEachWithin(double half_width, double across, const Visit& visit) {
    const int first = std::max(0, static_cast<int>((across - half_width + kHalf) / kStep + 1));
    for (int i = first; i < kCount && Across(i) < across + half_width; ++i) visit(i);
  }
  [[nodiscard]] double At(int i) const { return light_[static_cast<std::size_t>(i)]; }

  static constexpr int kCount = static_cast<int>(2 * kHalf / kStep) + 1;
  static double Across(int i) { return i * kStep - kHalf; }
  std::array<double, kCount> light_{};
};

struct SlotLine {
  double angle_rad = 0, across = 0;
  double darkness = 0;
};

// The darkest straight bar near the centre.
SlotLine DarkestLine(const cv::Mat& grey,
                     const ToneCurve& tone,
                     const Vector2d& center_px,
                     double radius_px) {
  constexpr int kAngles = 36, kPlaces = 12;
  constexpr double kOffsetStep = 0.05;
  SlotLine darkest;
  for (int k = 0; k < kAngles; ++k) {
    const double angle = k * std::numbers::pi / kAngles;
    const CrossProfile profile(
        HeadFrame(grey, tone, center_px, radius_px, angle), 0, kReach, kPlaces);
    for (double across = -kMostOff; across <= kMostOff + 1e-9; across += kOffsetStep) {
      const double darkness = profile.Darkness(across);
      if (darkness > darkest.darkness) darkest = {angle, across, darkness};
    }
  }
  return darkest;
}

// Where along the slot the middle of a section lies.
double SectionMiddle(int k) { return kReach * ((2 * k + 1.0) / kSections - 1); }

std::vector<CrossProfile> Sections(const HeadFrame& head) {
  constexpr int kPlaces = 4;
  std::vector<CrossProfile> sections;
  for (int k = 0; k < kSections; ++k) {
    sections.emplace_back(head, SectionMiddle(k), kReach / kSections, kPlaces);
  }
  return sections;
}

// A slot is dark, and alike from end to end; streaks of brushed metal are neither.
bool DarkThroughout(const std::vector<CrossProfile>& sections, const SlotLine& slot) {
  constexpr double kDark = 0.12, kAlike = 0.6;  // of the whole
  constexpr int kMostBright = 1;                // dirt or a glint in it
  if (slot.darkness < kDark) return false;
  const auto bright = std::count_if(sections.begin(), sections.end(), [&](const auto& section) {
    return section.Darkness(slot.across) < kAlike * slot.darkness;
  });
  return bright <= kMostBright;
}

// A straight line through the sections' centres: across = offset + slope * along.
struct CentreLine {
  double offset = 0, slope = 0, scatter = 0;
};

CentreLine LineThrough(const std::vector<CrossProfile>& sections, double across) {
  double sum = 0, moment = 0, squares = 0;
  std::vector<double> centers;
  for (int k = 0; k < kSections; ++k) {
    const double along = SectionMiddle(k);
    centers.push_back(sections[static_cast<std::size_t>(k)].BarAbout(across).centre);
    sum += centers.back();
    moment += along * centers.back();
    squares += along * along;
  }
  CentreLine line{sum / kSections, moment / squares, 0};
  for (int k = 0; k < kSections; ++k) {
    const double along = SectionMiddle(k);
    const double rest = centers[static_cast<std::size_t>(k)] - line.offset - line.slope * along;
    line.scatter += rest * rest / (kSections - 2);
  }
  line.scatter = std::sqrt(line.scatter);
  return line;
}

// How far what is dark may lie off the middle of the slot: a lit wall looks like the head.
double UnseenHalf(const HeadFrame& head, double across) {
  constexpr double kWide = 0.25;
  constexpr int kPlaces = 4 * kSections;
  const CrossProfile whole(head, 0, kReach, kPlaces);
  return 0.5 * std::max(0.0, kWide - whole.BarAbout(across).width);
}

// How far along the slot its end lies, towards +1 or -1: where half the darkness is gone.
std::optional<double> EndOf(const HeadFrame& head, double across, int toward) {
  constexpr double kInside = 0.6, kFirst = 0.7, kLast = 1.3, kStep = 0.02;
  const auto light = [&](double along) {
    return (head.Light(toward * along, across - 0.04) + head.Light(toward * along, across) +
            head.Light(toward * along, across + 0.04)) /
           3;
  };
  std::vector<double> inside, outside;
  for (double along = 0; along < kInside; along += kStep) inside.push_back(light(along));
  for (double along = kLast; along > kLast - 0.2; along -= kStep) outside.push_back(light(along));
  const double half = 0.5 * (Median(inside) + Median(outside));
  for (double along = kFirst; along < kLast; along += kStep) {
    if (light(along) > half) return toward * along;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ScrewSlot> FindSlot(const cv::Mat& grey,
                                  const ToneCurve& tone,
                                  const Vector2d& center_px,
                                  double radius_px) {
  constexpr int kRefinements = 3;
  constexpr double kStraight = 0.04;  // most scatter about the line
  if (radius_px < kLeastRadiusPx) return std::nullopt;
  SlotLine slot = DarkestLine(grey, tone, center_px, radius_px);
  CentreLine line;
  for (int k = 0; k < kRefinements; ++k) {
    const HeadFrame head(grey, tone, center_px, radius_px, slot.angle_rad);
    const std::vector<CrossProfile> sections = Sections(head);
    if (!DarkThroughout(sections, slot)) return std::nullopt;
    line = LineThrough(sections, slot.across);
    slot.across = line.offset;
    slot.angle_rad += std::atan(line.slope);
  }
  if (line.scatter > kStraight || std::abs(slot.across) > kMostOff) return std::nullopt;
  const HeadFrame head(grey, tone, center_px, radius_px, slot.angle_rad);
  const std::optional<double> first = EndOf(head, slot.across, -1),
                              last = EndOf(head, slot.across, 1);
  const double middle = first && last ? 0.5 * (*first + *last) : 0;
  const bool ends_seen = first && last && std::abs(middle) < kMostOff;
  // Ends about another centre than the rim's: one of both follows something else.
  const double along_sigma = ends_seen ? std::max(kEndsOffCentre, std::abs(middle)) : 1;
  const double across_sigma = std::hypot(
      kSlotOffCentre, UnseenHalf(head, slot.across), line.scatter / std::sqrt(kSections));
  const Vector2d along(std::cos(slot.angle_rad), std::sin(slot.angle_rad));
  return ScrewSlot{head.Place(ends_seen ? middle : 0, slot.across),
                   AlongAcross(along, radius_px * along_sigma, radius_px * across_sigma),
                   ends_seen};
}

}  // namespace bladecurve
