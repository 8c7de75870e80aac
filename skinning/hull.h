// Lower levels of detail: the body's own skin, simplified once for everybody, pushed out to the
// clothes and hair of each person and coloured by two pictures taken of that person.
//
// Simplifying the garments themselves breaks down below some thousand triangles (seams and open
// borders cannot collapse); the skin is one closed surface, so any number of triangles is reached
// without holes, and limbs cannot grow together.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "skinning/dress.h"
#include "skinning/image.h"
#include "skinning/makehuman.h"
#include "skinning/population.h"

namespace throng::skinning {

/// Triangles over some of the body's vertices; the same for every person.
struct HullTopology {
  std::vector<std::uint32_t> vertices;  ///< body vertices
  std::vector<std::uint32_t> indices;   ///< into vertices
};

/// The body's skin, its openings closed, with about `triangles` triangles.
HullTopology simplify_skin(const MakeHuman& makehuman, std::size_t triangles);

/// A dressed person drawn from the front and from behind, slightly from above, in the A-pose: what
/// the hulls are coloured with.
class Portrait {
 public:
  Portrait(const DressedPerson& person, const std::map<std::string, Image>& textures, int size);

  /// The hull of this person, its parts having texture `texture`. Marks in the picture which
  /// texels it uses.
  Mesh add_hull(const MakeHuman& makehuman, const DressedPerson& person,
                const HullTopology& topology, int texture);

  /// The finished texture for all hulls that were added.
  Image picture() const;

 private:
  struct Texel {
    float depth = -1e9F;
    Tint tint = Tint::none;
    bool seen = false;
  };
  Eigen::Vector2f texel_of(const Eigen::Vector3f& point, bool front) const;

  const std::map<std::string, Image>* textures_;
  int size_;
  Eigen::Vector2f low_;  ///< corner of the view, same for both sides
  Eigen::Vector2f extent_;
  Image colours_;
  std::vector<Texel> texels_;
  std::vector<std::uint8_t> wanted_;  ///< per texel: 1 + tint of the hull there, or 0
};

}  // namespace throng::skinning
