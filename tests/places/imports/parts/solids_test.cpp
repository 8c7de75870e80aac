// Bodies as triangles: volumes by the divergence theorem against formulas, and meshes written and
// read again by a small reader of OBJ.
#include "places/imports/parts/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/polygon.h"
#include "places/imports/gazebo/mesh_reader.h"
#include "places/imports/parts/mesh_text.h"
#include "tests/places/imports/parts/box.h"
#include "tests/world/temporary_folder.h"

namespace throng::imports {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using throng::testing::TemporaryFolder;

/// Positive where all triangles face outwards.
double enclosed_volume(const Triangles& triangles) {
  double volume = 0;
  for (const auto& [a, b, c] : triangles) volume += a.dot(b.cross(c)) / 6;
  return volume;
}

double surface_area(const Triangles& triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) area += (b - a).cross(c - a).norm() / 2;
  return area;
}

/// Area of the regular polygon of 24 corners that stands for a circle.
double round_m2(double radius) {
  return 12 * radius * radius * std::sin(2 * std::numbers::pi / 24);
}

TEST(BoxTriangles, HaveVolumeAndSurface) {
  const Triangles box = box_triangles({2, 3, 4});
  EXPECT_EQ(box.size(), 12);
  EXPECT_NEAR(enclosed_volume(box), 24, 1e-9);
  EXPECT_NEAR(surface_area(box), 2 * (6 + 8 + 12), 1e-9);
  for (const Triangle& triangle : box) {
    for (const Vector3d& corner : triangle) {
      EXPECT_EQ(corner.cwiseAbs(), Vector3d(1, 1.5, 2)) << "about the origin";
    }
  }
}

TEST(PrismTriangles, HaveVolume) {
  EXPECT_NEAR(enclosed_volume(prism_triangles(circle(Vector2d::Zero(), 2), 0, 5)), round_m2(2) * 5,
              1e-9);
  EXPECT_NEAR(enclosed_volume(prism_triangles(circle(Vector2d::Zero(), 2), 0, 5)),
              std::numbers::pi * 4 * 5, 1)
      << "about a circle";
}

TEST(ConeTriangles, HaveAThirdOfTheCylinder) {
  const Triangles cone = cone_triangles(2, 5);
  EXPECT_NEAR(enclosed_volume(cone), round_m2(2) * 5 / 3, 1e-9);
  double top = -1;
  for (const Triangle& triangle : cone) {
    for (const Vector3d& corner : triangle) {
      const double off = corner.z() > 0 ? corner.head<2>().norm() : 0;
      EXPECT_NEAR(off, 0, 1e-12) << "the tip";
      top = std::max(top, corner.z());
    }
  }
  EXPECT_DOUBLE_EQ(top, 2.5);
}

TEST(BallTriangles, HaveVolumesOfSpheresEllipsoidsAndCapsules) {
  const double sphere = 4.0 / 3 * std::numbers::pi;
  EXPECT_NEAR(enclosed_volume(ball_triangles({1, 1, 1})), sphere, 0.06 * sphere);
  EXPECT_NEAR(enclosed_volume(ball_triangles({1, 2, 3})), 6 * sphere, 0.06 * 6 * sphere);
  const double capsule = sphere + std::numbers::pi * 4;
  EXPECT_NEAR(enclosed_volume(ball_triangles({1, 1, 1}, 4)), capsule, 0.06 * capsule);
  double top = 0;
  for (const Triangle& triangle : ball_triangles({1, 1, 1}, 4)) {
    for (const Vector3d& corner : triangle) top = std::max(top, corner.z());
  }
  EXPECT_NEAR(top, 3, 1e-12) << "half the stretch and a radius";
}

TEST(PrismTriangles, FillAConcaveOutline) {
  const Corners outline = {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 2}, {0, 2}};
  EXPECT_NEAR(enclosed_volume(prism_triangles(outline, 1, 3.5)), 12 * 2.5, 1e-9);
  EXPECT_NEAR(surface_area(prism_triangles(outline, 1, 3.5)), 2 * 12 + 16 * 2.5, 1e-9);
}

TEST(Move, TurnsAndShifts) {
  Triangles triangles = {{Vector3d(1, 0, 0), Vector3d(0, 2, 0), Vector3d(0, 0, 3)}};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = Vector3d(10, 20, 30);
  move(triangles, pose);
  EXPECT_LT((triangles[0][0] - Vector3d(10, 21, 30)).norm(), 1e-12);
  EXPECT_LT((triangles[0][1] - Vector3d(8, 20, 30)).norm(), 1e-12);
  EXPECT_LT((triangles[0][2] - Vector3d(10, 20, 33)).norm(), 1e-12);
}

double shadow_m2(const Triangles& triangles) {
  double sum = 0;
  for (const Corners& corners : project_shadow(triangles)) sum += geometry::signed_area(corners);
  return sum;
}

Triangles raised(Triangles triangles, double by) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = by;
  move(triangles, pose);
  return triangles;
}

TEST(ShadowOf, CoversTheOutlineBetweenStepsAndHeads) {
  // Cells of 0.25 m that touch: at most half a cell more on each side.
  EXPECT_NEAR(shadow_m2(raised(box_triangles({4, 2, 1}), 0.5)), 8, 1.6);
  EXPECT_EQ(shadow_m2(raised(box_triangles({4, 2, 0.18}), 0.09)), 0) << "a step";
  EXPECT_EQ(shadow_m2(raised(box_triangles({4, 2, 0.2}), 0.1)), 0) << "a step of exactly 0.2 m";
  EXPECT_GT(shadow_m2(raised(box_triangles({4, 2, 0.21}), 0.105)), 7) << "1 cm more";
  EXPECT_EQ(shadow_m2(raised(box_triangles({4, 2, 1}), 2.6)), 0) << "above heads";
  EXPECT_EQ(shadow_m2(raised(box_triangles({4, 2, 1}), 2.5)), 0) << "from exactly 2 m on";
  EXPECT_GT(shadow_m2(raised(box_triangles({4, 2, 1}), 2.4)), 7) << "down to 1.9 m";
  EXPECT_TRUE(project_shadow({}).empty());
}

TEST(ShadowOf, IsThatOfTheSliceOnly) {
  // A table: a top 4 m x 4 m above heads on one leg of 0.5 m x 0.5 m.
  Triangles table = raised(box_triangles({4, 4, 0.1}), 2.5);
  for (const Triangle& triangle : raised(box_triangles({0.5, 0.5, 2.5}), 1.25)) {
    table.push_back(triangle);
  }
  EXPECT_LT(shadow_m2(table), 1.1);
  EXPECT_GE(shadow_m2(table), 0.25);
}

TEST(ShadowOf, GivesRectanglesThatDoNotOverlap) {
  Triangles cross = raised(box_triangles({6, 1, 2}), 1);
  for (const Triangle& triangle : raised(box_triangles({1, 6, 2}), 1)) cross.push_back(triangle);
  const std::vector<Corners> parts = project_shadow(cross);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    ASSERT_EQ(parts[i].size(), 4);
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_NEAR(shared_m2({parts[i], {}}, {parts[k], {}}), 0, 1e-9);
    }
  }
  EXPECT_NEAR(shadow_m2(cross), 11, 3.5) << "up to a cell more around it";
}

TEST(ShadowOf, HasTheWallsOfAHouseWhereverTheyAre) {
  for (const double size : {10.0, 10.1, 0.5, 0.25, 7.125}) {
    const std::vector<Corners> parts = project_shadow(raised(box_triangles({size, size, 3}), 1.5));
    const auto is_covered = [&](const Vector2d& p) {
      return std::any_of(parts.begin(), parts.end(), [&](const Corners& corners) {
        return geometry::distance_to(corners, p) < 1e-6;
      });
    };
    const double half = size / 2;
    for (const double along : {-0.5, 0.0, 0.3, 0.5}) {
      EXPECT_TRUE(is_covered({half, along * size})) << size << ": east";
      EXPECT_TRUE(is_covered({-half, along * size})) << size << ": west";
      EXPECT_TRUE(is_covered({along * size, half})) << size << ": north";
      EXPECT_TRUE(is_covered({along * size, -half})) << size << ": south";
    }
  }
}

/// Faces of an OBJ file as triangles, by material.
std::map<std::string, Triangles> read_obj(const std::string& text) {
  std::map<std::string, Triangles> found;
  std::vector<Vector3d> vertices;
  std::vector<Vector3d> normals;
  std::string material;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "usemtl") words >> material;
    if (kind == "v" || kind == "vn") {
      Vector3d v;
      words >> v.x() >> v.y() >> v.z();
      (kind == "v" ? vertices : normals).push_back(v);
    }
    if (kind != "f") continue;
    Triangle triangle;
    for (Vector3d& corner : triangle) {
      std::string index;
      words >> index;
      corner = vertices.at(std::stoul(index) - 1);
      const std::size_t normal = std::stoul(index.substr(index.rfind('/') + 1)) - 1;
      EXPECT_NEAR(normals.at(normal).norm(), 1, 1e-3);
    }
    const std::size_t last = normals.size() - 1;
    const Vector3d across = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    EXPECT_GT(across.dot(normals[last]), 0) << "normals face as triangles do";
    found[material].push_back(triangle);
  }
  return found;
}

TEST(MeshText, IsReadAgainWithYUp) {
  Object object{"box", {}};
  object.solids.push_back({{0.8, 0.2, 0.1}, raised(box_triangles({2, 4, 6}), 3)});
  object.solids.push_back({{0, 1, 0}, box_triangles({1, 1, 1})});
  const MeshText text = mesh_text(object, "box.mtl");
  EXPECT_EQ(text.triangles.rfind("mtllib box.mtl\n", 0), 0);
  EXPECT_NE(text.materials.find("newmtl m0\nKd 0.8000 0.2000 0.1000\n"), std::string::npos);
  EXPECT_NE(text.materials.find("newmtl m1\nKd 0.0000 1.0000 0.0000\n"), std::string::npos);
  const auto meshes = read_obj(text.triangles);
  ASSERT_EQ(meshes.size(), 2);
  EXPECT_NEAR(enclosed_volume(meshes.at("m0")), 48, 1e-3) << "not mirrored";
  EXPECT_NEAR(enclosed_volume(meshes.at("m1")), 1, 1e-3);
  for (const Triangle& triangle : meshes.at("m0")) {
    for (const Vector3d& corner : triangle) {
      EXPECT_NEAR(std::abs(corner.x()), 1, 1e-4);
      EXPECT_TRUE(std::abs(corner.y()) < 1e-4 || std::abs(corner.y() - 6) < 1e-4) << "up";
      EXPECT_NEAR(std::abs(corner.z()), 2, 1e-4);
    }
  }
}

TEST(MeshNames, AreUniqueWords) {
  ImportedScenario scenario;
  scenario.name = "yard";
  scenario.objects = {{"Big Tree!", {}}, {"Big Tree!", {}}, {std::string(90, 'x'), {}}};
  EXPECT_EQ(mesh_name(scenario, 0), "yard_meshes/000_big_tree");
  EXPECT_EQ(mesh_name(scenario, 1), "yard_meshes/001_big_tree");
  EXPECT_EQ(mesh_name(scenario, 2), "yard_meshes/002_" + std::string(40, 'x'));
}

constexpr const char* kTriangle =
    "o flat\nv 0 0 0\nv 2 0 0\nv 0 3 1\nf 1 2 3\no other\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 6 1 0\n"
    "f 4 5 7 6\n";

TEST(ReadMesh, TakesObjectsAsTheyAreAndQuadsAsTriangles) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "m.obj", kTriangle);
  const std::vector<Solid> solids = read_mesh(folder.path() / "m.obj", "");
  double area = 0;
  std::size_t triangles = 0;
  double top = 0;
  for (const Solid& solid : solids) {
    area += surface_area(solid.triangles);
    triangles += solid.triangles.size();
    for (const Triangle& triangle : solid.triangles) {
      for (const Vector3d& corner : triangle) top = std::max(top, corner.z());
    }
  }
  EXPECT_EQ(triangles, 3);
  EXPECT_NEAR(area, 0.5 * 2 * std::sqrt(10.0) + 1, 1e-6);
  EXPECT_NEAR(top, 1, 1e-9) << "z is up";
}

TEST(ReadMesh, TakesOneSubmesh) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "m.obj", kTriangle);
  const std::vector<Solid> solids = read_mesh(folder.path() / "m.obj", "other");
  ASSERT_EQ(solids.size(), 1);
  EXPECT_NEAR(surface_area(solids[0].triangles), 1, 1e-6);
  EXPECT_TRUE(read_mesh(folder.path() / "m.obj", "none of these").empty());
}

TEST(ReadMesh, TurnsCollada) {
  const TemporaryFolder folder;
  write_file_atomically(
      folder.path() / "m.dae",
      "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
      "version='1.4.1'><asset><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id='g' "
      "name='g'><mesh><source id='p'><float_array id='a' count='9'>0 0 0 2 0 0 0 3 1</float_array>"
      "<technique_common><accessor source='#a' count='3' stride='3'><param name='X' type='float'/>"
      "<param name='Y' type='float'/><param name='Z' type='float'/></accessor></technique_common>"
      "</source><vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles "
      "count='1'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles></mesh>"
      "</geometry></library_geometries><library_visual_scenes><visual_scene id='s'><node id='n'>"
      "<instance_geometry url='#g'/></node></visual_scene></library_visual_scenes><scene>"
      "<instance_visual_scene url='#s'/></scene></COLLADA>");
  const std::vector<Solid> solids = read_mesh(folder.path() / "m.dae", "");
  ASSERT_EQ(solids.size(), 1);
  const Triangle& triangle = solids[0].triangles.at(0);
  EXPECT_LT((triangle[1] - Vector3d(2, 0, 0)).norm(), 1e-6);
  EXPECT_LT((triangle[2] - Vector3d(0, 3, 1)).norm(), 1e-6) << "as the file says: z up";
}

TEST(ReadMesh, RefusesOtherFiles) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "text.obj", "no mesh at all");
  write_file_atomically(folder.path() / "m.xyz", "1 2 3");
  EXPECT_THROW(read_mesh(folder.path() / "m.xyz", ""), InputError);
  try {
    EXPECT_TRUE(read_mesh(folder.path() / "text.obj", "").empty());
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("text.obj"), std::string::npos);
  }
}

}  // namespace
}  // namespace throng::imports
