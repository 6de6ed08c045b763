// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/validation_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "samples/csv_text.h"
#include "samples/validation_misses.h"

namespace bladecurve {
namespace {

constexpr std::array<Quantity, kQuantities> kAll = {Quantity::kUpperEdge,
                                                    Quantity::kLowerEdge,
                                                    Quantity::kPivot,
                                                    Quantity::kTheta,
                                                    Quantity::kScale,
                                                    Quantity::kPhi,
                                                    Quantity::kTorque};

std::vector<double> SizesOf(const std::vector<ValidationRow>& rows, Quantity quantity) {
  std::vector<double> sizes;
  for (const ValidationRow& row : rows) {
    if (row.measured() && row.expected == "ok") sizes.push_back(row.Of(quantity).size);
  }
  return sizes;
}

std::string ErrorTable(const std::vector<ValidationRow>& rows) {
  std::string text = fmt::format("{:<14}{:>12}{:>12}{:>12}{:>26}\n",
                                 "error",
                                 "median",
                                 "95th",
                                 "largest",
                                 "95 % interval holds truth");
  for (const Quantity quantity : kAll) {
    const std::vector<double> sizes = SizesOf(rows, quantity);
    const Coverage coverage = CoverageOf(rows, quantity);
    const std::string held =
        coverage.of > 0 ? fmt::format("{:.1f} % of {}", 100 * coverage.share(), coverage.of)
                        : "no interval";
    text += fmt::format("{:<14}{:>12.4g}{:>12.4g}{:>12.4g}{:>26}\n",
                        fmt::format("{}, {}", QuantityName(quantity), QuantityUnit(quantity)),
                        Percentile(sizes, 0.5),
                        Percentile(sizes, 0.95),
                        Percentile(sizes, 1),
                        held);
  }
  for (const Quantity quantity : kAll) text += WhyMissed(rows, quantity);
  return text;
}

std::string CountsText(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? " (" : ", ", name, count);
  }
  return text.empty() ? "" : text + ")";
}

std::string RefusalTable(const std::vector<ValidationRow>& rows) {
  std::map<std::string, int> wrongly, rightly, other_reason;
  int ok = 0, review = 0, accepted = 0;
  for (const ValidationRow& row : rows) {
    if (row.expected == "ok") {
      ok += row.outcome == "ok" ? 1 : 0;
      review += row.outcome == "review" ? 1 : 0;
      if (!row.measured()) ++wrongly[row.outcome];
    } else if (row.measured()) {
      ++accepted;
    } else if (row.outcome == row.expected || row.expected == kAnyReason) {
      ++rightly[row.outcome];
    } else {
      ++other_reason[row.outcome + " for " + row.expected];
    }
  }
  const auto total = [](const std::map<std::string, int>& counts) {
    int sum = 0;
    for (const auto& entry : counts) sum += entry.second;
    return sum;
  };
  return fmt::format("can be measured: {} ok, {} review, {} refused{}\n",
                     ok,
                     review,
                     total(wrongly),
                     CountsText(wrongly)) +
         fmt::format("must be refused: {} refused{}, {} with another reason{}, {} ACCEPTED\n",
                     total(rightly),
                     CountsText(rightly),
                     total(other_reason),
                     CountsText(other_reason),
                     accepted);
}

std::string TimeLine(const std::vector<ValidationRow>& rows) {
  std::vector<double> ms;
  for (const ValidationRow& row : rows) ms.push_back(row.ms);
  return fmt::format("\nphotograph to curve: median {:.1f} ms, 95th {:.1f} ms\n",
                     Percentile(ms, 0.5),
                     Percentile(ms, 0.95));
}

std::string CsvNumber(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

// Largest of |error| / sigma; empty where no uncertainty is stated.
std::string CsvSigmas(const QuantityErrors& errors) {
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (const StatedError& stated : errors.stated) {
    largest = std::fmax(largest, std::abs(stated.error) / stated.sigma);
  }
  return CsvNumber(largest);
}

}  // namespace

const char* QuantityName(Quantity quantity) {
  switch (quantity) {
    case Quantity::kUpperEdge:
      return "upper_edge";
    case Quantity::kLowerEdge:
      return "lower_edge";
    case Quantity::kPivot:
      return "pivot";
    case Quantity::kTheta:
      return "theta";
    case Quantity::kScale:
      return "scale";
    case Quantity::kPhi:
      return "phi";
    case Quantity::kTorque:
      return "torque";
  }
  return "";
}

const char* QuantityUnit(Quantity quantity) {
  switch (quantity) {
    case Quantity::kUpperEdge:
    case Quantity::kLowerEdge:
    case Quantity::kPivot:
      return "px";
    case Quantity::kTheta:
      return "deg";
    case Quantity::kScale:
      return "ppm";
    case Quantity::kPhi:
      return "mm";
    case Quantity::kTorque:
      return "percent";
  }
  return "";
}

double Percentile(std::vector<double> values, double share) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

std::string ValidationTable(const std::vector<ValidationRow>& rows, bool with_times) {
  return fmt::format("{} scenes\n{}\n{}{}",
                     rows.size(),
                     RefusalTable(rows),
                     ErrorTable(rows),
                     with_times ? TimeLine(rows) : std::string());
}

std::string ValidationCsv(const std::vector<ValidationRow>& rows, bool with_times) {
  std::vector<std::string> head = {"scene", "expected", "outcome", "theta_deg"};
  for (const Quantity quantity : kAll) {
    head.push_back(fmt::format("{}_error_{}", QuantityName(quantity), QuantityUnit(quantity)));
    head.push_back(fmt::format("{}_sigmas", QuantityName(quantity)));
  }
  if (with_times) head.emplace_back("ms");
  head.emplace_back("detail");
  std::string text = CsvLine(head);
  for (const ValidationRow& row : rows) {
    std::vector<std::string> fields = {
        row.scene, row.expected, row.outcome, CsvNumber(row.theta_deg)};
    for (const Quantity quantity : kAll) {
      fields.push_back(CsvNumber(row.Of(quantity).size));
      fields.push_back(CsvSigmas(row.Of(quantity)));
    }
    if (with_times) fields.push_back(CsvNumber(row.ms));
    fields.push_back(row.measured() ? fmt::format("{}", fmt::join(row.warnings, " ")) : row.detail);
    text += CsvLine(fields);
  }
  return text;
}

}  // namespace bladecurve
