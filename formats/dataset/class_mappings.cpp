#include "formats/dataset/class_mappings.h"

#include <cstddef>

namespace throng::formats {

namespace {

using C = world::SemanticClass;

constexpr CityscapesClass kUnlabeled{0, "unlabeled", 255, {0, 0, 0}};
constexpr CityscapesClass kStatic{4, "static", 255, {0, 0, 0}};
constexpr CityscapesClass kDynamic{5, "dynamic", 255, {111, 74, 0}};
constexpr CityscapesClass kRoad{7, "road", 0, {128, 64, 128}};
constexpr CityscapesClass kSidewalk{8, "sidewalk", 1, {244, 35, 232}};
constexpr CityscapesClass kBuilding{11, "building", 2, {70, 70, 70}};
constexpr CityscapesClass kWall{12, "wall", 3, {102, 102, 156}};
constexpr CityscapesClass kFence{13, "fence", 4, {190, 153, 153}};
constexpr CityscapesClass kGuardRail{14, "guard rail", 255, {180, 165, 180}};
constexpr CityscapesClass kBridge{15, "bridge", 255, {150, 100, 100}};
constexpr CityscapesClass kRailTrack{10, "rail track", 255, {230, 150, 140}};
constexpr CityscapesClass kPole{17, "pole", 5, {153, 153, 153}};
constexpr CityscapesClass kVegetation{21, "vegetation", 8, {107, 142, 35}};
constexpr CityscapesClass kTerrain{22, "terrain", 9, {152, 251, 152}};
constexpr CityscapesClass kSky{23, "sky", 10, {70, 130, 180}};
constexpr CityscapesClass kPerson{24, "person", 11, {220, 20, 60}};
constexpr CityscapesClass kCar{26, "car", 13, {0, 0, 142}};
constexpr CityscapesClass kTruck{27, "truck", 14, {0, 0, 70}};
constexpr CityscapesClass kBus{28, "bus", 15, {0, 60, 100}};
constexpr CityscapesClass kMotorcycle{32, "motorcycle", 17, {0, 0, 230}};
constexpr CityscapesClass kBicycle{33, "bicycle", 18, {119, 11, 32}};
constexpr CityscapesClass kTrafficLight{19, "traffic light", 6, {250, 170, 30}};
constexpr CityscapesClass kTrafficSign{20, "traffic sign", 7, {220, 220, 0}};
constexpr CityscapesClass kTrain{31, "train", 16, {0, 80, 100}};

constexpr UavidClass kUavidClutter{"background clutter", {0, 0, 0}};
constexpr UavidClass kUavidBuilding{"building", {128, 0, 0}};
constexpr UavidClass kUavidRoad{"road", {128, 64, 128}};
constexpr UavidClass kUavidTree{"tree", {0, 128, 0}};
constexpr UavidClass kUavidVegetation{"low vegetation", {128, 128, 0}};
constexpr UavidClass kUavidHuman{"human", {64, 64, 0}};
constexpr UavidClass kUavidStaticCar{"static car", {192, 0, 192}};

struct Mapping {
  C value;
  CityscapesClass cityscapes;
  UavidClass uavid;
};

constexpr std::array<Mapping, world::kSemanticClasses> kMappings = {{
    {C::sky, kSky, kUavidClutter},
    {C::terrain, kTerrain, kUavidVegetation},
    {C::building, kBuilding, kUavidBuilding},
    {C::object, kStatic, kUavidClutter},
    {C::person, kPerson, kUavidHuman},
    {C::umbrella, kDynamic, kUavidClutter},
    {C::drone, kDynamic, kUavidClutter},
    {C::roof, kBuilding, kUavidBuilding},
    {C::door, kBuilding, kUavidBuilding},
    {C::wall, kWall, kUavidBuilding},
    {C::hedge, kVegetation, kUavidVegetation},
    {C::pavement, kSidewalk, kUavidClutter},
    {C::road, kRoad, kUavidRoad},
    {C::grass, kTerrain, kUavidVegetation},
    {C::dirt, kTerrain, kUavidClutter},
    {C::kerb, kSidewalk, kUavidClutter},
    {C::marking, kRoad, kUavidRoad},
    {C::tree, kVegetation, kUavidTree},
    {C::bench, kStatic, kUavidClutter},
    {C::lamp_post, kPole, kUavidClutter},
    {C::bin, kStatic, kUavidClutter},
    {C::car, kCar, kUavidStaticCar},
    {C::bollard, kPole, kUavidClutter},
    {C::stall, kStatic, kUavidClutter},
    {C::barrier, kGuardRail, kUavidClutter},
    {C::fence, kFence, kUavidClutter},
    {C::kiosk, kBuilding, kUavidBuilding},
    {C::tent, kStatic, kUavidClutter},
    {C::stage, kStatic, kUavidClutter},
    {C::train, kTrain, kUavidClutter},
    {C::fountain, kStatic, kUavidClutter},
    {C::rubble, kStatic, kUavidClutter},
    {C::water, kUnlabeled, kUavidClutter},
    {C::stands, kBuilding, kUavidBuilding},
    {C::bush, kVegetation, kUavidVegetation},
    {C::planter, kStatic, kUavidVegetation},
    {C::van, kCar, kUavidStaticCar},
    {C::truck, kTruck, kUavidStaticCar},
    {C::bus, kBus, kUavidStaticCar},
    {C::motorcycle, kMotorcycle, kUavidClutter},
    {C::bicycle, kBicycle, kUavidClutter},
    {C::sign, kTrafficSign, kUavidClutter},
    {C::traffic_light, kTrafficLight, kUavidClutter},
    {C::street_furniture, kStatic, kUavidClutter},
    {C::table, kStatic, kUavidClutter},
    {C::goods, kStatic, kUavidClutter},
    {C::playground, kStatic, kUavidClutter},
    {C::statue, kStatic, kUavidClutter},
    {C::flagpole, kPole, kUavidClutter},
    {C::construction, kStatic, kUavidClutter},
    {C::railway, kRailTrack, kUavidClutter},
    {C::sports, kStatic, kUavidClutter},
    {C::canopy, kBuilding, kUavidBuilding},
    {C::boat, kDynamic, kUavidClutter},
    {C::bridge, kBridge, kUavidClutter},
    {C::suitcase, kDynamic, kUavidClutter},
    {C::stroller, kDynamic, kUavidClutter},
}};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kMappings.size(); ++i) {
    if (static_cast<std::size_t>(kMappings[i].value) != i) return false;
  }
  return true;
}
static_assert(is_in_order(), "the table has the order of the enumerators");

const Mapping& class_mapping(C value) { return kMappings.at(static_cast<std::size_t>(value)); }

}  // namespace

const CityscapesClass& cityscapes_class(world::SemanticClass value) {
  return class_mapping(value).cityscapes;
}

const UavidClass& uavid_class(world::SemanticClass value) { return class_mapping(value).uavid; }

}  // namespace throng::formats
