// How long people were in how dense a crowd.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "metrics/people.h"

namespace throng::metrics {

/// Densities from which on exposure is counted, 1/m²: crowded, involuntary contact, dangerous when
/// standing, dangerous when moving (Fruin 1993).
inline constexpr std::array kExposureDensities = {2.0, 3.57, 4.0, 5.55};
inline constexpr std::array kExposurePacking = {0.6, 0.8};
/// Upper densities of the walkway levels of service A to E (Fruin 1971: areas per person of 3.25,
/// 2.32, 1.39, 0.93 and 0.46 m²); F is beyond.
inline constexpr std::array kServiceDensities = {1 / 3.25, 1 / 2.32, 1 / 1.39, 1 / 0.93, 1 / 0.46};

/// Each step of the trace stands for its time step of everybody who is inside. All densities but
/// the greatest are those of the person's own Voronoi cell.
struct Exposure {
  std::array<double, kExposureDensities.size()> above_person_s{};
  std::array<double, kExposurePacking.size()> packed_person_s{};  ///< share of close packing
  std::array<double, kServiceDensities.size() + 1> service_person_s{};
  double crush_proxy_person_s = 0;  ///< above 0.85 of close packing, below 0.1 of desired speed
  double max_density_per_m2 = 0;    ///< greatest mean over a square of 2 m² and a second
  double max_pressure_per_s2 = 0;   ///< greatest mean over a second (metrics/ground_pressure.h)
};

Exposure exposure_of(const world::Trace& trace, const world::Scenario& scenario,
                     const std::vector<PersonRecord>& people);

nlohmann::json to_json(const Exposure& exposure);

}  // namespace throng::metrics
