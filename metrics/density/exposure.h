// Exposure of people to density and crowd pressure, in person-seconds.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "metrics/basis/people.h"

namespace throng::metrics {

/// Thresholds of density, 1/m²: crowded (2), involuntary contact (3.57), packed (4), dangerous
/// forces (5 and 5.55; from 5 on individuals lose control), shock waves (6) (Fruin, The causes and
/// prevention of crowd disasters, 1993; Still, Introduction to Crowd Science, 2014).
inline constexpr std::array kExposureDensities = {2.0, 3.57, 4.0, 5.0, 5.55, 6.0};
/// Index of the density at which a crowd can crush people: 5 per m².
inline constexpr std::size_t kCrushDensityIndex = 3;
/// Thresholds of crowd pressure, 1/s²: the onset of crowd turbulence, and the value at the start of
/// the Jamarat disaster of 2006 (Helbing, Johansson and Al-Abideen, Phys. Rev. E 75, 046109, 2007).
inline constexpr std::array kExposurePressures = {0.02, 0.04};
/// Thresholds of density as shares of the closest packing of discs with the people's mean radius.
inline constexpr std::array kExposurePacking = {0.6, 0.8};
/// Upper densities of the walkway levels of service A to E (Fruin 1971: areas per person of 3.25,
/// 2.32, 1.39, 0.93 and 0.46 m²), in 1/m²; level F is above.
inline constexpr std::array kServiceDensities = {1 / 3.25, 1 / 2.32, 1 / 1.39, 1 / 0.93, 1 / 0.46};

/// Person-seconds above the thresholds: each step of the trace counts dt_s for every person inside.
/// Densities are those of the person's Voronoi cell, except max_density_per_m2.
struct Exposure {
  std::array<double, kExposureDensities.size()> above_person_s{};
  /// Time above 5 and above 6 per m² with a local pressure above kExposurePressures[0].
  double turbulent_5_person_s = 0;
  double turbulent_6_person_s = 0;
  std::array<double, kExposurePressures.size()> pressure_person_s{};
  std::array<double, kExposurePacking.size()> disc_packing_person_s{};
  std::array<double, kServiceDensities.size() + 1> service_person_s{};
  double max_density_per_m2 = 0;  ///< max of the mean over a square of 2 m² and a second
  double max_pressure_per_s2 =
      0;  ///< max of the mean over a second (metrics/density/ground_pressure.h)
};

Exposure measure_exposure(const world::Trace& trace, const world::Scenario& scenario,
                          const std::vector<PersonRecord>& people);

nlohmann::json to_json(const Exposure& exposure);

}  // namespace throng::metrics
