#include "world/props.h"

#include <map>
#include <numbers>
#include <set>

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
  static const std::array<PropType, kPropKinds> types = {{
      {"tree", {0.25, 0.25}, 0, C::tree, Foot::disc},
      {"bench", {0.9, 0.3}, 0.95, C::bench},
      {"lamp_post", {0.12, 0.12}, 4.8, C::lamp_post, Foot::disc},
      {"bin", {0.28, 0.28}, 1.15, C::bin, Foot::disc},
      {"car", {2.15, 0.9}, 1.75, C::car},
      {"bollard", {0.1, 0.1}, 1, C::bollard, Foot::disc},
      {"stall", {1.5, 1.1}, 2.75, C::stall, Foot::posts},
      {"barrier", {1.25, 0.25}, 1.15, C::barrier},
      {"fence", {1.5, 0.06}, 1.25, C::fence},
      {"kiosk", {1.5, 1.25}, 2.9, C::kiosk},
      {"tent", {3, 3}, 4.25, C::tent, Foot::posts},
      {"stage", {8, 4.5}, 8.5, C::stage},
      {"train", {10, 1.45}, 4.05, C::train},
      {"fountain", {2.6, 2.6}, 2.35, C::fountain, Foot::disc},
      {"bush", {0.7, 0.7}, 0, C::bush, Foot::disc},
      {"planter", {0.9, 0.4}, 0, C::planter},
      {"van", {2.6, 1}, 2.5, C::van},
      {"delivery_truck", {3.6, 1.2}, 3.3, C::truck},
      {"food_truck", {2.9, 1.45}, 3.1, C::truck},
      {"bus", {6.1, 1.3}, 3.3, C::bus},
      {"moped", {0.95, 0.38}, 1.27, C::motorcycle},
      {"motorcycle", {1.1, 0.42}, 1.25, C::motorcycle},
      {"bicycle", {0.92, 0.32}, 1.15, C::bicycle},
      {"bicycle_rack", {1.55, 0.95}, 1.15, C::bicycle},
      {"cargo_bike", {1.3, 0.45}, 1.3, C::bicycle},
      {"traffic_sign", {0.08, 0.08}, 3.2, C::sign, Foot::disc},
      {"traffic_light", {0.15, 0.15}, 3.6, C::traffic_light, Foot::disc},
      {"street_sign", {0.08, 0.08}, 2.9, C::sign, Foot::disc},
      {"parking_meter", {0.17, 0.14}, 1.7, C::street_furniture},
      {"post_box", {0.3, 0.26}, 1.45, C::street_furniture},
      {"hydrant", {0.22, 0.22}, 0.85, C::street_furniture, Foot::disc},
      {"newspaper_box", {0.5, 0.28}, 1.25, C::street_furniture},
      {"advertising_column", {0.75, 0.75}, 3.7, C::street_furniture, Foot::disc},
      {"bus_stop", {2.1, 0.85}, 2.7, C::street_furniture},
      {"cabinet", {0.5, 0.2}, 1.35, C::street_furniture},
      {"phone_booth", {0.5, 0.5}, 2.45, C::street_furniture},
      {"vending_machine", {0.5, 0.42}, 1.95, C::street_furniture},
      {"wheelie_bin", {0.3, 0.4}, 1.15, C::bin},
      {"wheelie_bins", {1, 0.4}, 1.15, C::bin},
      {"recycling_container", {0.9, 0.7}, 1.75, C::bin},
      {"skip", {1.8, 0.9}, 1.5, C::construction},
      {"garbage_bags", {0.6, 0.45}, 0.75, C::bin},
      {"cafe_table", {0.95, 0.95}, 2.6, C::table},
      {"beer_table", {1.1, 0.9}, 1, C::table},
      {"picnic_table", {0.95, 0.85}, 0.8, C::table},
      {"a_board", {0.33, 0.33}, 1.1, C::sign},
      {"flower_pots", {0.7, 0.4}, 1.2, C::planter},
      {"wall_box", {0.45, 0.07}, 1.9, C::street_furniture},
      {"info_board", {0.9, 0.12}, 2.2, C::sign},
      {"swing", {1.7, 1.15}, 2.5, C::playground},
      {"slide", {1.9, 0.5}, 2.7, C::playground},
      {"spring_rider", {0.5, 0.3}, 1, C::playground},
      {"sandbox", {1.4, 1.4}, 0.5, C::playground},
      {"statue", {0.9, 0.9}, 4.3, C::statue},
      {"flagpole", {0.15, 0.15}, 8.1, C::flagpole, Foot::disc},
      {"drinking_fountain", {0.3, 0.3}, 1.1, C::fountain, Foot::disc},
      {"scaffold", {2.65, 0.45}, 6.2, C::construction},
      {"construction_fence", {1.75, 0.3}, 2.05, C::construction},
      {"cone", {0.2, 0.2}, 0.75, C::construction},
      {"portable_toilet", {0.58, 0.6}, 2.4, C::construction},
      {"crates", {0.65, 0.45}, 1.4, C::goods},
      {"pallet", {0.62, 0.42}, 1.5, C::goods},
      {"cardboard", {0.6, 0.45}, 1.1, C::goods},
      {"market_goods", {1, 0.6}, 1.3, C::goods},
      {"flower_stand", {0.95, 0.5}, 1.4, C::goods},
      {"clothes_rack", {0.85, 0.3}, 1.75, C::goods},
      {"kick_scooter", {0.6, 0.25}, 1.2, C::bicycle},
      {"charging_station", {0.2, 0.16}, 1.6, C::street_furniture},
      {"main_stage", {13.6, 7.65}, 15, C::stage},
      {"line_array", {1.4, 1.3}, 11.5, C::stage},
      {"led_screen", {3.2, 1}, 9.5, C::stage},
      {"mixing_tower", {3.1, 3.1}, 7.5, C::stage},
      {"delay_tower", {1.6, 1.6}, 11.5, C::stage},
      {"crowd_barrier", {1, 0.6}, 1.25, C::barrier},
      {"camera_crane", {4, 0.9}, 5.5, C::stage},
      {"drink_stand", {2, 1.5}, 3.3, C::stall},
      {"beach_flag", {0.82, 0.25}, 4.4, C::flagpole},
      {"goal", {1.25, 3.75}, 2.5, C::sports, Foot::posts},
      {"team_bench", {4, 0.9}, 2.5, C::bench},
      {"advertising_board", {3, 0.25}, 1.05, C::sign},
      {"turnstile", {0.9, 0.8}, 2.4, C::barrier},
      {"queue_rail", {1, 0.06}, 1.15, C::barrier},
      {"vendor_cart", {1.1, 0.7}, 2.7, C::stall},
      {"floodlight_mast", {0.8, 0.8}, 42, C::lamp_post, Foot::disc},
      {"train_cab", {10, 1.45}, 4.8, C::train},
      {"catenary_mast", {0.25, 0.25}, 8.5, C::railway, Foot::disc},
      {"platform_canopy", {0.25, 0.25}, 5.4, C::canopy, Foot::disc},
      {"departure_board", {1.6, 0.2}, 3.8, C::sign, Foot::posts},
      {"station_clock", {0.15, 0.15}, 4, C::street_furniture, Foot::disc},
      {"name_board", {1.3, 0.15}, 3.1, C::sign, Foot::posts},
      {"ticket_machine", {0.5, 0.4}, 2.1, C::street_furniture},
      {"luggage", {0.55, 0.4}, 1.2, C::goods},
      {"taxi", {2.3, 0.9}, 1.8, C::car},
      {"platform_shelter", {2.1, 0.85}, 2.8, C::street_furniture},
      {"rowboat", {2.1, 0.8}, 1, C::boat},
      {"barge", {9.5, 2.4}, 4.4, C::boat},
      {"pontoon", {4, 1.4}, 3.4, C::boat},
  }};
  return types;
}

std::span<const PropSeat> prop_seats(PropKind kind) {
  constexpr double kAhead = -std::numbers::pi / 2;  // props have their backs at +y
  constexpr double kBehind = std::numbers::pi / 2;
  // Places follow the shapes: 0.18 m before a back, and beside the legs of tables.
  static const std::map<PropKind, std::vector<PropSeat>> seats = {
      {PropKind::bench,
       {{{-0.57, 0.05}, kAhead, 0.455}, {{0, 0.05}, kAhead, 0.455}, {{0.57, 0.05}, kAhead, 0.455}}},
      {PropKind::bus_stop,
       {{{-1.15, 0.46}, kAhead, 0.48},
        {{-0.5, 0.46}, kAhead, 0.48},
        {{0.15, 0.46}, kAhead, 0.48},
        {{0.68, 0.46}, kAhead, 0.48}}},
      {PropKind::platform_shelter,
       {{{-1.2, 0.44}, kAhead, 0.47},
        {{-0.7, 0.44}, kAhead, 0.47},
        {{-0.03, 0.44}, kAhead, 0.47},
        {{0.68, 0.44}, kAhead, 0.47}}},
      {PropKind::cafe_table, {{{0, 0.65}, kAhead, 0.46}, {{0, -0.65}, kBehind, 0.46}}},
      {PropKind::picnic_table,
       {{{-0.3, 0.7}, kAhead, 0.46},
        {{0.3, 0.7}, kAhead, 0.46},
        {{0.3, -0.7}, kBehind, 0.46},
        {{-0.3, -0.7}, kBehind, 0.46}}},
      {PropKind::beer_table,
       {{{-0.52, 0.7}, kAhead, 0.48},
        {{0, 0.7}, kAhead, 0.48},
        {{0.52, 0.7}, kAhead, 0.48},
        {{0.52, -0.7}, kBehind, 0.48},
        {{0, -0.7}, kBehind, 0.48},
        {{-0.52, -0.7}, kBehind, 0.48}}},
  };
  const auto found = seats.find(kind);
  return found == seats.end() ? std::span<const PropSeat>() : found->second;
}

std::array<Eigen::Vector2d, 4> prop_footprint(const Prop& prop) {
  return geometry::turned_rectangle(prop.position, prop.scale * prop_type(prop.kind).half_size,
                                    prop.yaw_rad);
}

double distance_to(const Prop& prop, const Eigen::Vector2d& point) {
  return geometry::distance_to(prop_footprint(prop), point);
}

void thin_out(Scenario& scenario, double share, std::uint64_t seed) {
  std::set<std::size_t> taken;
  for (const Sitter& sitter : scenario.sitters) taken.insert(sitter.prop);
  std::vector<Prop> kept;
  std::vector<std::size_t> new_index(scenario.props.size());
  const std::size_t first_strewn = scenario.props.size() - scenario.strewn_props;
  scenario.strewn_props = 0;
  for (std::size_t i = 0; i < scenario.props.size(); ++i) {
    const bool stays = i < scenario.placed_props || taken.contains(i) ||
                       Random(seed, Stream::environment, kThinning + i).uniform() < share;
    if (!stays) continue;
    new_index[i] = kept.size();
    kept.push_back(scenario.props[i]);
    scenario.strewn_props += i >= first_strewn ? 1 : 0;
  }
  for (Sitter& sitter : scenario.sitters) sitter.prop = new_index[sitter.prop];
  scenario.props = std::move(kept);
}

}  // namespace throng::world
