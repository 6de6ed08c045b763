// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/fit_record.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "curvefit/bands.h"

namespace bladecurve {
namespace {

using Json = nlohmann::ordered_json;

Json Record(const IterationRecord& step) {
  return {{"iteration", step.iteration},
          {"cost", step.cost},
          {"gradient_max", step.gradient_max},
          {"step_norm", step.step_norm}};
}

Json Record(const UndeterminedDirection& open) {
  return {{"text", open.text}, {"direction", open.direction}};
}

Json Record(const KnotCandidate& tried) {
  return {
      {"degree", tried.degree}, {"spans", tried.spans}, {"chi2", tried.chi2}, {"bic", tried.bic}};
}

const char* EdgeName(bool is_upper) { return is_upper ? "upper" : "lower"; }

Json Record(const RejectedPoint& point) {
  return {{"photo", point.photo},
          {"edge", EdgeName(point.is_upper)},
          {"index", point.index},
          {"sigmas", point.sigmas}};
}

Json Record(const EdgeFinding& edge) {
  return {{"photo", edge.photo},
          {"edge", EdgeName(edge.is_upper)},
          {"used", edge.used},
          {"points", edge.points},
          {"rejected", edge.rejected},
          {"sigma_scale", edge.sigma_scale},
          {"correlation_points", edge.correlation_points}};
}

Json Record(const ResidualTests& tests) {
  return {{"runs", tests.runs},
          {"runs_z", tests.runs_z},
          {"autocorrelation", tests.autocorrelation},
          {"correlation_points", tests.correlation_points},
          {"chi2_per_freedom", tests.chi2_per_freedom}};
}

Json Record(const Influence& influence) {
  return {{"largest_leverage", influence.largest_leverage},
          {"largest_cook", influence.largest_cook},
          {"photo", influence.photo},
          {"index", influence.index}};
}

Json Record(const GainFinding& gain) {
  return {{"gain", gain.gain}, {"sigma", gain.sigma}, {"chi2_per_freedom", gain.chi2_per_freedom}};
}

Json Record(const FamilyDifference& difference) {
  return {{"largest_mm", difference.largest_mm},
          {"at_x_mm", difference.at_x_mm},
          {"at_theta_rad", difference.at_theta_rad},
          {"largest_torque", difference.largest_torque},
          {"torque_at_theta_rad", difference.torque_at_theta_rad},
          {"near_closing_mm", difference.near_closing_mm},
          {"near_closing_torque", difference.near_closing_torque},
          {"near_closing_theta_rad", difference.near_closing_theta_rad},
          {"photographed_mm", difference.photographed_mm},
          {"photographed_torque", difference.photographed_torque}};
}

template <typename Item>
Json Records(const std::vector<Item>& items) {
  Json record = Json::array();
  for (const Item& item : items) record.push_back(Record(item));
  return record;
}

Json CriterionRecord(const BladeFit& fit) {
  return {{"name", "bic"},
          {"value", fit.recommended.bic},
          {"aicc", fit.recommended.aicc},
          {"why", fit.why_recommended},
          {"knots_tried", Records(fit.knots_tried)}};
}

// Standard uncertainties of the curve along the blade, at one angle; the torque's is relative.
Json BandRecord(const CurveBand& band, const CurveDomain& domain, double theta_rad) {
  constexpr int kPlaces = 11;  // enough for a plot: the band is smooth
  Json record = {{"theta_rad", theta_rad}};
  for (int i = 0; i < kPlaces; ++i) {
    const double share = static_cast<double>(i) / (kPlaces - 1);
    const double x_mm = domain.x_min_mm + share * (domain.x_max_mm - domain.x_min_mm);
    const CurveSigma sigma = band.At(x_mm, theta_rad);
    record["x_mm"].push_back(x_mm);
    record["phi_sigma_mm"].push_back(sigma.phi_mm);
    record["phi_x_sigma"].push_back(sigma.phi_x);
    record["phi_theta_sigma_mm_per_rad"].push_back(sigma.phi_theta_mm_per_rad);
  }
  const std::optional<double> torque = band.TorqueAt(theta_rad);
  record["torque_sigma"] = torque ? Json(*torque) : Json();
  return record;
}

// At the angle of each photograph.
Json BandsRecord(const BladeFit& fit) {
  const CurveBand band(fit.recommended);
  Json record = Json::array();
  for (const FittedPose& pose : fit.poses) {
    record.push_back(BandRecord(band, fit.recommended.curve.domain(), pose.theta_rad));
  }
  return record;
}

// What the points determine with the knots left open; null for a straight edge.
Json EffectiveCoefficients(const FamilyFit& fit) {
  return fit.finer ? Json(fit.finer->effective_coefficients) : Json();
}

}  // namespace

Json FitRecord(const BladeFit& fit, double mm_per_px) {
  const FamilyFit& chosen = fit.recommended;
  return {{"rms_mm", chosen.rms_mm},
          {"rms_px", chosen.rms_mm / mm_per_px},
          {"points", chosen.points},
          {"inliers", chosen.inliers},
          {"effective_points", chosen.effective_points},
          {"effective_coefficients", EffectiveCoefficients(chosen)},
          {"chi2", chosen.chi2},
          {"freedom", chosen.freedom},
          {"sigma_scale", chosen.sigma_scale},
          {"condition_number", chosen.condition_number},
          {"rank", chosen.rank},
          {"num_parameters", chosen.num_parameters},
          {"undetermined", Records(chosen.undetermined)},
          {"limits", chosen.limits},
          {"iterations", chosen.iterations},
          {"converged", chosen.converged},
          {"termination", chosen.termination},
          {"trace", Records(chosen.trace)},
          {"criterion", CriterionRecord(fit)},
          {"theta_definition", fit.theta_definition},
          {"gain", Record(fit.gain)},
          {"families_difference", Record(fit.difference)},
          {"residual_tests", Record(chosen.residual_tests)},
          {"influence", Record(chosen.influence)},
          {"edges", Records(fit.edges)},
          {"disagreement", chosen.disagreement},
          {"bands", BandsRecord(fit)},
          {"rejected", Records(fit.rejected)}};
}

}  // namespace bladecurve
