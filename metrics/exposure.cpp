#include "metrics/exposure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "metrics/voronoi.h"

namespace throng::metrics {

using Eigen::Vector2d;
using nlohmann::json;

namespace {

constexpr double kSampleS = 1.0;
constexpr double kSquareM = std::numbers::sqrt2;
constexpr double kCrushPacking = 0.85;
constexpr double kCrushSpeed = 0.1;
constexpr double kGridM = 0.8;

using Squares = std::map<std::pair<int, int>, double>;

// Spreads one person over the squares that the cell covers.
void spread(const VoronoiCell& cell, Squares& squares) {
  Vector2d min = cell.rings.front().front();
  Vector2d max = min;
  for (const Vector2d& corner : cell.rings.front()) {
    min = min.cwiseMin(corner);
    max = max.cwiseMax(corner);
  }
  const auto number = [](double at) { return static_cast<int>(std::floor(at / kSquareM)); };
  for (int column = number(min.x()); column <= number(max.x()); ++column) {
    for (int row = number(min.y()); row <= number(max.y()); ++row) {
      const Vector2d low(column * kSquareM, row * kSquareM);
      const std::array<Vector2d, 4> square = {low, low + Vector2d(kSquareM, 0),
                                              low + Vector2d(kSquareM, kSquareM),
                                              low + Vector2d(0, kSquareM)};
      squares[{column, row}] += area_in(cell, square) / cell.area_m2;
    }
  }
}

void add_person(double density, double packing, bool hardly_moves, Exposure& exposure) {
  for (std::size_t i = 0; i < kExposureDensities.size(); ++i) {
    if (density > kExposureDensities[i]) exposure.above_person_s[i] += kSampleS;
  }
  for (std::size_t i = 0; i < kExposurePacking.size(); ++i) {
    if (packing > kExposurePacking[i]) exposure.packed_person_s[i] += kSampleS;
  }
  const auto* level = std::lower_bound(kServiceDensities.begin(), kServiceDensities.end(), density);
  exposure.service_person_s[static_cast<std::size_t>(level - kServiceDensities.begin())] +=
      kSampleS;
  if (packing > kCrushPacking && hardly_moves) exposure.crush_proxy_person_s += kSampleS;
}

}  // namespace

Exposure exposure_of(const world::Trace& trace, const world::Scenario& scenario,
                     const std::vector<PersonRecord>& people) {
  Exposure exposure;
  if (people.empty()) return exposure;
  double radius_m = 0;
  for (const PersonRecord& person : people) radius_m += trace.header.radius_m[person.agent];
  radius_m /= static_cast<double>(people.size());
  const double close_packing_m2 = 2 * std::numbers::sqrt3 * radius_m * radius_m;
  const VoronoiCutter cutter(scenario.buildings);
  const auto stride =
      static_cast<std::size_t>(std::max<long>(1, std::lround(kSampleS / trace.header.dt_s)));
  for (std::size_t step = 0; step < trace.steps(); step += stride) {
    std::vector<Vector2d> places;
    std::vector<std::size_t> agents;
    for (const PersonRecord& person : people) {
      if (!trace.present(step, person.agent)) continue;
      places.push_back(trace.position[trace.at(step, person.agent)].cast<double>());
      agents.push_back(person.agent);
    }
    const PointGrid grid(places, kGridM);
    Squares squares;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!scenario.inside.contains(places[i])) continue;
      const VoronoiCell cell = cutter.cell(grid, i);
      const std::size_t at = trace.at(step, agents[i]);
      add_person(cell.density_per_m2(), cell.density_per_m2() * close_packing_m2,
                 trace.velocity[at].norm() < kCrushSpeed * trace.desired_speed_mps[at], exposure);
      spread(cell, squares);
    }
    for (const auto& square : squares) {
      exposure.max_density_per_m2 =
          std::max(exposure.max_density_per_m2, square.second / (kSquareM * kSquareM));
    }
  }
  return exposure;
}

json to_json(const Exposure& exposure) {
  json above = json::object();
  for (std::size_t i = 0; i < kExposureDensities.size(); ++i) {
    above[fmt::format("above_{}_per_m2_person_s", kExposureDensities[i])] =
        exposure.above_person_s[i];
  }
  for (std::size_t i = 0; i < kExposurePacking.size(); ++i) {
    above[fmt::format("above_{}_of_packing_person_s", kExposurePacking[i])] =
        exposure.packed_person_s[i];
  }
  json service = json::object();
  for (std::size_t i = 0; i < exposure.service_person_s.size(); ++i) {
    service[std::string(1, static_cast<char>('A' + i)) + "_person_s"] =
        exposure.service_person_s[i];
  }
  above["level_of_service"] = std::move(service);
  above["crush_proxy_person_s"] = exposure.crush_proxy_person_s;
  above["max_density_2m2_per_m2"] = exposure.max_density_per_m2;
  return above;
}

}  // namespace throng::metrics
