#include "render/props/trees.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/props/leaf_sprites.h"

namespace throng::render {

namespace {

using Eigen::Vector3d;

struct Interval {
  double min;
  double max;
};

/// A species; lengths in m.
struct Species {
  LeafSprite sprite;
  Interval height;
  Interval radius;  ///< of the crown
  double base;      ///< of the crown, as a share of the height
  int lobes;
  double lobe_radius;   ///< over that of the crown; a cone has its own
  double lobe_height;   ///< over its radius; likewise
  double cards_per_m2;  ///< of a lobe's surface
  double card_m;        ///< half the side of a card
  std::array<Vector3d, 2> greens;
  Vector3d bark;
  bool is_conical = false;
};

const std::array<Species, 6>& species() {
  static const std::array<Species, 6> all = {{
      {.sprite = LeafSprite::broad,  // linden
       .height = {5.2, 6.6},
       .radius = {1.7, 2.2},
       .base = 0.32,
       .lobes = 7,
       .lobe_radius = 0.56,
       .lobe_height = 0.9,
       .cards_per_m2 = 2.4,
       .card_m = 0.52,
       .greens = {Vector3d(0.075, 0.13, 0.032), Vector3d(0.105, 0.15, 0.04)},
       .bark = {0.12, 0.10, 0.08}},
      {.sprite = LeafSprite::broad,  // oak
       .height = {4.8, 6.0},
       .radius = {2.1, 2.7},
       .base = 0.30,
       .lobes = 9,
       .lobe_radius = 0.47,
       .lobe_height = 0.75,
       .cards_per_m2 = 2.3,
       .card_m = 0.55,
       .greens = {Vector3d(0.06, 0.10, 0.03), Vector3d(0.085, 0.115, 0.038)},
       .bark = {0.10, 0.085, 0.07}},
      {.sprite = LeafSprite::small,  // birch
       .height = {5.6, 7.2},
       .radius = {1.1, 1.5},
       .base = 0.28,
       .lobes = 7,
       .lobe_radius = 0.58,
       .lobe_height = 1.6,
       .cards_per_m2 = 2.0,
       .card_m = 0.45,
       .greens = {Vector3d(0.11, 0.15, 0.04), Vector3d(0.14, 0.17, 0.045)},
       .bark = {0.55, 0.54, 0.52}},
      {.sprite = LeafSprite::narrow,  // ash
       .height = {5.6, 7.2},
       .radius = {1.5, 2.0},
       .base = 0.36,
       .lobes = 7,
       .lobe_radius = 0.55,
       .lobe_height = 1.05,
       .cards_per_m2 = 2.5,
       .card_m = 0.55,
       .greens = {Vector3d(0.085, 0.125, 0.045), Vector3d(0.10, 0.13, 0.05)},
       .bark = {0.16, 0.145, 0.125}},
      {.sprite = LeafSprite::small,  // hornbeam, a column
       .height = {5.8, 7.4},
       .radius = {0.9, 1.2},
       .base = 0.14,
       .lobes = 6,
       .lobe_radius = 0.75,
       .lobe_height = 2.0,
       .cards_per_m2 = 2.0,
       .card_m = 0.42,
       .greens = {Vector3d(0.06, 0.105, 0.03), Vector3d(0.085, 0.125, 0.035)},
       .bark = {0.13, 0.12, 0.11}},
      {.sprite = LeafSprite::needles,  // spruce
       .height = {5.4, 7.6},
       .radius = {1.5, 1.9},
       .base = 0.07,
       .lobes = 17,  // whorls of boughs
       .lobe_radius = 1,
       .lobe_height = 0,
       .cards_per_m2 = 0,
       .card_m = 0,
       .greens = {Vector3d(0.04, 0.07, 0.036), Vector3d(0.055, 0.085, 0.042)},
       .bark = {0.10, 0.075, 0.055},
       .is_conical = true},
  }};
  return all;
}

struct Lobe {
  Vector3d middle;
  Vector3d radii;
};

double pick(Random& random, const Interval& interval) {
  return random.uniform(interval.min, interval.max);
}

/// Directions spread evenly over the sphere (a Fibonacci lattice).
Vector3d spread_direction(int i, int count) {
  const double z = 1 - 2 * (i + 0.5) / count;
  const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
  const double ring = std::sqrt(1 - z * z);
  return {ring * std::cos(angle), ring * std::sin(angle), z};
}

/// One lobe on top, the others around it at heights of their own.
std::vector<Lobe> round_lobes(const Species& kind, double height, double radius, Random& random) {
  std::vector<Lobe> lobes;
  const double base = kind.base * height;
  const double start = random.uniform(0, 2 * std::numbers::pi);
  for (int i = 0; i < kind.lobes; ++i) {
    const double size = kind.lobe_radius * radius * random.uniform(0.85, 1.15);
    const Vector3d radii(size, size, kind.lobe_height * size);
    if (i == 0) {
      lobes.push_back({{0, 0, height - radii.z()}, radii});
      continue;
    }
    const double angle = start + i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double share = static_cast<double>(i - 1) / std::max(1, kind.lobes - 2);
    const double low = base + 0.8 * radii.z();
    const double high = std::max(low, height - 1.3 * radii.z());
    const double z = low + (high - low) * share;
    // Widest below the middle.
    const double off = (radius - size) * (1.05 - 0.35 * share) * random.uniform(0.85, 1.1);
    lobes.push_back({{off * std::cos(angle), off * std::sin(angle), z}, radii});
  }
  return lobes;
}

/// How deep a point is in the other lobes: 0 in the middle of one, above 1 outside of all.
double depth_in(const std::vector<Lobe>& lobes, std::size_t but, const Vector3d& point) {
  double depth = 2;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    if (i == but) continue;
    depth = std::min(depth, (point - lobes[i].middle).cwiseQuotient(lobes[i].radii).norm());
  }
  return depth;
}

void add_wood(PropBuilder& builder, const Species& kind, double height,
              const std::vector<Lobe>& lobes) {
  const double fork = (kind.base + 0.12) * height;
  const double thick = (kind.is_conical ? 0.7 : 1) * (0.018 * height + 0.025);
  const auto trunk = [&](double from_m, double from, double to_m, double to) {
    builder.tube({0, 0, from_m}, from * thick, {0, 0, to_m}, to * thick, kind.bark, Finish::bark,
                 8);
  };
  // Wide at the roots, and thinner all the way up.
  trunk(0, 1.7, 0.1, 1.25);
  trunk(0.1, 1.25, 0.45, 1);
  trunk(0.45, 1, fork, 0.72);
  trunk(fork, 0.72, 0.85 * height, 0.2);
  if (kind.is_conical) return;
  for (const Lobe& lobe : lobes) {
    if (lobe.middle.head<2>().norm() < 0.1) continue;
    const double from = std::min(fork, 0.75 * lobe.middle.z());
    builder.tube({0, 0, from}, 0.5 * thick, lobe.middle, 0.12 * thick, kind.bark, Finish::bark, 4);
  }
}

/// Boughs around the trunk of a conifer, which hang the more the lower they are.
void add_boughs(PropBuilder& builder, const Species& kind, double height, double radius,
                const Vector3d& green) {
  Random& random = builder.random();
  for (int whorl = 0; whorl < kind.lobes; ++whorl) {
    const double share = (whorl + 0.4) / kind.lobes;
    const double z = height * (kind.base + (0.97 - kind.base) * share);
    const double length = radius * (1.06 - share) * random.uniform(0.9, 1.1);
    const int boughs = 9 + static_cast<int>(3 * (1 - share));
    const double start = random.uniform(0, 2 * std::numbers::pi);
    for (int i = 0; i < boughs; ++i) {
      const double angle =
          start + (i + random.uniform(-0.25, 0.25)) * 2 * std::numbers::pi / boughs;
      const double reach = std::max(0.4, length * random.uniform(0.8, 1.12));
      const double hangs = 0.55 - 0.75 * share + random.uniform(-0.12, 0.12);
      const Vector3d out(std::cos(angle), std::sin(angle), 0);
      const Vector3d along = std::cos(hangs) * out - std::sin(hangs) * Vector3d::UnitZ();
      const Vector3d across(-out.y(), out.x(), random.uniform(-0.5, 0.5));
      const Vector3d up = along.cross(across).normalized();
      const Vector3d half = std::max(0.33 * reach, 0.2) * across.normalized();
      const double lowest_m = 0.05 + std::max(0.0, reach * std::sin(hangs)) + std::abs(half.z());
      const Vector3d from(0, 0, std::max(z, lowest_m));
      const Vector3d tip = from + reach * along;
      // The inner ends lie in the shade of the boughs above.
      const double light = random.uniform(0.85, 1.15) * (0.8 + 0.3 * share);
      builder.leaves({from - half, tip - half, tip + half, from + half},
                     (0.6 * out + 0.5 * (up.z() < 0 ? -up : up)).normalized(), light * green,
                     kind.sprite);
    }
  }
}

/// Directions in which a lobe has no leaves: there one sees through the crown.
std::array<Vector3d, 2> pick_gaps(Random& random) {
  std::array<Vector3d, 2> gaps;
  for (Vector3d& gap : gaps) {
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    gap = Vector3d(std::cos(angle), std::sin(angle), random.uniform(-0.5, 0.5)).normalized();
  }
  return gaps;
}

}  // namespace

void grow_tree(PropBuilder& builder) {
  Random& random = builder.random();
  const Species& kind = species().at(random.below(species().size()));
  const double height = pick(random, kind.height);
  const double radius = pick(random, kind.radius);
  const double hue = random.uniform();
  const Vector3d green = (1 - hue) * kind.greens[0] + hue * kind.greens[1];
  const std::vector<Lobe> lobes =
      kind.is_conical ? std::vector<Lobe>() : round_lobes(kind, height, radius, random);
  add_wood(builder, kind, height, lobes);
  if (kind.is_conical) add_boughs(builder, kind, height, radius, green);
  const Vector3d middle(0, 0, 0.5 * (1 + kind.base) * height);
  const Vector3d crown(radius, radius, 0.5 * (1 - kind.base) * height);
  for (std::size_t l = 0; l < lobes.size(); ++l) {
    const Lobe& lobe = lobes[l];
    // A rough mean between the areas of a ball and of a long ellipsoid.
    const double surface_m2 =
        4 * std::numbers::pi * lobe.radii.x() * 0.5 * (lobe.radii.x() + lobe.radii.z());
    const int cards = std::max(8, static_cast<int>(kind.cards_per_m2 * surface_m2));
    const std::array<Vector3d, 2> gaps = pick_gaps(random);
    for (int i = 0; i < cards; ++i) {
      const Vector3d out = spread_direction(i, cards);
      const double depth = random.uniform(0.6, 1.0);
      const Vector3d at = lobe.middle + depth * lobe.radii.cwiseProduct(out);
      const Vector3d jitter(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const double brightness = random.uniform(0.85, 1.15);
      const double hidden = depth_in(lobes, l, at);
      if (hidden < 0.55) continue;  // nobody sees it
      if (std::max(out.dot(gaps[0]), out.dot(gaps[1])) > 0.8) continue;
      const Vector3d from_middle = (at - middle).cwiseQuotient(crown);
      const Vector3d normal =
          (0.55 * out + 0.45 * from_middle.normalized() + 0.2 * jitter).normalized();
      const Vector3d facing = (out + 0.7 * jitter).normalized();
      const Vector3d u = kind.card_m * facing.unitOrthogonal();
      const Vector3d v = facing.cross(u);
      // Leaves inside, below and between lobes get less light.
      const double inside = std::clamp(from_middle.norm(), 0.0, 1.0);
      const double light = (0.35 + 0.65 * inside * inside) * (0.82 + 0.18 * out.z()) *
                           (0.7 + 0.3 * std::min(1.0, hidden)) * brightness;
      builder.leaves({at - u - v, at + u - v, at + u + v, at - u + v}, normal, light * green,
                     kind.sprite);
    }
  }
}

}  // namespace throng::render
