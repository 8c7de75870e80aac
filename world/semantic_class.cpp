#include "world/semantic_class.h"

#include <algorithm>

namespace throng::world {

namespace {

using C = SemanticClass;
using G = SemanticGroup;

constexpr std::array<SemanticClassInfo, kSemanticClasses> kClasses = {{
    {C::sky, "sky", {70, 130, 180}, G::nothing},
    {C::terrain, "terrain", {152, 180, 120}, G::ground},
    {C::building, "building", {110, 110, 120}, G::building},
    {C::object, "object", {160, 110, 60}, G::prop},
    {C::person, "person", {220, 20, 60}, G::person},
    {C::umbrella, "umbrella", {255, 140, 190}, G::umbrella},
    {C::drone, "drone", {255, 220, 0}, G::drone},
    {C::roof, "roof", {150, 80, 70}, G::building},
    {C::door, "door", {90, 50, 20}, G::building},
    {C::wall, "wall", {102, 102, 156}, G::building},
    {C::hedge, "hedge", {60, 120, 40}, G::building},
    {C::pavement, "pavement", {200, 170, 200}, G::ground},
    {C::road, "road", {128, 64, 128}, G::ground},
    {C::grass, "grass", {120, 200, 60}, G::ground},
    {C::dirt, "dirt", {170, 130, 80}, G::ground},
    {C::kerb, "kerb", {230, 210, 230}, G::ground},
    {C::marking, "marking", {255, 255, 255}, G::ground},
    {C::tree, "tree", {20, 90, 20}, G::prop},
    {C::bench, "bench", {140, 90, 40}, G::prop},
    {C::lamp_post, "lamp_post", {190, 190, 150}, G::prop},
    {C::bin, "bin", {60, 90, 90}, G::prop},
    {C::car, "car", {0, 0, 200}, G::prop},
    {C::bollard, "bollard", {150, 150, 150}, G::prop},
    {C::stall, "stall", {230, 120, 40}, G::prop},
    {C::barrier, "barrier", {180, 165, 180}, G::prop},
    {C::fence, "fence", {190, 153, 153}, G::prop},
    {C::kiosk, "kiosk", {120, 60, 160}, G::prop},
    {C::tent, "tent", {240, 230, 160}, G::prop},
    {C::stage, "stage", {40, 30, 60}, G::prop},
    {C::train, "train", {0, 80, 100}, G::prop},
    {C::fountain, "fountain", {80, 190, 220}, G::prop},
    {C::rubble, "rubble", {120, 100, 90}, G::prop},
    {C::water, "water", {50, 120, 190}, G::prop},
    {C::stands, "stands", {90, 110, 160}, G::prop},
    {C::bush, "bush", {70, 140, 70}, G::prop},
    {C::planter, "planter", {190, 120, 90}, G::prop},
    {C::van, "van", {0, 60, 140}, G::prop},
    {C::truck, "truck", {0, 0, 90}, G::prop},
    {C::bus, "bus", {0, 60, 100}, G::prop},
    {C::motorcycle, "motorcycle", {0, 0, 230}, G::prop},
    {C::bicycle, "bicycle", {119, 11, 32}, G::prop},
    {C::sign, "sign", {220, 220, 0}, G::prop},
    {C::traffic_light, "traffic_light", {250, 170, 30}, G::prop},
    {C::street_furniture, "street_furniture", {90, 120, 150}, G::prop},
    {C::table, "table", {170, 110, 70}, G::prop},
    {C::goods, "goods", {200, 90, 60}, G::prop},
    {C::playground, "playground", {230, 70, 160}, G::prop},
    {C::statue, "statue", {130, 160, 140}, G::prop},
    {C::flagpole, "flagpole", {170, 200, 230}, G::prop},
    {C::construction, "construction", {240, 150, 0}, G::prop},
    {C::railway, "railway", {230, 150, 140}, G::prop},
    {C::sports, "sports", {250, 250, 200}, G::prop},
    {C::canopy, "canopy", {150, 100, 160}, G::prop},
    {C::boat, "boat", {30, 70, 110}, G::prop},
    {C::bridge, "bridge", {150, 100, 100}, G::prop},
    {C::suitcase, "suitcase", {200, 60, 120}, G::umbrella},
    {C::stroller, "stroller", {160, 40, 160}, G::umbrella},
}};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kClasses.size(); ++i) {
    if (static_cast<std::size_t>(kClasses[i].value) != i) return false;
  }
  return true;
}
static_assert(is_in_order(), "the table has the order of the enumerators");

}  // namespace

bool is_vehicle(SemanticClass value) {
  return value == C::car || value == C::train || value == C::van || value == C::truck ||
         value == C::bus || value == C::motorcycle;
}

std::optional<SemanticClass> semantic_class_named(std::string_view name) {
  const auto found =
      std::find_if(kClasses.begin(), kClasses.end(),
                   [&](const SemanticClassInfo& known) { return known.name == name; });
  if (found == kClasses.end()) return std::nullopt;
  return found->value;
}

std::span<const SemanticClassInfo, kSemanticClasses> semantic_classes() { return kClasses; }

}  // namespace throng::world
