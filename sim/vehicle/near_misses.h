// Detection of drones that come too close to people, buildings or other drones.
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

/// A drone as an upright cylinder with a constant velocity.
struct VehicleInAir {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, of its center
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  double radius_m = 0;
  double height_m = 0;
  bool moves = true;  ///< false: landed and at rest, hence never approaches anything
};

/// The gap between two surfaces (negative if they overlap), and the time until contact at constant
/// velocities; infinite if there is none (with a building: none within 1.5 s).
struct Approach {
  double gap_m = 0;
  double contact_in_s = 0;
};
Approach nearest_approach(const VehicleInAir& a, const VehicleInAir& b);
Approach nearest_approach(const VehicleInAir& vehicle, const world::Building& building);

/// Detects near misses: approaches to less than 1 m, or courses that lead to contact within 1.5 s,
/// without a collision. A near miss lasts until the gap exceeds 2 m and no contact is imminent.
class NearMisses {
 public:
  using Log = std::function<void(const world::TraceEvent&)>;

  NearMisses(std::vector<world::Building> buildings, Log log);

  /// Max horizontal distance (m) at which a person is relevant to the drone; 0: nobody is.
  static double reach_m(const VehicleInAir& vehicle);

  /// Checks the current state: each drone against other drones, buildings and `people`, who must
  /// include all within reach_m() of a drone.
  void update(double time_s, std::span<const VehicleInAir> vehicles,
              std::span<const NearPerson> people);

  /// Reports that an approach ended in a collision, so that it is no near miss.
  void collided(std::size_t vehicle, Obstacle obstacle, int index);

  /// Logs near misses that are still going on.
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
  std::vector<geometry::Rectangle> bounds_;  ///< bounding boxes of the buildings' footprints
  Log log_;
  std::map<Key, Case> cases_;
};

}  // namespace throng::sim
