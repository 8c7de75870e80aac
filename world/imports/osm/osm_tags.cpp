#include "world/imports/osm/osm_tags.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace throng::imports {

namespace {

constexpr double kLevelM = 3;
constexpr double kLaneM = 3;
constexpr double kTallestM = 900;
constexpr double kMinBuildingM = 2;

struct NamedWay {
  std::string_view name;
  WayKind kind;
};

// Widths are usual ones of European towns.
const std::array<NamedWay, 22>& ways() {
  static const std::array<NamedWay, 22> kWays = {{{"primary", {9, "asphalt", true, true}},
                                                  {"trunk", {10, "asphalt", true, true}},
                                                  {"trunk_link", {5, "asphalt", true, false}},
                                                  {"road", {6, "asphalt", true, false}},
                                                  {"busway", {6, "asphalt", true, false}},
                                                  {"bridleway", {2.5, "dirt", false, false}},
                                                  {"secondary", {8, "asphalt", true, true}},
                                                  {"tertiary", {7, "asphalt", true, true}},
                                                  {"primary_link", {5, "asphalt", true, false}},
                                                  {"secondary_link", {5, "asphalt", true, false}},
                                                  {"tertiary_link", {5, "asphalt", true, false}},
                                                  {"unclassified", {6, "asphalt", true, true}},
                                                  {"residential", {6, "asphalt", true, false}},
                                                  {"living_street", {5, "pavers", false, false}},
                                                  {"service", {4, "asphalt", true, false}},
                                                  {"pedestrian", {6, "pavers", false, false}},
                                                  {"footway", {2.5, "pavers", false, false}},
                                                  {"cycleway", {2.5, "asphalt", false, false}},
                                                  {"steps", {2.5, "concrete", false, false}},
                                                  {"corridor", {2.5, "concrete", false, false}},
                                                  {"path", {1.8, "dirt", false, false}},
                                                  {"track", {3, "dirt", false, false}}}};
  return kWays;
}

struct Surface {
  std::string_view key;
  std::string_view value;
  std::string_view material;
};

constexpr std::array<Surface, 24> kSurfaces = {{{"highway", "", "pavers"},
                                                {"amenity", "parking", "asphalt"},
                                                {"amenity", "marketplace", "pavers"},
                                                {"amenity", "fountain", "concrete"},
                                                {"leisure", "park", "grass"},
                                                {"leisure", "garden", "grass"},
                                                {"leisure", "pitch", "grass"},
                                                {"leisure", "playground", "dirt"},
                                                {"leisure", "golf_course", "grass"},
                                                {"landuse", "grass", "grass"},
                                                {"landuse", "meadow", "grass"},
                                                {"landuse", "forest", "grass"},
                                                {"landuse", "village_green", "grass"},
                                                {"landuse", "recreation_ground", "grass"},
                                                {"landuse", "flowerbed", "grass"},
                                                {"landuse", "cemetery", "grass"},
                                                {"landuse", "orchard", "grass"},
                                                {"landuse", "farmland", "dirt"},
                                                {"landuse", "construction", "dirt"},
                                                {"natural", "wood", "grass"},
                                                {"natural", "grassland", "grass"},
                                                {"natural", "scrub", "grass"},
                                                {"natural", "sand", "dirt"},
                                                {"natural", "bare_rock", "dirt"}}};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

const std::string& tag_value(const Tags& tags, const std::string& key) {
  static const std::string kNothing;
  const auto found = tags.find(key);
  return found == tags.end() ? kNothing : found->second;
}

std::optional<double> length_in(std::string_view text) {
  constexpr double kFoot = 0.3048;
  constexpr double kMaxLengthM = 1000;
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !(value >= 0 && value <= kMaxLengthM)) return std::nullopt;
  const char* const end = text.data() + text.size();
  if (end - rest >= 2 && *rest == ',' && is_digit(rest[1])) {  // a decimal comma
    std::string point(text);
    point[static_cast<std::size_t>(rest - text.data())] = '.';
    return length_in(point);
  }
  std::string_view unit(rest, static_cast<std::size_t>(end - rest));
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  if (unit.empty() || unit == "m") return value;
  if (unit == "ft" || unit == "'") return value * kFoot;
  if (unit.front() == '\'' && unit.back() == '"') {
    double inches = 0;
    const char* const last = unit.data() + unit.size() - 1;
    const auto [after, wrong] = std::from_chars(unit.data() + 1, last, inches);
    if (wrong == std::errc() && after == last && inches >= 0 && inches < 12) {
      return (value + inches / 12) * kFoot;
    }
  }
  return std::nullopt;
}

std::optional<WayKind> way_kind(const Tags& tags) {
  const std::string& name = tag_value(tags, "highway");
  const auto found = std::find_if(ways().begin(), ways().end(),
                                  [&](const NamedWay& way) { return way.name == name; });
  if (found == ways().end()) return std::nullopt;
  WayKind kind = found->kind;
  constexpr double kMinWidthM = 1;
  constexpr double kMaxWidthM = 40;
  if (const auto lanes = length_in(tag_value(tags, "lanes")); lanes && kind.road) {
    kind.width_m = std::clamp(*lanes * kLaneM, kLaneM, kMaxWidthM);
    kind.center_line = *lanes >= 2;
  }
  if (const auto width = length_in(tag_value(tags, "width"))) {
    kind.width_m = std::clamp(*width, kMinWidthM, kMaxWidthM);
  }
  return kind;
}

double building_height_m(const Tags& tags) {
  if (const auto height = length_in(tag_value(tags, "height")); height && *height > 0) {
    return std::clamp(*height, kMinBuildingM, kTallestM);
  }
  if (const auto levels = length_in(tag_value(tags, "building:levels")); levels && *levels > 0) {
    double roof = 0;
    if (const auto height = length_in(tag_value(tags, "roof:height"))) {
      roof = *height;
    } else if (const auto roofs = length_in(tag_value(tags, "roof:levels"))) {
      roof = *roofs * kLevelM;
    }
    return std::clamp(*levels * kLevelM + roof, kMinBuildingM, kTallestM);
  }
  const std::string& kind = tag_value(tags, "building");
  if (kind == "garage" || kind == "garages" || kind == "shed" || kind == "kiosk" ||
      kind == "roof" || kind == "hut" || kind == "carport") {
    return kLevelM;
  }
  if (kind == "house" || kind == "detached" || kind == "terrace" || kind == "bungalow") {
    return 2 * kLevelM;
  }
  return 3 * kLevelM;
}

double building_base_m(const Tags& tags) {
  if (const auto base = length_in(tag_value(tags, "min_height"))) return *base;
  if (const auto level = length_in(tag_value(tags, "building:min_level"))) return *level * kLevelM;
  return 0;
}

bool is_water(const Tags& tags) {
  const std::string& landuse = tag_value(tags, "landuse");
  return tag_value(tags, "natural") == "water" || tags.contains("water") ||
         tag_value(tags, "waterway") == "riverbank" || tag_value(tags, "waterway") == "dock" ||
         landuse == "basin" || landuse == "reservoir" ||
         tag_value(tags, "leisure") == "swimming_pool";
}

bool is_underground(const Tags& tags) {
  return tag_value(tags, "location") == "underground" ||
         tag_value(tags, "parking") == "underground" || tag_value(tags, "tunnel") == "yes";
}

std::string surface_material(const Tags& tags) {
  for (const Surface& surface : kSurfaces) {
    const std::string& value = tag_value(tags, std::string(surface.key));
    if (!value.empty() && (surface.value.empty() || surface.value == value)) {
      return std::string(surface.material);
    }
  }
  return "";
}

std::optional<Barrier> find_barrier(const Tags& tags) {
  const std::string& name = tag_value(tags, "barrier");
  Barrier barrier{0.3, 1.2, {0.25, 0.25, 0.25}};
  if (name == "wall" || name == "city_wall" || name == "retaining_wall") {
    barrier = {0.3, 2, {0.45, 0.4, 0.35}};
  } else if (name == "hedge") {
    barrier = {0.8, 1.5, {0.08, 0.2, 0.05}};
  } else if (name == "jersey_barrier" || name == "guard_rail") {
    barrier = {0.5, 0.9, {0.5, 0.5, 0.5}};
  } else if (name != "fence" && name != "handrail" && name != "railing") {
    return std::nullopt;
  }
  if (const auto height = length_in(tag_value(tags, "height")); height && *height >= 0.1) {
    barrier.height_m = std::min(*height, 50.0);
  }
  return barrier;
}

}  // namespace throng::imports
