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

void count_near_miss(const world::TraceEvent& event, DroneFigures& figures) {
  ++figures.near_misses;
  figures.nearest_miss_m = std::min(figures.nearest_miss_m.value_or(event.value), event.value);
}

void count(const world::TraceEvent& event, DroneFigures& figures) {
  if (event.type == "tilt_saturated") ++figures.tilt_saturated;
  if (event.type == "blown_away") ++figures.blown_away;
  if (event.type == "landed") figures.landed_s = event.time_s;
  if (event.type == "battery_flat") figures.battery_flat_s = event.time_s;
  if (event.type == "near_miss") count_near_miss(event, figures);
  if (event.type == "downwash") figures.downwash_person_s += event.value;
  if (event.type == "propeller_broken") ++figures.propellers_broken;
  if (event.type == "structure_broken") figures.structure_broken = true;
  if (event.type == "falling") figures.falling_s = event.time_s;
  if (event.type == "fall_hazard") ++figures.fall_hazard_people;
  if (event.type == "collision") {
    ++figures.collisions[event.partner];
    figures.hardest_ns = std::max(figures.hardest_ns, event.extra);
  }
}

json or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

}  // namespace

std::vector<DroneFigures> drone_figures(const world::Trace& trace) {
  std::vector<DroneFigures> list;
  for (std::size_t i = 0; i < trace.drones.size(); ++i) {
    list.push_back(flown(trace.header.drone_ids[i], trace.drones[i]));
  }
  std::vector<std::set<std::int32_t>> blown_on(list.size());
  for (const world::TraceEvent& event : trace.events) {
    if (event.drone < 0) continue;
    const auto drone = static_cast<std::size_t>(event.drone);
    count(event, list[drone]);
    if (event.type == "downwash") blown_on[drone].insert(event.agent);
    const bool has_other = event.type == "near_miss" && event.partner == "drone" &&
                           event.other >= 0 && static_cast<std::size_t>(event.other) < list.size();
    if (has_other) count_near_miss(event, list[static_cast<std::size_t>(event.other)]);
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
