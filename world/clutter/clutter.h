// Clutter of streets: bicycles along walls, signs and meters beside roads, parked vehicles, benches
// on lawns, goods before houses. A seed strews it by rules over ground on which nobody walks.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "world/props.h"

namespace throng::world {

struct Clutter {
  std::uint64_t seed = 0;
  double density = 0.5;              ///< 0 to 1
  std::vector<PropKind> kinds = {};  ///< those that may appear; empty: all that clutter knows
};

/// Adds clutter to the props of a scenario whose other parts are read (Scenario::strewn_props).
/// It stands neither in buildings, before exits, near other props or on crossings, nor within 1 m
/// of the inside of the scenario, where people walk; only what is flat on a wall may stand there.
/// The same values give the same props.
void strew(const Clutter& clutter, Scenario& scenario);

/// Whether clutter may have a kind.
bool is_strewn(PropKind kind);

}  // namespace throng::world
