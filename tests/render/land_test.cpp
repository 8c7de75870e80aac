// Leaves of hedges, bushes and planters, and what stands on the land beyond a scenario.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/geometry/polygon.h"
#include "render/ground/ground_layers.h"
#include "render/scenery/far_land.h"
#include "render/scenery/hedges.h"
#include "render/scenery/land_pattern.h"
#include "render/scenery/scenery.h"
#include "render/scenery/surface_classes.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

using Eigen::Vector2d;

constexpr double kHedgeM = 1.4;

world::Scenario with_hedge() {
  world::Building hedge = block(6, 6.6, -10, 10, kHedgeM);
  hedge.facade = world::Facade::hedge;
  return open_ground({block(20, 30, -5, 5, 6), hedge});
}

std::size_t count_triangles(const std::vector<PropMesh>& meshes) {
  std::size_t corners = 0;
  for (const PropMesh& mesh : meshes) corners += mesh.indices.size();
  return corners / 3;
}

Eigen::AlignedBox3d find_bounds(const std::vector<PropMesh>& meshes) {
  Eigen::AlignedBox3d box;
  for (const PropMesh& mesh : meshes) {
    for (const PropVertex& vertex : mesh.vertices) {
      box.extend(Eigen::Vector3f(vertex.position.data()).cast<double>());
    }
  }
  return box;
}

TEST(Hedges, HaveLeavesThatStayWithinReachAndBelongToTheirBuildings) {
  const world::Scenario scenario = with_hedge();
  const std::vector<PropMesh> meshes = hedge_leaves(scenario, false);
  ASSERT_GT(count_triangles(meshes), 600U);
  for (const PropMesh& mesh : meshes) {
    for (const PropVertex& vertex : mesh.vertices) {
      ASSERT_EQ(vertex.id, kIdBuilding + 1);
      const Eigen::Vector3d at = Eigen::Vector3f(vertex.position.data()).cast<double>();
      ASSERT_LE(geometry::signed_distance_to(scenario.buildings[1].footprint, at.head<2>()), 0.08);
      ASSERT_GE(at.z(), 0);
      ASSERT_LE(at.z(), kHedgeM + 0.08);
    }
  }
  const std::uint32_t classified = id_with_class(kIdBuilding + 1, world::SemanticClass::hedge);
  EXPECT_EQ(hedge_leaves(scenario, true).front().vertices.front().id, classified);
}

TEST(Hedges, CostNoMoreCardsThanTheirCap) {
  world::Scenario scenario = with_hedge();
  scenario.buildings[1] = block(-500, 500, 0, 3, 3);
  scenario.buildings[1].facade = world::Facade::hedge;
  EXPECT_LT(count_triangles(hedge_leaves(scenario, false)), 2 * 4200U);
}

TEST(Hedges, HaveARaggedOutline) {
  Stage stage(with_hedge());
  const camera::Camera camera = camera_at({0, 0, 1.6}, 0, 0, 640, 480, 40);
  const Frame frame = stage.draw(camera);
  std::set<int> tops;
  for (int x = 100; x < 540; ++x) {
    int y = 0;
    while (y < frame.height() && frame.id[pixel_index(frame, x, y)] != kIdBuilding + 1) ++y;
    tops.insert(y);
  }
  EXPECT_GT(tops.size(), 6U) << "rows at which the hedge begins";
  const world::Building inside = without_leaves(with_hedge().buildings[1]);
  EXPECT_LT(inside.height_m, kHedgeM);
  EXPECT_LT(geometry::signed_area(inside.footprint), 0.9 * 0.6 * 20);
  EXPECT_EQ(without_leaves(with_hedge().buildings[0]).height_m, 6);
}

TEST(Plants, StayOnTheGroundThatTheirKindCovers) {
  for (const world::PropKind kind : {world::PropKind::bush, world::PropKind::planter}) {
    std::set<std::size_t> sizes;
    for (std::uint32_t look = 0; look < 30; ++look) {
      world::Prop prop;
      prop.kind = kind;
      prop.look = look;
      const PropMesh mesh = prop_shape(prop, kIdProp);
      const Eigen::AlignedBox3d box = find_bounds({mesh});
      const Vector2d half = world::prop_type(kind).half_size;
      EXPECT_LE(box.max().x(), half.x() + 0.3) << look;
      EXPECT_LE(box.max().y(), half.y() + 0.3) << look;
      EXPECT_GE(box.min().z(), 0) << look;
      EXPECT_GT(box.max().z(), 0.5) << look;
      EXPECT_LT(box.max().z(), 1.8) << look;
      sizes.insert(mesh.indices.size());
    }
    EXPECT_GE(sizes.size(), 3U) << "looks";
  }
}

TEST(LandPattern, IsTheSameBothWays) {
  for (const Vector2d& point : {Vector2d(0, 0), Vector2d(310.5, -77), Vector2d(-820, 640)}) {
    EXPECT_LT((ground_from_land(land_from_ground(point)) - point).norm(), 0.01);
  }
  const Field field = field_at({123, 456});
  EXPECT_LE(field.begin_m, 123);
  EXPECT_GT(field.begin_m + field.length_m, 123);
  EXPECT_EQ(field.number.y(), 3);
}

class FarLand : public ::testing::Test {
 protected:
  world::Scenario scenario_ = open_ground();
};

TEST_F(FarLand, KeepsAwayFromTheGroundItsStreetsAndMeshes) {
  scenario_.areas = {{{{-40, -4}, {40, -4}, {40, 4}, {-40, 4}}, "asphalt", false}};
  const Eigen::AlignedBox2d river(Vector2d(-1000, 60), Vector2d(1000, 200));
  const std::vector<PropMesh> meshes = far_land(scenario_, {river});
  const auto streets = streets_beyond(scenario_, 0);
  ASSERT_EQ(streets.size(), 2U);
  const Eigen::AlignedBox2d ground(scenario_.ground.min, scenario_.ground.max);
  for (const PropMesh& mesh : meshes) {
    for (const PropVertex& vertex : mesh.vertices) {
      const Vector2d at = Eigen::Vector3f(vertex.position.data()).head<2>().cast<double>();
      ASSERT_GT(ground.exteriorDistance(at), kMinLandM - 6);
      ASSERT_LT(ground.exteriorDistance(at), kMaxLandM + 6);
      for (const auto& street : streets) ASSERT_GT(geometry::distance_to(street, at), 0);
      ASSERT_FALSE(river.contains(at));
    }
  }
}

TEST_F(FarLand, IsATownBetweenTallHousesAndVillagesElsewhere) {
  const std::vector<PropMesh> villages = far_land(scenario_, {});
  for (int i = 0; i < 4; ++i) {
    scenario_.buildings.push_back(block(9.0 * i - 20, 9.0 * i - 14, 0, 6, 12));
  }
  const std::vector<PropMesh> town = far_land(scenario_, {});
  EXPECT_GT(count_triangles(villages), 5'000U);
  EXPECT_LT(count_triangles(villages), 30'000U);
  EXPECT_LT(count_triangles(town), 30'000U);
  const auto high_corners = [](const std::vector<PropMesh>& meshes) {
    std::size_t count = 0;
    for (const PropMesh& mesh : meshes) {
      count += static_cast<std::size_t>(
          std::count_if(mesh.vertices.begin(), mesh.vertices.end(), [](const PropVertex& vertex) {
            return vertex.position[2] > 9 &&
                   vertex.paint[3] == static_cast<std::uint8_t>(Finish::matt);
          }));
    }
    return count;
  };
  EXPECT_GT(high_corners(town), 5 * high_corners(villages)) << "blocks of flats";
}

TEST_F(FarLand, IsABackdropThatLabelsDoNotShow) {
  Stage stage(scenario_);
  const Frame frame = stage.draw(camera_at({0, 0, 4}, 0, 0, 640, 480));
  // Above the horizon, below the hills' highest, the sky is brighter than houses and trees.
  int dark = 0;
  for (int y = 200; y < 235; ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const std::size_t i = pixel_index(frame, x, y);
      ASSERT_EQ(frame.id[i], kIdNothing);
      ASSERT_TRUE(std::isinf(frame.depth_m[i]));
      dark += frame.rgb[3 * i] < 130 ? 1 : 0;
    }
  }
  EXPECT_GT(dark, 300);
  EXPECT_EQ(tallest_m(scenario_), 2.5);
}

/// A triangle of the land beyond, and how it looks.
struct FarTriangle {
  std::array<Eigen::Vector3d, 3> corners;
  bool is_green = false;
  bool is_leaf = false;
};

std::vector<FarTriangle> list_triangles(const std::vector<PropMesh>& meshes) {
  std::vector<FarTriangle> all;
  for (const PropMesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      FarTriangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const PropVertex& vertex = mesh.vertices[mesh.indices[i + k]];
        triangle.corners[k] = Eigen::Vector3f(vertex.position.data()).cast<double>();
        triangle.is_green = vertex.paint[1] > 1.1 * vertex.paint[0];
        triangle.is_leaf = vertex.paint[3] == static_cast<std::uint8_t>(Finish::leaves);
      }
      all.push_back(triangle);
    }
  }
  return all;
}

/// Distance along a ray to a triangle (Moeller and Trumbore, 1997); infinite if it misses.
double distance_to(const FarTriangle& triangle, const Eigen::Vector3d& from,
                   const Eigen::Vector3d& direction) {
  const Eigen::Vector3d a = triangle.corners[1] - triangle.corners[0];
  const Eigen::Vector3d b = triangle.corners[2] - triangle.corners[0];
  const Eigen::Vector3d p = direction.cross(b);
  const double scale = a.dot(p);
  if (std::abs(scale) < 1e-12) return INFINITY;
  const Eigen::Vector3d off = from - triangle.corners[0];
  const double u = off.dot(p) / scale;
  const double v = direction.dot(off.cross(a)) / scale;
  const double distance = b.dot(off.cross(a)) / scale;
  return u < 0 || v < 0 || u + v > 1 || distance <= 0 ? INFINITY : distance;
}

TEST_F(FarLand, HousesHideWhatIsBehindThem) {
  for (int i = 0; i < 4; ++i) {
    scenario_.buildings.push_back(block(9.0 * i - 20, 9.0 * i - 14, 0, 6, 12));
  }
  const Eigen::Vector3d eye(0, 0, 45);
  const camera::Camera camera = camera_at(eye, 30, -14, 480, 320);
  const std::vector<FarTriangle> triangles = list_triangles(far_land(scenario_, {}));
  Stage stage(scenario_);
  const Frame frame = stage.draw(camera);
  int walls = 0;
  int green_walls = 0;
  for (int y = 0; y < frame.height(); y += 6) {
    for (int x = 0; x < frame.width(); x += 6) {
      const Eigen::Vector3d direction = camera.unproject({x + 0.0, y + 0.0}, 1) - eye;
      double wall_m = INFINITY;
      double green_m = INFINITY;
      double leaf_m = INFINITY;
      for (const FarTriangle& triangle : triangles) {
        const double distance = distance_to(triangle, eye, direction);
        double& nearest = triangle.is_leaf ? leaf_m : triangle.is_green ? green_m : wall_m;
        nearest = std::min(nearest, distance);
      }
      // Only where the wrong one of two could be seen.
      if (leaf_m < wall_m || !std::isfinite(green_m) || wall_m > green_m - 0.5) continue;
      const std::size_t i = 3 * pixel_index(frame, x, y);
      if (frame.id[i / 3] != kIdNothing && frame.id[i / 3] < kIdGround) continue;
      ++walls;
      green_walls += frame.rgb[i + 1] > frame.rgb[i] + 6 ? 1 : 0;
    }
  }
  EXPECT_GT(walls, 50);
  EXPECT_LT(green_walls, walls / 20);
}

TEST(GroundLayers, PathsGoOnAsNarrowTracksAndRoadsAsTheyAre) {
  world::Scenario scenario = open_ground();
  scenario.areas = {{{{-40, -4}, {40, -4}, {40, 4}, {-40, 4}}, "asphalt", false}};
  EXPECT_EQ(streets_beyond(scenario, 0).size(), 2U);
  scenario.areas[0].material = "dirt";
  const auto track = streets_beyond(scenario, 0);
  ASSERT_GT(track.size(), 4U);
  for (const auto& part : track) {
    EXPECT_EQ(part.size(), 4U);
    EXPECT_GT(geometry::signed_area(part), 0);
  }
  EXPECT_NEAR((track.front()[0] - track.front()[1]).norm(), 8, 0.1);
  EXPECT_NEAR((track[3][2] - track[3][3]).norm(), 3, 0.1);
}

TEST(GroundLayers, KnowHowFarTheOutlineOfAWideAreaIs) {
  const auto farthest = [](double width_m) {
    world::Scenario scenario = open_ground();
    scenario.areas = {{{{-10, 0}, {10, 0}, {10, width_m}, {-10, width_m}}, "grass", false}};
    SceneryMesh mesh;
    add_ground_layers(scenario, mesh);
    float most = 0;
    for (const SceneryVertex& vertex : mesh.vertices) most = std::max(most, vertex.local[1]);
    // No triangle lies on the outline with all of its corners.
    for (std::size_t i = 0; i < mesh.indices.size() && most > 0; i += 3) {
      float inside = 0;
      for (std::size_t k = i; k < i + 3; ++k) {
        inside = std::max(inside, mesh.vertices[mesh.indices[k]].local[1]);
      }
      EXPECT_GT(inside, 1.01F) << i;
    }
    return most;
  };
  EXPECT_GT(farthest(20), 8);
  EXPECT_EQ(farthest(4), 0) << "narrow";
}

TEST(GroundLayers, ThatMeetHaveHeightsOfTheirOwn) {
  world::Scenario scenario = open_ground();
  for (int i = 0; i < 9; ++i) {
    const double x = 4.0 * i - 20;
    scenario.areas.push_back({{{x, 0}, {x + 2, 0}, {x + 2, 9}, {x, 9}}, "dirt", false});
  }
  scenario.areas.push_back({{{-20, 3}, {20, 3}, {20, 6}, {-20, 6}}, "grass", false});
  SceneryMesh mesh = scenery_mesh(scenario);
  const auto layers = add_ground_layers(scenario, mesh);
  const auto height = [&](const GroundLayer& layer) {
    return mesh.vertices[mesh.indices[layer.range.first]].position[2];
  };
  for (const GroundLayer& layer : layers) {
    if (layer.material != "dirt") continue;
    EXPECT_LT(height(layer), height(layers.front()));
  }
}

}  // namespace
}  // namespace throng::render
