// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/measure.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "vision/blade_frame.h"
#include "vision/parallel.h"
#include "vision/pivot/pivot.h"
#include "vision/refused.h"
#include "vision/scale/scale_debug.h"
#include "vision/scene/scene.h"
#include "vision/scissors/located_blade.h"
#include "vision/scissors/opening.h"
#include "vision/scissors/scissors.h"
#include "vision/warnings.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

PlaneMap MapFor(const ScaleResult& scale,
                const ScaleOptions& options,
                const Pivot& pivot,
                const LocatedBlade& upper) {
  if (scale.map) return *scale.map;
  // --length-mm: the distance from the pivot to the upper distal end.
  const double length_px = (Undistorted(scale.camera->camera, upper.end.point_px) -
                            Undistorted(scale.camera->camera, pivot.point_px))
                               .norm();
  const double sigma_px =
      std::sqrt(pivot.covariance_px2.trace() / 2 + std::pow(upper.end.along_sigma_px, 2));
  return PlaneMap::Uniform(
      *options.length_mm / length_px, sigma_px / length_px, "length", scale.camera->camera);
}

std::vector<EdgePoint> ToFrame(const BladeFrame& frame,
                               const std::vector<LocatedEdgePoint>& located) {
  std::vector<EdgePoint> points;
  points.reserve(located.size());
  for (const LocatedEdgePoint& p : located)
    points.push_back(frame.FromImage(p.point_px, p.normal, p.sigma_px));
  return points;
}

// Everything in mm that the fit needs.
EdgePoints ToEdgePoints(const BladeFrame& frame,
                        const PlaneMap& map,
                        const Pivot& pivot,
                        const LocatedBlade& upper,
                        const LocatedBlade& lower) {
  EdgePoints edges;
  const double shared_px = upper.edge.common_sigma_px;
  edges.upper = ToFrame(frame, upper.used);
  edges.lower = ToFrame(frame, DoubtedAlone(lower, upper));
  edges.pivot = frame.FromImage(pivot.point_px, pivot.covariance_px2);
  edges.upper_end = frame.FromImage(upper.end.point_px, EndCovariance(upper, shared_px));
  edges.lower_end = frame.FromImage(lower.end.point_px, EndCovariance(lower, shared_px));
  edges.scale_relative_sigma = map.relative_sigma();
  edges.correlation_length_mm = upper.edge.correlation_px * frame.mm_per_px();
  edges.common_offset_sigma_mm = shared_px * frame.mm_per_px();
  return edges;
}

// Paths, ends and pivot as the viewer sees them, and the trend in mm.
void FillPixels(const Photo& photo,
                const BladeFrame& frame,
                const Pivot& pivot,
                const Blades& blades,
                PhotoMeasurement* result) {
  result->pivot_px = photo.DisplayedFromStored(pivot.point_px);
  result->pivot_sigma_px = pivot.SigmaPx();
  result->pivot_source = pivot.source;
  result->axis_px = photo.DisplayedFromStored(pivot.point_px + frame.axis_px()) - result->pivot_px;
  for (const LocatedEdgePoint& p : blades.upper.used) {
    result->upper_edge_px.push_back(photo.DisplayedFromStored(p.trend_px));
    result->upper_edge_mm.push_back(frame.FromImage(p.trend_px));
  }
  for (const LocatedEdgePoint& p : blades.lower.used)
    result->lower_edge_px.push_back(photo.DisplayedFromStored(p.trend_px));
  result->upper_edge_sigma_px = EdgeSigmaPx(blades.upper);
  result->upper_end_px = photo.DisplayedFromStored(blades.upper.end.point_px);
  result->lower_end_px = photo.DisplayedFromStored(blades.lower.end.point_px);
}

// Whether the scale was hardly meant: of a factor wrong by 2 some scissors show it, of 25.4 all.
bool IsUnusual(const EdgePoints& edges, const PlaneMap& map) {
  constexpr double kShortestMm = 5, kLongestMm = 160;  // micro scissors, tailor's shears
  const double length_mm = edges.upper_end.point_mm.norm();
  return map.source() != kPixelsSource && (length_mm < kShortestMm || length_mm > kLongestMm);
}

void FillTheta(const Opening& opening,
               const std::optional<double>& given_rad,
               PhotoMeasurement* result) {
  result->theta_rad = given_rad.value_or(opening.theta_rad);
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const double sigma_rad = std::hypot(opening.sigma_rad, opening.view_sigma_rad);
  result->theta_sigma_rad = given_rad ? kUnknown : sigma_rad;
  result->theta_source = given_rad ? "given" : "distal-ends";
  result->seen_theta_rad = opening.theta_rad;
  result->seen_theta_sigma_rad = sigma_rad;
  result->edges.theta_rad = result->theta_rad;
  result->edges.theta_sigma_rad = given_rad ? kUnknown : opening.sigma_rad;
  result->edges.theta_given = given_rad.has_value();
  result->edges.view_theta_sigma_rad = opening.view_sigma_rad;
}

ScaleResult FindScaleInView(const Photo& photo, const ScaleOptions& options, StageLog* log) {
  try {
    ScaleResult scale = FindScale(photo, options);
    log->Picture("scale", [&] { return DrawMarkers(photo.grey(), scale.markers); });
    return scale;
  } catch (const Refused&) {
    log->Picture("scale", [&] {
      return DrawMarkers(photo.grey(), FindMarkers(photo.grey(), SrgbToneCurve()));
    });
    throw;
  }
}

// Prints that are seen but give no scale are no part of the scene either; they are looked for where
// nothing else explains what is seen.
void FindScene(const Photo& photo,
               const StoredHints& hints,
               ScaleResult* scale,
               std::optional<SceneFinder>* finder,
               StageLog* log) {
  try {
    finder->emplace(photo, scale->markers, hints, log);
  } catch (const Refused&) {
    if (!scale->markers.empty()) throw;
    scale->markers = FindMarkers(photo.grey(), scale->tone);
    if (scale->markers.empty()) throw;
    log->Ran("markers", "print that gives no scale is left out");
    finder->emplace(photo, scale->markers, hints, log);
  }
}

}  // namespace

PhotoMeasurement MeasurePhoto(const std::filesystem::path& path, const MeasureOptions& options) {
  StageLog log(options.debug_dir, options.plan);
  Photo photo = Photo::Load(path);
  log.Ran("decode", "grey");
  ScaleResult scale = FindScaleInView(photo, options.scale, &log);
  log.Ran("scale", scale.map ? scale.map->source() : "waits for the blades: --length-mm");
  const StoredHints hints = InStored(photo, options.hints);
  std::optional<SceneFinder> finder;
  std::string sha256;
  ParallelAside([&] { FindScene(photo, hints, &scale, &finder, &log); },
                [&] { sha256 = photo.Sha256(); });  // where finding leaves a thread idle
  const Scissors scissors = LocateScissors({photo, scale, hints}, &*finder, &log);
  const Pivot& pivot = scissors.pivot;
  const Blades& blades = scissors.blades;
  const PlaneMap map = MapFor(scale, options.scale, pivot, blades.upper);
  const Opening opening = MeasureOpening(map, scale.camera, pivot, blades.upper, blades.lower);
  const BladeFrame frame(map, pivot.point_px, opening.x_in_plane);

  PhotoMeasurement result;
  result.file = path.string();
  result.sha256 = std::move(sha256);
  result.width = photo.displayed_width();
  result.height = photo.displayed_height();
  result.mm_per_px = frame.mm_per_px();
  result.mm_per_px_sigma = frame.mm_per_px_sigma(pivot.covariance_px2);
  result.scale_source = map.source();
  result.edges = ToEdgePoints(frame, map, pivot, blades.upper, blades.lower);
  result.edges.photo = result.file;
  FillPixels(photo, frame, pivot, blades, &result);
  FillTheta(opening, options.hints.theta_rad, &result);
  result.warnings = WarningsOf(scissors.scene, scale, map, pivot, blades);
  if (IsUnusual(result.edges, map)) result.warnings.emplace_back("size_unusual");
  log.Ran("pose", "opening angle and axis from the distal ends");
  result.plan = log.records();
  result.ms_total = log.total_ms();
  if (options.keep_photo) result.photo = std::make_shared<const Photo>(std::move(photo));
  return result;
}

}  // namespace bladecurve
