#include "places/imports/osm/osm_tags.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "places/imports/osm/osm_lengths.h"

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

using Keys = std::vector<std::string>;

// The usual key of a size first, then keys that mappers use in its place.
const Keys& find_keys(const std::string& size) {
  static const std::map<std::string, Keys> kKeys = {
      {"height", {"height", "building:height", "est_height"}},
      {"levels", {"building:levels", "levels"}},
      {"min_height", {"min_height", "building:min_height"}},
      {"min_level", {"building:min_level", "min_level"}},
      {"roof:height", {"roof:height"}},
      {"roof:levels", {"roof:levels"}}};
  return kKeys.at(size);
}

using Reader = std::optional<double> (*)(std::string_view);

/// The first readable value of a size.
std::optional<double> size_in(const Tags& tags, const std::string& size, Reader read) {
  for (const std::string& key : find_keys(size)) {
    if (const auto value = read(tag_value(tags, key))) return value;
  }
  return std::nullopt;
}

/// "KEY=VALUE" of the tags that have these keys and that cannot be read.
std::vector<std::string> unread_values(const Tags& tags, const std::vector<std::string>& keys,
                                       Reader read) {
  std::vector<std::string> unread;
  for (const std::string& key : keys) {
    const auto tag = tags.find(key);
    if (tag != tags.end() && !read(tag->second)) unread.push_back(key + "=" + tag->second);
  }
  return unread;
}

bool is_below_ground(std::string_view text, Reader read) {
  return text.starts_with('-') && read(text.substr(1)).has_value();
}

}  // namespace

const std::string& tag_value(const Tags& tags, const std::string& key) {
  static const std::string kNothing;
  const auto found = tags.find(key);
  return found == tags.end() ? kNothing : found->second;
}

std::optional<WayKind> way_kind(const Tags& tags) {
  const std::string& name = tag_value(tags, "highway");
  const auto found = std::find_if(ways().begin(), ways().end(),
                                  [&](const NamedWay& way) { return way.name == name; });
  if (found == ways().end()) return std::nullopt;
  WayKind kind = found->kind;
  constexpr double kMinWidthM = 1;
  constexpr double kMaxWidthM = 40;
  if (const auto lanes = count_in(tag_value(tags, "lanes")); lanes && kind.road) {
    kind.width_m = std::clamp(*lanes * kLaneM, kLaneM, kMaxWidthM);
    kind.center_line = *lanes >= 2;
  }
  if (const auto width = length_in(tag_value(tags, "width"))) {
    kind.width_m = std::clamp(*width, kMinWidthM, kMaxWidthM);
  }
  return kind;
}

std::optional<double> stated_height_m(const Tags& tags) {
  if (const auto height = size_in(tags, "height", length_in); height && *height > 0) {
    return std::clamp(*height, kMinBuildingM, kTallestM);
  }
  if (const auto levels = size_in(tags, "levels", count_in)) {
    const double height = *levels * kLevelM + roof_height_m(tags).value_or(0);
    if (height > 0) return std::clamp(height, kMinBuildingM, kTallestM);
  }
  return std::nullopt;
}

std::optional<double> roof_height_m(const Tags& tags) {
  if (const auto height = size_in(tags, "roof:height", length_in)) return height;
  if (const auto levels = size_in(tags, "roof:levels", count_in)) return *levels * kLevelM;
  return std::nullopt;
}

double building_height_m(const Tags& tags) {
  if (const auto stated = stated_height_m(tags)) return *stated;
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
  if (const auto base = size_in(tags, "min_height", length_in)) return *base;
  if (const auto level = size_in(tags, "min_level", count_in)) return *level * kLevelM;
  return 0;
}

std::vector<std::string> unread_lengths(const Tags& tags, const std::vector<std::string>& keys) {
  return unread_values(tags, keys, length_in);
}

std::vector<std::string> unread_counts(const Tags& tags, const std::vector<std::string>& keys) {
  return unread_values(tags, keys, count_in);
}

std::vector<std::string> unread_building_sizes(const Tags& tags) {
  std::vector<std::string> unread;
  const auto look_at = [&](const std::string& size, Reader read, bool may_be_zero,
                           bool may_be_below) {
    for (const std::string& key : find_keys(size)) {
      const auto tag = tags.find(key);
      if (tag == tags.end()) continue;
      const auto value = read(tag->second);
      const bool below = may_be_below && is_below_ground(tag->second, read);
      if (below || (value && *value <= kTallestM && (may_be_zero || *value > 0))) continue;
      unread.push_back(key + "=" + tag->second);
    }
  };
  const bool is_stated = stated_height_m(tags).has_value();
  look_at("height", length_in, false, false);
  look_at("levels", count_in, is_stated, false);
  look_at("min_height", length_in, true, true);
  look_at("min_level", count_in, true, true);
  look_at("roof:height", length_in, true, false);
  look_at("roof:levels", count_in, true, false);
  return unread;
}

void inherit_height(const Tags& building, Tags& part) {
  for (const char* size : {"height", "levels"}) {
    for (const std::string& key : find_keys(size)) {
      if (part.contains(key)) return;
    }
  }
  for (const char* size : {"height", "levels", "roof:height", "roof:levels"}) {
    for (const std::string& key : find_keys(size)) {
      const std::string& value = tag_value(building, key);
      if (!value.empty()) part.try_emplace(key, value);
    }
  }
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

bool is_off_ground(const Tags& tags) {
  const auto says = [&](const char* key, std::string_view but) {
    const std::string& value = tag_value(tags, key);
    return !value.empty() && value != "no" && value != but;
  };
  // Galleries below avalanches are on the ground, and boardwalks nearly.
  const bool in_gallery = tag_value(tags, "tunnel") == "avalanche_protector";
  const bool in_tunnel = says("tunnel", "building_passage") && !in_gallery;
  return in_tunnel || says("bridge", "boardwalk") ||
         length_in(tag_value(tags, "layer")).value_or(0) > 0;
}

bool is_ring(const Tags& tags) {
  const auto has = [&](const char* key) {
    return tags.contains(key) && tag_value(tags, key) != "no";
  };
  const std::string& leisure = tag_value(tags, "leisure");
  const bool is_course = leisure == "track" || leisure == "slipway";
  return has("building") || has("building:part") || has("landuse") || has("amenity") ||
         (has("leisure") && !is_course) || has("area") || is_water(tags) ||
         (has("natural") && !surface_material(tags).empty());
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
