#include "formats/dataset/reid_attributes.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "formats/files/csv_field.h"

namespace throng::formats {

using nlohmann::json;

namespace {

/// Garments in their columns; one that covers upper and lower body is in both.
constexpr const char* kReidGarments[] = {"upper", "lower", "shoes", "hat", "carried"};

const json& garment_in(const json& clothes, const std::string& column) {
  static const json kNone = json::object();
  const bool is_half = column == "upper" || column == "lower";
  for (const json& garment : clothes) {
    const std::string slot = garment.value("slot", "");
    if (slot == column || (is_half && slot == "whole")) return garment;
  }
  return kNone;
}

}  // namespace

std::string reid_attribute_columns() {
  std::string text = "id,set,sex,age_years,age_band,stature_m";
  for (const char* garment : kReidGarments) {
    text += fmt::format(",{0}_type,{0}_color,{0}_rgb", garment);
  }
  return text + ",hair_rgb,umbrella\n";
}

std::string reid_attribute_line(int number, ReidSide side, const Person& person) {
  static const json kNone = json::object();
  const auto found = person.track->find("attributes");
  const json& attributes = found == person.track->end() ? kNone : *found;
  std::string text = fmt::format("{},{}", number, to_string(side));
  for (const char* key : {"sex", "age_years", "age_band", "stature_m"}) {
    text += "," + csv_field(attributes, key);
  }
  const auto clothes = attributes.find("clothes");
  for (const char* column : kReidGarments) {
    const json& garment = clothes == attributes.end() ? kNone : garment_in(*clothes, column);
    for (const char* key : {"type", "colour_name", "colour"}) text += "," + csv_field(garment, key);
  }
  text += "," + csv_field(attributes, "hair_colour");
  const std::string carries = attributes.value("carries", "");
  return text + (carries.empty() ? "," : carries == "umbrella" ? ",1" : ",0") + "\n";
}

}  // namespace throng::formats
