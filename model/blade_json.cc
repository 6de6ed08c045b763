// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/blade_json.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace bladecurve {
namespace {

using Json = nlohmann::json;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void Complain(const std::string& key, const std::string& what) {
  throw std::invalid_argument(key + ": " + what);
}

// A value as it stands in the file, cut short for a message.
std::string Shown(const Json& value) {
  constexpr std::size_t kLongest = 40;
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

const Json& Need(const Json& object, const std::string& key, const std::string& where = "") {
  const auto found = object.find(key);
  if (found == object.end()) Complain(where + key, "is missing; add it");
  return *found;
}

double Number(const Json& value, const std::string& key) {
  if (!value.is_number()) Complain(key, "is " + Shown(value) + "; it must be a number");
  return value.get<double>();
}

std::string Word(const Json& value, const std::string& key) {
  if (!value.is_string()) Complain(key, "is " + Shown(value) + "; it must be a text in quotes");
  return value.get<std::string>();
}

std::vector<double> Numbers(const Json& value, const std::string& key) {
  if (!value.is_array()) Complain(key, "is " + Shown(value) + "; it must be a list of numbers");
  std::vector<double> numbers;
  numbers.reserve(value.size());
  for (const Json& item : value) {
    numbers.push_back(Number(item, key + "[" + std::to_string(numbers.size()) + "]"));
  }
  return numbers;
}

std::vector<std::string> Words(const Json& value, const std::string& key) {
  if (!value.is_array()) Complain(key, "is " + Shown(value) + "; it must be a list of texts");
  std::vector<std::string> words;
  for (const Json& item : value) {
    words.push_back(Word(item, key + "[" + std::to_string(words.size()) + "]"));
  }
  return words;
}

TaperedRectangle TaperedOfJson(const Json& curve) {
  TaperedRectangle shape;
  shape.a_mm = Number(Need(curve, "a_mm", "curve."), "curve.a_mm");
  shape.b = Number(Need(curve, "b", "curve."), "curve.b");
  if (curve.contains("gain")) shape.gain = Number(curve["gain"], "curve.gain");
  return shape;
}

RigidSpline SplineOfJson(const Json& curve) {
  const double degree = Number(Need(curve, "degree", "curve."), "curve.degree");
  if (degree != std::floor(degree) || std::abs(degree) > 1000) {
    Complain("curve.degree",
             "is " + Shown(curve["degree"]) + "; it must be a whole number, 1 to 5");
  }
  return {static_cast<int>(degree),
          Numbers(Need(curve, "knots_mm", "curve."), "curve.knots_mm"),
          Numbers(Need(curve, "coefficients_mm", "curve."), "curve.coefficients_mm")};
}

BladeShape ShapeOfJson(const Json& curve) {
  if (!curve.is_object()) Complain("curve", "is " + Shown(curve) + "; it must be an object");
  const std::string family = Word(Need(curve, "family", "curve."), "curve.family");
  if (family == "tapered-rectangle") return TaperedOfJson(curve);
  if (family == "rigid-spline") return SplineOfJson(curve);
  Complain("curve.family", "is \"" + family + "\"; it must be tapered-rectangle or rigid-spline");
}

std::pair<double, double> Range(const Json& domain, const std::string& key) {
  const std::string full = "domain." + key;
  const std::vector<double> ends = Numbers(Need(domain, key, "domain."), full);
  if (ends.size() != 2) {
    Complain(full, "has " + std::to_string(ends.size()) + " numbers; it must have two, [from, to]");
  }
  return {ends[0], ends[1]};
}

CurveDomain DomainOfJson(const Json& domain) {
  if (!domain.is_object()) Complain("domain", "is " + Shown(domain) + "; it must be an object");
  const auto [x_min, x_max] = Range(domain, "x_mm");
  const auto [theta_min, theta_max] = Range(domain, "theta_rad");
  return {x_min, x_max, theta_min, theta_max};
}

BladeCurve CurveOfJson(const Json& record) {
  BladeShape shape = ShapeOfJson(Need(record, "curve"));
  const CurveDomain domain = DomainOfJson(Need(record, "domain"));
  try {
    return {std::move(shape), domain};
  } catch (const std::invalid_argument& error) {
    Complain("curve", error.what());
  }
}

double NumberOrUnknown(const Json& value, const std::string& key) {
  return value.is_null() ? kUnknown : Number(value, key);
}

void CheckSquare(const Json& matrix, std::size_t size) {
  bool square = matrix.is_array() && matrix.size() == size;
  for (std::size_t i = 0; square && i < size; ++i) {
    square = matrix[i].is_array() && matrix[i].size() == size;
  }
  if (!square) {
    const std::string n = std::to_string(size);
    Complain("covariance.matrix",
             "must be " + n + " lists of " + n +
                 " numbers, one for each of parameters; correct it or leave covariance out");
  }
}

// The file's covariance in the order of the shape's own parameters; unknown for those it leaves
// out.
std::vector<double> CovarianceOfJson(const Json& record, const std::vector<std::string>& names) {
  const Json& covariance = record["covariance"];
  if (!covariance.is_object())
    Complain("covariance", "is " + Shown(covariance) + "; it must be an object");
  const auto given = Words(Need(covariance, "parameters", "covariance."), "covariance.parameters");
  const Json& matrix = Need(covariance, "matrix", "covariance.");
  CheckSquare(matrix, given.size());
  std::vector<std::size_t> place(given.size(), names.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (std::size_t j = 0; j < names.size(); ++j) {
      if (given[i] == names[j]) place[i] = j;
    }
  }
  std::vector<double> ordered(names.size() * names.size(), kUnknown);
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (std::size_t j = 0; j < given.size(); ++j) {
      const double value = NumberOrUnknown(matrix[i][j], "covariance.matrix");
      if (place[i] == names.size() || place[j] == names.size()) continue;
      ordered[place[i] * names.size() + place[j]] = value;
    }
  }
  return ordered;
}

std::vector<double> DiagonalRoots(const std::vector<double>& matrix, std::size_t size) {
  std::vector<double> roots(size, kUnknown);
  for (std::size_t i = 0; i < size && !matrix.empty(); ++i)
    roots[i] = std::sqrt(matrix[i * size + i]);
  return roots;
}

// "standard_errors": {"a_mm": ..}: what an exported plugin knows instead of a covariance.
std::vector<double> StandardErrorsOfJson(const Json& errors,
                                         const std::vector<std::string>& names) {
  if (!errors.is_object())
    Complain("standard_errors", "is " + Shown(errors) + "; it must be an object");
  std::vector<double> values(names.size(), kUnknown);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = errors.find(names[i]);
    if (found != errors.end()) values[i] = NumberOrUnknown(*found, "standard_errors." + names[i]);
  }
  return values;
}

void CheckFormat(const Json& record) {
  const std::string format = Word(Need(record, "format"), "format");
  if (format != "bladecurve/1") {
    Complain("format", "is \"" + format + "\"; this version reads \"bladecurve/1\"");
  }
}

// A refusal is a record without a curve.
std::string StatusOfJson(const Json& record) {
  if (!record.contains("status")) return "ok";
  std::string status = Word(record["status"], "status");
  if (status == "ok" || status == "review") return status;
  if (status != "refused")
    Complain("status", "is \"" + status + "\"; it must be ok, review or refused");
  const auto text = [&record](const char* key) {
    return record.contains(key) && record[key].is_string() ? record[key].get<std::string>() : "?";
  };
  Complain("status",
           "the photograph was refused (" + text("reason") + ": " + text("detail") +
               "), so there is no curve; fit another photograph");
}

// "units": "px" for a curve that was measured without a scale.
bool PixelsOfJson(const Json& units) {
  const std::string word = Word(units, "units");
  if (word != "mm" && word != "px") Complain("units", "is \"" + word + "\"; it must be mm or px");
  return word == "px";
}

bool Has(const Json& record, const char* key) {
  return record.contains(key) && !record[key].is_null();
}

BladeFile BladeFileOfJson(const Json& record) {
  if (!record.is_object())
    Complain("the file", "is " + Shown(record) + "; it must be a JSON object");
  CheckFormat(record);
  std::string status = StatusOfJson(record);
  BladeFile blade = {Word(Need(record, "name"), "name"), CurveOfJson(record), std::move(status)};
  const std::vector<std::string> names = ParameterNames(blade.curve.shape());
  if (Has(record, "warnings")) blade.warnings = Words(record["warnings"], "warnings");
  if (Has(record, "covariance")) blade.covariance = CovarianceOfJson(record, names);
  blade.standard_errors = Has(record, "standard_errors")
                              ? StandardErrorsOfJson(record["standard_errors"], names)
                              : DiagonalRoots(blade.covariance, names.size());
  if (Has(record, "units")) blade.in_pixels = PixelsOfJson(record["units"]);
  if (Has(record, "fit") && record["fit"].is_object() && Has(record["fit"], "rms_mm")) {
    blade.fit_rms_mm = Number(record["fit"]["rms_mm"], "fit.rms_mm");
  }
  return blade;
}

// The parser's own words, without its code and without line ends.
std::string ParserComplaint(const std::string& what) {
  const std::size_t bracket = what.find("] ");
  std::string text = bracket == std::string::npos ? what : what.substr(bracket + 2);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return text;
}

}  // namespace

BladeFile ParseBladeJson(const std::string& text) {
  if (text.empty()) throw std::invalid_argument("is empty; it must be a .blade.json or a .so");
  try {
    return BladeFileOfJson(Json::parse(text));
  } catch (const Json::exception& error) {
    throw std::invalid_argument("is no JSON: " + ParserComplaint(error.what()) +
                                "; correct it there");
  }
}

}  // namespace bladecurve
