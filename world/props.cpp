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
  using C = SemanticClass;
  using H = Habitat;
  static const std::array<PropType, kPropKinds> types = {{
      {"tree", {0.25, 0.25}, 0, C::tree, Foot::disc},
      {"bench", {0.9, 0.3}, 0.95, C::bench, Foot::rectangle, H::lawn},
      {"lamp_post", {0.12, 0.12}, 4.8, C::lamp_post, Foot::disc},
      {"bin", {0.28, 0.28}, 1.15, C::bin, Foot::disc, H::kerb},
      {"car", {2.15, 0.9}, 1.75, C::car, Foot::rectangle, H::road},
      {"bollard", {0.1, 0.1}, 1, C::bollard, Foot::disc, H::kerb},
      {"stall", {1.5, 1.1}, 2.75, C::stall, Foot::posts},
      {"barrier", {1.25, 0.25}, 1.15, C::barrier},
      {"fence", {1.5, 0.06}, 1.25, C::fence},
      {"kiosk", {1.5, 1.25}, 2.9, C::kiosk},
      {"tent", {3, 3}, 4.25, C::tent, Foot::posts},
      {"stage", {8, 4.5}, 8.5, C::stage},
      {"train", {10, 1.45}, 4.05, C::train},
      {"fountain", {2.6, 2.6}, 2.35, C::fountain, Foot::disc},
      {"bush", {0.7, 0.7}, 0, C::bush, Foot::disc},
      {"planter", {0.9, 0.4}, 0, C::planter, Foot::rectangle, H::facade},
      {"van", {2.6, 1}, 2.5, C::van, Foot::rectangle, H::road},
      {"delivery_truck", {3.6, 1.2}, 3.3, C::truck, Foot::rectangle, H::road},
      {"food_truck", {2.9, 1.15}, 3.1, C::truck, Foot::rectangle, H::lot},
      {"bus", {6.1, 1.3}, 3.3, C::bus},
      {"moped", {0.95, 0.38}, 1.2, C::motorcycle, Foot::rectangle, H::road},
      {"motorcycle", {1.1, 0.42}, 1.25, C::motorcycle, Foot::rectangle, H::road},
      {"bicycle", {0.92, 0.32}, 1.15, C::bicycle, Foot::rectangle, H::facade},
      {"bicycle_rack", {1.55, 0.95}, 1.15, C::bicycle, Foot::rectangle, H::kerb},
      {"cargo_bike", {1.3, 0.45}, 1.3, C::bicycle, Foot::rectangle, H::facade},
      {"traffic_sign", {0.08, 0.08}, 3.2, C::sign, Foot::disc, H::kerb},
      {"traffic_light", {0.15, 0.15}, 3.6, C::traffic_light, Foot::disc},
      {"street_sign", {0.08, 0.08}, 2.9, C::sign, Foot::disc, H::kerb},
      {"parking_meter", {0.17, 0.14}, 1.7, C::street_furniture, Foot::rectangle, H::kerb},
      {"post_box", {0.3, 0.26}, 1.45, C::street_furniture, Foot::rectangle, H::kerb},
      {"hydrant", {0.22, 0.22}, 0.85, C::street_furniture, Foot::disc, H::kerb},
      {"newspaper_box", {0.5, 0.28}, 1.25, C::street_furniture, Foot::rectangle, H::kerb},
      {"advertising_column", {0.75, 0.75}, 3.7, C::street_furniture, Foot::disc, H::kerb},
      {"bus_stop", {2.1, 0.85}, 2.7, C::street_furniture, Foot::rectangle, H::kerb},
      {"cabinet", {0.5, 0.2}, 1.35, C::street_furniture, Foot::rectangle, H::facade},
      {"phone_booth", {0.5, 0.5}, 2.45, C::street_furniture, Foot::rectangle, H::kerb},
      {"vending_machine", {0.5, 0.42}, 1.95, C::street_furniture, Foot::rectangle, H::facade},
      {"wheelie_bin", {0.3, 0.38}, 1.15, C::bin, Foot::rectangle, H::facade},
      {"wheelie_bins", {1, 0.4}, 1.15, C::bin, Foot::rectangle, H::facade},
      {"recycling_container", {0.9, 0.7}, 1.75, C::bin, Foot::rectangle, H::corner},
      {"skip", {1.8, 0.9}, 1.5, C::construction, Foot::rectangle, H::lot},
      {"garbage_bags", {0.6, 0.45}, 0.75, C::bin, Foot::rectangle, H::corner},
      {"cafe_table", {0.95, 0.95}, 2.6, C::table, Foot::rectangle, H::facade},
      {"beer_table", {1.1, 0.9}, 0.85, C::table, Foot::rectangle, H::lot},
      {"picnic_table", {0.95, 0.85}, 0.8, C::table, Foot::rectangle, H::lawn},
      {"a_board", {0.33, 0.33}, 1.1, C::sign, Foot::rectangle, H::facade},
      {"flower_pots", {0.6, 0.3}, 1.2, C::planter, Foot::rectangle, H::facade},
      {"wall_box", {0.45, 0.12}, 1.9, C::street_furniture, Foot::rectangle, H::wall},
      {"info_board", {0.9, 0.12}, 2.2, C::sign, Foot::rectangle, H::lawn},
      {"swing", {1.7, 1.15}, 2.5, C::playground, Foot::rectangle, H::lawn},
      {"slide", {1.9, 0.5}, 2.7, C::playground, Foot::rectangle, H::lawn},
      {"spring_rider", {0.5, 0.3}, 1, C::playground, Foot::rectangle, H::lawn},
      {"sandbox", {1.4, 1.4}, 0.5, C::playground, Foot::rectangle, H::lawn},
      {"statue", {0.9, 0.9}, 4.3, C::statue, Foot::rectangle, H::lawn},
      {"flagpole", {0.15, 0.15}, 8.1, C::flagpole, Foot::disc, H::lawn},
      {"drinking_fountain", {0.3, 0.3}, 1.1, C::fountain, Foot::disc, H::kerb},
      {"scaffold", {2.65, 0.45}, 6.2, C::construction, Foot::rectangle, H::facade},
      {"construction_fence", {1.75, 0.3}, 2.05, C::construction, Foot::rectangle, H::corner},
      {"cone", {0.2, 0.2}, 0.75, C::construction, Foot::rectangle, H::road},
      {"portable_toilet", {0.58, 0.6}, 2.4, C::construction, Foot::rectangle, H::lot},
      {"crates", {0.65, 0.45}, 1.4, C::goods, Foot::rectangle, H::facade},
      {"pallet", {0.62, 0.42}, 1.5, C::goods, Foot::rectangle, H::corner},
      {"cardboard", {0.6, 0.45}, 1.1, C::goods, Foot::rectangle, H::corner},
      {"market_goods", {1, 0.6}, 1.3, C::goods, Foot::rectangle, H::facade},
      {"flower_stand", {0.95, 0.4}, 1.3, C::goods, Foot::rectangle, H::facade},
      {"clothes_rack", {0.85, 0.3}, 1.75, C::goods, Foot::rectangle, H::facade},
      {"kick_scooter", {0.6, 0.25}, 1.2, C::bicycle, Foot::rectangle, H::kerb},
      {"charging_station", {0.2, 0.16}, 1.6, C::street_furniture, Foot::rectangle, H::kerb},
  }};
  return types;
}

std::array<Eigen::Vector2d, 4> prop_footprint(const Prop& prop) {
  return geometry::turned_rectangle(prop.position, prop.scale * prop_type(prop.kind).half_size,
                                    prop.yaw_rad);
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
