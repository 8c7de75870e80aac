#include "places/imports/osm/osm_looks.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/compute/srgb.h"
#include "base/geometry/angle.h"
#include "places/imports/osm/osm_lengths.h"
#include "places/imports/osm/osm_tags.h"

namespace throng::imports {

namespace {

using world::Covering;
using world::Facade;
using world::Paint;
using world::RoofKind;

template <typename Value>
struct Named {
  std::string_view name;
  Value value;
  bool is_exact = true;  ///< else a kind that looks alike
};

template <typename Value, std::size_t count>
const Named<Value>* find_named(const std::array<Named<Value>, count>& names,
                               std::string_view name) {
  const auto found = std::find_if(names.begin(), names.end(),
                                  [&](const Named<Value>& each) { return each.name == name; });
  return found == names.end() ? nullptr : &*found;
}

constexpr std::array<Named<RoofKind>, 22> kShapes = {
    {{"flat", RoofKind::flat},
     {"gabled", RoofKind::gabled},
     {"hipped", RoofKind::hipped},
     {"half-hipped", RoofKind::half_hipped},
     {"half_hipped", RoofKind::half_hipped},
     {"mansard", RoofKind::mansard},
     {"gambrel", RoofKind::mansard, false},
     {"skillion", RoofKind::shed},
     {"lean_to", RoofKind::shed},
     {"shed", RoofKind::shed},
     {"sawtooth", RoofKind::sawtooth},
     {"pyramidal", RoofKind::pyramid},
     {"pyramid", RoofKind::pyramid},
     {"cone", RoofKind::pyramid},
     {"conical", RoofKind::pyramid},
     {"dome", RoofKind::dome},
     {"onion", RoofKind::dome, false},
     {"round", RoofKind::gabled, false},
     {"saltbox", RoofKind::gabled, false},
     {"side_hipped", RoofKind::hipped, false},
     {"quadruple_saltbox", RoofKind::hipped, false},
     {"double_saltbox", RoofKind::gabled, false}}};

constexpr std::array<Named<Covering>, 26> kCoverings = {
    {{"roof_tiles", Covering::tiles},  {"tile", Covering::tiles},
     {"tiles", Covering::tiles},       {"brick", Covering::tiles},
     {"clay", Covering::tiles},        {"slate", Covering::slate},
     {"eternit", Covering::slate},     {"asphalt_shingle", Covering::slate},
     {"shingle", Covering::slate},     {"metal", Covering::metal},
     {"metal_sheet", Covering::metal}, {"copper", Covering::metal},
     {"zinc", Covering::metal},        {"tin", Covering::metal},
     {"steel", Covering::metal},       {"aluminium", Covering::metal},
     {"gravel", Covering::gravel},     {"stone", Covering::gravel},
     {"concrete", Covering::gravel},   {"grass", Covering::grass},
     {"plants", Covering::grass},      {"green", Covering::grass},
     {"tar_paper", Covering::felt},    {"asphalt", Covering::felt},
     {"bitumen", Covering::felt},      {"roofing_felt", Covering::felt}}};

constexpr std::array<Named<Facade>, 15> kMaterials = {{{"brick", Facade::brick},
                                                       {"bricks", Facade::brick},
                                                       {"red_brick", Facade::brick},
                                                       {"plaster", Facade::plaster},
                                                       {"stucco", Facade::plaster},
                                                       {"render", Facade::plaster},
                                                       {"glass", Facade::glass},
                                                       {"mirror", Facade::glass},
                                                       {"concrete", Facade::concrete},
                                                       {"cement_block", Facade::concrete},
                                                       {"panel", Facade::concrete},
                                                       {"stone", Facade::historic, false},
                                                       {"sandstone", Facade::historic, false},
                                                       {"metal", Facade::modern, false},
                                                       {"steel", Facade::modern, false}}};

/// Colors of CSS that maps name, in sRGB.
constexpr std::array<Named<std::uint32_t>, 40> kColors = {
    {{"white", 0xFFFFFF},     {"black", 0x202020},       {"gray", 0x808080},
     {"grey", 0x808080},      {"silver", 0xC0C0C0},      {"lightgray", 0xD3D3D3},
     {"lightgrey", 0xD3D3D3}, {"darkgray", 0xA9A9A9},    {"darkgrey", 0xA9A9A9},
     {"dimgray", 0x696969},   {"dimgrey", 0x696969},     {"maroon", 0x800000},
     {"red", 0xFF0000},       {"darkred", 0x8B0000},     {"firebrick", 0xB22222},
     {"brown", 0xA52A2A},     {"saddlebrown", 0x8B4513}, {"sienna", 0xA0522D},
     {"chocolate", 0xD2691E}, {"peru", 0xCD853F},        {"tan", 0xD2B48C},
     {"beige", 0xF5F5DC},     {"wheat", 0xF5DEB3},       {"ivory", 0xFFFFF0},
     {"cream", 0xFFFDD0},     {"orange", 0xFFA500},      {"salmon", 0xFA8072},
     {"pink", 0xFFC0CB},      {"yellow", 0xFFFF00},      {"gold", 0xFFD700},
     {"olive", 0x808000},     {"green", 0x008000},       {"darkgreen", 0x006400},
     {"lime", 0x00FF00},      {"teal", 0x008080},        {"aqua", 0x00FFFF},
     {"blue", 0x0000FF},      {"lightblue", 0xADD8E6},   {"navy", 0x000080},
     {"purple", 0x800080}}};

/// A color such as "#a53", "#aa5533" or "brown"; no surface reflects all light.
std::optional<Paint> paint_in(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::erase_if(text, [](char c) { return c == ' ' || c == '_'; });
  std::uint32_t rgb = 0;
  if (const auto* named = find_named(kColors, text)) {
    rgb = named->value;
  } else {
    if (text.size() == 4) text = {text[0], text[1], text[1], text[2], text[2], text[3], text[3]};
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    const char* const end = text.data() + text.size();
    if (std::from_chars(text.data() + 1, end, rgb, 16).ptr != end) return std::nullopt;
  }
  constexpr float kMaxAlbedo = 0.72F;
  Paint paint;
  for (int i = 0; i < 3; ++i) {
    paint[i] = kMaxAlbedo * linear_from_srgb(static_cast<std::uint8_t>(rgb >> (16 - 8 * i)));
  }
  return paint;
}

/// A direction such as "NE" or "135", degrees clockwise from north, as an angle from +x.
std::optional<double> direction_in(std::string_view text) {
  constexpr std::array<std::string_view, 16> kWinds = {"N",  "NNE", "NE", "ENE", "E",  "ESE",
                                                       "SE", "SSE", "S",  "SSW", "SW", "WSW",
                                                       "W",  "WNW", "NW", "NNW"};
  double degrees = 0;
  const auto wind = std::find(kWinds.begin(), kWinds.end(), text);
  if (wind != kWinds.end()) {
    degrees = 22.5 * static_cast<double>(wind - kWinds.begin());
  } else {
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, degrees);
    if (text.empty() || error != std::errc() || rest != end || std::abs(degrees) > 360) {
      return std::nullopt;
    }
  }
  return std::remainder((90 - degrees) * kDegree, 2 * std::numbers::pi);
}

std::optional<double> pitch_in(std::string_view text) {
  double degrees = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, degrees);
  if (text.empty() || error != std::errc() || degrees < 5 || degrees > 75) return std::nullopt;
  if (rest != end && std::string_view(rest, static_cast<std::size_t>(end - rest)) != "°")
    return std::nullopt;
  return degrees * kDegree;
}

/// The keys of colors, in American and British spelling.
std::optional<Paint> paint_by(const Tags& tags, const std::string& part) {
  for (const char* word : {":colour", ":color"}) {
    if (const auto paint = paint_in(tag_value(tags, part + word))) return paint;
  }
  return std::nullopt;
}

constexpr std::array<const char*, 11> kLookKeys = {"roof:shape",
                                                   "roof:material",
                                                   "roof:colour",
                                                   "roof:color",
                                                   "roof:angle",
                                                   "roof:direction",
                                                   "roof:orientation",
                                                   "building:material",
                                                   "building:colour",
                                                   "building:color",
                                                   "building:facade:material"};

}  // namespace

BuildingLooks building_looks(const Tags& tags, std::optional<double> roof_m) {
  BuildingLooks looks;
  if (const auto* named = find_named(kMaterials, tag_value(tags, "building:material"))) {
    looks.facade = named->value;
  }
  looks.paint = paint_by(tags, "building");
  if (const auto* named = find_named(kShapes, tag_value(tags, "roof:shape"))) {
    looks.roof.kind = named->value;
  }
  if (const auto* named = find_named(kCoverings, tag_value(tags, "roof:material"))) {
    looks.roof.covering = named->value;
  }
  looks.roof.paint = paint_by(tags, "roof");
  looks.roof.pitch_rad = pitch_in(tag_value(tags, "roof:angle"));
  looks.roof.falls_rad = direction_in(tag_value(tags, "roof:direction"));
  if (roof_m && *roof_m > 0) looks.roof.height_m = roof_m;
  return looks;
}

std::vector<std::string> undrawn_looks(const Tags& tags) {
  std::vector<std::string> undrawn;
  const auto look_at = [&](const std::string& key, const auto& is_drawn) {
    const std::string& value = tag_value(tags, key);
    if (!value.empty() && !is_drawn(value)) undrawn.push_back(key + "=" + value);
  };
  const auto is_in = [](const auto& names) {
    return [&names](const std::string& value) {
      const auto* named = find_named(names, value);
      return named != nullptr && named->is_exact;
    };
  };
  look_at("roof:shape", is_in(kShapes));
  look_at("roof:material", is_in(kCoverings));
  look_at("building:material", is_in(kMaterials));
  for (const char* key : {"roof:colour", "roof:color", "building:colour", "building:color"}) {
    look_at(key, [](const std::string& value) { return paint_in(value).has_value(); });
  }
  look_at("roof:angle", [](const std::string& value) { return pitch_in(value).has_value(); });
  look_at("roof:direction",
          [](const std::string& value) { return direction_in(value).has_value(); });
  look_at("roof:orientation", [](const std::string& value) { return value == "along"; });
  return undrawn;
}

void inherit_looks(const Tags& building, Tags& part) {
  for (const char* key : kLookKeys) {
    const std::string& value = tag_value(building, key);
    if (!value.empty()) part.try_emplace(key, value);
  }
}

}  // namespace throng::imports
