#include "metrics/density/pressure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/geometry/point_grid.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kLatticeM = 0.5;
constexpr double kAverageS = 1.0;

}  // namespace

double crowd_pressure(double weights, const Vector2d& velocities, double squares) {
  if (weights <= 0) return 0;
  const double variance = squares / weights - (velocities / weights).squaredNorm();
  constexpr double kReach = kPressureReachM / kPressureRadiusM;
  const double mass =
      std::numbers::pi * kPressureRadiusM * kPressureRadiusM * (1 - std::exp(-kReach * kReach));
  return weights / mass * std::max(0.0, variance);
}

double pressure_at(const Vector2d& place, const geometry::PointGrid& grid,
                   std::span<const NearPerson> people) {
  double weights = 0;
  Vector2d velocity = Vector2d::Zero();
  double squares = 0;
  grid.for_within(place, kPressureReachM, [&](std::size_t i, const Vector2d& person) {
    const double squared = (person - place).squaredNorm();
    const double weight = std::exp(-squared / (kPressureRadiusM * kPressureRadiusM));
    weights += weight;
    velocity += weight * people[i].velocity;
    squares += weight * people[i].velocity.squaredNorm();
  });
  return crowd_pressure(weights, velocity, squares);
}

PressureMeter::PressureMeter(const ControlZone& zone, double dt_s)
    : window_(std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kAverageS / dt_s)))) {
  const auto half_size = static_cast<int>(std::ceil(zone.radius_m() / kLatticeM));
  for (int row = -half_size; row < half_size; ++row) {
    for (int column = -half_size; column < half_size; ++column) {
      const Vector2d place = zone.middle() + kLatticeM * Vector2d(column + 0.5, row + 0.5);
      if (zone.contains(place)) lattice_.push_back(place);
    }
  }
  last_.assign(window_, std::vector<double>(lattice_.size(), 0));
  sum_.assign(lattice_.size(), 0);
}

double PressureMeter::step(std::span<const NearPerson> people) {
  std::vector<Vector2d> places;
  for (const NearPerson& person : people) places.push_back(person.place);
  const geometry::PointGrid grid(places, kPressureRadiusM);
  std::vector<double>& now = last_[steps_ % window_];
  ++steps_;
  double greatest = 0;
  for (std::size_t i = 0; i < lattice_.size(); ++i) {
    sum_[i] -= now[i];
    now[i] = people.empty() ? 0 : pressure_at(lattice_[i], grid, people);
    sum_[i] += now[i];
    greatest = std::max(greatest, sum_[i]);
  }
  return greatest / static_cast<double>(std::min(steps_, window_));
}

}  // namespace throng::metrics
