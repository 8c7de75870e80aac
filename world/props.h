// Props of a scenario: placed individually, or scattered with a seed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "world/semantic_class.h"

namespace throng::world {

struct Scenario;

enum class PropKind : std::uint8_t {
  tree,
  bench,
  lamp_post,
  bin,
  car,
  bollard,
  stall,
  barrier,
  fence,
  kiosk,
  tent,
  stage,
  train,
  fountain,
  bush,
  planter,
  van,
  delivery_truck,
  food_truck,
  bus,
  moped,
  motorcycle,
  bicycle,
  bicycle_rack,
  cargo_bike,
  traffic_sign,
  traffic_light,
  street_sign,
  parking_meter,
  post_box,
  hydrant,
  newspaper_box,
  advertising_column,
  bus_stop,
  cabinet,
  phone_booth,
  vending_machine,
  wheelie_bin,
  wheelie_bins,
  recycling_container,
  skip,
  garbage_bags,
  cafe_table,
  beer_table,
  picnic_table,
  a_board,
  flower_pots,
  wall_box,
  info_board,
  swing,
  slide,
  spring_rider,
  sandbox,
  statue,
  flagpole,
  drinking_fountain,
  scaffold,
  construction_fence,
  cone,
  portable_toilet,
  crates,
  pallet,
  cardboard,
  market_goods,
  flower_stand,
  clothes_rack,
  kick_scooter,
  charging_station,
  main_stage,
  line_array,
  led_screen,
  mixing_tower,
  delay_tower,
  crowd_barrier,
  camera_crane,
  drink_stand,
  beach_flag,
  goal,
  team_bench,
  advertising_board,
  turnstile,
  queue_rail,
  vendor_cart,
  floodlight_mast,
  train_cab,
  catenary_mast,
  platform_canopy,
  departure_board,
  station_clock,
  name_board,
  ticket_machine,
  luggage,
  taxi,
  platform_shelter,
  rowboat,
  barge,
  pontoon
};
inline constexpr std::size_t kPropKinds = 97;

/// Form of a prop where it meets the ground.
enum class Foot : std::uint8_t { rectangle, disc, posts };

/// A kind of prop at scale 1.
struct PropType {
  std::string_view name;  ///< in files
  /// Half of its length along its heading and half of its width, up to the height of people's
  /// heads (m). Nobody can walk there.
  Eigen::Vector2d half_size;
  double height_m = 0;  ///< at most; 0: it grows
  SemanticClass semantic_class{};
  Foot foot = Foot::rectangle;
};

/// Kinds of props, in the order of PropKind.
const std::array<PropType, kPropKinds>& prop_types();
inline const PropType& prop_type(PropKind kind) {
  return prop_types().at(static_cast<std::size_t>(kind));
}

/// A place to sit on a prop of scale 1, in the prop's frame.
struct PropSeat {
  Eigen::Vector2d position;  ///< below the sitter's pelvis (m)
  double yaw_rad = 0;        ///< where the sitter faces: away from a back, toward a table
  double height_m = 0;       ///< of the seat above the ground
};

/// The seats of a kind; none of kinds that nobody sits on. They are where all looks of the kind
/// have one (render/props/shapes).
std::span<const PropSeat> prop_seats(PropKind kind);

struct Prop {
  PropKind kind = PropKind::tree;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< center on the ground, m
  double yaw_rad = 0;
  double scale = 1;
  std::uint32_t look = 0;  ///< selects among the kind's colors and shapes
};

/// Somebody who sits on a prop for the whole run.
struct Sitter {
  std::size_t prop = 0;                                ///< index into Scenario::props
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< below the pelvis (m)
  double yaw_rad = 0;
  /// Height (m) of the floor on which the same person would sit on a seat of kSeatHeightM
  /// (world/stand_seats.h): a little above or below the ground.
  double floor_m = 0;
};

/// Corners of the ground that a prop covers, counter-clockwise (m).
std::array<Eigen::Vector2d, 4> prop_footprint(const Prop& prop);

/// Distance from a point to the ground that a prop covers (m); 0 inside.
double distance_to(const Prop& prop, const Eigen::Vector2d& point);

/// Depth in front of and behind an exit, over its whole width, that props must leave free (m).
inline constexpr double kClearOfExitsM = 3;

}  // namespace throng::world
