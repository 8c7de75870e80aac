// Meaning of OpenStreetMap's tags for a scenario: sizes and surfaces, where mappers gave none.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "world/imports/osm/osm_file.h"

namespace throng::imports {

/// The value of a tag; empty where there is none.
const std::string& tag_value(const Tags& tags, const std::string& key);

/// A length as mappers write it: "12", "12.5 m", "3,5", "40 ft", "40'", "16'4\""; nothing for what
/// is none, negative or above 1 km.
std::optional<double> length_in(std::string_view text);

/// A way that people or cars use.
struct WayKind {
  double width_m = 2;
  std::string material;
  bool road = false;         ///< cars have the middle of it
  bool center_line = false;  ///< dashes are painted on it
};

/// By `highway`, with `width` or `lanes` where they are given; nothing for what nobody walks on.
std::optional<WayKind> way_kind(const Tags& tags);

/// How high a building is (m), with its roof: `height`, else `building:levels` of 3 m and on them
/// `roof:height` or `roof:levels`, else by its kind.
double building_height_m(const Tags& tags);
/// Height of its lower end: `min_height`, else `building:min_level`, else the ground.
double building_base_m(const Tags& tags);

bool is_water(const Tags& tags);
bool is_underground(const Tags& tags);

/// The material of an area of ground; empty for areas that are none.
std::string surface_material(const Tags& tags);

/// A barrier's width, height and color (linear RGB); nothing for those that one walks through.
struct Barrier {
  double width_m;
  double height_m;
  Eigen::Vector3d rgb;
};
std::optional<Barrier> find_barrier(const Tags& tags);

}  // namespace throng::imports
