// Interpretation of OpenStreetMap's tags: sizes and surfaces, with defaults for missing values.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "world/imports/osm/osm_file.h"

namespace throng::imports {

/// The value of a tag, or "" if there is none.
const std::string& tag_value(const Tags& tags, const std::string& key);

/// Parses a length (m) such as "12", "12.5 m", "3,5", "40 ft", "40'" or "16'4\""; nothing for other
/// text, negative lengths and lengths above 1 km.
std::optional<double> length_in(std::string_view text);

/// A way that people or cars use.
struct WayKind {
  double width_m = 2;
  std::string material;
  bool road = false;         ///< has a carriageway for cars in the middle
  bool center_line = false;  ///< has a dashed center line
};

/// The kind of a way by `highway` and, if given, `width` or `lanes`; nothing if nobody walks on it.
std::optional<WayKind> way_kind(const Tags& tags);

/// Height (m) of a building with its roof: `height`; else 3 m for each of `building:levels` plus
/// `roof:height` or `roof:levels`; else by its kind.
double building_height_m(const Tags& tags);
/// Height (m) of a building's lower end: `min_height`, else `building:min_level`, else 0.
double building_base_m(const Tags& tags);

bool is_water(const Tags& tags);
bool is_underground(const Tags& tags);

/// The material of an area of ground; "" for other areas.
std::string surface_material(const Tags& tags);

/// A barrier's width, height and color (linear RGB).
struct Barrier {
  double width_m;
  double height_m;
  Eigen::Vector3d rgb;
};
/// The size and color of a barrier; nothing for barriers that people can pass.
std::optional<Barrier> find_barrier(const Tags& tags);

}  // namespace throng::imports
