#include "metrics/density/exposure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <nlohmann/json.hpp>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/geometry/point_grid.h"
#include "base/geometry/rectangle.h"
#include "metrics/density/ground_pressure.h"
#include "metrics/density/voronoi.h"

namespace throng::metrics {

using Eigen::Vector2d;
using nlohmann::json;

namespace {

constexpr double kMeanS = 1.0;
constexpr double kSquareM = std::numbers::sqrt2;
constexpr double kGridM = 0.8;

/// Mean density of squares of 2 m² over the last second.
class SquareMeter {
 public:
  explicit SquareMeter(std::size_t window) : window_(window) {}

  /// Spreads somebody over the squares that their cell covers.
  void add(const VoronoiCell& cell) {
    const auto [min, max] = geometry::bounding_box(cell.rings.front());
    const Corner low = corner_at(min);
    const Corner high = corner_at(max);
    if (low.column == high.column && low.row == high.row) return add_to(low, 1);
    for (int column = low.column; column <= high.column; ++column) {
      for (int row = low.row; row <= high.row; ++row) {
        const Vector2d at(column * kSquareM, row * kSquareM);
        const std::array<Vector2d, 4> square = {at, at + Vector2d(kSquareM, 0),
                                                at + Vector2d(kSquareM, kSquareM),
                                                at + Vector2d(0, kSquareM)};
        add_to({column, row}, area_in(cell, square) / cell.area_m2);
      }
    }
  }

  /// The greatest mean once everybody of a step was added (1/m²). In the first second the mean is
  /// over what there was.
  double finish_step() {
    if (last_.size() == window_) {
      for (const auto& [square, people] : last_.front()) square->sum -= people;
      last_.pop_front();
    }
    double max_sum = 0;
    for (auto& [square, people] : now_) {
      people = std::exchange(square->now, 0);
      square->sum += people;
      max_sum = std::max(max_sum, square->sum);
    }
    last_.push_back(std::exchange(now_, {}));
    return max_sum / (static_cast<double>(last_.size()) * kSquareM * kSquareM);
  }

 private:
  struct Square {
    double now = 0;  ///< people at this step
    double sum = 0;  ///< over the window
  };
  struct Corner {
    int column = 0;
    int row = 0;
  };
  using People = std::vector<std::pair<Square*, double>>;

  static Corner corner_at(const Vector2d& place) {
    return {static_cast<int>(std::floor(place.x() / kSquareM)),
            static_cast<int>(std::floor(place.y() / kSquareM))};
  }
  void add_to(const Corner& corner, double share) {
    if (share <= 0) return;
    const auto key =
        (static_cast<std::uint64_t>(static_cast<std::uint32_t>(corner.column)) << 32U) |
        static_cast<std::uint32_t>(corner.row);
    Square& square = squares_[key];  // stays where it is
    if (square.now == 0) now_.emplace_back(&square, 0);
    square.now += share;
  }

  std::size_t window_;
  std::unordered_map<std::uint64_t, Square> squares_;
  People now_;
  std::deque<People> last_;
};

void add_person(double density, double packing, double pressure, double dt_s, Exposure& exposure) {
  for (std::size_t i = 0; i < kExposureDensities.size(); ++i) {
    if (density > kExposureDensities[i]) exposure.above_person_s[i] += dt_s;
  }
  for (std::size_t i = 0; i < kExposurePacking.size(); ++i) {
    if (packing > kExposurePacking[i]) exposure.disc_packing_person_s[i] += dt_s;
  }
  const auto* level = std::lower_bound(kServiceDensities.begin(), kServiceDensities.end(), density);
  exposure.service_person_s[static_cast<std::size_t>(level - kServiceDensities.begin())] += dt_s;
  for (std::size_t i = 0; i < kExposurePressures.size(); ++i) {
    if (pressure > kExposurePressures[i]) exposure.pressure_person_s[i] += dt_s;
  }
  if (pressure <= kExposurePressures.front()) return;
  if (density > kExposureDensities[kCrushDensityIndex]) exposure.turbulent_5_person_s += dt_s;
  if (density > kExposureDensities.back()) exposure.turbulent_6_person_s += dt_s;
}

}  // namespace

Exposure measure_exposure(const world::Trace& trace, const world::Scenario& scenario,
                          const std::vector<PersonRecord>& people) {
  Exposure exposure;
  if (people.empty()) return exposure;
  double radius_m = 0;
  for (const PersonRecord& person : people) radius_m += trace.header.radius_m[person.agent];
  radius_m /= static_cast<double>(people.size());
  const double close_packing_m2 = 2 * std::numbers::sqrt3 * radius_m * radius_m;
  const VoronoiCutter cutter(scenario.buildings);
  const double dt_s = trace.header.dt_s;
  SquareMeter squares(static_cast<std::size_t>(std::max<long>(1, std::lround(kMeanS / dt_s))));
  GroundPressure pressure(scenario.inside, scenario.buildings, dt_s);
  std::vector<Vector2d> places;
  std::vector<std::size_t> agents;
  VoronoiCell cell;
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    places.clear();
    agents.clear();
    for (const PersonRecord& person : people) {
      if (!trace.present(step, person.agent)) continue;
      const std::size_t at = trace.at(step, person.agent);
      places.push_back(trace.position[at].cast<double>());
      agents.push_back(person.agent);
      pressure.add(places.back(), trace.velocity[at].cast<double>());
    }
    // The pressure about each person is needed, so it comes first.
    exposure.max_pressure_per_s2 = std::max(exposure.max_pressure_per_s2, pressure.finish_step());
    const geometry::PointGrid grid(places, kGridM);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!scenario.inside.contains(places[i])) continue;
      cutter.cut(grid, i, cell);
      add_person(cell.density_per_m2(), cell.density_per_m2() * close_packing_m2,
                 pressure.mean_at(places[i]), dt_s, exposure);
      squares.add(cell);
    }
    exposure.max_density_per_m2 = std::max(exposure.max_density_per_m2, squares.finish_step());
  }
  return exposure;
}

json to_json(const Exposure& exposure) {
  json above = json::object();
  for (std::size_t i = 0; i < kExposureDensities.size(); ++i) {
    above[fmt::format("above_{}_per_m2_person_s", kExposureDensities[i])] =
        exposure.above_person_s[i];
  }
  json packing = json::object();
  for (std::size_t i = 0; i < kExposurePacking.size(); ++i) {
    packing[fmt::format("above_{}_person_s", kExposurePacking[i])] =
        exposure.disc_packing_person_s[i];
  }
  json pressure = json::object();
  for (std::size_t i = 0; i < kExposurePressures.size(); ++i) {
    pressure[fmt::format("above_{}_per_s2_person_s", kExposurePressures[i])] =
        exposure.pressure_person_s[i];
  }
  json service = json::object();
  for (std::size_t i = 0; i < exposure.service_person_s.size(); ++i) {
    service[std::string(1, static_cast<char>('A' + i)) + "_person_s"] =
        exposure.service_person_s[i];
  }
  above["level_of_service"] = std::move(service);
  above["pressure"] = std::move(pressure);
  above["turbulent_above_5_per_m2_person_s"] = exposure.turbulent_5_person_s;
  above["turbulent_above_6_per_m2_person_s"] = exposure.turbulent_6_person_s;
  above["disc_packing"] = std::move(packing);
  above["max_density_2m2_per_m2"] = exposure.max_density_per_m2;
  above["max_pressure_per_s2"] = exposure.max_pressure_per_s2;
  return above;
}

}  // namespace throng::metrics
