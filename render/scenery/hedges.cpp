#include "render/scenery/hedges.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/polygon.h"
#include "base/geometry/triangulate.h"
#include "render/frame/frame.h"
#include "render/ground/ground_tone.h"
#include "render/props/prop_cells.h"
#include "render/scenery/surface_classes.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector3d kHedgeGreen(0.062, 0.108, 0.031);

double perimeter_m(const std::vector<Vector2d>& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    sum += (outline[(i + 1) % outline.size()] - outline[i]).norm();
  }
  return sum;
}

/// All edges of an outline moved inwards.
std::vector<Vector2d> moved_inwards(const std::vector<Vector2d>& outline, double by_m) {
  std::vector<Vector2d> moved;
  const std::size_t count = outline.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d before = (outline[i] - outline[(i + count - 1) % count]).normalized();
    const Vector2d after = (outline[(i + 1) % count] - outline[i]).normalized();
    const Vector2d inwards(-before.y() - after.y(), before.x() + after.x());
    // Both edges move by the same distance, but those of very pointed corners by less.
    moved.push_back(outline[i] + 2 * by_m / std::max(0.5, inwards.squaredNorm()) * inwards);
  }
  return moved;
}

/// The leaves of one hedge, by cells of the ground.
class HedgePlanter {
 public:
  HedgePlanter(const world::Building& hedge, std::uint32_t number, std::uint32_t id)
      : hedge_(hedge), random_(number, Stream::environment, 0x4ED6E), cells_(kCellM, id) {
    const double top_m2 = geometry::signed_area(hedge.footprint);
    const double wanted = kCardsPerM2 * (top_m2 + perimeter_m(hedge.footprint) * hedge.height_m);
    thinned_ = std::min(1.0, kMaxCards / std::max(wanted, 1.0));
    // Fewer cards are larger, so that they cover as much.
    half_m_ = std::min(kMaxCardM, kCardM / std::sqrt(thinned_));
  }

  void plant_walls() {
    const std::vector<Vector2d>& outline = hedge_.footprint;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector2d& from = outline[i];
      const Vector2d edge = outline[(i + 1) % outline.size()] - from;
      const Vector3d out(edge.y() / edge.norm(), -edge.x() / edge.norm(), 0);
      const int count = cards_on(edge.norm() * hedge_.height_m);
      for (int k = 0; k < count; ++k) {
        const Vector2d at = from + (k + random_.uniform()) / count * edge;
        plant({at.x(), at.y(), random_.uniform(0, hedge_.height_m)}, out);
      }
    }
  }

  void plant_top() {
    for (const auto& triangle : geometry::triangulate(hedge_.footprint)) {
      const Vector2d& a = hedge_.footprint[triangle[0]];
      const Vector2d u = hedge_.footprint[triangle[1]] - a;
      const Vector2d v = hedge_.footprint[triangle[2]] - a;
      const int count = cards_on(0.5 * std::abs(geometry::cross(u, v)));
      for (int k = 0; k < count; ++k) {
        const double root = std::sqrt(random_.uniform());
        const double share = random_.uniform();
        const Vector2d at = a + root * (1 - share) * u + root * share * v;
        plant({at.x(), at.y(), hedge_.height_m}, Vector3d::UnitZ());
      }
    }
  }

  void take(std::vector<PropMesh>& meshes) { cells_.take(meshes); }

 private:
  static constexpr double kCardsPerM2 = 13;
  static constexpr double kCardM = 0.27;  ///< half the side of a card
  static constexpr double kMaxCardM = 0.45;
  static constexpr double kMaxCards = 4000;
  static constexpr double kCellM = 12;

  int cards_on(double area_m2) {
    return static_cast<int>(kCardsPerM2 * thinned_ * area_m2 + random_.uniform());
  }

  /// Adds a card on a surface, some of its corners inside the hedge and none farther out of it than
  /// leaves reach.
  void plant(Vector3d at, const Vector3d& out) {
    const auto jitter = [&] {
      return Vector3d(random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1));
    };
    const double half = half_m_ * random_.uniform(0.75, 1);
    const Vector3d facing = (out + 0.45 * jitter()).normalized();
    const double turn = random_.uniform(0, std::numbers::pi);
    const Vector3d side = facing.unitOrthogonal();
    const Vector3d u = half * (std::cos(turn) * side + std::sin(turn) * facing.cross(side));
    const Vector3d v = facing.cross(u);
    const Vector3d surface = at;
    at += random_.uniform(-0.07, 0.04) * out;
    if (out.z() == 0) at.z() = std::clamp(at.z(), 0.6 * half, hedge_.height_m - 0.4 * half);
    const double share = std::clamp(at.z() / hedge_.height_m, 0.0, 1.0);
    const double tone = 2 * ground_tone_at(7 * at.head<2>()) - 1;
    const double light =
        (0.42 + 0.58 * share) * random_.uniform(0.78, 1.22) * std::clamp<double>(tone, 0.6, 1.4);
    const Vector3d yellow(1 + 0.25 * random_.uniform(), 1, 1);
    const Vector3d normal = (out + Vector3d(0, 0, 0.25) + 0.35 * jitter()).normalized();
    std::array<Vector3d, 4> corners = {at - u - v, at + u - v, at + u + v, at - u + v};
    for (Vector3d& corner : corners) keep_within(surface, out, at, corner);
    cells_.at(at.head<2>())
        .leaves(corners, normal, (light * kHedgeGreen).cwiseProduct(yellow), LeafSprite::small);
  }

  /// Bends a card so that its corner is not farther out of the hedge than leaves reach.
  void keep_within(const Vector3d& surface, const Vector3d& out, const Vector3d& middle,
                   Vector3d& corner) const {
    const double beyond = (corner - surface).dot(out) - kMaxLeafReachM;
    if (beyond > 0) corner -= beyond * out;
    corner.z() = std::clamp(corner.z(), 0.01, hedge_.height_m + kMaxLeafReachM);
    constexpr int kHalvings = 4;
    for (int i = 0; i < kHalvings; ++i) {
      const double off = geometry::signed_distance_to(hedge_.footprint, corner.head<2>());
      if (off <= kMaxLeafReachM) return;
      corner.head<2>() = 0.5 * (corner.head<2>() + middle.head<2>());
    }
    corner.head<2>() = surface.head<2>();
  }

  const world::Building& hedge_;
  Random random_;
  double thinned_ = 1;
  double half_m_ = kCardM;
  PropCells cells_;
};

}  // namespace

world::Building without_leaves(const world::Building& building) {
  constexpr double kInsideM = 0.1;
  if (building.facade != world::Facade::hedge) return building;
  world::Building inside = building;
  const double thickness_m =
      2 * geometry::signed_area(building.footprint) / perimeter_m(building.footprint);
  double by_m = std::min(kInsideM, 0.15 * thickness_m);
  for (std::size_t i = 0; i < building.footprint.size(); ++i) {
    const Vector2d& next = building.footprint[(i + 1) % building.footprint.size()];
    by_m = std::min(by_m, 0.2 * (next - building.footprint[i]).norm());
  }
  inside.footprint = moved_inwards(building.footprint, by_m);
  inside.height_m = std::max(0.5 * building.height_m, building.height_m - kInsideM);
  return inside;
}

std::vector<PropMesh> hedge_leaves(const world::Scenario& scenario, bool semantic) {
  std::vector<PropMesh> meshes;
  for (std::uint32_t i = 0; i < scenario.buildings.size(); ++i) {
    const world::Building& building = scenario.buildings[i];
    if (building.facade != world::Facade::hedge || building.footprint.size() < 3) continue;
    const std::uint32_t id = kIdBuilding + i;
    HedgePlanter planter(building, i,
                         semantic ? id_with_class(id, world::SemanticClass::hedge) : id);
    planter.plant_walls();
    planter.plant_top();
    planter.take(meshes);
  }
  return meshes;
}

}  // namespace throng::render
