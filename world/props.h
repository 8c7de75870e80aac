// Props of a scenario: placed one by one, or scattered by a seed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace throng::world {

class JsonValue;
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
  fountain
};
inline constexpr std::size_t kPropKinds = 14;

/// A kind's name in files and its size on the ground at scale 1: half of its length along its
/// heading and half of its width (m). People cannot be there.
struct PropType {
  std::string_view name;
  Eigen::Vector2d half_size;
};
const std::array<PropType, kPropKinds>& prop_types();

struct Prop {
  PropKind kind = PropKind::tree;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< middle of its foot, m
  double yaw_rad = 0;
  double scale = 1;
  std::uint32_t look = 0;  ///< which of a kind's colors and shapes it has
};

/// Corners of the ground that a prop covers, counter-clockwise (m).
std::array<Eigen::Vector2d, 4> prop_footprint(const Prop& prop);

/// Distance from a point to the ground that a prop covers: 0 inside (m).
double distance_to(const Prop& prop, const Eigen::Vector2d& point);

/// Reads the lists "props" and "scatter" of a scenario whose exits and buildings are known.
/// Scattered props keep off buildings, exits and each other; props that stand in a building or
/// within kClearOfExitsM of an exit are refused.
std::vector<Prop> read_props(const JsonValue& props, const JsonValue& scatter,
                             const Scenario& scenario);

/// How far in front of and behind an exit, over its whole width, nothing may stand (m).
inline constexpr double kClearOfExitsM = 3;

}  // namespace throng::world
