// The rules by which traces of use lie on the ground.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/ground/ground_decals.h"
#include "world/props.h"

namespace throng::render {

/// Bits of DecalRule::on.
enum GroundBit : std::uint8_t { on_paved = 1, on_road = 2, on_green = 4, on_bare = 8, on_any = 15 };

enum class DecalAnchor : std::uint8_t { prop, area, wall, kerb };
enum class DecalTurn : std::uint8_t { any, along, across };  ///< of the area, wall or kerb

struct DecalRule {
  DecalKind kind;
  DecalAnchor anchor;
  std::uint8_t on;  ///< materials of the ground on which it may lie
  double count;     ///< per prop, per 100 m² of an area, or per 10 m of a wall or kerb
  std::array<double, 2> half_length_m;  ///< least and most
  std::array<double, 2> width_share;    ///< of the length, least and most
  DecalTurn turn = DecalTurn::any;
  double reach_m = 0;  ///< from the edge of a prop; negative: below it
  double apart_m = 0;  ///< from others of the kind
  world::PropKind prop = world::PropKind::tree;
};

std::span<const DecalRule> decal_rules();

}  // namespace throng::render
