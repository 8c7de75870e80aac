#include "sim/fleet/flight.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {

using Eigen::Vector3d;

namespace {

constexpr double kWindHz = 240;
constexpr double kSampleHz = 60;
// Slower contact is a landing.
constexpr double kCollisionMps = 0.3;
// Rotors stopped and slower than this, a vehicle lies where it has come down.
constexpr double kRestMps = 0.1;

int whole_ticks(double interval_s, double max_tick_s) {
  constexpr double kRounding = 1e-9;
  return std::max(1, static_cast<int>(std::ceil(interval_s / max_tick_s - kRounding)));
}

FlightClock make_clock(double interval_s, double physics_dt_s) {
  FlightClock clock{interval_s, whole_ticks(interval_s, physics_dt_s)};
  clock.ticks_per_wind = nearest_ticks(kWindHz, clock.tick_s());
  clock.ticks_per_sample = nearest_ticks(kSampleHz, clock.tick_s());
  return clock;
}

// People far from all drones cost no more than a lookup of their positions, and nothing while all
// drones are high up.
std::vector<NearPerson> people_near(std::span<const FlyingDrone> drones,
                                    const MovingPeople& people) {
  std::vector<NearPerson> near;
  for (const FlyingDrone& drone : drones) {
    const Vector3d& position = drone.sampled.position;
    const double reach_m = std::max(NearMisses::reach_m(drone.sampled),
                                    DownwashExposure::reach_m(drone.jet, position.z()));
    if (reach_m > 0) people.collect({position.head<2>(), reach_m}, near);
  }
  const auto by_agent = [](const NearPerson& a, const NearPerson& b) { return a.agent < b.agent; };
  const auto is_same = [](const NearPerson& a, const NearPerson& b) { return a.agent == b.agent; };
  std::sort(near.begin(), near.end(), by_agent);
  near.erase(std::unique(near.begin(), near.end(), is_same), near.end());
  return near;
}

// Those of the people whom a drone can touch within an interval.
std::vector<NearPerson> touchable(std::span<const NearPerson> people,
                                  std::span<const FlyingDrone> drones, double interval_s) {
  std::vector<NearPerson> list;
  for (const NearPerson& person : people) {
    const auto can_touch = [&](const FlyingDrone& drone) {
      const VehicleInAir& vehicle = drone.sampled;
      const double path_m = (vehicle.velocity.norm() + person.velocity.norm() + 1) * interval_s;
      const Eigen::Vector2d aside = vehicle.position.head<2>() - person.position;
      return vehicle.position.z() < kPersonHeightM + vehicle.radius_m + path_m &&
             aside.norm() < vehicle.radius_m + kPersonRadiusM + path_m;
    };
    if (std::any_of(drones.begin(), drones.end(), can_touch)) list.push_back(person);
  }
  return list;
}

std::vector<VehicleInAir> vehicles_in_air(std::span<const FlyingDrone> drones) {
  std::vector<VehicleInAir> vehicles;
  vehicles.reserve(drones.size());
  for (const FlyingDrone& drone : drones) vehicles.push_back(drone.sampled);
  return vehicles;
}

}  // namespace

double FlightClock::time_s() const {
  const long intervals = tick / ticks_per_interval;
  const long ticks = tick % ticks_per_interval;
  return static_cast<double>(intervals) * interval_s + static_cast<double>(ticks) * tick_s();
}

Flight::Flight(const std::vector<world::Building>& buildings,
               const std::vector<PlannedDrone>& drones, double interval_s, double physics_dt_s,
               FlightLog log, const FlightWeather& weather)
    : clock_(make_clock(interval_s, physics_dt_s)),
      fleet_(make_fleet(buildings, drones, clock_.tick_s(), weather)),
      log_(std::move(log)),
      near_misses_(buildings, [this](const world::TraceEvent& event) { log_.event(event); }),
      exposure_([this](const world::TraceEvent& event) { log_.event(event); }) {
  blow(fleet_, 0);
  record_samples();
}

void Flight::advance(const PeopleView& people_at_end) {
  const auto report = [this](const world::EventKind& event) {
    log_.event({clock_.time_s(), event});
  };
  people_.begin(people_at_end, clock_.interval_s);
  near_ = people_near(fleet_.drones, people_);
  fleet_.world.set_people(touchable(near_, fleet_.drones, clock_.interval_s));
  do {
    if (clock_.tick % clock_.ticks_per_wind == 0) blow(fleet_, clock_.time_s());
    steer(fleet_, clock_.tick, report);
    fleet_.world.step();
    ++clock_.tick;
    record_impacts(fleet_.world.impacts());
    // Only people near a fall are checked, once, when it begins.
    for (std::size_t i = 0; i < fleet_.drones.size(); ++i) {
      FlyingDrone& drone = fleet_.drones[i];
      drone.fall.update(clock_.time_s(),
                        {state(i), drone.pilot.can_hold(), fleet_.world.airframe(i).radius_m()},
                        people_, log_.event);
    }
    if (clock_.is_interval_over() || clock_.tick % clock_.ticks_per_sample == 0) {
      record_samples();
      near_misses_.update(clock_.time_s(), vehicles_in_air(fleet_.drones), near_);
    }
  } while (!clock_.is_interval_over());
  for (std::size_t i = 0; i < fleet_.drones.size(); ++i) {
    const FlyingDrone& drone = fleet_.drones[i];
    if (!drone.pilot.is_running()) continue;
    exposure_.update(clock_.time_s(), clock_.interval_s, i, drone.jet, drone.sampled.position,
                     near_);
  }
  exposure_.flush(clock_.time_s(), false);
  people_.finish();
}

void Flight::finish() {
  record_impacts(fleet_.world.unfinished_impacts());
  near_misses_.finish();
  exposure_.flush(clock_.time_s(), true);
}

void Flight::record_samples() {
  const double time_s = clock_.time_s();
  const double since_s = time_s - clock_.sampled_s;
  const FlightWorld& world = fleet_.world;
  for (std::size_t i = 0; i < fleet_.drones.size(); ++i) {
    FlyingDrone& drone = fleet_.drones[i];
    const FlightState state = world.state(i);
    drone.pilot.spend(state, world.thrust_n(i), drone.air_mps, since_s);
    log_.sample(i, {time_s, state.position, state.velocity, world.orientation(i), state.body_rates,
                    world.specific_force(i), drone.air_mps, drone.pilot.battery().used_j()});
    const Airframe& frame = world.airframe(i);
    const bool moves = drone.pilot.is_running() || state.velocity.norm() > kRestMps;
    drone.sampled = {state.position, state.velocity, frame.radius_m(), frame.height_m, moves};
  }
  for (NearPerson& person : near_) person.position += since_s * person.velocity;
  clock_.sampled_s = time_s;
}

void Flight::record_impacts(std::span<const Impact> impacts) {
  const double time_s = clock_.time_s();
  for (const Impact& impact : impacts) {
    if (impact.speed_mps < kCollisionMps) continue;
    near_misses_.collided(impact.vehicle, impact.obstacle, impact.index);
    log_.event({std::max(0.0, time_s - impact.ago_s),
                world::Collision{static_cast<std::int32_t>(impact.vehicle), impact.obstacle,
                                 impact.index, impact.speed_mps, impact.impulse_ns}});
    if (impact.obstacle == world::Partner::person && log_.strike) {
      log_.strike(static_cast<std::size_t>(impact.index), impact.push_ns.head<2>());
    }
    break_parts(fleet_, impact, [&](const world::EventKind& event) {
      log_.event({time_s, event});
    });
  }
}

}  // namespace throng::sim
