// Buildings of a scenario: extruded polygons with a facade and a roof.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace throng::world {

/// Linear RGB, 0 to 1.
using Paint = Eigen::Array3f;

/// Appearance of a building's walls. by_id: a seed chooses, so that neighbors differ. The values
/// are those of shaders/wall.frag.glsl, which has further ones for render::WallLook.
enum class Facade : std::uint8_t {
  by_id = 0,
  plaster = 1,
  brick = 2,
  glass = 3,
  hedge = 8,
  screen = 9,      ///< a wall of lights that shows moving images
  historic = 10,   ///< stucco with framed windows, as around 1890
  modern = 11,     ///< smooth render with wide windows
  concrete = 12,   ///< slabs with joints
  warehouse = 13,  ///< brick with large windows of many panes
  blank = 15,      ///< plaster without windows or anything on it
  railing = 16,    ///< posts, a handrail and bars
  fence = 17,      ///< posts and panels of wire
  stand = 18       ///< the block of a stand (world/stand.h), for people and drones; not in files
};

/// Shape of a roof. by_id: a seed chooses among those that suit the building.
enum class RoofKind : std::uint8_t {
  by_id,
  flat,
  gabled,
  hipped,
  half_hipped,
  mansard,
  shed,
  sawtooth,
  pyramid,
  dome
};

/// Covering of a roof. by_id: a usual one of the kind. The values are those of
/// shaders/roof.frag.glsl.
enum class Covering : std::uint8_t { by_id, gravel, tiles, slate, metal, grass, felt };

struct Roof {
  RoofKind kind = RoofKind::by_id;
  /// Height between eaves and ridge (m), which is part of the building's; else it follows from the
  /// pitch.
  std::optional<double> height_m = std::nullopt;
  std::optional<double> pitch_rad = std::nullopt;
  Covering covering = Covering::by_id;
  std::optional<Paint> paint = std::nullopt;
  /// Direction in which a shed's or a gable's slopes fall, from +x; else that of the short sides.
  std::optional<double> falls_rad = std::nullopt;
};

/// An extruded polygon. Corners counter-clockwise seen from above, not repeated at the end.
struct Building {
  std::string id;
  std::vector<Eigen::Vector2d> footprint;  ///< m
  double height_m = 10;                    ///< with its roof
  Facade facade = Facade::by_id;
  std::optional<Paint> paint = std::nullopt;  ///< of its walls
  Roof roof = {};
};

}  // namespace throng::world
