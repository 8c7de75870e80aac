// Disasters of a scenario: time, position, growth. The crowd's files define who notices them and
// what they block; this defines their appearance.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace throng::world {

class JsonValue;

enum class DisasterKind : std::uint8_t { explosion, fire, attacker, collapse, gas };

/// The kinds' names in files, in the order of DisasterKind.
inline constexpr std::array<std::string_view, 5> kDisasterKinds = {"explosion", "fire", "attacker",
                                                                   "collapse", "gas"};

struct Disaster {
  DisasterKind kind = DisasterKind::explosion;
  int agent = 0;  ///< that stands for it in the crowd; neither rendered nor counted
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m; where an attacker starts
  double start_s = 0;
  double radius_m = 2;      ///< when it starts
  double growth_mps = 0;    ///< of the radius
  double max_radius_m = 2;  ///< up to which it grows

  /// How far it reaches from its place; 0 before it starts (m).
  double reach_m(double time_s) const;
};

/// The disaster that an object describes; its fields are the caller's to list.
Disaster read_disaster(const JsonValue& item, int agent);

/// Reads a scenario's list "disasters".
std::vector<Disaster> read_disasters(const JsonValue& list);

}  // namespace throng::world
