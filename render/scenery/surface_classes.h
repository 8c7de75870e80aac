// Semantic classes on their way through the id buffer: ids of what stands still have 16 bits of
// index, and the class in the 8 bits above them, until a frame is read.
#pragma once

#include <cstdint>

#include "render/frame.h"
#include "world/semantic_class.h"

namespace throng::render {

/// The id of a building, prop or the ground with the class of a surface.
constexpr std::uint32_t id_with_class(std::uint32_t id, world::SemanticClass value) {
  constexpr std::uint32_t kClassBits = 0x00FF0000;
  return (id & ~kClassBits) | (static_cast<std::uint32_t>(value) << 16U);
}

/// Fills Frame::surface from the ids, and takes the classes out of them.
void split_classes(Frame& frame);

}  // namespace throng::render
