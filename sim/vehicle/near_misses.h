// Drones that come too near to somebody or something.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "base/geometry/rectangle.h"
#include "sim/vehicle/contact_log.h"
#include "sim/vehicle/flight_world.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::sim {

/// A drone as others meet it: an upright cylinder that moves on.
struct VehicleInAir {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, its middle
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  double radius_m = 0;
  double height_m = 0;
  bool moves = true;  ///< one that has landed and rests comes near to nobody
};

/// Distance between two surfaces, and the time until they touch if nobody changes course; infinite
/// when they will not within the next seconds.
struct Approach {
  double gap_m = 0;
  double contact_in_s = 0;
};
Approach nearest_approach(const VehicleInAir& a, const VehicleInAir& b);
Approach nearest_approach(const VehicleInAir& vehicle, const world::Building& building);

/// A near miss is an approach to less than 1 m, or a course that leads to contact within 1.5 s,
/// that does not end in a collision. It is one until 2 m are between both and nothing threatens.
class NearMisses {
 public:
  using Log = std::function<void(const world::TraceEvent&)>;

  NearMisses(std::vector<world::Building> buildings, Log log);

  /// How far away somebody on foot may be and matter, for a drone of this speed.
  static double reach_m(const VehicleInAir& vehicle);

  /// Looks at everybody as they are now: each drone with each other, with buildings and with the
  /// people that are near.
  void update(double time_s, std::span<const VehicleInAir> vehicles,
              std::span<const NearPerson> people);

  /// The approach ended in a collision.
  void collided(std::size_t vehicle, Obstacle obstacle, int index);

  /// Writes what is still going on.
  void finish();

 private:
  using Key = std::tuple<std::size_t, Obstacle, int>;
  struct Case {
    double gap_m;
    double gap_time_s;
    double contact_in_s;
    bool seen;
    bool hit;
  };
  void look(double time_s, const Key& key, const Approach& approach);
  void write(const Key& key, const Case& entry);

  std::vector<world::Building> buildings_;
  std::vector<geometry::Rectangle> bounds_;  ///< of the buildings' footprints
  Log log_;
  std::map<Key, Case> cases_;
};

}  // namespace throng::sim
