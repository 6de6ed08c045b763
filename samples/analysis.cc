// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/analysis.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <stdexcept>
#include <utility>

#include "model/degrees.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

std::string NamingThePhoto(const std::string& detail, const std::string& photo) {
  return detail.find(photo) != std::string::npos ? detail : photo + ": " + detail;
}

// One photograph, with every failure named after it.
PhotoMeasurement Measure(const std::filesystem::path& photo, const MeasureOptions& options) {
  try {
    return MeasurePhoto(photo, options);
  } catch (const Refused& refusal) {
    throw PhotoRefused(refusal, photo.string());
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(NamingThePhoto(error.what(), photo.string()));
  } catch (const std::exception& error) {
    throw std::runtime_error(NamingThePhoto(error.what(), photo.string()));
  }
}

std::vector<PhotoMeasurement> MeasureAll(const std::vector<std::filesystem::path>& photos,
                                         const AnalysisSettings& settings) {
  std::vector<std::optional<PhotoMeasurement>> measured(photos.size());
  ParallelFor(static_cast<int>(photos.size()), settings.num_threads, [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    MeasureOptions options = settings.measure;
    if (options.debug_dir && photos.size() > 1)
      *options.debug_dir /= fmt::format("{}_{}", index + 1, photos[i].stem().string());
    if (!settings.theta_rad.empty()) options.hints.theta_rad = settings.theta_rad[i];
    measured[i] = Measure(photos[i], options);
  });
  std::vector<PhotoMeasurement> results;
  for (auto& photo : measured) results.push_back(std::move(*photo));
  return results;
}

// The same picture twice is no second observation.
void RequireDistinct(const std::vector<PhotoMeasurement>& photos) {
  for (std::size_t i = 0; i < photos.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (photos[i].sha256 != photos[j].sha256) continue;
      throw std::invalid_argument(
          fmt::format("{} and {} are the same picture, which tells nothing twice; give it once",
                      photos[j].file,
                      photos[i].file));
    }
  }
}

BladeFit Fit(const std::vector<PhotoMeasurement>& photos, const FitOptions& options) {
  std::vector<EdgePoints> edges;
  for (const PhotoMeasurement& photo : photos) edges.push_back(photo.edges);
  try {
    return FitBlade(edges, options);
  } catch (const Refused& refusal) {
    throw PhotoRefused(refusal, photos.front().file);
  }
}

// Of angles that are known to more than a quarter of a degree only, not of given ones.
void DoubtVagueAngles(const BladeFit& fit, std::vector<PhotoMeasurement>* photos) {
  constexpr double kVagueRad = 0.25 * kRadPerDeg;
  for (std::size_t i = 0; i < photos->size(); ++i) {
    PhotoMeasurement& photo = (*photos)[i];
    if (photo.edges.theta_given || fit.poses[i].theta_sigma_rad <= kVagueRad) continue;
    photo.warnings.emplace_back("theta_vague");
  }
}

}  // namespace

PhotoRefused::PhotoRefused(const Refused& refusal, std::string photo)
    : Refused(refusal.reason(), NamingThePhoto(refusal.what(), photo)), photo_(std::move(photo)) {}

Analysis AnalyzeScissors(const std::vector<std::filesystem::path>& photos,
                         const AnalysisSettings& settings) {
  if (photos.empty()) throw std::invalid_argument("no photograph given");
  if (!settings.theta_rad.empty() && settings.theta_rad.size() != photos.size()) {
    throw std::invalid_argument(
        fmt::format("--theta-deg: {} angles for {} photographs; give one each",
                    settings.theta_rad.size(),
                    photos.size()));
  }
  std::vector<PhotoMeasurement> measured = MeasureAll(photos, settings);
  RequireDistinct(measured);
  const auto start = std::chrono::steady_clock::now();
  BladeFit fit = Fit(measured, settings.fit);
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start;
  DoubtVagueAngles(fit, &measured);
  return {std::move(measured), std::move(fit), elapsed.count()};
}

}  // namespace bladecurve
