// Stands, tracks, railings, water and bridges: what they are made of, by measures of the world.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "render/frame/frame.h"
#include "render/scenery/place_meshes.h"
#include "render/scenery/railings.h"
#include "render/scenery/stands.h"
#include "render/scenery/tracks.h"
#include "world/stand_seats.h"

namespace throng::render {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

world::Scenario lawn() {
  world::Scenario scenario;
  scenario.ground = {{-30, -30}, {30, 30}};
  scenario.ground_material = "grass";
  scenario.inside.bounds = {{-5, -25}, {5, 25}};
  return scenario;
}

world::GroundArea box_area(const Vector2d& low, const Vector2d& high, const char* material) {
  world::GroundArea area;
  area.corners = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  area.material = material;
  return area;
}

template <typename Vertex>
Vector3d position(const Vertex& vertex) {
  return Eigen::Vector3f(vertex.position.data()).template cast<double>();
}

/// Area of a range's triangles as seen from above.
double area_m2(const SceneryMesh& mesh, const Range& range) {
  double sum = 0;
  for (std::uint32_t i = range.first; i < range.first + range.count; i += 3) {
    const Vector3d a = position(mesh.vertices[mesh.indices[i]]);
    const Vector3d u = position(mesh.vertices[mesh.indices[i + 1]]) - a;
    const Vector3d v = position(mesh.vertices[mesh.indices[i + 2]]) - a;
    sum += 0.5 * u.cross(v).z();
  }
  return sum;
}

std::vector<const PropMesh*> with_class(const PlaceMeshes& meshes, world::SemanticClass value) {
  std::vector<const PropMesh*> found;
  for (const PlacedProp& prop : meshes.props) {
    const std::uint32_t id = prop.mesh.vertices.front().id;
    if (!prop.is_backdrop && ((id >> 16U) & 0xFFU) == static_cast<std::uint32_t>(value)) {
      found.push_back(&prop.mesh);
    }
  }
  return found;
}

Eigen::AlignedBox3d bounds(const std::vector<const PropMesh*>& meshes) {
  Eigen::AlignedBox3d box;
  for (const PropMesh* mesh : meshes) {
    for (const PropVertex& vertex : mesh->vertices) box.extend(position(vertex));
  }
  return box;
}

TEST(Water, IsCutOutOfTheGroundAndOfAreasBelowIt) {
  world::Scenario scenario = lawn();
  scenario.areas = {box_area({-20, -10}, {20, 10}, "dirt"),
                    box_area({-7.3, -30}, {4.1, 30}, "water")};
  scenario.areas.back().level_m = -2;
  const PlaceMeshes meshes = place_meshes(scenario, true);
  EXPECT_NEAR(area_m2(meshes.scenery, meshes.scenery.ground), 60 * (60 - 11.4), 0.01);
  ASSERT_EQ(meshes.layers.size(), 1U);
  EXPECT_EQ(meshes.layers.front().material, "dirt");
  EXPECT_NEAR(area_m2(meshes.scenery, meshes.layers.front().range), 20 * (40 - 11.4), 0.01);
  const Eigen::AlignedBox3d surface = bounds(with_class(meshes, world::SemanticClass::water));
  EXPECT_NEAR(surface.max().z(), -2, 1e-6);
  EXPECT_NEAR(surface.sizes().x(), 11.4, 1e-5);
  const Eigen::AlignedBox3d walls = bounds(with_class(meshes, world::SemanticClass::bridge));
  EXPECT_LT(walls.min().z(), -2) << "the banks' walls reach below the surface";
  EXPECT_LE(walls.max().z(), 0.11) << "their ladders reach a little above the ground";
}

TEST(Water, OfAnyOutlineLeavesTheRestOfTheGround) {
  world::Scenario scenario = lawn();
  world::GroundArea lake;
  lake.material = "water";
  lake.level_m = -1;
  for (int i = 0; i < 9; ++i) {
    const double angle = 2 * std::numbers::pi * i / 9;
    const double radius = i % 2 == 0 ? 12 : 7;  // not convex
    lake.corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  double lake_m2 = 0;
  for (std::size_t i = 0; i < lake.corners.size(); ++i) {
    const Vector2d& a = lake.corners[i];
    const Vector2d& b = lake.corners[(i + 1) % lake.corners.size()];
    lake_m2 += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  scenario.areas = {lake};
  const PlaceMeshes meshes = place_meshes(scenario, false);
  EXPECT_NEAR(area_m2(meshes.scenery, meshes.scenery.ground), 3600 - lake_m2, 0.01);
}

TEST(Water, CarriesWhatFloatsAtItsLevel) {
  world::Scenario scenario = lawn();
  scenario.areas = {box_area({-10, -10}, {10, 10}, "water")};
  scenario.areas.back().level_m = -3;
  world::Prop boat;
  boat.kind = world::PropKind::rowboat;
  scenario.props = {boat};
  const PlaceMeshes meshes = place_meshes(scenario, true);
  const Eigen::AlignedBox3d hull = bounds(with_class(meshes, world::SemanticClass::boat));
  EXPECT_LT(hull.min().z(), -2.9);
  EXPECT_LT(hull.max().z(), -1.5);
}

TEST(Bridges, LieBelowAreasOverWaterAndNowhereElse) {
  for (const double level_m : {-3.2, -1.2}) {  // arches; girders
    SCOPED_TRACE(level_m);
    world::Scenario scenario = lawn();
    scenario.areas = {box_area({-20, -30}, {20, 30}, "water"),
                      box_area({-25, -2}, {25, 2}, "concrete")};
    scenario.areas.front().level_m = level_m;
    const auto parts_below_the_deck = [&] {
      std::size_t below = 0;
      const PlaceMeshes meshes = place_meshes(scenario, true);
      for (const PropMesh* mesh : with_class(meshes, world::SemanticClass::bridge)) {
        for (const PropVertex& vertex : mesh->vertices) {
          const Vector3d at = position(vertex);
          below += std::abs(at.x()) < 15 && std::abs(at.y()) < 5 ? 1U : 0U;
          EXPECT_LE(at.z(), 0.11);
        }
      }
      return below;
    };
    EXPECT_GT(parts_below_the_deck(), 40U);
    std::swap(scenario.areas[0], scenario.areas[1]);  // the water cuts the path off
    EXPECT_EQ(parts_below_the_deck(), 0U);
  }
}

TEST(Tracks, HaveTheGaugeOfRailways) {
  world::Marking track;
  track.kind = "track";
  track.from = {-40, 5};
  track.to = {40, 5};
  std::set<int> edges_mm;
  for (const PropMesh& mesh : make_track(track, kIdProp)) {
    for (const PropVertex& vertex : mesh.vertices) {
      if (std::abs(position(vertex).z() - kRailTopM) > 0.003) continue;
      edges_mm.insert(static_cast<int>(std::lround(1000 * std::abs(position(vertex).y() - 5))));
    }
  }
  ASSERT_FALSE(edges_mm.empty());
  EXPECT_NEAR(*edges_mm.begin(), 1435 / 2, 1);
}

TEST(Pitches, HaveTheLinesOfTheLawsOfTheGame) {
  world::Scenario scenario = lawn();
  scenario.ground = {{-70, -50}, {70, 50}};
  world::Marking pitch;
  pitch.kind = "pitch";
  pitch.from = {-52.5, 0};
  pitch.to = {52.5, 0};
  pitch.width_m = 68;
  scenario.markings = {pitch};
  const PlaceMeshes meshes = place_meshes(scenario, false);
  double paint_m2 = 0;
  for (const GroundLayer& layer : meshes.layers) {
    if (layer.material == "paint") paint_m2 += area_m2(meshes.scenery, layer.range);
  }
  const double pi = std::numbers::pi;
  const double penalty_arc_m = 2 * 9.15 * std::acos(5.5 / 9.15);
  const double length_m = 2 * 105 + 3 * 68 + 2 * (2 * 16.5 + 40.32 + 2 * 5.5 + 18.32) +
                          2 * pi * 9.15 + 2 * penalty_arc_m + 4 * 0.5 * pi;
  EXPECT_NEAR(paint_m2 / 0.12, length_m, 0.01 * length_m);
}

TEST(Railings, HaveBarsThatNobodyFallsThrough) {
  world::Scenario scenario = lawn();
  world::Building rail;
  rail.footprint = {{-10, 2}, {10, 2}, {10, 2.25}, {-10, 2.25}};
  rail.height_m = 1.1;
  rail.facade = world::Facade::railing;
  scenario.buildings = {rail};
  std::set<int> bars_mm;
  for (const PropMesh& mesh : railings(scenario, false)) {
    for (std::size_t i = mesh.far_indices; i < mesh.indices.size(); ++i) {
      bars_mm.insert(
          static_cast<int>(std::lround(1000 * position(mesh.vertices[mesh.indices[i]]).x())));
    }
    for (const PropVertex& vertex : mesh.vertices) EXPECT_EQ(vertex.id, kIdBuilding);
  }
  for (auto bar = bars_mm.begin(); std::next(bar) != bars_mm.end(); ++bar) {
    EXPECT_LE(*std::next(bar) - *bar, 120);
  }
  const PlaceMeshes meshes = place_meshes(scenario, false);
  EXPECT_EQ(meshes.scenery.walls.count, 0U);
}

world::Stand end_stand() {
  world::Stand stand;
  stand.id = "north";
  stand.from = {-30, 20};
  stand.to = {30, 20};
  stand.rows = 16;
  stand.vomitories = 2;
  return stand;
}

TEST(Stands, HaveOneSeatForEachNearByAndFewTrianglesFarAway) {
  const world::Stand stand = end_stand();
  const double seats = static_cast<double>(world::seats(stand).size());
  std::size_t far = 0;
  std::size_t near = 0;
  std::size_t single = 0;
  for (const PropMesh& mesh : make_stand(stand, kIdProp)) {
    far += mesh.far_indices / 3;
    near += (mesh.indices.size() - mesh.only_far) / 3;
    single += (mesh.indices.size() - mesh.far_indices) / 3;
  }
  EXPECT_GT(static_cast<double>(single), 7 * seats) << "a shell of four faces each";
  EXPECT_LT(static_cast<double>(far), 3.5 * seats);
  EXPECT_LT(far, near);
}

TEST(Stands, StandOnTheirOutlineWithTheirRowsAtTheirHeights) {
  world::Stand stand = end_stand();
  stand.from = {12, -7};
  stand.to = {-20, 30};  // askew
  constexpr double kStepsM = 0.8;
  std::map<int, double> tread_m2;
  for (const PropMesh& mesh : make_stand(stand, kIdProp)) {
    for (const PropVertex& vertex : mesh.vertices) {
      const Vector2d at = world::frame_point(stand, position(vertex).head<2>());
      EXPECT_GT(at.y(), -kStepsM);
      EXPECT_LT(at.y(), world::depth_m(stand) + 0.6);
      EXPECT_GT(at.x(), -0.3);
      EXPECT_LT(at.x(), world::length_m(stand) + 0.3);
    }
    for (std::size_t i = 0; i + 2 < mesh.far_indices; i += 3) {
      const Vector3d a = position(mesh.vertices[mesh.indices[i]]);
      const Vector3d b = position(mesh.vertices[mesh.indices[i + 1]]);
      const Vector3d c = position(mesh.vertices[mesh.indices[i + 2]]);
      if (std::abs(a.z() - b.z()) > 1e-4 || std::abs(a.z() - c.z()) > 1e-4) continue;
      tread_m2[static_cast<int>(std::lround(1000 * a.z()))] += 0.5 * (b - a).cross(c - a).z();
    }
  }
  for (int row = 0; row < stand.rows; ++row) {
    const int z_mm = static_cast<int>(std::lround(1000 * world::row_height_m(stand, row)));
    const bool is_open =
        row >= world::kVomitoryFirstRow && row < world::kVomitoryFirstRow + world::kVomitoryRows;
    const double wide = world::length_m(stand) - (is_open ? 2 * world::kVomitoryWidthM : 0);
    // The floor of an opening is as high as the row before it.
    const bool is_before = row + 1 == world::kVomitoryFirstRow;
    const double floors_m = is_before ? 2 * world::kVomitoryWidthM * world::kVomitoryRows : 0;
    EXPECT_NEAR(tread_m2[z_mm], (wide + floors_m) * stand.row_depth_m, 0.05 * wide) << row;
  }
}

TEST(Stands, WriteTheirTextWithSeatsOfTheLastColor) {
  world::Stand stand = end_stand();
  const auto last = [](const world::Stand& s) {
    std::size_t count = 0;
    for (const PropMesh& mesh : make_stand(s, kIdProp)) {
      for (std::size_t i = 0; i < mesh.only_far; ++i) {
        const auto& paint = mesh.vertices[mesh.indices[i]].paint;
        count += paint[0] > 100 && paint[0] > 3 * paint[2] ? 1U : 0U;
      }
    }
    return count;
  };
  stand.colors = {{0.1F, 0.1F, 0.3F}, {0.8F, 0.2F, 0.05F}};
  EXPECT_EQ(last(stand), 0U);
  stand.text = "HOME";
  EXPECT_GT(last(stand), 100U);
}

}  // namespace
}  // namespace throng::render
