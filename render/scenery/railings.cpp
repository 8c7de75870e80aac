#include "render/scenery/railings.h"

#include <algorithm>
#include <cmath>

#include "base/compute/random.h"
#include "render/frame/frame.h"
#include "render/props/prop_cells.h"
#include "render/scenery/surface_classes.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRailingPieceM = 10;

/// A footprint as a strip along its longest side.
struct Strip {
  Vector2d from = Vector2d::Zero();  ///< on its axis, m
  Vector2d along = Vector2d::UnitX();
  double length_m = 0;
  double width_m = 0;
};

Strip find_strip(const std::vector<Vector2d>& footprint) {
  Vector2d longest = Vector2d::Zero();
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Vector2d edge = footprint[(i + 1) % footprint.size()] - footprint[i];
    if (edge.norm() > longest.norm()) longest = edge;
  }
  const Vector2d u = longest.normalized();
  const Vector2d v(-u.y(), u.x());
  Eigen::AlignedBox2d bounds;
  for (const Vector2d& p : footprint) bounds.extend(Vector2d(p.dot(u), p.dot(v)));
  return {bounds.min().x() * u + bounds.center().y() * v, u, bounds.sizes().x(),
          bounds.sizes().y()};
}

/// A thin upright bar that is visible from both sides of the strip.
void add_bar(PropBuilder& builder, double x, double half_m, double low_m, double high_m,
             const Vector3d& paint) {
  const Vector3d a(x - half_m, 0, low_m);
  const Vector3d b(x + half_m, 0, low_m);
  const Vector3d c(x + half_m, 0, high_m);
  const Vector3d d(x - half_m, 0, high_m);
  builder.quad({a, b, c, d}, paint, Finish::matt);
  builder.quad({b, a, d, c}, paint, Finish::matt);
}

/// Bars, evenly spaced between the ends of a piece.
void add_bars(PropBuilder& builder, double length_m, double apart_m, double half_m, double low_m,
              double high_m, const Vector3d& paint) {
  builder.is_near = true;
  const double count = std::max(1.0, std::round(length_m / apart_m));
  for (double i = 0.5; i < count; ++i) {
    add_bar(builder, i / count * length_m, half_m, low_m, high_m, paint);
  }
  builder.is_near = false;
}

/// Posts at both ends of a piece and between them.
void add_posts(PropBuilder& builder, double length_m, double apart_m, double half_m, double high_m,
               const Vector3d& paint) {
  const double count = std::max(1.0, std::round(length_m / apart_m));
  for (double i = 0; i <= count; ++i) {
    const double x = i / count * length_m;
    builder.box({x - half_m, -half_m, 0}, {x + half_m, half_m, high_m}, paint);
  }
}

void add_railing(PropBuilder& builder, double length_m, double width_m, double high_m,
                 const Vector3d& paint) {
  const Vector3d stone(0.33, 0.32, 0.3);
  const double half_m = 0.5 * width_m;
  const double plinth_m = std::min(0.18, 0.25 * high_m);
  builder.box({0, -half_m, 0}, {length_m, half_m, plinth_m}, stone);
  builder.box({0, -0.04, high_m - 0.06}, {length_m, 0.04, high_m}, paint);
  builder.box({0, -0.02, plinth_m + 0.08}, {length_m, 0.02, plinth_m + 0.12}, paint);
  add_posts(builder, length_m, 2, 0.035, high_m - 0.06, paint);
  add_bars(builder, length_m, 0.115, 0.009, plinth_m + 0.12, high_m - 0.06, paint);
}

void add_fence(PropBuilder& builder, double length_m, double high_m, const Vector3d& paint,
               Random& random) {
  add_posts(builder, length_m, 2.5, 0.03, high_m, paint);
  for (const double z : {0.1, high_m - 0.06}) {
    builder.box({0, -0.02, z}, {length_m, 0.02, z + 0.04}, paint);
  }
  add_bars(builder, length_m, 0.1, 0.004, 0.14, high_m - 0.06, paint);
  builder.is_near = true;
  for (double z = 0.5; z < high_m - 0.3; z += 0.45) {
    builder.box({0, -0.006, z}, {length_m, 0.006, z + 0.012}, paint);
  }
  builder.is_near = false;
  // Cloth that keeps out wind and looks.
  const double panels = std::max(1.0, std::round(length_m / 2.5));
  for (double i = 0; i < panels; ++i) {
    constexpr double kClothShare = 0.4;
    if (random.uniform() > kClothShare) continue;
    const Vector3d cloth =
        random.uniform() < 0.75 ? Vector3d(0.03, 0.06, 0.04) : Vector3d(0.4, 0.4, 0.38);
    const double from = i / panels * length_m + 0.05;
    const double to = (i + 1) / panels * length_m - 0.05;
    for (const double side : {1.0, -1.0}) {
      const double y = 0.012 * side;
      const double a = side > 0 ? to : from;
      const double b = side > 0 ? from : to;
      builder.quad({Vector3d(a, y, 0.15), Vector3d(b, y, 0.15), Vector3d(b, y, high_m - 0.1),
                    Vector3d(a, y, high_m - 0.1)},
                   cloth, Finish::matt);
    }
  }
}

}  // namespace

bool has_no_walls(const world::Building& building) {
  return building.facade == world::Facade::railing || building.facade == world::Facade::fence ||
         building.facade == world::Facade::stand;
}

std::vector<PropMesh> railings(const world::Scenario& scenario, bool semantic) {
  std::vector<PropMesh> meshes;
  for (std::uint32_t i = 0; i < scenario.buildings.size(); ++i) {
    const world::Building& building = scenario.buildings[i];
    const bool is_fence = building.facade == world::Facade::fence;
    if (!is_fence && building.facade != world::Facade::railing) continue;
    const std::uint32_t id = kIdBuilding + i;
    PropCells cells(kRailingPieceM, semantic ? id_with_class(id, world::SemanticClass::wall) : id);
    const Strip strip = find_strip(building.footprint);
    const Vector3d paint = building.paint ? building.paint->matrix().cast<double>().eval()
                           : is_fence     ? Vector3d(0.36, 0.37, 0.38)
                                          : Vector3d(0.045, 0.055, 0.055);
    const double yaw_rad = std::atan2(strip.along.y(), strip.along.x());
    const double pieces = std::max(1.0, std::ceil(strip.length_m / kRailingPieceM));
    const double length_m = strip.length_m / pieces;
    Random random(i, Stream::environment, 0xFE2CE);
    for (double k = 0; k < pieces; ++k) {
      const Vector2d from = strip.from + k * length_m * strip.along;
      PropBuilder& builder = cells.at(from + 0.5 * length_m * strip.along);
      builder.placing = Eigen::Translation3d(from.x(), from.y(), 0) *
                        Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ());
      if (is_fence) {
        add_fence(builder, length_m, building.height_m, paint, random);
      } else {
        add_railing(builder, length_m, strip.width_m, building.height_m, paint);
      }
    }
    cells.take(meshes);
  }
  return meshes;
}

}  // namespace throng::render
