#include "render/props/prop_shapes.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/compute/random.h"
#include "render/props/large_props.h"
#include "render/props/plants.h"
#include "render/props/prop_builder.h"
#include "render/props/trees.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using Builder = PropBuilder;

const Vector3d kMetal(0.10, 0.105, 0.11);
const Vector3d kWood(0.26, 0.16, 0.085);

void make_bench(Builder& builder) {
  for (const double y : {-0.25, -0.08, 0.09}) {
    builder.box({-0.9, y, 0.42}, {0.9, y + 0.14, 0.46}, kWood);
  }
  for (const double z : {0.58, 0.76}) builder.box({-0.9, 0.24, z}, {0.9, 0.28, z + 0.13}, kWood);
  for (const double x : {-0.7, 0.62}) {
    builder.box({x, -0.22, 0}, {x + 0.08, 0.24, 0.42}, kMetal);
    builder.box({x, 0.24, 0.3}, {x + 0.08, 0.28, 0.88}, kMetal);
  }
}

void make_lamp_post(Builder& builder) {
  builder.tube({0, 0, 0}, 0.1, {0, 0, 0.6}, 0.09, kMetal);
  builder.tube({0, 0, 0.6}, 0.06, {0, 0, kLampPostM}, 0.045, kMetal, Finish::matt, 6);
  builder.box({-0.24, -0.24, kLampPostM}, {0.24, 0.24, kLampPostM + 0.1}, kMetal);
  builder.box({-0.2, -0.2, kLampPostM - 0.06}, {0.2, 0.2, kLampPostM}, {0.75, 0.74, 0.70},
              Finish::lamp);
}

void make_bin(Builder& builder) {
  const Vector3d paint = builder.random().uniform() < 0.5 ? Vector3d(0.05, 0.09, 0.06) : kMetal;
  builder.tube({0, 0, 0}, 0.24, {0, 0, 0.85}, 0.28, paint, Finish::matt, 10);
  builder.tube({0, 0, 0.85}, 0.29, {0, 0, 0.95}, 0.2, 0.7 * paint, Finish::matt, 10);
}

void make_bollard(Builder& builder) {
  builder.tube({0, 0, 0}, 0.09, {0, 0, 0.75}, 0.08, kMetal);
  builder.tube({0, 0, 0.75}, 0.085, {0, 0, 0.85}, 0.085, {0.6, 0.6, 0.58});
  builder.tube({0, 0, 0.85}, 0.08, {0, 0, 0.95}, 0.04, kMetal);
}

void make_car(Builder& builder) {
  constexpr std::array<std::array<double, 3>, 8> kLacquers = {{{0.55, 0.56, 0.57},
                                                               {0.30, 0.31, 0.33},
                                                               {0.03, 0.03, 0.035},
                                                               {0.72, 0.72, 0.70},
                                                               {0.08, 0.13, 0.27},
                                                               {0.36, 0.04, 0.035},
                                                               {0.12, 0.17, 0.14},
                                                               {0.16, 0.16, 0.17}}};
  const Vector3d lacquer(kLacquers[builder.random().below(kLacquers.size())].data());
  const Vector3d glass(0.025, 0.03, 0.035);
  const auto outline = [](double x0, double x1, double half_width) {
    return Eigen::AlignedBox2d(Vector2d(x0, -half_width), Vector2d(x1, half_width));
  };
  builder.block(outline(-2.1, 2.08, 0.80), 0.18, outline(-2.15, 2.15, 0.88), 0.5, 0.8 * lacquer,
                Finish::glossy);
  builder.block(outline(-2.15, 2.15, 0.88), 0.5, outline(-2.08, 2.02, 0.82), 0.82, lacquer,
                Finish::glossy);
  builder.block(outline(-2.08, 1.0, 0.80), 0.82, outline(-1.95, 0.85, 0.78), 0.9, lacquer,
                Finish::glossy);
  builder.block(outline(-1.85, 0.95, 0.76), 0.9, outline(-1.35, 0.15, 0.60), 1.38, glass,
                Finish::glossy);
  builder.block(outline(-1.38, 0.18, 0.61), 1.38, outline(-1.2, 0.02, 0.5), 1.45, lacquer,
                Finish::glossy);
  for (const double x : {-1.35, 1.32}) {
    for (const double side : {-1.0, 1.0}) {
      builder.tube({x, side * 0.68, 0.32}, 0.32, {x, side * 0.9, 0.32}, 0.32, {0.02, 0.02, 0.02},
                   Finish::matt, 12);
      builder.tube({x, side * 0.9, 0.32}, 0.19, {x, side * 0.91, 0.32}, 0.17, {0.35, 0.35, 0.36});
    }
  }
  for (const double side : {-0.62, 0.62}) {
    builder.box({2.0, side - 0.16, 0.56}, {2.13, side + 0.16, 0.7}, {0.7, 0.7, 0.68},
                Finish::glossy);
    builder.box({-2.14, side - 0.16, 0.58}, {-2.0, side + 0.16, 0.74}, {0.3, 0.02, 0.02},
                Finish::glossy);
  }
}

void make_stall(Builder& builder) {
  constexpr std::array<std::array<double, 3>, 4> kCloths = {
      {{0.42, 0.06, 0.05}, {0.06, 0.14, 0.30}, {0.08, 0.22, 0.10}, {0.45, 0.30, 0.06}}};
  const Vector3d cloth(kCloths[builder.random().below(kCloths.size())].data());
  const Vector3d white(0.62, 0.61, 0.57);
  builder.box({-1.4, -0.9, 0}, {1.4, -0.2, 0.85}, kWood);
  Random& random = builder.random();
  for (int i = 0; i < 10; ++i) {
    const double x = -1.3 + 0.27 * i;
    const Vector3d goods(random.uniform(0.1, 0.5), random.uniform(0.1, 0.4),
                         random.uniform(0, 0.2));
    builder.box({x, -0.82, 0.85}, {x + 0.22, -0.3, 0.85 + random.uniform(0.08, 0.25)}, goods);
  }
  builder.box({-0.12, -0.42, 1.98}, {0.12, -0.18, 2.04}, {0.75, 0.72, 0.6}, Finish::lamp);
  for (const double x : {-1.4, 1.34}) {
    for (const double y : {-1.0, 0.94}) builder.box({x, y, 0}, {x + 0.06, y + 0.06, 2.1}, kMetal);
  }
  constexpr int kStripes = 6;
  for (int i = 0; i < kStripes; ++i) {
    const double x0 = -1.5 + 0.5 * i;
    const Vector3d& paint = i % 2 == 0 ? cloth : white;
    for (const double side : {-1.0, 1.0}) {
      const std::array<Vector3d, 4> roof = {Vector3d(x0, side * 1.1, 2.05),
                                            Vector3d(x0 + 0.5, side * 1.1, 2.05),
                                            Vector3d(x0 + 0.5, 0, 2.6), Vector3d(x0, 0, 2.6)};
      const std::array<Vector3d, 4> inside = {roof[3], roof[2], roof[1], roof[0]};
      builder.quad(side < 0 ? roof : inside, paint, Finish::matt);
      builder.quad(side < 0 ? inside : roof, 0.5 * paint, Finish::matt);
    }
  }
}

}  // namespace

PropMesh prop_shape(const world::Prop& prop, std::uint32_t id) {
  Builder builder(prop, id);
  switch (prop.kind) {
    case world::PropKind::tree:
      grow_tree(builder);
      break;
    case world::PropKind::bench:
      make_bench(builder);
      break;
    case world::PropKind::lamp_post:
      make_lamp_post(builder);
      break;
    case world::PropKind::bin:
      make_bin(builder);
      break;
    case world::PropKind::car:
      make_car(builder);
      break;
    case world::PropKind::bollard:
      make_bollard(builder);
      break;
    case world::PropKind::stall:
      make_stall(builder);
      break;
    case world::PropKind::barrier:
      make_barrier(builder);
      break;
    case world::PropKind::fence:
      make_fence(builder);
      break;
    case world::PropKind::kiosk:
      make_kiosk(builder);
      break;
    case world::PropKind::tent:
      make_tent(builder);
      break;
    case world::PropKind::stage:
      make_stage(builder);
      break;
    case world::PropKind::train:
      make_train(builder);
      break;
    case world::PropKind::fountain:
      make_fountain(builder);
      break;
    case world::PropKind::bush:
      make_bush(builder);
      break;
    case world::PropKind::planter:
      make_planter(builder);
      break;
  }
  return builder.take();
}

}  // namespace throng::render
