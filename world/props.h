// Props of a scenario: placed individually, or scattered with a seed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

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
  planter
};
inline constexpr std::size_t kPropKinds = 16;

/// Name of a kind in files and its size on the ground at scale 1: half of its length along its
/// heading and half of its width (m). People cannot walk there.
struct PropType {
  std::string_view name;
  /// Types of props, in the order of PropKind.
  Eigen::Vector2d half_size;
};
const std::array<PropType, kPropKinds>& prop_types();

struct Prop {
  PropKind kind = PropKind::tree;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< center on the ground, m
  double yaw_rad = 0;
  double scale = 1;
  std::uint32_t look = 0;  ///< selects among the kind's colors and shapes
};

/// Corners of the ground that a prop covers, counter-clockwise (m).
std::array<Eigen::Vector2d, 4> prop_footprint(const Prop& prop);

/// Distance from a point to the ground that a prop covers (m); 0 inside.
double distance_to(const Prop& prop, const Eigen::Vector2d& point);

/// Depth in front of and behind an exit, over its whole width, that props must leave free (m).
inline constexpr double kClearOfExitsM = 3;

}  // namespace throng::world
