#include "render/props/leaf_sprites.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/compute/random.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Level = std::vector<LeafTexel>;

/// Leaves of a species, in sizes of the sprite.
struct Foliage {
  int count;
  double length;
  double width;      ///< over length
  double outward;    ///< how much they point away from the middle: 0 anywhere, 1 exactly
  double roundness;  ///< exponent of the outline: above 1 for pointed ends
  int clumps;        ///< that they grow in, with gaps between
  double clump_size;
};

Foliage foliage(LeafSprite sprite) {
  switch (sprite) {
    case LeafSprite::small:
      return {620, 0.042, 0.66, 0.3, 0.8, 12, 0.125};
    case LeafSprite::narrow:
      return {520, 0.078, 0.3, 0.75, 1.2, 10, 0.14};
    case LeafSprite::needles:
      return {2400, 0.036, 0.2, 1, 0.6, 0, 0};
    case LeafSprite::crown:
      return {1500, 0.042, 0.7, 0.4, 0.8, 13, 0.13};
    case LeafSprite::broad:
      break;
  }
  return {400, 0.066, 0.68, 0.4, 0.9, 11, 0.14};
}

/// Draws one leaf over what is there.
void draw_leaf(const Foliage& leaves, const Vector2d& base, double angle, double shade,
               Level& level) {
  const Vector2d along(std::cos(angle), std::sin(angle));
  const Vector2d across(-along.y(), along.x());
  const auto texel = [](double value) {
    return std::clamp(static_cast<int>(value * kLeafTexels), 0, kLeafTexels - 1);
  };
  for (int y = texel(base.y() - leaves.length); y <= texel(base.y() + leaves.length); ++y) {
    for (int x = texel(base.x() - leaves.length); x <= texel(base.x() + leaves.length); ++x) {
      const Vector2d from_base = Vector2d(x + 0.5, y + 0.5) / kLeafTexels - base;
      const double t = from_base.dot(along) / leaves.length;
      if (t <= 0 || t >= 1) continue;
      const double half =
          0.5 * leaves.width * std::pow(std::sin(std::numbers::pi * t), leaves.roundness);
      const double off = std::abs(from_base.dot(across)) / leaves.length;
      if (off > std::max(half, 0.6 / (leaves.length * kLeafTexels))) continue;
      // The rib is brighter, and the sides hang down.
      const double bent = 1.12 - 0.4 * off / std::max(half, 1e-3);
      const double value = std::clamp(shade * bent, 0.0, 255.0);
      level[static_cast<std::size_t>(y) * kLeafTexels + static_cast<std::size_t>(x)] = {
          255, static_cast<std::uint8_t>(value)};
    }
  }
}

/// A leaf's beginning, direction and brightness.
struct Placed {
  Vector2d base;
  double angle;
  double shade;
};

/// In one of the clumps of a twig or crown, which give it an uneven outline with gaps; leaves that
/// are drawn late are in front and get more light.
Placed place_in_clump(const Foliage& leaves, int leaf, Random& random) {
  const int clump = leaf % leaves.clumps;
  const double away =
      (0.46 - leaves.clump_size) * std::sqrt((clump + 0.5) / static_cast<double>(leaves.clumps));
  const double turn = clump * std::numbers::pi * (3 - std::sqrt(5.0));
  const double share = 1 - static_cast<double>(leaf) / leaves.count;
  const double off = leaves.clump_size * std::sqrt(random.uniform());
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const Vector2d in_clump = off * Vector2d(std::cos(angle), std::sin(angle));
  const Vector2d base =
      Vector2d(0.5, 0.5) + away * Vector2d(std::cos(turn), std::sin(turn)) + in_clump;
  const double freedom = (1 - leaves.outward) * std::numbers::pi;
  // The side of a clump that is turned downward lies in its shade.
  const double lit = 1 + 0.22 * in_clump.y() / leaves.clump_size;
  return {base, angle + random.uniform(-freedom, freedom),
          random.uniform(95, 160) * (1.12 - 0.42 * share) * lit};
}

/// On a bough whose axis leads from the left to the right: along it and its side shoots, to both
/// sides of each.
Placed place_on_bough(int leaf, Random& random) {
  constexpr int kShoots = 17;
  const int shoot = leaf % kShoots;
  Vector2d from(0.03, 0.5);
  double heading = 0;
  double length = 0.9;
  if (shoot > 0) {
    const double share = (shoot - 0.5) / kShoots;
    from.x() += 0.8 * share;
    heading = shoot % 2 == 0 ? 0.75 : -0.75;
    length =
        0.06 + 0.6 * (1 - share) * std::min(1.0, 0.35 + 2.4 * share) * (shoot % 3 == 0 ? 0.75 : 1);
  }
  const double along = random.uniform();
  const Vector2d direction(std::cos(heading), std::sin(heading));
  const double side = random.uniform() < 0.5 ? 0.8 : -0.8;
  return {from + along * length * direction, heading + side * random.uniform(0.5, 1.2),
          random.uniform(85, 150) * (0.6 + 0.6 * along)};
}

Level draw_finest(LeafSprite sprite) {
  const Foliage leaves = foliage(sprite);
  Random random(static_cast<std::uint64_t>(sprite), Stream::environment);
  Level level(static_cast<std::size_t>(kLeafTexels) * kLeafTexels, LeafTexel{0, 128});
  for (int i = 0; i < leaves.count; ++i) {
    const Placed leaf =
        leaves.clumps > 0 ? place_in_clump(leaves, i, random) : place_on_bough(i, random);
    draw_leaf(leaves, leaf.base, leaf.angle, leaf.shade, level);
  }
  return level;
}

double covered_share(const Level& level, double threshold) {
  const auto covered = std::count_if(
      level.begin(), level.end(), [&](const LeafTexel& texel) { return texel.cover >= threshold; });
  return static_cast<double>(covered) / static_cast<double>(level.size());
}

/// Half as large: means, of the shade where there are leaves.
Level halved(const Level& fine, int size) {
  Level coarse;
  for (int y = 0; y < size / 2; ++y) {
    for (int x = 0; x < size / 2; ++x) {
      int cover = 0;
      int shade = 0;
      int plain = 0;
      for (const int row : {2 * y, 2 * y + 1}) {
        for (const int column : {2 * x, 2 * x + 1}) {
          const LeafTexel& texel =
              fine[static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
                   static_cast<std::size_t>(column)];
          cover += texel.cover;
          shade += texel.cover * texel.shade;
          plain += texel.shade;
        }
      }
      coarse.push_back({static_cast<std::uint8_t>(cover / 4),
                        static_cast<std::uint8_t>(cover > 0 ? shade / cover : plain / 4)});
    }
  }
  return coarse;
}

/// Scales the cover so that this share of the texels has half or more.
void keep_share(Level& level, double share) {
  double low = 0;
  double high = 255;
  for (int i = 0; i < 8; ++i) {
    const double middle = 0.5 * (low + high);
    (covered_share(level, middle) > share ? low : high) = middle;
  }
  for (LeafTexel& texel : level) {
    texel.cover =
        static_cast<std::uint8_t>(std::min(255.0, texel.cover * 128 / std::max(high, 1.0)));
  }
}

}  // namespace

std::vector<std::vector<LeafTexel>> draw_leaf_sprite(LeafSprite sprite) {
  return sprite_levels(draw_finest(sprite));
}

std::vector<std::vector<LeafTexel>> sprite_levels(std::vector<LeafTexel> finest) {
  std::vector<Level> levels = {std::move(finest)};
  const double share = covered_share(levels.front(), 128);
  std::vector<Level> shown = levels;
  for (int size = kLeafTexels; size > 1; size /= 2) {
    levels.push_back(halved(levels.back(), size));
    shown.push_back(levels.back());
    keep_share(shown.back(), share);
  }
  return shown;
}

}  // namespace throng::render
