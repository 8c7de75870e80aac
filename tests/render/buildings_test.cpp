// Roofs and fronts of buildings as geometry, without rendering.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "render/buildings/building_mesh.h"
#include "render/buildings/facade_details.h"
#include "render/buildings/facade_style.h"
#include "render/buildings/roof_details.h"
#include "world/scenario.h"

namespace throng::render {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using world::RoofKind;

constexpr double kHeightM = 11;

world::Building house(std::vector<Vector2d> footprint, RoofKind kind) {
  world::Building building;
  building.id = "house";
  building.footprint = std::move(footprint);
  building.height_m = kHeightM;
  building.facade = world::Facade::plaster;
  building.roof.kind = kind;
  return building;
}

const std::vector<Vector2d> kBox = {{0, 0}, {16, 0}, {16, 9}, {0, 9}};
const std::vector<Vector2d> kAngle = {{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 18}, {0, 18}};
const std::vector<Vector2d> kSlanted = {{0, 0}, {15, 2}, {14, 11}, {-1, 8}};

double plan_m2(const RoofSurface& surface) {
  std::vector<Vector2d> plan;
  for (const Vector3d& corner : surface.corners) plan.emplace_back(corner.head<2>());
  return geometry::signed_area(plan);
}

RoofShape shape_with(const world::Building& building) {
  return roof_shape(building, building_look(building, 0));
}

double lowest_eaves_m(const RoofShape& shape) {
  double low = kHeightM;
  for (const RoofSurface& surface : shape.surfaces) {
    for (const Vector3d& corner : surface.corners) low = std::min(low, corner.z());
  }
  return low;
}

class RoofKinds : public testing::TestWithParam<RoofKind> {};

TEST_P(RoofKinds, CoverTheFootprintUpToTheHeight) {
  for (const auto& footprint : {kBox, kAngle, kSlanted}) {
    const RoofShape shape = shape_with(house(footprint, GetParam()));
    double covered_m2 = 0;
    double top_m = 0;
    for (const RoofSurface& surface : shape.surfaces) {
      for (const Vector3d& corner : surface.corners) {
        EXPECT_LT(geometry::signed_distance_to(footprint, corner.head<2>()), 1e-6);
        EXPECT_GT(corner.z(), 2.6) << "a story remains below";
        top_m = std::max(top_m, corner.z());
      }
      if (surface.part == RoofPart::covering) {
        EXPECT_GT(plan_m2(surface), 0) << "seen from above";
        covered_m2 += plan_m2(surface);
      } else if (surface.part == RoofPart::coping) {
        covered_m2 += std::abs(plan_m2(surface));
      } else {
        EXPECT_NEAR(plan_m2(surface), 0, 1e-6) << "upright";
      }
    }
    EXPECT_NEAR(covered_m2, geometry::signed_area(footprint), 1e-3);
    EXPECT_NEAR(top_m, kHeightM, 1e-6);
  }
}

TEST_P(RoofKinds, HaveTheHeightThatTheFileSays) {
  if (GetParam() == RoofKind::flat) return;
  world::Building building = house(kBox, GetParam());
  building.roof.height_m = 2.5;
  EXPECT_NEAR(lowest_eaves_m(shape_with(building)), kHeightM - 2.5, 1e-6);
}

TEST_P(RoofKinds, HaveDetailsOnThem) {
  for (std::uint32_t number = 0; number < 40; ++number) {
    const world::Building building = house(kBox, GetParam());
    const PropMesh mesh = roof_details(building_model(building, number), 7);
    for (const PropVertex& vertex : mesh.vertices) {
      const Vector2d at(vertex.position[0], vertex.position[1]);
      EXPECT_LT(geometry::signed_distance_to(kBox, at), 0.25);
      EXPECT_LT(vertex.position[2], kHeightM + kMaxAboveRoofM);
      EXPECT_GT(vertex.position[2], 2.6);
      EXPECT_EQ(vertex.id, 7U);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, RoofKinds,
                         testing::Values(RoofKind::flat, RoofKind::gabled, RoofKind::hipped,
                                         RoofKind::half_hipped, RoofKind::mansard, RoofKind::shed,
                                         RoofKind::sawtooth, RoofKind::pyramid, RoofKind::dome));

/// The normal of the first slope above a wall.
Vector3d slope_normal(const RoofShape& shape, std::size_t wall) {
  for (const RoofSurface& surface : shape.surfaces) {
    if (surface.wall != wall || surface.part != RoofPart::covering) continue;
    return (surface.corners[1] - surface.corners[0])
        .cross(surface.corners[2] - surface.corners[0])
        .normalized();
  }
  return Vector3d::Zero();
}

TEST(Roofs, HaveThePitchThatTheFileSays) {
  world::Building building = house(kBox, RoofKind::gabled);
  building.roof.pitch_rad = 30 * kDegree;
  const RoofShape shape = shape_with(building);
  EXPECT_NEAR(std::acos(slope_normal(shape, 0).z()), 30 * kDegree, 1e-6);
  EXPECT_EQ(std::count_if(shape.surfaces.begin(), shape.surfaces.end(),
                          [](const auto& each) { return each.part == RoofPart::gable; }),
            2);
}

TEST(Roofs, ShedsFallAsTheFileSays) {
  for (const double falls_deg : {0.0, 90.0, 180.0, -90.0}) {
    world::Building building = house(kBox, RoofKind::shed);
    building.roof.falls_rad = falls_deg * kDegree;
    const RoofShape shape = shape_with(building);
    ASSERT_EQ(shape.eaves.size(), 1U);
    const Vector3d normal = slope_normal(shape, shape.eaves.front());
    EXPECT_NEAR(std::remainder(std::atan2(normal.y(), normal.x()) - falls_deg * kDegree,
                               2 * std::numbers::pi),
                0, 1e-6);
  }
}

TEST(Roofs, AreFlatWhereTheFootprintAllowsNothingElse) {
  std::vector<Vector2d> comb;
  for (int i = 0; i < 40; ++i) comb.insert(comb.end(), {{2.0 * i, 9}, {2.0 * i + 1, 3}});
  std::reverse(comb.begin(), comb.end());
  comb.insert(comb.end(), {{0, 0}, {80, 0}});
  const RoofShape shape = shape_with(house(comb, RoofKind::hipped));
  EXPECT_TRUE(shape.is_flat);
  EXPECT_FALSE(shape.surfaces.empty());
}

TEST(BuildingLooks, AreMixedByNumber) {
  std::map<world::Facade, int> facades;
  std::map<RoofKind, int> roofs;
  for (std::uint32_t number = 0; number < 300; ++number) {
    world::Building building = house(kBox, RoofKind::by_id);
    building.facade = world::Facade::by_id;
    const BuildingLook look = building_look(building, number);
    ++facades[look.facade];
    ++roofs[look.roof];
  }
  EXPECT_GE(facades.size(), 4U);
  EXPECT_GE(roofs.size(), 5U);
  EXPECT_LT(roofs[RoofKind::flat], 120);
}

TEST(BuildingLooks, NeighboringFrontsHaveOtherColors) {
  for (std::uint32_t number = 0; number < 50; ++number) {
    for (std::uint32_t front = 0; front < 8; ++front) {
      EXPECT_FALSE((front_paint(world::Facade::plaster, number, front) ==
                    front_paint(world::Facade::plaster, number, front + 1))
                       .all());
    }
  }
}

TEST(BuildingLooks, FileDecides) {
  world::Building building = house(kBox, RoofKind::hipped);
  building.paint = Paint(0.1F, 0.2F, 0.3F);
  building.roof.paint = Paint(0.3F, 0.2F, 0.1F);
  building.roof.covering = world::Covering::grass;
  const BuildingModel model = building_model(building, 5);
  EXPECT_TRUE((model.look.roof_paint == *building.roof.paint).all());
  EXPECT_EQ(model.look.covering, world::Covering::grass);
  for (const Front& front : model.fronts) EXPECT_TRUE((front.paint == *building.paint).all());
}

TEST(Fronts, AddUpToTheirWalls) {
  const world::Building building = house({{0, 0}, {50, 0}, {50, 9}, {0, 9}}, RoofKind::flat);
  const BuildingModel model = building_model(building, 3);
  double length_m = 0;
  for (const Front& front : model.fronts) length_m += front.length_m;
  EXPECT_NEAR(length_m, 2 * 50 + 2 * 9, 1e-9);
  EXPECT_GT(model.fronts.size(), 8U) << "a long wall is several houses";
}

TEST(FacadeDetails, KeepClearOfPeopleAndOfExits) {
  constexpr double kHeadM = 2.1;
  constexpr double kStepM = 0.31;
  world::Scenario scenario;
  world::Exit& door = scenario.exits.emplace_back();
  door.from = {7, 0};
  door.to = {9, 0};
  std::size_t total = 0;
  for (std::uint32_t number = 0; number < 60; ++number) {
    world::Building building = house(kBox, RoofKind::gabled);
    building.facade = world::Facade::by_id;
    const PropMesh mesh = facade_details(building_model(building, number), scenario, 9, 9);
    total += mesh.indices.size() / 3;
    for (const PropVertex& vertex : mesh.vertices) {
      const Vector2d at(vertex.position[0], vertex.position[1]);
      const double out_m = geometry::signed_distance_to(kBox, at);
      EXPECT_LT(out_m, vertex.position[2] < kHeadM ? kStepM : 1.3);
      EXPECT_LT(vertex.position[2], kHeightM + 0.01);
      const bool is_low = vertex.position[2] < 3.5 && vertex.position[2] > 0.01;
      const bool is_by_door = std::abs(at.x() - 8) < 1 && at.y() < -0.2;
      EXPECT_FALSE(is_low && is_by_door) << at.transpose() << " " << vertex.position[2];
    }
  }
  EXPECT_GT(total, 60U * 100);
  EXPECT_LT(total, 60U * 3000);
}

}  // namespace
}  // namespace throng::render
