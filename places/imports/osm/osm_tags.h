// Interpretation of OpenStreetMap's tags: sizes and surfaces, with defaults for missing values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "places/imports/osm/osm_file.h"

namespace throng::imports {

/// The value of a tag, or "" if there is none.
const std::string& tag_value(const Tags& tags, const std::string& key);

/// A way that people or cars use.
struct WayKind {
  double width_m = 2;
  std::string material;
  bool road = false;         ///< has a carriageway for cars in the middle
  bool center_line = false;  ///< has a dashed center line
};

/// The kind of a way by `highway` and, if given, `width` or `lanes`; nothing if nobody walks on it.
std::optional<WayKind> way_kind(const Tags& tags);

/// Height (m) of a building with its roof as its tags state it: `height` (also `building:height` or
/// `est_height`); else 3 m for each of `building:levels` (also `levels`) plus `roof:height` or
/// `roof:levels`; nothing if none of them can be read.
std::optional<double> stated_height_m(const Tags& tags);
/// The stated height (m) of a building, else the usual one of its kind.
double building_height_m(const Tags& tags);
/// Height (m) of a building's lower end: `min_height`, else `building:min_level`, else 0.
double building_base_m(const Tags& tags);

/// The tags ("height=tall") of a building that state a size and cannot be read, or state a height
/// of 0 or of more than 900 m, which buildings are cut off at.
std::vector<std::string> unread_building_sizes(const Tags& tags);
/// The tags with these keys that are not lengths, or not numbers of levels or lanes.
std::vector<std::string> unread_lengths(const Tags& tags, const std::vector<std::string>& keys);
std::vector<std::string> unread_counts(const Tags& tags, const std::vector<std::string>& keys);

/// The height of a building's roof (m): `roof:height`, else 3 m for each of `roof:levels`.
std::optional<double> roof_height_m(const Tags& tags);

/// Gives a part that states no height those tags of its building that do.
void inherit_height(const Tags& building, Tags& part);

bool is_water(const Tags& tags);
bool is_underground(const Tags& tags);
/// Whether a way leads over a bridge or through a tunnel; passages below buildings are no tunnels.
bool is_off_ground(const Tags& tags);
/// Whether a way with such tags is the edge of an area.
bool is_ring(const Tags& tags);

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
