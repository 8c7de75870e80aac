#include "render/props/leaf_sprites.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

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
};

Foliage foliage(LeafSprite sprite) {
  switch (sprite) {
    case LeafSprite::small:
      return {230, 0.075, 0.62, 0.3, 0.8};
    case LeafSprite::narrow:
      return {150, 0.15, 0.27, 0.7, 1.2};
    case LeafSprite::needles:
      return {560, 0.085, 0.13, 0.85, 0.6};
    case LeafSprite::crown:
      return {1500, 0.042, 0.7, 0.4, 0.8};
    case LeafSprite::broad:
      break;
  }
  return {115, 0.125, 0.6, 0.5, 0.9};
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

/// A place in one of the clumps of a crown, which give it an uneven outline with gaps.
Vector2d place_in_clump(int leaf, Random& random) {
  constexpr int kClumps = 13;
  constexpr double kClumpSize = 0.13;
  const int clump = leaf % kClumps;
  const double away = 0.31 * std::sqrt((clump + 0.5) / kClumps);
  const double turn = clump * std::numbers::pi * (3 - std::sqrt(5.0));
  const double off = kClumpSize * std::sqrt(random.uniform());
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  return Vector2d(0.5, 0.5) + away * Vector2d(std::cos(turn), std::sin(turn)) +
         off * Vector2d(std::cos(angle), std::sin(angle));
}

Level draw_finest(LeafSprite sprite) {
  const Foliage leaves = foliage(sprite);
  Random random(static_cast<std::uint64_t>(sprite), Stream::environment);
  Level level(static_cast<std::size_t>(kLeafTexels) * kLeafTexels, LeafTexel{0, 128});
  for (int i = 0; i < leaves.count; ++i) {
    // From the rim inwards: leaves in the middle are in front and get more light.
    const double share = 1 - static_cast<double>(i) / leaves.count;
    const double radius = (0.47 - leaves.length) * std::sqrt(share) + 0.03;
    double around = random.uniform(0, 2 * std::numbers::pi);
    double turn = (1 - leaves.outward) * random.uniform(-std::numbers::pi, std::numbers::pi);
    if (sprite == LeafSprite::needles) {
      // Along twigs, to both sides.
      constexpr int kTwigs = 9;
      const auto twig = static_cast<double>(random.below(kTwigs));
      around = (twig + random.uniform(-0.1, 0.1)) * 2 * std::numbers::pi / kTwigs;
      turn = random.uniform() < 0.5 ? 0.7 : -0.7;
    }
    Vector2d base = Vector2d(0.5, 0.5) + radius * Vector2d(std::cos(around), std::sin(around));
    if (sprite == LeafSprite::crown) base = place_in_clump(i, random);
    const double shade = random.uniform(95, 165) * (1.1 - 0.3 * share);
    draw_leaf(leaves, base, around + turn, shade, level);
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
  std::vector<Level> levels = {draw_finest(sprite)};
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
