#include "render/ground/worn_paths.h"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "base/compute/random.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;

bool is_lawn(const GroundMap& map, const Vector2d& point) {
  return map.material_at(point) == "grass" && map.wall_m(point) > 0.4;
}

/// Distance (m) from a point of a lawn to its end, if that is at a path or road; else 0.
double lawn_m(const GroundMap& map, const Vector2d& from, const Vector2d& direction) {
  constexpr double kMaxM = 7;
  constexpr double kStepM = 0.25;
  double off_m = 0;
  while (off_m < kMaxM && is_lawn(map, from + off_m * direction)) off_m += kStepM;
  const Vector2d end = from + off_m * direction;
  const std::string_view material = map.material_at(end);
  const bool is_end = is_paved(material) || material == "dirt" || material == "asphalt";
  return is_end && map.wall_m(end) > 0.4 ? off_m : 0;
}

}  // namespace

std::vector<GroundDecal> worn_paths(const world::Scenario& scenario, const GroundMap& map) {
  constexpr double kGridM = 3;
  constexpr double kMinHalfM = 1.5;
  constexpr double kApartM = 16;
  const double half_root = std::sqrt(0.5);
  std::vector<GroundDecal> paths;
  std::uint64_t number = 0;
  for (double y = scenario.ground.min.y() + 1; y < scenario.ground.max.y(); y += kGridM) {
    for (double x = scenario.ground.min.x() + 1; x < scenario.ground.max.x(); x += kGridM) {
      Random random(++number, Stream::environment, std::uint64_t{1} << 45U);
      const Vector2d point(x + random.uniform(-1, 1), y + random.uniform(-1, 1));
      const double lean = random.below(2) == 0 ? 1 : -1;
      const Vector2d along(half_root, lean * half_root);
      if (!is_lawn(map, point)) continue;
      const double ahead_m = lawn_m(map, point, along);
      const double behind_m = ahead_m > 0 ? lawn_m(map, point, -along) : 0;
      const double half_m = 0.5 * (ahead_m + behind_m);
      if (behind_m == 0 || half_m < kMinHalfM) continue;
      const Vector2d from = point - behind_m * along;
      const Vector2d to = point + ahead_m * along;
      // One of the corners beside a path that is worth it belongs to the paths around the lawn.
      const bool is_corner = !is_lawn(map, {from.x(), to.y()}) != !is_lawn(map, {to.x(), from.y()});
      const Vector2d middle = 0.5 * (from + to);
      bool is_apart = is_corner;
      for (const GroundDecal& other : paths) {
        is_apart = is_apart && (other.middle - middle).norm() > kApartM;
      }
      if (!is_apart) continue;
      paths.push_back({DecalKind::soil, middle, {half_m + 0.5, random.uniform(0.5, 0.8)}, along});
    }
  }
  return paths;
}

}  // namespace throng::render
