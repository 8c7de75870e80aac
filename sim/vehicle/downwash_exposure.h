// People in the air that drones blow down.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <utility>

#include "sim/vehicle/downwash.h"
#include "sim/vehicle/flight_world.h"
#include "world/trace.h"

namespace throng::sim {

/// People exposed to air faster than 5 m/s at the height of the head, and the duration.
class DownwashExposure {
 public:
  using Log = std::function<void(const world::TraceEvent&)>;

  explicit DownwashExposure(Log log) : log_(std::move(log)) {}

  /// How far aside of a drone that hovers so high somebody may stand and feel it; 0: nobody does.
  static double reach_m(const Jet& jet, double height_m);

  /// Counts `dt_s` for everybody that is near one drone.
  void update(double time_s, double dt_s, std::size_t vehicle, const Jet& jet,
              const Eigen::Vector3d& position, std::span<const NearPerson> people);

  /// Writes the exposures that have ended, or all.
  void flush(double time_s, bool all);

 private:
  struct Exposure {
    double from_s;
    double last_s;
    double seconds;
    double fastest_mps;
  };

  Log log_;
  std::map<std::pair<std::size_t, int>, Exposure> exposures_;
};

}  // namespace throng::sim
