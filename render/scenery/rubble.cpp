#include "render/scenery/rubble.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/compute/random.h"
#include "render/props/prop_builder.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint64_t kRubble = std::uint64_t{1} << 44;  // apart from other uses of the stream

/// A block with slanted sides, of concrete, plaster or brick, and a smaller one on top of it.
void add_chunk(PropBuilder& builder, double height_m) {
  constexpr std::array<std::array<double, 3>, 4> kPaints = {
      {{0.34, 0.33, 0.31}, {0.42, 0.40, 0.36}, {0.26, 0.15, 0.11}, {0.22, 0.22, 0.22}}};
  Random& random = builder.random();
  const Vector3d paint(kPaints[random.below(kPaints.size())].data());
  const Vector2d half(random.uniform(0.35, 1.0), random.uniform(0.25, 0.7));
  const Vector2d slip(random.uniform(-0.25, 0.25), random.uniform(-0.25, 0.25));
  const Vector2d top = 0.65 * half;
  const Vector2d slipped = slip.cwiseProduct(half);
  builder.block({Vector2d(-half), half}, 0, {Vector2d(slipped - top), Vector2d(slipped + top)},
                height_m, random.uniform(0.8, 1.15) * paint);
  if (random.uniform() < 0.4) {
    builder.tube({0, 0, 0.4 * height_m}, 0.03,
                 {random.uniform(-1, 1), random.uniform(-1, 1), height_m + 0.4}, 0.02,
                 {0.12, 0.07, 0.05}, Finish::matt, 5);
  }
}

}  // namespace

std::vector<RubblePiece> make_rubble(const world::Disaster& disaster, std::uint32_t id) {
  std::vector<RubblePiece> pieces;
  if (disaster.kind != world::DisasterKind::collapse) return pieces;
  constexpr double kPerM2 = 0.8;
  constexpr double kMaxPieces = 300;
  const double reach_m = disaster.growth_mps > 0
                             ? std::max(disaster.radius_m, disaster.max_radius_m)
                             : disaster.radius_m;
  const auto count = static_cast<std::uint64_t>(
      std::clamp(kPerM2 * std::numbers::pi * reach_m * reach_m, 1.0, kMaxPieces));
  for (std::uint64_t i = 0; i < count; ++i) {
    Random random(static_cast<std::uint64_t>(disaster.agent), Stream::environment, kRubble + i);
    // More of it in the middle than evenly spread.
    const double r = reach_m * std::pow(random.uniform(), 0.7);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    world::Prop prop;
    prop.position = disaster.position + r * Vector2d(std::cos(angle), std::sin(angle));
    prop.yaw_rad = random.uniform(0, 2 * std::numbers::pi);
    prop.look = random.bits();
    PropBuilder builder(prop, id);
    add_chunk(builder, (0.25 + 1.6 * std::pow(1 - r / reach_m, 1.5)) * random.uniform(0.5, 1.2));
    const double beyond_m = std::max(r - disaster.radius_m, 0.0);
    const double later_s = beyond_m > 0 ? beyond_m / disaster.growth_mps : 0;
    pieces.push_back({builder.take(), disaster.start_s + later_s});
  }
  return pieces;
}

}  // namespace throng::render
