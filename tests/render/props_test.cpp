// Props and layers of the ground on pixels.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <set>
#include <string>

#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/angle.h"
#include "render/props/prop_shapes.h"
#include "render/props/vehicles.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

using world::Prop;
using world::PropKind;

Prop prop_at(PropKind kind, double x, double y, double yaw_deg = 0) {
  Prop prop;
  prop.kind = kind;
  prop.position = {x, y};
  prop.yaw_rad = yaw_deg * kDegree;
  prop.look = 4;
  return prop;
}

world::Scenario ground_with(std::vector<Prop> props) {
  world::Scenario scenario = open_ground();
  scenario.props = std::move(props);
  return scenario;
}

bool covers(const std::array<Eigen::Vector2d, 3>& triangle, const Eigen::Vector2d& p) {
  int sides = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d edge = triangle[(i + 1) % 3] - triangle[i];
    const Eigen::Vector2d to = p - triangle[i];
    sides += edge.x() * to.y() - edge.y() * to.x() >= 0 ? 1 : -1;
  }
  return std::abs(sides) == 3;
}

/// Pixels whose middle some projected triangle of the prop covers.
std::set<std::size_t> projected(const Prop& prop, const camera::Camera& camera) {
  const PropMesh mesh = prop_shape(prop, kIdProp);
  std::set<std::size_t> pixels;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::array<Eigen::Vector2d, 3> triangle;
    Eigen::AlignedBox2d box;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& p = mesh.vertices[mesh.indices[i + k]].position;
      triangle[k] = camera.project({p[0], p[1], p[2]}).pixel;
      box.extend(triangle[k]);
    }
    for (int y = static_cast<int>(std::ceil(box.min().y())); y <= box.max().y(); ++y) {
      for (int x = static_cast<int>(std::ceil(box.min().x())); x <= box.max().x(); ++x) {
        if (!covers(triangle, Eigen::Vector2d(x, y))) continue;
        pixels.insert(static_cast<std::size_t>(y) *
                          static_cast<std::size_t>(camera.intrinsics.width) +
                      static_cast<std::size_t>(x));
      }
    }
  }
  return pixels;
}

class PropOutline : public testing::TestWithParam<PropKind> {};

TEST_P(PropOutline, IdsCoverTheProjectedMesh) {
  const Prop prop = prop_at(GetParam(), 9, 0.4, 25);
  Stage stage(ground_with({prop}));
  const camera::Camera camera = camera_at({0, 0, 6}, 0, -25, 640, 480);
  const Frame frame = stage.draw(camera);
  const std::set<std::size_t> expected = projected(prop, camera);
  std::size_t wrong = 0;
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < frame.id.size(); ++i) {
    const bool is_prop = frame.id[i] == kIdProp;
    drawn += is_prop ? 1 : 0;
    wrong += is_prop != (expected.count(i) == 1) ? 1 : 0;
  }
  EXPECT_GT(drawn, 100U);
  // If an edge passes within 1/256 pixel of a pixel's center, either answer is right.
  EXPECT_LE(wrong, drawn / 100);
}

using Triangle = std::array<Eigen::Vector3d, 3>;

std::vector<Triangle> list_triangles(const PropMesh& mesh) {
  std::vector<Triangle> triangles(mesh.indices.size() / 3);
  for (std::size_t k = 0; k < mesh.indices.size(); ++k) {
    const auto& p = mesh.vertices[mesh.indices[k]].position;
    triangles[k / 3][k % 3] = {p[0], p[1], p[2]};
  }
  return triangles;
}

/// Distance along a ray to a triangle (Moeller and Trumbore 1997), or infinity.
double distance_along(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                      const Triangle& triangle) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d a = triangle[1] - triangle[0];
  const Eigen::Vector3d b = triangle[2] - triangle[0];
  const Eigen::Vector3d p = direction.cross(b);
  const double determinant = a.dot(p);
  if (std::abs(determinant) < 1e-12) return kNever;
  const Eigen::Vector3d to = from - triangle[0];
  const double u = to.dot(p) / determinant;
  const Eigen::Vector3d q = to.cross(a);
  const double v = direction.dot(q) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return kNever;
  const double distance = b.dot(q) / determinant;
  return distance > 0 ? distance : kNever;
}

TEST_P(PropOutline, DepthIsThatOfCastRays) {
  const Prop prop = prop_at(GetParam(), 9, 0.4, 25);
  Stage stage(ground_with({prop}));
  const camera::Camera camera = camera_at({0, 0, 6}, 0, -25, 320, 240);
  const Frame frame = stage.draw(camera);
  const std::vector<Triangle> triangles = list_triangles(prop_shape(prop, kIdProp));
  const Eigen::Vector3d eye = camera.pose.center();
  int compared = 0;
  int wrong = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const std::size_t i = pixel_index(frame, x, y);
      if (frame.id[i] != kIdProp && frame.id[i] != kIdGround) continue;
      // At depth 1 along the pixel's ray, so that distances are depths.
      const Eigen::Vector3d ray = camera.unproject({x, y}, 1.0) - eye;
      double nearest = -eye.z() / ray.z();
      for (const Triangle& triangle : triangles) {
        nearest = std::min(nearest, distance_along(eye, ray, triangle));
      }
      ++compared;
      wrong += std::abs(frame.depth_m[i] - nearest) > 0.003 + 1e-4 * nearest ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 20'000);
  // Rays that pass an edge within the rasterizer's rounding may meet either side of it.
  EXPECT_LT(wrong, 60);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PropOutline,
                         testing::Values(PropKind::bench, PropKind::lamp_post, PropKind::bin,
                                         PropKind::car, PropKind::bollard, PropKind::stall,
                                         PropKind::barrier, PropKind::kiosk, PropKind::tent,
                                         PropKind::fountain));

TEST(Props, HaveIdsOfTheirOwnAndTreesHaveTransparentCrowns) {
  const Prop tree = prop_at(PropKind::tree, 12, 0);
  Stage stage(ground_with({tree, prop_at(PropKind::car, 9, 4), prop_at(PropKind::car, 9, -4)}));
  const camera::Camera camera = camera_at({0, 0, 7}, 0, -20, 640, 480);
  const Frame frame = stage.draw(camera);
  EXPECT_GT(instance_mask(frame, kIdProp + 1).pixels, 1000U);
  EXPECT_GT(instance_mask(frame, kIdProp + 2).pixels, 1000U);
  const double shown = static_cast<double>(instance_mask(frame, kIdProp).pixels);
  const auto outline = static_cast<double>(projected(tree, camera).size());
  EXPECT_GT(shown, 0.5 * outline);
  EXPECT_LT(shown, 0.97 * outline);
}

TEST(Props, HidePeopleWhoseWholeOutlineIsStillKnown) {
  Stage alone(ground_with({}));
  Stage behind(ground_with({prop_at(PropKind::car, 9, 0, 90)}));
  const camera::Camera camera = camera_at({0, 0, 2}, 0, -5, 640, 480);
  const Frame free = alone.draw(camera, {alone.standing(0, 11, 0)});
  const Frame hidden = behind.draw(camera, {behind.standing(0, 11, 0)});
  EXPECT_LT(instance_mask(hidden, id_of_agent(0)).pixels,
            0.8 * instance_mask(free, id_of_agent(0)).pixels);
  EXPECT_GT(instance_mask(hidden, id_of_agent(0)).pixels, 0U);
  EXPECT_EQ(find_person(hidden, 0).amodal_area_px, find_person(free, 0).amodal_area_px);
}

TEST(Props, CastShadows) {
  Environment light;
  light.sun_azimuth_rad = 0;
  light.sun_elevation_rad = 45 * kDegree;
  Stage empty(ground_with({}), light);
  Stage stage(ground_with({prop_at(PropKind::tree, 0, 0)}), light);
  const camera::Camera camera = camera_at({0, 0, 30}, 0, -90);
  const Frame before = empty.draw(camera);
  const Frame after = stage.draw(camera);
  const auto darkened = [&](double x) {
    int sum = 0;
    for (int dy = -2; dy <= 2; ++dy) {
      const Eigen::Vector2d pixel = camera.project({x, 0, 0}).pixel;
      const int column = static_cast<int>(std::lround(pixel.x()));
      const int row = static_cast<int>(std::lround(pixel.y())) + dy;
      sum += brightness(before, column, row) - brightness(after, column, row);
    }
    return sum / 5;
  };
  EXPECT_GT(darkened(-4), 60) << "the crown's shadow, as far away as it is high";
  EXPECT_NEAR(darkened(5), 0, 8)
      << "towards the sun, less of the sky, but for light from the trunk";
}

// The sky that a round foot hides is hidden from a ring around it, not from a square.
TEST(Props, DarkenTheGroundAroundARoundFootEquallyOnAllSides) {
  Environment light;
  light.weather = Weather::overcast;
  light.sun_elevation_rad = 89.9 * kDegree;
  RenderOptions options;
  options.quality = Quality::standard;
  world::Scenario scenario = ground_with({});
  scenario.ground_material = "dirt";  // on which no wet patches show
  Stage empty(scenario, light, options);
  scenario.props = {prop_at(PropKind::fountain, 0, 0)};
  Stage stage(scenario, light, options);
  const camera::Camera camera = camera_at({0, 0, 14}, 0, -90, 480, 480, 40);
  const Frame before = empty.draw(camera);
  const Frame after = stage.draw(camera);
  const auto darkened = [&](double radius_m, double turn_deg) {
    const Eigen::Vector3d place(radius_m * std::cos(turn_deg * kDegree),
                                radius_m * std::sin(turn_deg * kDegree), 0);
    const Eigen::Vector2d pixel = camera.project(place).pixel;
    const int x = static_cast<int>(std::lround(pixel.x()));
    const int y = static_cast<int>(std::lround(pixel.y()));
    return brightness(before, x, y) - brightness(after, x, y);
  };
  for (const double turn_deg : {0.0, 30.0, 45.0, 60.0, 135.0, 250.0}) {
    EXPECT_NEAR(darkened(2.85, turn_deg), 20, 20) << turn_deg;
    EXPECT_NEAR(darkened(3.1, turn_deg), 10, 15) << turn_deg;
  }
}

/// A tetrahedron of 2 units, y up, of a red material, as files in a folder of its own.
class MeshFile : public testing::Test {
 protected:
  MeshFile() {
    std::filesystem::create_directories(folder_);
    write_file_atomically(folder_ / "t.mtl", "newmtl red\nKd 0.8 0.05 0.05\n");
    write_file_atomically(folder_ / "t.obj",
                          "mtllib t.mtl\nusemtl red\nv -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 2 0\n"
                          "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
    write_file_atomically(folder_ / "bad.obj", "not a mesh");
  }
  ~MeshFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("throng-mesh-" + std::to_string(::getpid()));
};

TEST_F(MeshFile, StandsUprightWhereTheScenarioPutsIt) {
  world::Scenario scenario = ground_with({prop_at(PropKind::bin, 30, 30)});
  scenario.meshes = {{folder_ / "t.obj", {10, 1, 0}, 0.3, 1.5}};
  Stage stage(scenario);
  const camera::Camera camera = camera_at({0, 0, 3}, 0, -10, 640, 480);
  const Frame frame = stage.draw(camera);
  const Mask mask = instance_mask(frame, kIdProp + 1);
  ASSERT_GT(mask.pixels, 1000U);
  const Eigen::Vector2d tip = camera.project({10, 1, 3}).pixel;
  EXPECT_NEAR(mask.box.min().y(), tip.y() + 0.5, 1.5) << "2 units of 1.5 m high";
  const Eigen::Vector2d inside = camera.project({10, 1, 1}).pixel;
  const std::size_t i =
      3 * pixel_index(frame, static_cast<int>(inside.x()), static_cast<int>(inside.y()));
  EXPECT_GT(frame.rgb[i], 2 * frame.rgb[i + 2]) << "red";
}

TEST_F(MeshFile, IsAVehicleWhoseFootIsThatOfItsShape) {
  world::Scenario scenario = open_ground();
  scenario.meshes = {{folder_ / "t.obj", {10, 1, 0}, 0.3, 1.5}};
  scenario.meshes[0].semantic_class = world::SemanticClass::car;
  ASSERT_EQ(vehicle_count(scenario), 1U);
  const Vehicle car = list_vehicles(scenario).at(0);
  EXPECT_EQ(car.id, kIdProp);
  EXPECT_NEAR(car.position.z(), 0, 1e-6);
  // Its shape reaches 1.5 m to one side of its origin, 3 m wide: turned by 0.3 about it.
  Eigen::AlignedBox2d around;
  for (const PropVertex& vertex : car.mesh.vertices) {
    around.extend(Eigen::Vector2d(vertex.position[0], vertex.position[1]));
  }
  EXPECT_TRUE(around.contains(Eigen::Vector2d(car.position.head<2>())));
}

TEST_F(MeshFile, BadFilesAreNamed) {
  world::Scenario scenario = open_ground();
  scenario.meshes = {{folder_ / "bad.obj", {10, 0, 0}, 0, 1}};
  EXPECT_THROW(Stage{scenario}, InputError);
}

TEST(Facades, LookDifferent) {
  std::set<std::string> images;
  for (const auto facade : {world::Facade::plaster, world::Facade::brick, world::Facade::glass}) {
    world::Building building = block(12, 20, -10, 10, 10);
    building.facade = facade;
    Stage stage(open_ground({building}));
    const Frame frame = stage.draw(camera_at({0, 0, 5}, 0, 0));
    images.emplace(frame.rgb.begin(), frame.rgb.end());
  }
  EXPECT_EQ(images.size(), 3U);
}

TEST(GroundLayers, LieOnTheGroundAndShowTheirMaterials) {
  world::Scenario scenario = open_ground();
  scenario.ground_material = "asphalt";
  scenario.areas = {{{{5, -5}, {15, -5}, {15, 0}, {5, 0}}, "grass", true}};
  scenario.markings = {{"crossing", {5, 5}, {15, 5}, 4}};
  Stage stage(scenario);
  const camera::Camera camera = camera_at({10, 0, 20}, 0, -90, 640, 480);
  const Frame frame = stage.draw(camera);
  const auto color = [&](double x, double y) {
    const Eigen::Vector2d pixel = camera.project({x, y, 0}).pixel;
    const std::size_t i = 3 * pixel_index(frame, static_cast<int>(std::lround(pixel.x())),
                                          static_cast<int>(std::lround(pixel.y())));
    return Eigen::Vector3i(frame.rgb[i], frame.rgb[i + 1], frame.rgb[i + 2]);
  };
  const Eigen::Vector3i asphalt = color(10, 9);
  EXPECT_GT(color(10, -2.5).y(), color(10, -2.5).z() + 20) << "grass is green";
  EXPECT_NEAR(asphalt.y(), asphalt.z(), 8);
  int bars = 0;
  for (int i = 0; i < 10; ++i) {
    bars += color(5.25 + i, 5).sum() > color(5.75 + i, 5).sum() + 60 ? 1 : 0;
  }
  EXPECT_GE(bars, 7) << "paint, worn here and there, and gaps";
  for (const std::uint32_t id : frame.id) ASSERT_EQ(id, kIdGround);
  for (const float depth : frame.depth_m) {
    ASSERT_NEAR(depth, 20, 0.0021 + 0.05) << "the kerb around grass stands up";
  }
}

}  // namespace
}  // namespace throng::render
