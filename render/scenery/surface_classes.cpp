#include "render/scenery/surface_classes.h"

#include <unordered_map>

namespace throng::render {

namespace {

constexpr std::uint32_t kFirstGround = 0xFF000000;  // kIdGround with class 0

std::uint8_t class_number(world::SemanticClass value) { return static_cast<std::uint8_t>(value); }

world::SemanticClass led_class(skinning::Carry led) {
  if (led == skinning::Carry::suitcase) return world::SemanticClass::suitcase;
  return led == skinning::Carry::pram ? world::SemanticClass::stroller
                                      : world::SemanticClass::bicycle;
}

}  // namespace

void split_classes(const skinning::Population& population, const Scene& scene, Frame& frame) {
  using world::SemanticClass;
  std::unordered_map<std::uint32_t, SemanticClass> led;  // by agent
  for (const PersonInstance& person : scene.people) {
    const skinning::Carry carries = population.characters[person.appearance.character].carries;
    if (skinning::is_led(carries)) led.emplace(person.agent, led_class(carries));
  }
  frame.surface.resize(frame.id.size());
  std::uint8_t* surface = frame.surface.data();
  for (std::uint32_t& id : frame.id) {
    if (id == kIdNothing) {
      *surface = class_number(SemanticClass::sky);
    } else if (is_agent(id)) {
      *surface = class_number(SemanticClass::person);
    } else if (is_umbrella(id)) {
      const auto found = led.find(agent_of_id(id - kIdUmbrella));
      *surface = class_number(found == led.end() ? SemanticClass::umbrella : found->second);
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
