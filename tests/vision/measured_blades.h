// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// A rendered photograph with markers, measured up to where the two edges are compared, and ways to
// spoil what was found.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "process_folder.h"
#include "vision/photo/png_writer.h"
#include "vision/pivot/pivot_geometry.h"
#include "vision/render/render.h"
#include "vision/scissors/edge_pair.h"
#include "vision/scissors/mirror_line.h"

namespace bladecurve::testing {

using Eigen::Vector2d;

inline constexpr double kMarkerMm = 25;

inline SceneSpec SceneWithMarkers() {
  SceneSpec spec;
  spec.width = 1200;
  spec.height = 900;
  spec.camera.mm_per_px = 0.25;
  spec.camera.tilt_rad = 0.15;
  for (int k = 0; k < 4; ++k) {
    const Vector2d corner((k % 2 == 0 ? -1 : 1) * 120, (k < 2 ? -1 : 1) * 85);
    spec.markers.push_back({k, kMarkerMm, corner, 0.1, 5});
  }
  return spec;
}

// The same without a trace of the scissors.
inline cv::Mat BareSheet() {
  SceneSpec bare = SceneWithMarkers();
  bare.with_scissors = false;
  return RenderScene(bare).bgr;
}

// A lamp that throws the lower blade's shadow into the gap between the blades.
inline SceneSpec SceneWithShadow(double elevation_rad, double direction_rad, double blur_mm) {
  SceneSpec spec = SceneWithMarkers();
  spec.light.elevation_rad = elevation_rad;
  spec.light.direction_rad = direction_rad;
  spec.light.shadow = 0.75;
  spec.light.shadow_blur_mm = blur_mm;
  spec.light.glint = 0;
  return spec;
}

inline constexpr double kBevelPx = 9;

// The picture with grain.
inline cv::Mat Grained(cv::Mat picture) {
  constexpr double kGrain = 4;
  cv::Mat grain(picture.size(), CV_16SC3);
  cv::RNG(1).fill(grain, cv::RNG::NORMAL, 0, kGrain);
  cv::add(picture, grain, picture, cv::noArray(), CV_8UC3);
  return picture;
}

// The scissors retouched within a distance of the upper edge. retouch(sheet, depth_px, share): what
// the sheet's grey levels look like so far within the blade (negative: outside), there along the
// edge.
template <typename Retouch>
cv::Mat RetouchedAlongUpperEdge(const SceneSpec& spec,
                                double from_px,
                                double to_px,
                                const Retouch& retouch) {
  constexpr double kStepPx = 0.25, kBeyondPx = 3;
  const cv::Mat picture = RenderScene(spec).bgr;
  cv::Mat retouched = picture.clone();
  const std::vector<Vector2d>& edge = TruthOf(spec).upper.px;
  for (std::size_t i = 1; i < edge.size(); ++i) {
    const Vector2d along = edge[i] - edge[i - 1];
    const Vector2d outwards = Vector2d(-along.y(), along.x()).normalized();  // the tips lie right
    const double share = static_cast<double>(i) / static_cast<double>(edge.size());
    for (double t = 0; t < 1; t += kStepPx / along.norm()) {
      const Vector2d on_edge = edge[i - 1] + t * along;
      for (double depth = from_px; depth < to_px; depth += kStepPx) {
        const auto pixel = [](const Vector2d& at) {
          return cv::Point(static_cast<int>(std::lround(at.x())),
                           static_cast<int>(std::lround(at.y())));
        };
        const cv::Vec3b sheet =
            picture.at<cv::Vec3b>(pixel(on_edge + (std::abs(depth) + kBeyondPx) * outwards));
        retouched.at<cv::Vec3b>(pixel(on_edge - depth * outwards)) =
            cv::Vec3b(retouch(cv::Vec3d(sheet), depth, share));
      }
    }
  }
  return retouched;
}

// light(depth_px, share): how much brighter the sheet looks; grey levels.
template <typename Light>
cv::Mat BrightenedAlongUpperEdge(const SceneSpec& spec,
                                 double from_px,
                                 double to_px,
                                 const Light& light) {
  const auto brighter = [&](const cv::Vec3d& sheet, double depth, double share) -> cv::Vec3d {
    return sheet + cv::Vec3d::all(std::round(light(depth, share)));
  };
  return RetouchedAlongUpperEdge(spec, from_px, to_px, brighter);
}

// The scissors with a bevel on the upper blade that mirrors the sheet but for a few grey levels,
// brighter here and darker there, in a grainy picture.
inline cv::Mat WithMirroringBevel(const SceneSpec& spec) {
  constexpr double kUnlike = 3, kWaves = 1.5;
  return Grained(BrightenedAlongUpperEdge(spec, 0, kBevelPx, [](double, double share) {
    return kUnlike * std::cos(kWaves * 2 * std::numbers::pi * share);
  }));
}

// The scissors with a bevel that is a little brighter than the sheet, over the other blade as well.
inline cv::Mat WithBrightBevel(const SceneSpec& spec) {
  constexpr double kBrighter = 12;
  const cv::Vec3b sheet = RenderScene(spec).bgr.at<cv::Vec3b>(spec.height / 2, 10);
  return Grained(RetouchedAlongUpperEdge(spec, 0, kBevelPx, [&](const cv::Vec3d&, double, double) {
    return cv::Vec3d(sheet) + cv::Vec3d::all(kBrighter);
  }));
}

// The scissors with a shadow beside the upper edge that is so wide; the other blade's edge, moved
// along with what it is beside, is seen in it.
inline cv::Mat WithShadowBeside(const SceneSpec& spec, double width_px) {
  constexpr double kDarker = 60;
  return Grained(
      BrightenedAlongUpperEdge(spec, -width_px, 0, [](double, double) { return -kDarker; }));
}

// As a camera that sees no colours takes the scene: none tell shadows from blades.
inline cv::Mat WithoutColours(const SceneSpec& spec) {
  cv::Mat grey;
  cv::cvtColor(RenderScene(spec).bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

// A rendered photograph up to where the edges are compared. The blades' outer sides, which tell
// cast shadows, stay unseen: an edge may lie at a shadow's border.
struct Measured {
  explicit Measured(const SceneSpec& spec) : Measured(spec, RenderScene(spec).bgr) {}
  Measured(const SceneSpec& spec, const cv::Mat& picture)
      : truth(TruthOf(spec)), photo(PhotoOf(picture)), scale(FindScale(photo, ScaleOf(spec))) {
    StageLog log;
    scene = SceneFinder(photo, scale.markers, {}, &log).Likeliest();
    for (SceneBlade* blade : {&scene.left, &scene.right}) blade->outer_px.clear();
    BladeEdges edges = LocateBlades(View());
    blades = {{true, edges.upper, {}, {}, {}}, {false, edges.lower, {}, {}, {}}, false};
    for (LocatedBlade* blade : {&blades.upper, &blades.lower}) TrimToFree(View(), blade);
    pivot.point_px = truth.pivot_px;
    pivot.covariance_px2.setIdentity();
    pivot.source = "screw";
    Compare();
  }

  void Compare() {
    const EdgePair edges = PairOf(blades.upper, blades.lower);
    pivot.asymmetry = EdgeAsymmetry(edges, pivot.point_px);
    pivot.unlikeness = EdgeUnlikeness(edges, pivot.point_px);
  }

  // As if the other side of the scissors were up.
  void TurnOver() { std::swap(blades.upper, blades.lower); }

  // As if nothing beside the edge looked like a border.
  static void MakeClear(LocatedBlade* blade) {
    blade->edge.ambiguity = 0;
    blade->edge.common_sigma_px = 0.1;
  }

  // As if the edge had been lost and were the trace of the scene.
  void Lose(LocatedBlade* blade, double outwards_px) {
    Misplace(blade, outwards_px);
    blade->edge.ambiguity = 1;
    blade->edge.common_sigma_px = outwards_px;
  }

  // As if the edge had been taken for a faint line of the background, or for another one.
  static constexpr double kFaint = 0.01, kStrong = 0.9;
  void Misplace(LocatedBlade* blade, double outwards_px, double contrast = kFaint) {
    for (LocatedEdgePoint& p : blade->edge.points) p.contrast = contrast;
    Shift(blade, [&](double) { return outwards_px; });
  }

  // Outwards by outwards_px(share of the edge) at each point.
  template <typename Outwards>
  void Shift(LocatedBlade* blade, const Outwards& outwards_px) {
    std::vector<LocatedEdgePoint>& points = blade->edge.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(points.size());
      const Vector2d shift = outwards_px(share) * points[i].normal;
      points[i].point_px += shift;
      points[i].trend_px += shift;
    }
    KeepFree(scene, blade);
    Compare();
  }

  [[nodiscard]] LocatedBlade& Blade(bool upper) { return upper ? blades.upper : blades.lower; }
  [[nodiscard]] const EdgeTruth& TrueEdge(bool upper) const {
    return upper ? truth.upper : truth.lower;
  }

  [[nodiscard]] BladeView View() const { return BladeView(photo, scale, scene); }

  static Photo PhotoOf(const cv::Mat& picture) {
    const std::filesystem::path file = ProcessFolder() / "picture.png";
    WritePng(file, picture);
    return Photo::Load(file);
  }
  static ScaleOptions ScaleOf(const SceneSpec& spec) {
    ScaleOptions options;
    options.marker_mm = kMarkerMm;
    options.plane_height_mm = spec.edge_height_mm;
    return options;
  }

  SceneTruth truth;
  Photo photo;
  ScaleResult scale;
  Scene scene;
  Blades blades;
  Pivot pivot;
};

// Median distance of the inlying points from the true edge, px.
inline double FarFrom(const EdgeTruth& truth, const std::vector<LocatedEdgePoint>& points) {
  std::vector<double> off;
  for (const LocatedEdgePoint& p : points) {
    if (!p.inlier) continue;
    double nearest = 1e9;
    for (const Vector2d& q : truth.px)
      nearest = std::min(nearest,
                         std::abs(p.normal.dot(p.point_px - q)) + 0.01 * (p.point_px - q).norm());
    off.push_back(nearest);
  }
  std::nth_element(
      off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2), off.end());
  return off[off.size() / 2];
}

}  // namespace bladecurve::testing
