#include "metrics/drones.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace throng::metrics {

namespace {

using nlohmann::json;

constexpr double kJoulesPerWh = 3600;

DroneFigures flown(const std::string& id, const std::vector<world::DroneSample>& samples) {
  DroneFigures figures;
  figures.id = id;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const world::DroneSample& sample = samples[i];
    if (i > 0) figures.flown_m += (sample.position - samples[i - 1].position).norm();
    figures.fastest_mps = std::max(figures.fastest_mps, sample.velocity.norm());
    figures.wind_mps += sample.air_velocity.norm() / static_cast<double>(samples.size());
  }
  if (!samples.empty()) figures.energy_wh = samples.back().energy_j / kJoulesPerWh;
  return figures;
}

void count_near_miss(const world::NearMiss& event, DroneFigures& figures) {
  ++figures.near_misses;
  figures.nearest_miss_m =
      std::min(figures.nearest_miss_m.value_or(event.distance_m), event.distance_m);
}

/// Adds an event to its drone's figures.
struct Count {
  double time_s;
  DroneFigures& figures;

  void operator()(const world::TiltSaturated&) const { ++figures.tilt_saturated; }
  void operator()(const world::BlownAway&) const { ++figures.blown_away; }
  void operator()(const world::Landed&) const { figures.landed_s = time_s; }
  void operator()(const world::BatteryFlat&) const { figures.battery_flat_s = time_s; }
  void operator()(const world::NearMiss& event) const { count_near_miss(event, figures); }
  void operator()(const world::Downwash& event) const {
    figures.downwash_person_s += event.duration_s;
  }
  void operator()(const world::PropellerBroken&) const { ++figures.propellers_broken; }
  void operator()(const world::StructureBroken&) const { figures.structure_broken = true; }
  void operator()(const world::Falling&) const { figures.falling_s = time_s; }
  void operator()(const world::FallHazard&) const { ++figures.fall_hazard_people; }
  void operator()(const world::Collision& event) const {
    ++figures.collisions[std::string(world::to_string(event.partner))];
    figures.hardest_ns = std::max(figures.hardest_ns, event.impulse_ns);
  }
  void operator()(const auto&) const {}
};

json or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

}  // namespace

std::vector<DroneFigures> drone_figures(const world::Trace& trace) {
  std::vector<DroneFigures> list;
  for (std::size_t i = 0; i < trace.drones.size(); ++i) {
    list.push_back(flown(trace.header.drone_ids[i], trace.drones[i]));
  }
  std::vector<std::set<std::int32_t>> blown_on(list.size());
  for (const world::TraceEvent& event : trace.events) {
    const auto drone = world::drone_of_event(event.kind);
    if (!drone) continue;
    const auto index = static_cast<std::size_t>(*drone);
    std::visit(Count{event.time_s, list[index]}, event.kind);
    if (const auto* downwash = std::get_if<world::Downwash>(&event.kind)) {
      blown_on[index].insert(downwash->agent);
    }
    const auto* miss = std::get_if<world::NearMiss>(&event.kind);
    const bool has_other = miss != nullptr && miss->partner == world::Partner::drone &&
                           miss->index >= 0 && static_cast<std::size_t>(miss->index) < list.size();
    if (has_other) count_near_miss(*miss, list[static_cast<std::size_t>(miss->index)]);
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    list[i].downwash_people = static_cast<int>(blown_on[i].size());
  }
  return list;
}

json to_json(const DroneFigures& figures) {
  return {{"id", figures.id},
          {"flown_m", figures.flown_m},
          {"energy_wh", figures.energy_wh},
          {"fastest_mps", figures.fastest_mps},
          {"mean_wind_mps", figures.wind_mps},
          {"tilt_saturated", figures.tilt_saturated},
          {"blown_away", figures.blown_away},
          {"collisions", json(figures.collisions)},
          {"hardest_collision_ns", figures.hardest_ns},
          {"near_misses", figures.near_misses},
          {"nearest_miss_m", or_null(figures.nearest_miss_m)},
          {"downwash_people", figures.downwash_people},
          {"downwash_person_s", figures.downwash_person_s},
          {"landed_s", or_null(figures.landed_s)},
          {"battery_flat_s", or_null(figures.battery_flat_s)},
          {"propellers_broken", figures.propellers_broken},
          {"structure_broken", figures.structure_broken},
          {"falling_s", or_null(figures.falling_s)},
          {"fall_hazard_people", figures.fall_hazard_people}};
}

}  // namespace throng::metrics
