#include "render/place/surface_classes.h"

namespace throng::render {

namespace {

constexpr std::uint32_t kFirstGround = 0xFF000000;  // kIdGround with class 0

std::uint8_t number_of(world::SemanticClass value) { return static_cast<std::uint8_t>(value); }

}  // namespace

void split_classes(Frame& frame) {
  using world::SemanticClass;
  frame.surface.resize(frame.id.size());
  std::uint8_t* surface = frame.surface.data();
  for (std::uint32_t& id : frame.id) {
    if (id == kIdNothing) {
      *surface = number_of(SemanticClass::sky);
    } else if (is_agent(id)) {
      *surface = number_of(SemanticClass::person);
    } else if (is_umbrella(id)) {
      *surface = number_of(SemanticClass::umbrella);
    } else if (id >= kIdDrone && id < kFirstGround) {
      *surface = number_of(SemanticClass::drone);
    } else {
      *surface = static_cast<std::uint8_t>(id >> 16U);
      id = id >= kFirstGround ? kIdGround : id_with_class(id, SemanticClass::sky);
    }
    ++surface;
  }
}

}  // namespace throng::render
