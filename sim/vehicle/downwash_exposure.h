// Exposure of people to the downwash of drones.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <utility>

#include "sim/vehicle/downwash.h"
#include "sim/vehicle/flight_world.h"
#include "world/trace.h"

namespace throng::sim {

/// Records which people are exposed to air faster than 5 m/s at head height, and how long.
class DownwashExposure {
 public:
  using Log = std::function<void(const world::TraceEvent&)>;

  explicit DownwashExposure(Log log) : log_(std::move(log)) {}

  /// Max horizontal distance (m) from a drone at `height_m` at which a person is exposed; 0: none.
  static double reach_m(const Jet& jet, double height_m);

  /// Adds `dt_s` to the exposures of `people` to one drone at `position` (m).
  void update(double time_s, double dt_s, std::size_t vehicle, const Jet& jet,
              const Eigen::Vector3d& position, std::span<const NearPerson> people);

  /// Logs the exposures that have ended, or all.
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
