#include "sim/vehicle/flight.h"

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

int nearest_ticks(double hz, double tick_s) {
  return std::max(1, static_cast<int>(std::lround(1 / (hz * tick_s))));
}

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

Flight::Flight(const std::vector<world::Building>& buildings,
               const std::vector<PlannedDrone>& drones, double interval_s, double physics_dt_s,
               FlightLog log, const FlightWeather& weather)
    : ticks_per_interval_(whole_ticks(interval_s, physics_dt_s)),
      ticks_per_wind_(nearest_ticks(kWindHz, interval_s / ticks_per_interval_)),
      ticks_per_sample_(nearest_ticks(kSampleHz, interval_s / ticks_per_interval_)),
      interval_s_(interval_s),
      world_(buildings, interval_s / ticks_per_interval_),
      log_(std::move(log)),
      wind_(weather.wind),
      damages_(drones.size()),
      states_(drones.size()),
      air_(drones.size(), Vector3d::Zero()),
      crafts_(drones.size()),
      near_misses_(buildings, [this](const world::TraceEvent& event) { log_.event(event); }),
      exposure_([this](const world::TraceEvent& event) { log_.event(event); }) {
  for (std::size_t i = 0; i < drones.size(); ++i) {
    const PlannedDrone& drone = drones[i];
    world_.add(drone.airframe, drone.start, drone.yaw_rad);
    pilots_.emplace_back(drone, static_cast<std::int32_t>(pilots_.size()));
    const Autopilot& autopilot = drone.airframe.autopilot;
    clocks_.push_back({nearest_ticks(autopilot.rate_hz, world_.dt_s()),
                       static_cast<int>(std::lround(autopilot.delay_s / world_.dt_s())),
                       {}});
    gusts_.emplace_back(wind_, weather.seed, i);
    jets_.emplace_back(drone.airframe);
    falls_.emplace_back(i);
    pilots_.back().trim(wind_.mean_at(drone.start.z()));
  }
  blow();
  record_samples();
}

void Flight::advance(const PeopleView& people_at_end) {
  people_.begin(people_at_end, interval_s_);
  meet_people();
  for (int i = 1; i <= ticks_per_interval_; ++i) {
    if (tick_ % ticks_per_wind_ == 0) blow();
    control();
    command();
    world_.step();
    ++tick_;
    // From the interval's number, so that no rounding adds up over a run.
    time_s_ = static_cast<double>(interval_) * interval_s_ + i * world_.dt_s();
    if (i == ticks_per_interval_) time_s_ = static_cast<double>(interval_ + 1) * interval_s_;
    if (!world_.impacts().empty()) record_impacts(world_.impacts());
    watch_falls();
    if (i == ticks_per_interval_ || tick_ % ticks_per_sample_ == 0) {
      record_samples();
      watch_surroundings();
    }
  }
  people_.finish();
  ++interval_;
}

void Flight::finish() {
  record_impacts(world_.unfinished_impacts());
  near_misses_.finish();
  exposure_.flush(time_s_, true);
}

// People far from all drones cost no more than a lookup of their positions, and nothing while all
// drones are high up.
void Flight::meet_people() {
  near_.clear();
  for (std::size_t i = 0; i < crafts_.size(); ++i) {
    const VehicleInAir& vehicle = crafts_[i];
    const double reach_m = std::max(NearMisses::reach_m(vehicle),
                                    DownwashExposure::reach_m(jets_[i], vehicle.position.z()));
    if (reach_m > 0) people_.collect({vehicle.position.head<2>(), reach_m}, near_);
  }
  const auto by_agent = [](const NearPerson& a, const NearPerson& b) { return a.agent < b.agent; };
  const auto is_same = [](const NearPerson& a, const NearPerson& b) { return a.agent == b.agent; };
  std::sort(near_.begin(), near_.end(), by_agent);
  near_.erase(std::unique(near_.begin(), near_.end(), is_same), near_.end());

  std::vector<NearPerson> touchable;
  for (const NearPerson& person : near_) {
    const auto can_touch = [&](const VehicleInAir& vehicle) {
      const double path_m = (vehicle.velocity.norm() + person.velocity.norm() + 1) * interval_s_;
      const Eigen::Vector2d aside = vehicle.position.head<2>() - person.position;
      return vehicle.position.z() < kPersonHeightM + vehicle.radius_m + path_m &&
             aside.norm() < vehicle.radius_m + kPersonRadiusM + path_m;
    };
    if (std::any_of(crafts_.begin(), crafts_.end(), can_touch)) touchable.push_back(person);
  }
  world_.set_people(touchable);
}

// Lets those pilots decide whose turn it is.
void Flight::control() {
  for (std::size_t i = 0; i < pilots_.size(); ++i) {
    ControlClock& clock = clocks_[i];
    if (tick_ % clock.ticks_per_control != 0) continue;
    const double dt_s = clock.ticks_per_control * world_.dt_s();
    const auto report = [&](const world::EventKind& event) { log_.event({time_s_, event}); };
    clock.commands.emplace_back(tick_ + clock.delay_ticks,
                                pilots_[i].control(world_.state(i), dt_s, report));
  }
}

// Hands the motors what they have by now.
void Flight::command() {
  for (std::size_t i = 0; i < clocks_.size(); ++i) {
    auto& commands = clocks_[i].commands;
    while (!commands.empty() && commands.front().first <= tick_) {
      world_.command(i, commands.front().second);
      commands.pop_front();
    }
  }
}

// Lets the wind blow, and each vehicle on those below it.
void Flight::blow() {
  for (std::size_t i = 0; i < states_.size(); ++i) states_[i] = world_.state(i);
  for (std::size_t i = 0; i < pilots_.size(); ++i) {
    const FlightState& state = states_[i];
    const Vector3d mean = wind_.mean_at(state.position.z());
    air_[i] = mean + gusts_[i].at(time_s_, state.position.z(), (state.velocity - mean).norm());
    world_.set_air_velocity(i, air_[i]);
    PerRotor downwash_mps{};
    for (std::size_t j = 0; j < pilots_.size(); ++j) {
      if (j == i || !pilots_[j].is_running()) continue;
      const Vector3d d = states_[j].position - state.position;
      const double arm_m = world_.airframe(i).arm_m;
      if (!jets_[j].may_reach(d.z() + arm_m, d.head<2>().norm() - arm_m)) continue;
      add_downwash(jets_[j], states_[j], state, world_.airframe(i), downwash_mps);
    }
    world_.set_downwash(i, downwash_mps);
  }
}

void Flight::record_samples() {
  const double since_s = time_s_ - sampled_s_;
  for (std::size_t i = 0; i < pilots_.size(); ++i) {
    const FlightState state = world_.state(i);
    pilots_[i].spend(state, world_.thrust_n(i), air_[i], since_s);
    log_.sample(i,
                {time_s_, state.position, state.velocity, world_.orientation(i), state.body_rates,
                 world_.specific_force(i), air_[i], pilots_[i].battery().used_j()});
    const Airframe& frame = world_.airframe(i);
    const bool moves = pilots_[i].is_running() || state.velocity.norm() > kRestMps;
    crafts_[i] = {state.position, state.velocity, frame.radius_m(), frame.height_m, moves};
  }
  for (NearPerson& person : near_) person.position += since_s * person.velocity;
  sampled_s_ = time_s_;
}

void Flight::record_impacts(std::span<const Impact> impacts) {
  for (const Impact& impact : impacts) {
    if (impact.speed_mps < kCollisionMps) continue;
    near_misses_.collided(impact.vehicle, impact.obstacle, impact.index);
    log_.event({std::max(0.0, time_s_ - impact.ago_s),
                world::Collision{static_cast<std::int32_t>(impact.vehicle), impact.obstacle,
                                 impact.index, impact.speed_mps, impact.impulse_ns}});
    if (impact.obstacle == world::Partner::person && log_.strike) {
      log_.strike(static_cast<std::size_t>(impact.index), impact.push_ns.head<2>());
    }
    damage(impact);
  }
}

// Breaks what does not withstand the impact, and is not broken already.
void Flight::damage(const Impact& impact) {
  const Airframe& airframe = world_.airframe(impact.vehicle);
  Damage damage = impact_damage(impact, airframe);
  Damage& before = damages_[impact.vehicle];
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
    world_.break_rotor(impact.vehicle, rotor);
    if (damage.structure) continue;
    log_.event(
        {time_s_, world::PropellerBroken{drone, speed_mps, static_cast<std::int32_t>(rotor)}});
  }
  if (damage.structure) log_.event({time_s_, world::StructureBroken{drone, speed_mps}});
  pilots_[impact.vehicle].damaged(damage, world_.state(impact.vehicle));
}

// Only people near a fall are checked, once, when it begins.
void Flight::watch_falls() {
  for (std::size_t i = 0; i < pilots_.size(); ++i) {
    falls_[i].update(time_s_,
                     {world_.state(i), pilots_[i].can_hold(), world_.airframe(i).radius_m()},
                     people_, log_.event);
  }
}

void Flight::watch_surroundings() {
  near_misses_.update(time_s_, crafts_, near_);
  if (tick_ % ticks_per_interval_ != 0) return;
  for (std::size_t i = 0; i < crafts_.size(); ++i) {
    if (!pilots_[i].is_running()) continue;
    exposure_.update(time_s_, interval_s_, i, jets_[i], crafts_[i].position, near_);
  }
  exposure_.flush(time_s_, false);
}

}  // namespace throng::sim
