// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "vision/scale/card.h"
#include "vision/scale/marker_detector.h"

namespace bladecurve {
namespace {

constexpr const char* kFormat = "bladecurve-card/1";

class CardReader {
 public:
  explicit CardReader(const std::filesystem::path& path) : path_(path) {
    std::ifstream stream(path);
    if (!stream) Fail("cannot be opened");
    json_ = nlohmann::json::parse(stream, nullptr, /*allow_exceptions=*/false);
    if (!json_.is_object()) Fail("is no JSON object");
    if (json_.value("format", nlohmann::json()) != kFormat)
      Fail(std::string("format is not \"") + kFormat + "\"");
  }

  Card Read() const {
    Card card;
    card.name = json_.value("name", "card");
    card.width_mm = Positive(json_, "width_mm");
    card.height_mm = Positive(json_, "height_mm");
    card.marker_mm = Positive(json_, "marker_mm");
    card.markers = Markers();
    for (const nlohmann::json& area : json_.value("print_mm", nlohmann::json::array())) {
      if (!area.is_array() || area.size() != 4)
        Fail("print_mm has an area that is not [x, y, width, height]");
      card.print_mm.push_back(area.get<std::array<double, 4>>());
    }
    return card;
  }

 private:
  [[noreturn]] void Fail(const std::string& cause) const {
    throw std::invalid_argument("card: " + path_.string() + ": " + cause +
                                "; `bladecurve card --json FILE` writes an example");
  }

  double Number(const nlohmann::json& object, const char* field) const {
    if (!object.is_object() || !object.contains(field) || !object[field].is_number()) {
      Fail(std::string(field) + " is missing or no number");
    }
    return object[field].get<double>();
  }

  double Positive(const nlohmann::json& object, const char* field) const {
    const double value = Number(object, field);
    if (!(value > 0) || !std::isfinite(value)) Fail(std::string(field) + " is not positive");
    return value;
  }

  std::vector<Card::Marker> Markers() const {
    std::vector<Card::Marker> markers;
    std::set<int> ids;
    for (const nlohmann::json& entry : json_.value("markers", nlohmann::json::array())) {
      const double id = Number(entry, "id");
      const bool known = id >= 0 && id < kDictionarySize && id == std::floor(id);
      if (!known || !ids.insert(static_cast<int>(id)).second) {
        Fail("markers: id " + entry["id"].dump() + " is not one of 0 to 49, or is there twice");
      }
      markers.push_back({static_cast<int>(id), {Number(entry, "x_mm"), Number(entry, "y_mm")}});
    }
    if (markers.empty()) Fail("markers is missing or empty");
    return markers;
  }

  std::filesystem::path path_;
  nlohmann::json json_;
};

}  // namespace

std::string CardText(const Card& card) {
  nlohmann::ordered_json json = {{"format", kFormat},
                                 {"name", card.name},
                                 {"dictionary", "DICT_4X4_50"},
                                 {"width_mm", card.width_mm},
                                 {"height_mm", card.height_mm},
                                 {"marker_mm", card.marker_mm}};
  for (const Card::Marker& marker : card.markers) {
    json["markers"].push_back(
        {{"id", marker.id}, {"x_mm", marker.centre_mm.x()}, {"y_mm", marker.centre_mm.y()}});
  }
  for (const auto& area : card.print_mm) json["print_mm"].push_back(area);
  return json.dump(1) + "\n";
}

Card ReadCard(const std::filesystem::path& path) { return CardReader(path).Read(); }

}  // namespace bladecurve
