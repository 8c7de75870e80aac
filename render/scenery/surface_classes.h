// Encoding of semantic classes in the id buffer: until a frame is read, ids of static objects have
// 16 bits of index and the class in the 8 bits above.
#pragma once

#include <cstdint>

#include "render/frame/frame.h"
#include "render/props/scene.h"
#include "skinning/population.h"
#include "world/semantic_class.h"

namespace throng::render {

/// The id of a building, a prop or the ground, with the class of a surface.
constexpr std::uint32_t id_with_class(std::uint32_t id, world::SemanticClass value) {
  constexpr std::uint32_t kClassBits = 0x00FF0000;
  return (id & ~kClassBits) | (static_cast<std::uint32_t>(value) << 16U);
}

/// Fills Frame::surface from the ids and removes the classes from the ids; what people hold or lead
/// has the class of what these people in the scene carry.
void split_classes(const skinning::Population& population, const Scene& scene, Frame& frame);

}  // namespace throng::render
