#include "spec/sim/run_spec.h"

namespace throng::sim {

std::optional<Airframe> find_airframe(const DroneMission& mission) {
  return mission.own_airframe ? mission.own_airframe : find_airframe(mission.airframe);
}

}  // namespace throng::sim
