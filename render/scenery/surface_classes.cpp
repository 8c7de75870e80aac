#include "render/scenery/surface_classes.h"

namespace throng::render {

namespace {

constexpr std::uint32_t kFirstGround = 0xFF000000;  // kIdGround with class 0

std::uint8_t class_number(world::SemanticClass value) { return static_cast<std::uint8_t>(value); }

}  // namespace

void split_classes(Frame& frame) {
  using world::SemanticClass;
  frame.surface.resize(frame.id.size());
  std::uint8_t* surface = frame.surface.data();
  for (std::uint32_t& id : frame.id) {
    if (id == kIdNothing) {
      *surface = class_number(SemanticClass::sky);
    } else if (is_agent(id)) {
      *surface = class_number(SemanticClass::person);
    } else if (is_umbrella(id)) {
      *surface = class_number(SemanticClass::umbrella);
    } else if (id >= kIdDrone && id < kFirstGround) {
      *surface = class_number(SemanticClass::drone);
    } else {
      *surface = static_cast<std::uint8_t>(id >> 16U);
      id = id >= kFirstGround ? kIdGround : id_with_class(id, SemanticClass::sky);
    }
    ++surface;
  }
}

}  // namespace throng::render
