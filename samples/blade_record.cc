// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/blade_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "model/blade_file.h"
#include "samples/fit_record.h"
#include "samples/fitted_photo.h"
#include "samples/json_arrays.h"
#include "vision/scale/scale.h"

namespace bladecurve {
namespace {

using Json = nlohmann::ordered_json;

// As the model writes it: what the format's own keys look like is said in one place.
Json PlainFile(const BladeCurve& curve) { return Json::parse(BladeFileText({"", curve})); }

Json AlternativesRecord(const BladeFit& fit) {
  Json record = Json::array();
  for (const FamilyFit& other : fit.alternatives) {
    record.push_back({{"curve", CurveRecord(other.curve)},
                      {"rms_mm", other.rms_mm},
                      {"largest_difference_mm", fit.largest_difference_mm},
                      {"largest_difference_torque", fit.largest_difference_torque},
                      {"parameters", other.parameter_names},
                      {"covariance", MatrixJson(other.covariance)},
                      {"bic", other.bic},
                      {"aicc", other.aicc}});
  }
  return record;
}

double MeanMmPerPx(const std::vector<PhotoMeasurement>& photos) {
  double sum = 0;
  for (const PhotoMeasurement& photo : photos) sum += photo.mm_per_px;
  return sum / static_cast<double>(photos.size());
}

Json PlanRecord(const std::vector<StageRecord>& plan, bool times) {
  Json record = Json::array();
  for (const StageRecord& stage : plan) {
    Json line = {{"stage", stage.stage}, {"ran", stage.ran}, {"why", stage.why}};
    if (times) line["ms"] = stage.ms;
    record.push_back(line);
  }
  return record;
}

// The curve fit as the last stage of each photograph; all share its time.
std::vector<StageRecord> PlanWithFit(const PhotoMeasurement& photo, const Analysis& analysis) {
  std::vector<StageRecord> plan = photo.plan;
  const auto photos = static_cast<double>(analysis.photos.size());
  plan.push_back({"fit", true, "all photographs together", analysis.fit_ms / photos});
  return plan;
}

Json PhotoRecord(const Analysis& analysis, std::size_t index, bool times) {
  const PhotoMeasurement& photo = analysis.photos[index];
  const FittedPhoto fitted = ApplyPose(photo, analysis.fit.poses[index]);
  const std::vector<StageRecord> plan = PlanWithFit(photo, analysis);
  Json record = {{"file", photo.file},
                 {"sha256", photo.sha256},
                 {"width", photo.width},
                 {"height", photo.height},
                 {"pivot_px", PointJson(fitted.pivot_px)},
                 {"pivot_sigma_px", fitted.pivot_sigma_px},
                 {"pivot_source", photo.pivot_source},
                 {"axis_px", PointJson(fitted.axis_px)},
                 {"theta_rad", fitted.theta_rad},
                 {"theta_sigma_rad", fitted.theta_sigma_rad},
                 {"theta_source", photo.theta_source},
                 {"mm_per_px", fitted.mm_per_px},
                 {"mm_per_px_sigma", photo.mm_per_px_sigma},
                 {"scale_source", photo.scale_source},
                 {"rms_mm", analysis.fit.poses[index].rms_mm},
                 {"upper_edge_px", PointsJson(photo.upper_edge_px)},
                 {"upper_edge_mm", PointsJson(fitted.upper_edge_mm)},
                 {"upper_edge_sigma_px", photo.upper_edge_sigma_px},
                 {"lower_edge_px", PointsJson(photo.lower_edge_px)},
                 {"upper_end_px", PointJson(photo.upper_end_px)},
                 {"lower_end_px", PointJson(photo.lower_end_px)},
                 {"warnings", photo.warnings},
                 {"plan", PlanRecord(plan, times)}};
  if (photo.theta_source == "given") {
    record["seen_theta_rad"] = photo.seen_theta_rad;
    record["seen_theta_sigma_rad"] = photo.seen_theta_sigma_rad;
  }
  if (times) record["ms_total"] = photo.ms_total + plan.back().ms;
  return record;
}

Json PhotosRecord(const Analysis& analysis, bool times) {
  Json record = Json::array();
  for (std::size_t i = 0; i < analysis.photos.size(); ++i) {
    record.push_back(PhotoRecord(analysis, i, times));
  }
  return record;
}

// A line a key: readable and comparable line by line, without a line for each of a thousand
// numbers.
std::string LineAKey(const Json& record) {
  std::string text;
  for (const auto& [key, value] : record.items()) {
    text += text.empty() ? "{\n" : ",\n";
    text += Json(key).dump() + ": ";
    text += value.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return text + "\n}\n";
}

}  // namespace

Json CurveRecord(const BladeCurve& curve) { return PlainFile(curve).at("curve"); }

std::vector<std::string> Warnings(const Analysis& analysis) {
  std::vector<std::string> warnings;
  const auto add = [&warnings](const std::vector<std::string>& codes) {
    for (const std::string& code : codes) {
      if (std::find(warnings.begin(), warnings.end(), code) == warnings.end()) {
        warnings.push_back(code);
      }
    }
  };
  for (const PhotoMeasurement& photo : analysis.photos) add(photo.warnings);
  add(analysis.fit.warnings);
  return warnings;
}

std::string Status(const Analysis& analysis) {
  return Warnings(analysis).empty() ? "ok" : "review";
}

std::string BladeRecordText(const Analysis& analysis, const RecordOptions& options) {
  const FamilyFit& fit = analysis.fit.recommended;
  Json record = {
      {"format", "bladecurve/1"},
      {"name", options.name},
      {"status", Status(analysis)},
      {"warnings", Warnings(analysis)},
      {"notes", analysis.fit.notes},
      {"software", {{"name", "bladecurve"}, {"version", BLADECURVE_VERSION}}},
      {"curve", CurveRecord(fit.curve)},
      {"alternatives", AlternativesRecord(analysis.fit)},
      {"domain", PlainFile(fit.curve).at("domain")},
      {"covariance", {{"parameters", fit.parameter_names}, {"matrix", MatrixJson(fit.covariance)}}},
      {"fit", FitRecord(analysis.fit, MeanMmPerPx(analysis.photos))},
      {"photos", PhotosRecord(analysis, options.times)}};
  if (analysis.photos.front().scale_source == kPixelsSource) record["units"] = "px";
  return LineAKey(record);
}

}  // namespace bladecurve
