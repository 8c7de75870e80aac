#include "sim/fleet/fleet.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {

using Eigen::Vector3d;

namespace {

// The air that one hovering vehicle blows down on another's rotors.
void add_downwash(const Jet& jet, const FlightState& from, const FlightState& to,
                  const Airframe& frame, PerRotor& downwash_mps) {
  for (std::size_t i = 0; i < downwash_mps.size(); ++i) {
    const Eigen::Vector2d& at_m = frame.rotors[i].at_m;
    const Vector3d rotor = to.position + to.rotation * Vector3d(at_m.x(), at_m.y(), 0);
    const Vector3d below = from.position - rotor;
    downwash_mps[i] += jet.speed_mps(below.z(), below.head<2>().norm());
  }
}

}  // namespace

int nearest_ticks(double hz, double tick_s) {
  return std::max(1, static_cast<int>(std::lround(1 / (hz * tick_s))));
}

Fleet make_fleet(const std::vector<world::Building>& buildings,
                 const std::vector<PlannedDrone>& planned, double dt_s,
                 const FlightWeather& weather) {
  Fleet fleet{FlightWorld(buildings, dt_s), weather.wind, {}};
  fleet.drones.reserve(planned.size());
  for (std::size_t i = 0; i < planned.size(); ++i) {
    const PlannedDrone& drone = planned[i];
    const Autopilot& autopilot = drone.airframe.autopilot;
    fleet.world.add(drone.airframe, drone.start, drone.yaw_rad);
    fleet.drones.push_back({Pilot(drone, static_cast<std::int32_t>(i)),
                            {nearest_ticks(autopilot.rate_hz, dt_s),
                             static_cast<int>(std::lround(autopilot.delay_s / dt_s))},
                            Gusts(weather.wind, weather.seed, i),
                            Jet(drone.airframe),
                            FallWarning(i)});
    fleet.drones.back().pilot.trim(weather.wind.mean_at(drone.start.z()));
  }
  return fleet;
}

void blow(Fleet& fleet, double time_s) {
  std::vector<FlyingDrone>& drones = fleet.drones;
  std::vector<FlightState> states;
  states.reserve(drones.size());
  for (std::size_t i = 0; i < drones.size(); ++i) states.push_back(fleet.world.state(i));
  for (std::size_t i = 0; i < drones.size(); ++i) {
    const FlightState& state = states[i];
    const Vector3d mean = fleet.wind.mean_at(state.position.z());
    drones[i].air_mps =
        mean + drones[i].gusts.at(time_s, state.position.z(), (state.velocity - mean).norm());
    fleet.world.set_air_velocity(i, drones[i].air_mps);
    const Airframe& frame = fleet.world.airframe(i);
    PerRotor downwash_mps{};
    for (std::size_t j = 0; j < drones.size(); ++j) {
      if (j == i || !drones[j].pilot.is_running()) continue;
      const Vector3d d = states[j].position - state.position;
      if (!drones[j].jet.may_reach(d.z() + frame.arm_m, d.head<2>().norm() - frame.arm_m)) continue;
      add_downwash(drones[j].jet, states[j], state, frame, downwash_mps);
    }
    fleet.world.set_downwash(i, downwash_mps);
  }
}

void steer(Fleet& fleet, long tick, const Pilot::Report& report) {
  for (std::size_t i = 0; i < fleet.drones.size(); ++i) {
    auto& [ticks_per_control, delay_ticks, commands] = fleet.drones[i].clock;
    if (tick % ticks_per_control == 0) {
      const double dt_s = ticks_per_control * fleet.world.dt_s();
      commands.emplace_back(tick + delay_ticks,
                            fleet.drones[i].pilot.control(fleet.world.state(i), dt_s, report));
    }
    while (!commands.empty() && commands.front().first <= tick) {
      fleet.world.command(i, commands.front().second);
      commands.pop_front();
    }
  }
}

void break_parts(Fleet& fleet, const Impact& impact, const Pilot::Report& report) {
  const Airframe& airframe = fleet.world.airframe(impact.vehicle);
  Damage damage = impact_damage(impact, airframe);
  Damage& before = fleet.drones[impact.vehicle].damage;
  if (before.structure) return;
  for (std::size_t rotor = 0; rotor < damage.propeller.size(); ++rotor) {
    damage.propeller[rotor] = damage.propeller[rotor] && !before.propeller[rotor];
    before.propeller[rotor] = before.propeller[rotor] || damage.propeller[rotor];
  }
  before.structure = damage.structure;
  if (!damage.structure && !damage.any_propeller()) return;
  const double speed_mps = wall_speed_mps(impact.impulse_ns, airframe);
  const auto drone = static_cast<std::int32_t>(impact.vehicle);
  for (std::size_t rotor = 0; rotor < damage.propeller.size(); ++rotor) {
    if (!damage.structure && !damage.propeller[rotor]) continue;
    fleet.world.break_rotor(impact.vehicle, rotor);
    if (damage.structure) continue;
    report(world::PropellerBroken{drone, speed_mps, static_cast<std::int32_t>(rotor)});
  }
  if (damage.structure) report(world::StructureBroken{drone, speed_mps});
  fleet.drones[impact.vehicle].pilot.damaged(damage, fleet.world.state(impact.vehicle));
}

}  // namespace throng::sim
