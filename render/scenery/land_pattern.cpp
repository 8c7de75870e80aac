#include "render/scenery/land_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace throng::render {

using Eigen::Vector2d;
using Eigen::Vector2i;

namespace {

/// Borders of fields are no straight lines.
Vector2d bend(const Vector2d& point) {
  constexpr double kPerM = 0.011;
  constexpr double kByM = 9;
  return kByM * Vector2d(smooth_noise(kPerM * point),
                         smooth_noise(kPerM * point + Vector2d::Constant(31)));
}

// By -kLandYawRad; also in shaders/ground_surroundings.glsl.
Eigen::Matrix2d turn() { return (Eigen::Matrix2d() << 0.94, -0.34, 0.34, 0.94).finished(); }

}  // namespace

double cell_hash(const Vector2i& cell) {
  const std::uint32_t x = static_cast<std::uint32_t>(cell.x()) * 1597334673U;
  const std::uint32_t y = static_cast<std::uint32_t>(cell.y()) * 3812015801U;
  std::uint32_t h = (x ^ y) * 1597334673U;
  h ^= h >> 15U;
  h *= 2246822519U;
  return static_cast<double>(h >> 8U) / 16777216.0;
}

double smooth_noise(const Vector2d& at) {
  const Vector2d low = at.array().floor();
  const Eigen::Array2d t = (at - low).array();
  const Eigen::Array2d f = t * t * (3 - 2 * t);
  const Vector2i cell = low.cast<int>();
  const auto row = [&](int up) {
    const double first = cell_hash(cell + Vector2i(0, up));
    return first + f.x() * (cell_hash(cell + Vector2i(1, up)) - first);
  };
  const double below = row(0);
  return below + f.y() * (row(1) - below);
}

Vector2d land_from_ground(const Vector2d& point) { return turn() * point + bend(point); }

Vector2d ground_from_land(const Vector2d& at) {
  const Eigen::Matrix2d back = turn().inverse();
  Vector2d point = back * at;
  // The bend changes so little over its own length that this converges by a factor of 5 each time.
  constexpr int kSteps = 6;
  for (int i = 0; i < kSteps; ++i) point = back * (at - bend(point));
  return point;
}

Field field_at(const Vector2d& at) {
  const int row = static_cast<int>(std::floor(at.y() / kFieldM));
  Field field;
  field.length_m = kFieldM * (0.8 + 0.9 * cell_hash({row, 3}));
  const double shift = 7 * cell_hash({row, 17});
  const int number = static_cast<int>(std::floor(at.x() / field.length_m + shift));
  field.number = {number, row};
  field.begin_m = (number - shift) * field.length_m;
  return field;
}

double built_share(const world::Scenario& scenario) {
  constexpr double kThreeStoriesM = 9;
  constexpr int kMinHouses = 4;
  constexpr double kVillages = 0.28;
  constexpr double kTown = 0.85;
  const auto tall = std::count_if(
      scenario.buildings.begin(), scenario.buildings.end(),
      [](const world::Building& building) { return building.height_m >= kThreeStoriesM; });
  return tall >= kMinHouses ? kTown : kVillages;
}

bool is_built(const Field& field, double share) {
  return cell_hash(field.number + Vector2i::Constant(91)) >= 1 - share;
}

bool has_house(const Vector2i& plot) { return cell_hash(plot + Vector2i::Constant(5)) <= 0.75; }

bool has_hedge(int row) { return cell_hash({row, 29}) >= 0.4; }

}  // namespace throng::render
