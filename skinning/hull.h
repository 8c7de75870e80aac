// Lower levels of detail: the body's own skin, simplified once for everybody, pushed out to the
// clothes and hair of each person, cut along their borders and coloured by pictures of that person.
//
// Simplifying the garments themselves breaks down below some thousand triangles (seams and open
// borders cannot collapse); the skin is one closed surface, so any number of triangles is reached
// without holes, and limbs cannot grow together.
#pragma once

#include <cstdint>
#include <vector>

#include "skinning/cover.h"
#include "skinning/dress.h"
#include "skinning/makehuman.h"
#include "skinning/population.h"
#include "skinning/portrait.h"

namespace throng::skinning {

/// Triangles over some of the body's vertices; the same for every person.
struct HullTopology {
  std::vector<std::uint32_t> vertices;  ///< body vertices
  std::vector<std::uint32_t> indices;   ///< into vertices
  float swell_m = 0;  ///< pushed out by this: flat facets lie inside the round body
};

/// The body's skin, its openings closed, with about `triangles` triangles.
HullTopology simplify_skin(const MakeHuman& makehuman, std::size_t triangles, float swell_m);

/// A person's hull. Its untinted parts have texture `picture`, the tinted ones `picture` + 1: the
/// portrait's two pictures.
Mesh make_hull(const MakeHuman& makehuman, const DressedPerson& person,
               const HullTopology& topology, const Portrait& portrait, const Clothing& clothing,
               int picture);

}  // namespace throng::skinning
