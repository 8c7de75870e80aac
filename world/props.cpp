#include "world/props.h"

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "world/scenario.h"

namespace throng::world {

namespace {

constexpr std::uint64_t kThinning = std::uint64_t{1} << 42;  // apart from other uses of the stream

}  // namespace

const std::array<PropType, kPropKinds>& prop_types() {
  static const std::array<PropType, kPropKinds> types = {{{"tree", {0.25, 0.25}},
                                                          {"bench", {0.9, 0.3}},
                                                          {"lamp_post", {0.12, 0.12}},
                                                          {"bin", {0.28, 0.28}},
                                                          {"car", {2.15, 0.9}},
                                                          {"bollard", {0.1, 0.1}},
                                                          {"stall", {1.5, 1.1}},
                                                          {"barrier", {1.25, 0.25}},
                                                          {"fence", {1.5, 0.06}},
                                                          {"kiosk", {1.5, 1.25}},
                                                          {"tent", {3, 3}},
                                                          {"stage", {8, 4.5}},
                                                          {"train", {10, 1.45}},
                                                          {"fountain", {2.6, 2.6}},
                                                          {"bush", {0.7, 0.7}},
                                                          {"planter", {0.9, 0.4}}}};
  return types;
}

std::array<Eigen::Vector2d, 4> prop_footprint(const Prop& prop) {
  const PropType& type = prop_types().at(static_cast<std::size_t>(prop.kind));
  return geometry::turned_rectangle(prop.position, prop.scale * type.half_size, prop.yaw_rad);
}

double distance_to(const Prop& prop, const Eigen::Vector2d& point) {
  return geometry::distance_to(prop_footprint(prop), point);
}

void thin_out(Scenario& scenario, double share, std::uint64_t seed) {
  std::vector<Prop> kept;
  for (std::size_t i = 0; i < scenario.props.size(); ++i) {
    const bool stays = i < scenario.placed_props ||
                       Random(seed, Stream::environment, kThinning + i).uniform() < share;
    if (stays) kept.push_back(scenario.props[i]);
  }
  scenario.props = std::move(kept);
}

}  // namespace throng::world
