// Semantic classes: what a surface is. One table of names and colors. The numbers are stable: they
// are the values of semantic/*.png.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "world/props.h"

namespace throng::world {

enum class SemanticClass : std::uint8_t {
  sky = 0,       ///< or nothing, where a lens ends
  terrain = 1,   ///< the plain around a scenario
  building = 2,  ///< facades
  object = 3,    ///< of no other class: meshes whose scenario names none
  person = 4,    ///< with clothes and what is carried
  umbrella = 5,
  drone = 6,
  roof = 7,  ///< with what stands on it
  door = 8,  ///< of exits
  wall = 9,  ///< too low for a story
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
};
inline constexpr std::size_t kSemanticClasses = 34;

/// The kind of instance that a pixel of a class may belong to.
enum class SemanticGroup : std::uint8_t {
  nothing,
  ground,
  building,
  prop,
  person,
  umbrella,
  drone
};

struct SemanticClassInfo {
  SemanticClass value{};
  std::string_view name = {};
  std::array<std::uint8_t, 3> color{};  ///< of legends, sRGB
  SemanticGroup group{};
};

/// The class of a kind of prop.
SemanticClass semantic_class(PropKind kind);

/// The class of this name; nothing if there is none.
std::optional<SemanticClass> semantic_class_named(std::string_view name);

/// All classes, by value.
std::span<const SemanticClassInfo, kSemanticClasses> semantic_classes();

inline const SemanticClassInfo& semantic_class_info(SemanticClass value) {
  return semantic_classes()[static_cast<std::size_t>(value)];
}

}  // namespace throng::world
