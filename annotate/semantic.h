// The class of what each pixel shows, for semantic segmentation.
#pragma once

#include <cstdint>
#include <string>

#include "render/frame.h"

namespace throng::annotate {

/// Values of the files.
enum class SemanticClass : std::uint8_t {
  sky,  ///< or nothing, where a lens ends
  ground,
  building,
  prop,    ///< also meshes and rubble
  person,  ///< with clothes and what is carried
  umbrella,
  drone,
};

/// Of a value of the frame's id buffer.
constexpr SemanticClass semantic_class(std::uint32_t id) {
  if (id == render::kIdNothing) return SemanticClass::sky;
  if (render::is_agent(id)) return SemanticClass::person;
  if (render::is_umbrella(id)) return SemanticClass::umbrella;
  if (render::is_drone(id)) return SemanticClass::drone;
  if (id >= render::kIdGround) return SemanticClass::ground;
  return id >= render::kIdProp ? SemanticClass::prop : SemanticClass::building;
}

/// The bytes of a PNG file: 8-bit gray, a SemanticClass for each pixel.
std::string semantic_png(const render::Frame& frame);

}  // namespace throng::annotate
