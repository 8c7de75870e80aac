#include "render/scenery/far_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using Paints = std::array<std::array<double, 3>, 6>;

constexpr Paints kPlasters = {{{0.36, 0.33, 0.27},
                               {0.40, 0.385, 0.35},
                               {0.33, 0.27, 0.19},
                               {0.27, 0.265, 0.25},
                               {0.21, 0.115, 0.08},
                               {0.34, 0.29, 0.22}}};
constexpr Paints kTiles = {{{0.21, 0.095, 0.06},
                            {0.17, 0.085, 0.06},
                            {0.12, 0.115, 0.11},
                            {0.15, 0.10, 0.075},
                            {0.10, 0.10, 0.105},
                            {0.23, 0.115, 0.075}}};
const Vector3d kPane(0.045, 0.052, 0.06);
const Vector3d kFlatRoof(0.24, 0.235, 0.23);
const Vector3d kShade(0.045, 0.055, 0.028);
const Vector3d kBush(0.045, 0.065, 0.026);

Vector3d choose(const Paints& paints, Random& random) {
  return random.uniform(0.85, 1.12) *
         Vector3d(paints[random.below(static_cast<std::uint32_t>(paints.size()))].data());
}

/// A house's surfaces in its own frame: x along the ridge, y across, z up.
class HouseBuilder {
 public:
  HouseBuilder(PropBuilder& builder, const FarHouse& house, Random& random)
      : builder_(builder), house_(house), random_(random) {
    wall_ = choose(kPlasters, random_);
    roof_ = choose(kTiles, random_);
  }

  void build() {
    const double eaves_m = kStoryM * house_.stories;
    add_walls(eaves_m);
    house_.has_flat_roof ? add_flat_roof(eaves_m) : add_pitched_roof(eaves_m);
    const Vector2d rim = house_.half_size + Vector2d::Constant(2.2);
    constexpr double kAboveM = 0.04;
    quad({-rim.x(), -rim.y(), kAboveM}, {rim.x(), -rim.y(), kAboveM}, {rim.x(), rim.y(), kAboveM},
         {-rim.x(), rim.y(), kAboveM}, kShade);
    add_bushes();
    if (house_.detail != FarDetail::far) add_windows();
  }

 private:
  static constexpr double kStoryM = 2.9;

  Vector3d placed(const Vector3d& p) const {
    const Vector2d turned = Eigen::Rotation2Dd(house_.yaw_rad) * p.head<2>();
    return {house_.middle.x() + turned.x(), house_.middle.y() + turned.y(), p.z()};
  }

  void quad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
            const Vector3d& paint) {
    builder_.quad({placed(a), placed(b), placed(c), placed(d)}, paint, Finish::matt);
  }

  /// A rectangle on one of the four walls: 0 and 2 along x, 1 and 3 along y, counted from the one
  /// that faces -y; from one place along it to another.
  void panel(int wall, double from, double to, double low, double high, double off,
             const Vector3d& paint) {
    const auto at = [&](double along, double z) -> Vector3d {
      const Vector2d& half = house_.half_size;
      switch (wall) {
        case 0:
          return {along, -half.y() - off, z};
        case 1:
          return {half.x() + off, along, z};
        case 2:
          return {-along, half.y() + off, z};
        default:
          return {-half.x() - off, -along, z};
      }
    };
    quad(at(from, low), at(to, low), at(to, high), at(from, high), paint);
  }

  double half_length(int wall) const {
    return wall % 2 == 0 ? house_.half_size.x() : house_.half_size.y();
  }

  void add_walls(double eaves_m) {
    constexpr double kFootM = 0.7;  // darker by splashes, bushes and the shade at its foot
    for (int wall = 0; wall < 4; ++wall) {
      const double half = half_length(wall);
      panel(wall, -half, half, 0, kFootM, 0, 0.5 * wall_);
      panel(wall, -half, half, kFootM, eaves_m, 0, wall_);
    }
  }

  void add_windows() {
    // Bands for all windows of a story, which piers divide near by.
    const bool has_bands = house_.has_flat_roof || house_.detail == FarDetail::middle;
    const bool has_piers = has_bands && house_.detail == FarDetail::near;
    for (int wall = 0; wall < 4; ++wall) {
      const double half = half_length(wall);
      const int windows = std::max(1, static_cast<int>(2 * half / (has_bands ? 2.6 : 3.2)));
      const double apart = 2 * half / windows;
      for (int story = 0; story < house_.stories; ++story) {
        const double low = kStoryM * story + 0.95;
        if (has_bands) panel(wall, 0.6 - half, half - 0.6, low, low + 1.35, 0.04, kPane);
        for (int i = 0; i < windows && !has_bands; ++i) {
          const double middle = -half + (i + 0.5) * apart;
          if (random_.uniform() < 0.12) continue;
          panel(wall, middle - 0.55, middle + 0.55, low, low + 1.25, 0.04, kPane);
        }
      }
      for (int i = 1; i < windows && has_piers; ++i) {
        const double middle = -half + i * apart;
        panel(wall, middle - 0.5, middle + 0.5, 0.7, kStoryM * house_.stories - 0.3, 0.08, wall_);
      }
    }
  }

  /// Bushes and fences before the walls: without them houses seem to float over their gardens.
  void add_bushes() {
    for (int wall = 0; wall < 4; ++wall) {
      const double half = half_length(wall) + 1.4;
      const double from = random_.uniform(-1, 0.1) * half;
      const double to = from + random_.uniform(0.5, 0.9) * half;
      panel(wall, from, to, 0, random_.uniform(0.9, 1.8), 1.8, random_.uniform(0.7, 1.3) * kBush);
    }
  }

  void add_flat_roof(double eaves_m) {
    const Vector2d& half = house_.half_size;
    for (int wall = 0; wall < 4; ++wall) {
      panel(wall, -half_length(wall), half_length(wall), eaves_m, eaves_m + 0.5, 0, 0.8 * wall_);
    }
    const double z = eaves_m + 0.5;
    quad({-half.x(), -half.y(), z}, {half.x(), -half.y(), z}, {half.x(), half.y(), z},
         {-half.x(), half.y(), z}, random_.uniform(0.8, 1.2) * kFlatRoof);
  }

  void add_pitched_roof(double eaves_m) {
    constexpr double kOverM = 0.5;
    const Vector2d half = house_.half_size + Vector2d::Constant(kOverM);
    const double slope = random_.uniform(0.65, 0.95);
    const double ridge_m = eaves_m + slope * house_.half_size.y();
    const double low_m = eaves_m - slope * kOverM;
    const bool is_hipped = random_.uniform() < 0.3;
    const double ridge_x = is_hipped ? std::max(0.5, half.x() - 0.8 * half.y()) : half.x();
    for (const double side : {-1.0, 1.0}) {
      const auto at = [&](double x, double y, double z) -> Vector3d {
        return {side * x, side * y, z};
      };
      quad(at(-half.x(), -half.y(), low_m), at(half.x(), -half.y(), low_m), at(ridge_x, 0, ridge_m),
           at(-ridge_x, 0, ridge_m), roof_);
      const double gable_x = is_hipped ? half.x() : house_.half_size.x();
      const double gable_y = is_hipped ? half.y() : house_.half_size.y();
      const Vector3d top = at(is_hipped ? ridge_x : gable_x, 0, ridge_m);
      const double gable_low_m = is_hipped ? low_m : eaves_m;
      quad(at(gable_x, -gable_y, gable_low_m), at(gable_x, gable_y, gable_low_m), top, top,
           is_hipped ? roof_ : wall_);
    }
    if (house_.detail != FarDetail::near) return;
    const double x = random_.uniform(-0.5, 0.5) * half.x();
    for (const Vector2d& side :
         {Vector2d(0, -1), Vector2d(1, 0), Vector2d(0, 1), Vector2d(-1, 0)}) {
      const Vector3d across = 0.35 * Vector3d(-side.y(), side.x(), 0);
      const Vector3d foot(x + 0.35 * side.x(), 0.35 * side.y(), ridge_m - 0.8);
      const Vector3d up(0, 0, 1.7);
      quad(foot - across, foot + across, foot + across + up, foot - across + up, 0.7 * roof_);
    }
  }

  PropBuilder& builder_;
  const FarHouse& house_;
  Random& random_;
  Vector3d wall_;
  Vector3d roof_;
};

/// A card whose corners are lit as those of a ball around `heart`.
void add_round_card(PropBuilder& builder, const Vector3d& middle, const Vector3d& u,
                    const Vector3d& v, const Vector3d& heart, const Vector3d& paint) {
  const std::array<Vector3d, 4> corners = {middle - u - v, middle + u - v, middle + u + v,
                                           middle - u + v};
  std::array<Vector3d, 4> normals;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normals[i] = ((corners[i] - heart).normalized() + Vector3d(0, 0, 0.35)).normalized();
  }
  builder.leaves(corners, normals, paint, LeafSprite::crown);
}

}  // namespace

void add_far_house(PropBuilder& builder, const FarHouse& house, Random& random) {
  HouseBuilder(builder, house, random).build();
}

void add_far_tree(PropBuilder& builder, const FarTree& tree, Random& random) {
  const Vector3d green = random.uniform(0.6, 1.05) * Vector3d(0.05 + 0.035 * random.uniform(),
                                                              0.08 + 0.02 * random.uniform(),
                                                              0.024 + 0.01 * random.uniform());
  // Crowns without a trunk reach down to the ground.
  const double crown_share = tree.detail == FarDetail::near ? 0.82 : 0.97;
  const double crown_half = 0.5 * std::max(1.2, crown_share * tree.height_m);
  const Vector3d heart(tree.middle.x(), tree.middle.y(), tree.height_m - crown_half);
  const double turn = random.uniform(0, std::numbers::pi);
  const auto across = [&](double angle) { return Vector3d(std::cos(angle), std::sin(angle), 0); };
  // Upright cards that cross show the crown from the side.
  const int upright = tree.detail == FarDetail::near ? 3 : 2;
  for (int i = 0; i < upright; ++i) {
    const double angle = turn + i * std::numbers::pi / upright;
    add_round_card(builder, heart, tree.crown_m * across(angle), {0, 0, crown_half}, heart,
                   0.8 * green);
  }
  // Tilted ones on the outside give it lobes and a top.
  const int lobes = tree.detail == FarDetail::far ? 0 : tree.detail == FarDetail::middle ? 1 : 5;
  for (int i = 0; i < lobes; ++i) {
    const double angle = turn + i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double up = -0.35 + 1.2 * (i + random.uniform()) / lobes;
    const double ring = std::sqrt(std::max(0.1, 1 - up * up));
    const Vector3d out = (ring * across(angle) + Vector3d(0, 0, up)).normalized();
    const Vector3d off =
        0.55 * Vector3d(tree.crown_m * out.x(), tree.crown_m * out.y(), crown_half * out.z());
    const Vector3d u = 0.62 * tree.crown_m * out.unitOrthogonal();
    const Vector3d v = out.cross(u);
    add_round_card(builder, heart + off, u, v, heart, (0.85 + 0.3 * up) * green);
  }
  // The shade below it, and the trunk.
  if (tree.detail == FarDetail::far) return;
  const Vector3d foot(tree.middle.x(), tree.middle.y(), 0.06);
  builder.leaves({foot - tree.crown_m * across(turn), foot - tree.crown_m * across(turn + 1.57),
                  foot + tree.crown_m * across(turn), foot + tree.crown_m * across(turn + 1.57)},
                 Vector3d::UnitZ(), kShade, LeafSprite::crown);
  if (tree.detail != FarDetail::near) return;
  const double thick = 0.02 * tree.height_m;
  builder.tube({foot.x(), foot.y(), 0}, thick, {foot.x(), foot.y(), 0.6 * tree.height_m},
               0.5 * thick, {0.09, 0.075, 0.06}, Finish::matt, 4);
}

}  // namespace throng::render
