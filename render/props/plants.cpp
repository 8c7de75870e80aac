#include "render/props/plants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector3d kBoxwood(0.050, 0.095, 0.028);
const Vector3d kLaurel(0.060, 0.105, 0.030);
const Vector3d kSpirea(0.095, 0.135, 0.040);

constexpr std::array<std::array<double, 3>, 5> kFlowers = {{{0.52, 0.06, 0.07},
                                                            {0.60, 0.42, 0.05},
                                                            {0.60, 0.56, 0.54},
                                                            {0.30, 0.14, 0.42},
                                                            {0.55, 0.20, 0.32}}};

Vector3d choose_flower(Random& random) {
  return Vector3d(kFlowers[random.below(static_cast<std::uint32_t>(kFlowers.size()))].data());
}

/// A card around a point that faces a direction.
std::array<Vector3d, 4> card_at(const Vector3d& at, const Vector3d& facing, double half_m) {
  const Vector3d u = half_m * facing.unitOrthogonal();
  const Vector3d v = facing.cross(u);
  return {at - u - v, at + u - v, at + u + v, at - u + v};
}

Vector3d jitter(Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

/// Blossoms on the upper half of a body.
void add_blossoms(PropBuilder& builder, const LeafBody& body, const Vector3d& paint, int count) {
  Random& random = builder.random();
  constexpr double kBlossomM = 0.11;
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double z = random.uniform(0.15, 1);
    const double ring = std::sqrt(1 - z * z);
    const Vector3d out(ring * std::cos(angle), ring * std::sin(angle), z);
    const Vector3d at = body.middle + 1.04 * body.radii.cwiseProduct(out);
    builder.leaves(card_at(at, (out + 0.4 * jitter(random)).normalized(), kBlossomM), out,
                   random.uniform(0.75, 1.1) * paint, LeafSprite::broad);
  }
}

/// A box of leaves, as shears leave it, from one corner to the other.
void add_clipped_box(PropBuilder& builder, const Vector3d& low, const Vector3d& high,
                     const Vector3d& paint) {
  constexpr double kCardM = 0.14;
  constexpr double kCardsPerM2 = 26;
  Random& random = builder.random();
  builder.box(low + Vector3d(0.05, 0.05, 0), high - Vector3d::Constant(0.05), 0.3 * paint);
  const Vector3d size = high - low;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      if (axis == 2 && side < 0) continue;
      const int across = (axis + 1) % 3;
      const int along = (axis + 2) % 3;
      const int cards = static_cast<int>(kCardsPerM2 * size[across] * size[along]) + 1;
      for (int i = 0; i < cards; ++i) {
        Vector3d at;
        at[axis] = (side < 0 ? low : high)[axis] - 0.03 * side;
        at[across] = random.uniform(low[across], high[across]);
        at[along] = random.uniform(low[along], high[along]);
        at.z() = std::max(at.z(), low.z() + 0.7 * kCardM);
        const Vector3d out = side * Vector3d::Unit(axis);
        const Vector3d facing = (out + 0.35 * jitter(random)).normalized();
        const double share = (at.z() - low.z()) / size.z();
        const double light = (0.55 + 0.45 * share) * random.uniform(0.8, 1.2);
        builder.leaves(card_at(at, facing, kCardM), (out + 0.3 * jitter(random)).normalized(),
                       light * paint, LeafSprite::small);
      }
    }
  }
}

/// Blades that bend outwards.
void add_grasses(PropBuilder& builder, double half_x, double z) {
  Random& random = builder.random();
  const Vector3d paint(0.17, 0.18, 0.07);
  for (double x = -half_x; x <= half_x; x += 0.24) {
    for (int i = 0; i < 9; ++i) {
      const double angle = random.uniform(0, 2 * std::numbers::pi);
      const Vector3d out(std::cos(angle), std::sin(angle), 0.9);
      const double high = random.uniform(0.3, 0.6);
      const Vector3d side = 0.1 * Vector3d(-out.y(), out.x(), 0);
      const Vector3d foot(x, random.uniform(-0.08, 0.08), z);
      const Vector3d top = foot + Vector3d(0.3 * out.x(), 0.3 * out.y(), high);
      builder.leaves({foot - side, foot + side, top + side, top - side}, out.normalized(),
                     random.uniform(0.7, 1.2) * paint, LeafSprite::narrow);
    }
  }
}

void add_trough(PropBuilder& builder, const Vector2d& half, double high_m) {
  constexpr std::array<std::array<double, 3>, 4> kStones = {
      {{0.34, 0.33, 0.31}, {0.22, 0.215, 0.21}, {0.40, 0.37, 0.32}, {0.11, 0.115, 0.12}}};
  Random& random = builder.random();
  const auto outline = [](const Vector2d& size) { return Eigen::AlignedBox2d(-size, size); };
  const bool is_wood = random.uniform() < 0.4;
  const Vector3d stone(kStones[random.below(static_cast<std::uint32_t>(kStones.size()))].data());
  const Vector2d rim = half - Vector2d::Constant(0.06);
  if (is_wood) {
    const Vector3d wood(0.21, 0.14, 0.085);
    constexpr int kBoards = 4;
    for (int i = 0; i < kBoards; ++i) {
      const double z = 0.04 + (high_m - 0.04) * i / kBoards;
      const double next = 0.04 + (high_m - 0.04) * (i + 1) / kBoards - 0.012;
      builder.block(outline(half), z, outline(half), next, random.uniform(0.8, 1.2) * wood);
    }
    builder.block(outline(rim), 0, outline(rim), high_m, 0.35 * wood);
  } else {
    const Vector2d foot = half - Vector2d::Constant(0.05);
    builder.block(outline(foot), 0, outline(half), high_m - 0.07, stone);
    builder.block(outline(half), high_m - 0.07, outline(half), high_m, 1.12 * stone);
  }
  const Vector3d earth(0.07, 0.052, 0.038);
  builder.block(outline(rim), high_m - 0.01, outline(rim), high_m + 0.01, earth);
}

}  // namespace

void add_leaf_body(PropBuilder& builder, const LeafBody& body) {
  Random& random = builder.random();
  for (int i = 0; i < body.cards; ++i) {
    // A Fibonacci lattice on the part of the sphere that is seen.
    constexpr double kLowest = -0.45;
    const double z = 1 - (1 - kLowest) * (i + 0.5) / body.cards;
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double ring = std::sqrt(1 - z * z);
    const Vector3d out(ring * std::cos(angle), ring * std::sin(angle), z);
    const double depth = random.uniform(0.72, 1.0);
    Vector3d at = body.middle + depth * body.radii.cwiseProduct(out);
    at.z() = std::max(at.z(), 0.02);
    const Vector3d facing = (out + 0.6 * jitter(random)).normalized();
    const Vector3d normal = (0.8 * out + Vector3d(0, 0, 0.3) + 0.2 * jitter(random)).normalized();
    const double light = (0.62 + 0.38 * z) * (0.4 + 0.6 * depth) * random.uniform(0.82, 1.18);
    std::array<Vector3d, 4> corners = card_at(at, facing, body.card_m);
    for (Vector3d& corner : corners) corner.z() = std::max(corner.z(), 0.01);
    builder.leaves(corners, normal, light * body.paint, body.sprite);
  }
}

void make_bush(PropBuilder& builder) {
  Random& random = builder.random();
  const std::uint32_t look = random.below(4);
  if (look == 0) {  // a clipped ball of boxwood
    const double radius = random.uniform(0.5, 0.62);
    const LeafBody ball = {{0, 0, 0.92 * radius},
                           {radius, radius, 0.95 * radius},
                           LeafSprite::small,
                           120,
                           0.13,
                           kBoxwood};
    builder.tube({0, 0, 0.1}, 0.6 * radius, {0, 0, 1.5 * radius}, 0.6 * radius, 0.3 * kBoxwood);
    add_leaf_body(builder, ball);
    return;
  }
  const Vector3d paint = look == 1 ? kLaurel : kSpirea;
  const LeafSprite sprite = look == 1 ? LeafSprite::broad : LeafSprite::narrow;
  const Vector3d flower = choose_flower(random);
  const double start = random.uniform(0, 2 * std::numbers::pi);
  builder.tube({0, 0, 0}, 0.3, {0, 0, 0.7}, 0.2, 0.3 * paint, Finish::matt, 6);
  constexpr int kLobes = 4;
  for (int i = 0; i < kLobes; ++i) {
    const double radius = random.uniform(0.36, 0.46);
    const double angle = start + 2 * std::numbers::pi * i / (kLobes - 1);
    const double off = i == 0 ? 0.05 : 0.27;
    const double high = i == 0 ? random.uniform(0.65, 0.85) : random.uniform(0.36, 0.5);
    const LeafBody lobe = {{off * std::cos(angle), off * std::sin(angle), high},
                           {radius, radius, 1.15 * radius},
                           sprite,
                           46,
                           0.19,
                           random.uniform(0.88, 1.12) * paint};
    add_leaf_body(builder, lobe);
    if (look == 3) add_blossoms(builder, lobe, flower, 12);
  }
}

void make_planter(PropBuilder& builder) {
  Random& random = builder.random();
  const Vector2d half(0.9, 0.4);
  const double high_m = random.uniform(0.45, 0.6);
  add_trough(builder, half, high_m);
  const std::uint32_t planted = random.below(3);
  if (planted == 0) {
    const double hedge_m = random.uniform(0.4, 0.7);
    add_clipped_box(builder, {-0.76, -0.28, high_m}, {0.76, 0.28, high_m + hedge_m}, kBoxwood);
    return;
  }
  if (planted == 1) {
    add_grasses(builder, 0.7, high_m);
    return;
  }
  for (int i = 0; i < 4; ++i) {
    const LeafBody tuft = {{-0.6 + 0.4 * i, 0, high_m + 0.02},
                           {0.3, 0.32, 0.28},
                           LeafSprite::broad,
                           26,
                           0.13,
                           kSpirea};
    add_leaf_body(builder, tuft);
    add_blossoms(builder, tuft, choose_flower(random), 12);
  }
}

}  // namespace throng::render
