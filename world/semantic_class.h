// Semantic classes of surfaces: one table of numbers, names and colors. The numbers are the values
// of semantic/*.png and never change.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace throng::world {

enum class SemanticClass : std::uint8_t {
  sky = 0,       ///< also pixels outside the image circle of a lens
  terrain = 1,   ///< the land around a scenario
  building = 2,  ///< facades
  object = 3,    ///< surfaces of no other class, e.g. meshes without a class
  person = 4,    ///< with clothes and carried objects
  umbrella = 5,
  drone = 6,
  roof = 7,  ///< with structures on it, and upper faces of details
  door = 8,  ///< of an exit
  wall = 9,  ///< lower than a story
  hedge = 10,
  pavement = 11,  ///< pavers and concrete
  road = 12,      ///< asphalt
  grass = 13,
  dirt = 14,
  kerb = 15,
  marking = 16,  ///< paint on the ground
  tree = 17,
  bench = 18,
  lamp_post = 19,
  bin = 20,
  car = 21,
  bollard = 22,
  stall = 23,
  barrier = 24,
  fence = 25,
  kiosk = 26,
  tent = 27,
  stage = 28,
  train = 29,
  fountain = 30,
  rubble = 31,
  water = 32,
  stands = 33,  ///< tiers of seats
  bush = 34,
  planter = 35,
  van = 36,
  truck = 37,
  bus = 38,
  motorcycle = 39,  ///< and mopeds
  bicycle = 40,     ///< with its rack; kick scooters
  sign = 41,        ///< of traffic, streets, maps and shops
  traffic_light = 42,
  street_furniture = 43,  ///< post boxes, meters, cabinets, shelters, columns, hydrants
  table = 44,             ///< with its chairs and parasol
  goods = 45,             ///< for sale or delivered, with their crates
  playground = 46,
  statue = 47,
  flagpole = 48,
  construction = 49,  ///< scaffolds, fences, cones, skips, cabins
  railway = 50,       ///< rails, sleepers, ballast, masts and wires
  sports = 51,        ///< goals
  canopy = 52,        ///< roofs on posts over platforms
  boat = 53,          ///< and pontoons
  bridge = 54,        ///< what carries a deck: arches, girders, piers
  suitcase = 55,      ///< pulled
  stroller = 56       ///< prams and pushchairs
};
inline constexpr std::size_t kSemanticClasses = 57;

/// Kinds of instances to which a pixel can belong.
enum class SemanticGroup : std::uint8_t {
  nothing,
  ground,
  building,
  prop,
  person,
  umbrella,  ///< what people hold or lead; bicycles, which are led as well, are props
  drone
};

struct SemanticClassInfo {
  SemanticClass value{};
  std::string_view name = {};
  std::array<std::uint8_t, 3> color{};  ///< in legends, sRGB
  SemanticGroup group{};
};

/// Whether objects of a class are vehicles, which have labels of their own: motor vehicles and
/// trains.
bool is_vehicle(SemanticClass value);

/// Returns the class with this name, or nothing.
std::optional<SemanticClass> semantic_class_named(std::string_view name);

/// All classes, sorted by value.
std::span<const SemanticClassInfo, kSemanticClasses> semantic_classes();

inline const SemanticClassInfo& semantic_class_info(SemanticClass value) {
  return semantic_classes()[static_cast<std::size_t>(value)];
}

}  // namespace throng::world
