#include "world/semantic_class.h"

#include <algorithm>

#include "base/error.h"

namespace throng::world {

namespace {

using C = SemanticClass;
using G = SemanticGroup;

/// Indices into kUavid.
enum Uavid : std::uint8_t { clutter, building, road, tree, vegetation, human, static_car };

constexpr std::array kUavid = {
    UavidClass{"background clutter", {0, 0, 0}}, UavidClass{"building", {128, 0, 0}},
    UavidClass{"road", {128, 64, 128}},          UavidClass{"tree", {0, 128, 0}},
    UavidClass{"low vegetation", {128, 128, 0}}, UavidClass{"human", {64, 64, 0}},
    UavidClass{"static car", {192, 0, 192}},
};

/// Labels that classes map to.
constexpr std::array kCityscapes = {
    CityscapesClass{0, "unlabeled", 255, {0, 0, 0}},
    CityscapesClass{4, "static", 255, {0, 0, 0}},
    CityscapesClass{5, "dynamic", 255, {111, 74, 0}},
    CityscapesClass{6, "ground", 255, {81, 0, 81}},
    CityscapesClass{7, "road", 0, {128, 64, 128}},
    CityscapesClass{8, "sidewalk", 1, {244, 35, 232}},
    CityscapesClass{11, "building", 2, {70, 70, 70}},
    CityscapesClass{12, "wall", 3, {102, 102, 156}},
    CityscapesClass{13, "fence", 4, {190, 153, 153}},
    CityscapesClass{14, "guard rail", 255, {180, 165, 180}},
    CityscapesClass{17, "pole", 5, {153, 153, 153}},
    CityscapesClass{21, "vegetation", 8, {107, 142, 35}},
    CityscapesClass{22, "terrain", 9, {152, 251, 152}},
    CityscapesClass{23, "sky", 10, {70, 130, 180}},
    CityscapesClass{24, "person", 11, {220, 20, 60}},
    CityscapesClass{26, "car", 13, {0, 0, 142}},
    CityscapesClass{31, "train", 16, {0, 80, 100}},
};

constexpr std::array<SemanticClassInfo, kSemanticClasses> kClasses = {{
    {C::sky, "sky", {70, 130, 180}, G::nothing, 23, clutter},
    {C::terrain, "terrain", {152, 180, 120}, G::ground, 22, vegetation},
    {C::building, "building", {110, 110, 120}, G::building, 11, building},
    {C::object, "object", {160, 110, 60}, G::prop, 4, clutter},
    {C::person, "person", {220, 20, 60}, G::person, 24, human},
    {C::umbrella, "umbrella", {255, 140, 190}, G::umbrella, 5, clutter},
    {C::drone, "drone", {255, 220, 0}, G::drone, 5, clutter},
    {C::roof, "roof", {150, 80, 70}, G::building, 11, building},
    {C::door, "door", {90, 50, 20}, G::building, 11, building},
    {C::wall, "wall", {102, 102, 156}, G::building, 12, building},
    {C::hedge, "hedge", {60, 120, 40}, G::building, 21, vegetation},
    {C::pavement, "pavement", {200, 170, 200}, G::ground, 8, clutter},
    {C::road, "road", {128, 64, 128}, G::ground, 7, road},
    {C::grass, "grass", {120, 200, 60}, G::ground, 22, vegetation},
    {C::dirt, "dirt", {170, 130, 80}, G::ground, 22, clutter},
    {C::kerb, "kerb", {230, 210, 230}, G::ground, 8, clutter},
    {C::marking, "marking", {255, 255, 255}, G::ground, 7, road},
    {C::tree, "tree", {20, 90, 20}, G::prop, 21, tree},
    {C::bench, "bench", {140, 90, 40}, G::prop, 4, clutter},
    {C::lamp_post, "lamp_post", {190, 190, 150}, G::prop, 17, clutter},
    {C::bin, "bin", {60, 90, 90}, G::prop, 4, clutter},
    {C::car, "car", {0, 0, 200}, G::prop, 26, static_car},
    {C::bollard, "bollard", {150, 150, 150}, G::prop, 17, clutter},
    {C::stall, "stall", {230, 120, 40}, G::prop, 4, clutter},
    {C::barrier, "barrier", {180, 165, 180}, G::prop, 14, clutter},
    {C::fence, "fence", {190, 153, 153}, G::prop, 13, clutter},
    {C::kiosk, "kiosk", {120, 60, 160}, G::prop, 11, building},
    {C::tent, "tent", {240, 230, 160}, G::prop, 4, clutter},
    {C::stage, "stage", {40, 30, 60}, G::prop, 4, clutter},
    {C::train, "train", {0, 80, 100}, G::prop, 31, clutter},
    {C::fountain, "fountain", {80, 190, 220}, G::prop, 4, clutter},
    {C::rubble, "rubble", {120, 100, 90}, G::prop, 4, clutter},
    {C::water, "water", {50, 120, 190}, G::prop, 0, clutter},
    {C::stands, "stands", {90, 110, 160}, G::prop, 11, building},
}};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kClasses.size(); ++i) {
    if (static_cast<std::size_t>(kClasses[i].value) != i) return false;
  }
  return true;
}
static_assert(is_in_order(), "the table has the order of the enumerators");

}  // namespace

SemanticClass class_of(PropKind kind) {
  // Both lists have the same order.
  return static_cast<SemanticClass>(static_cast<std::size_t>(C::tree) +
                                    static_cast<std::size_t>(kind));
}

std::optional<SemanticClass> semantic_class_named(std::string_view name) {
  const auto found =
      std::find_if(kClasses.begin(), kClasses.end(),
                   [&](const SemanticClassInfo& known) { return known.name == name; });
  if (found == kClasses.end()) return std::nullopt;
  return found->value;
}

std::span<const SemanticClassInfo, kSemanticClasses> semantic_classes() { return kClasses; }

std::span<const UavidClass> uavid_classes() { return kUavid; }

const CityscapesClass& cityscapes_class(std::uint8_t id) {
  const auto found = std::find_if(kCityscapes.begin(), kCityscapes.end(),
                                  [&](const CityscapesClass& known) { return known.id == id; });
  check(found != kCityscapes.end(), "the table has every label that classes map to");
  return *found;
}

}  // namespace throng::world
