// Disasters of a scenario: time, position, growth. The scene and behavior files define who notices
// a disaster and what it blocks; this header defines its appearance.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace throng::world {

enum class DisasterKind : std::uint8_t { explosion, fire, attacker, collapse, gas };

/// Names of the kinds in files, in the order of DisasterKind.
inline constexpr std::array<std::string_view, 5> kDisasterKinds = {"explosion", "fire", "attacker",
                                                                   "collapse", "gas"};

/// Max radius of a disaster (m).
inline constexpr double kMaxReachM = 1000;

struct Disaster {
  DisasterKind kind = DisasterKind::explosion;
  int agent = 0;  ///< index of the agent that represents the disaster; neither rendered nor counted
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m; the start of an attacker
  double start_s = 0;
  double radius_m = 2;               ///< radius at the start
  double growth_mps = 0;             ///< growth of the radius
  double max_radius_m = kMaxReachM;  ///< the radius stops growing here

  /// Radius of the affected disc at a time of the run (m); 0 before the start.
  double reach_m(double time_s) const;
};

}  // namespace throng::world
