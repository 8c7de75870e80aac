// Procedural shapes of props: few triangles, designed for distances of 15 to 60 m.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "world/props.h"

namespace throng::render {

/// How a surface takes light; also in shaders/prop.frag.glsl.
enum class Finish : std::uint8_t {
  matt = 0,
  leaves = 1,  ///< a card of leaves: full of holes
  glossy = 2,  ///< lacquer and glass: mirrors the sky
  lamp = 3     ///< shines after sunset
};

struct PropVertex {
  std::array<float, 3> position{};  ///< m, in the world
  std::array<float, 3> normal{};
  std::array<float, 2> card{};          ///< leaves: place on the card, 0 to 1
  std::array<std::uint8_t, 4> paint{};  ///< linear albedo, then the Finish
  std::uint32_t id = 0;
};

/// Triangles, counter-clockwise seen from outside; cards of leaves are seen from both sides.
struct PropMesh {
  std::vector<PropVertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// The prop where it stands, with `id` for the id buffer.
PropMesh prop_shape(const world::Prop& prop, std::uint32_t id);

/// Height of the light of a lamp post at scale 1 (m).
inline constexpr double kLampPostM = 4.6;

}  // namespace throng::render
