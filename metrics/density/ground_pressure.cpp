#include "metrics/density/ground_pressure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "metrics/density/pressure.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

constexpr double kGroundLatticeM = 0.5;
constexpr double kMaxPositions = 250'000;
// Places of the lattice within the kernel's reach along one axis, at most.
constexpr std::size_t kAcross = 9;

}  // namespace

GroundPressure::GroundPressure(const geometry::Region& ground,
                               std::span<const world::Building> buildings, double dt_s)
    : lattice_(lattice_over(ground.bounds, kGroundLatticeM, kMaxPositions)),
      covered_(covered_by(buildings, lattice_)),
      sums_(lattice_.size()),
      window_(std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(1 / dt_s)))) {
  for (std::size_t i = 0; i < covered_.size(); ++i) {
    const auto columns = static_cast<std::size_t>(lattice_.columns);
    const Vector2d place =
        lattice_.place(static_cast<int>(i % columns), static_cast<int>(i / columns));
    covered_[i] = covered_[i] || !ground.contains(place);
  }
}

void GroundPressure::add(const Vector2d& place, const Vector2d& velocity) {
  const auto range = [&](double at, int count, int& low, int& high) {
    low = std::max(0, static_cast<int>(std::ceil((at - kPressureReachM) / lattice_.pitch_m)));
    high = std::min(count - 1,
                    static_cast<int>(std::floor((at + kPressureReachM) / lattice_.pitch_m)));
  };
  const Vector2d from_first = place - lattice_.first;
  int left = 0, right = 0, bottom = 0, top = 0;
  range(from_first.x(), lattice_.columns, left, right);
  range(from_first.y(), lattice_.rows, bottom, top);
  if (left > right || bottom > top) return;
  // The Gaussian is one of x times one of y.
  std::array<double, kAcross> weight_x{};
  std::array<double, kAcross> squared_x{};
  for (int column = left; column <= right; ++column) {
    const double x = column * lattice_.pitch_m - from_first.x();
    squared_x[static_cast<std::size_t>(column - left)] = x * x;
    weight_x[static_cast<std::size_t>(column - left)] =
        std::exp(-x * x / (kPressureRadiusM * kPressureRadiusM));
  }
  const double square = velocity.squaredNorm();
  for (int row = bottom; row <= top; ++row) {
    const double y = row * lattice_.pitch_m - from_first.y();
    const double weight_y = std::exp(-y * y / (kPressureRadiusM * kPressureRadiusM));
    const std::size_t first = lattice_.index(left, row);
    for (std::size_t i = 0; i <= static_cast<std::size_t>(right - left); ++i) {
      if (squared_x[i] + y * y > kPressureReachM * kPressureReachM) continue;
      if (covered_[first + i]) continue;
      Sums& sums = sums_[first + i];
      const double weight = weight_x[i] * weight_y;
      if (sums.weight == 0) touched_.push_back(first + i);
      sums.weight += weight;
      sums.x += weight * velocity.x();
      sums.y += weight * velocity.y();
      sums.squares += weight * square;
    }
  }
}

double GroundPressure::finish_step() {
  if (last_.size() == window_) {
    for (const auto& [place, pressure] : last_.front()) sums_[place].mean -= pressure;
    last_.pop_front();
  }
  auto& now = last_.emplace_back();
  double max_mean = 0;
  for (const std::size_t place : touched_) {
    Sums& sums = sums_[place];
    const double pressure = crowd_pressure(sums.weight, Vector2d(sums.x, sums.y), sums.squares);
    sums.weight = sums.x = sums.y = sums.squares = 0;
    if (pressure <= 0) continue;
    now.emplace_back(place, pressure);
    sums.mean += pressure;
    // At an empty point the mean cannot be the maximum: it was greater before.
    max_mean = std::max(max_mean, sums.mean);
  }
  touched_.clear();
  return max_mean / static_cast<double>(last_.size());
}

double GroundPressure::mean_at(const Vector2d& place) const {
  const Vector2d cell = (place - lattice_.first) / lattice_.pitch_m;
  const long column = std::lround(cell.x());
  const long row = std::lround(cell.y());
  if (column < 0 || row < 0 || column >= lattice_.columns || row >= lattice_.rows) return 0;
  const std::size_t at = lattice_.index(static_cast<int>(column), static_cast<int>(row));
  return std::max(0.0, sums_[at].mean) / static_cast<double>(last_.size());
}

}  // namespace throng::metrics
