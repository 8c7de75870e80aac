// Surfaces of different instances or classes do not coincide in any place: which one of them an
// image shows would be left to rounding, and differ between cameras.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "base/files/resources.h"
#include "base/geometry/polygon.h"
#include "places/scenarios/blueprint/generated.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "render/frame/frame.h"
#include "render/ground/ground_layers.h"
#include "render/props/mesh_file.h"
#include "render/props/prop_shapes.h"
#include "render/scenery/rubble.h"
#include "render/scenery/scenery.h"
#include "world/scenario.h"

namespace throng::render {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Face {
  std::array<Vector3d, 3> corners;
  std::uint32_t id = 0;
  std::string part;
  bool is_two_sided = false;  ///< seen from behind, too
};

template <typename Mesh>
void add_faces(const Mesh& mesh, std::size_t first, std::size_t count, const std::string& part,
               std::vector<Face>& faces) {
  for (std::size_t i = first; i + 2 < first + count; i += 3) {
    Face face;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& vertex = mesh.vertices[mesh.indices[i + k]];
      face.corners[k] = Eigen::Vector3f(vertex.position.data()).template cast<double>();
      face.id = vertex.id;
    }
    face.part = part;
    faces.push_back(face);
  }
}

/// All that stands in a place, and its ground. Its areas and markings lie above it by tenths of
/// a millimeter each, in an order of their own.
std::vector<Face> list_faces(const world::Scenario& scenario) {
  std::vector<Face> faces;
  const SceneryMesh place = scenery_mesh(scenario);
  add_faces(place, place.walls.first, place.walls.count, "wall", faces);
  add_faces(place, place.roofs.first, place.roofs.count, "roof", faces);
  add_faces(place, place.ground.first, place.ground.count, "ground", faces);
  std::uint32_t id = kIdProp;
  for (const world::Prop& prop : scenario.props) {
    const PropMesh mesh = prop_shape(prop, id++);
    add_faces(mesh, 0, mesh.indices.size(), "prop " + std::to_string(static_cast<int>(prop.kind)),
              faces);
  }
  const std::size_t first_mesh = faces.size();
  for (const world::PlacedMesh& placed : scenario.meshes) {
    const PropMesh mesh = mesh_from_file(placed, id++);
    add_faces(mesh, 0, mesh.indices.size(), placed.file.filename().string(), faces);
  }
  for (std::size_t i = first_mesh; i < faces.size(); ++i) faces[i].is_two_sided = true;
  for (const world::Disaster& disaster : scenario.disasters) {
    for (const RubblePiece& piece : make_rubble(disaster, id)) {
      add_faces(piece.mesh, 0, piece.mesh.indices.size(), "rubble", faces);
    }
    ++id;
  }
  return faces;
}

/// Areas and markings of the ground, by material.
std::vector<Face> list_ground_layers(const world::Scenario& scenario) {
  SceneryMesh mesh;
  std::vector<Face> faces;
  std::map<std::string, std::uint32_t> ids;
  for (const GroundLayer& layer : add_ground_layers(scenario, mesh)) {
    const std::size_t first = faces.size();
    add_faces(mesh, layer.range.first, layer.range.count, layer.material, faces);
    const std::uint32_t id = ids.try_emplace(layer.material, ids.size()).first->second;
    for (std::size_t i = first; i < faces.size(); ++i) faces[i].id = id;
  }
  return faces;
}

/// Planes nearer to each other than this are one.
constexpr double kApartM = 0.004;
/// The same for layers of the ground.
constexpr double kLayersApartM = 0.00005;
/// Less of an area is a matter of corners that touch.
constexpr double kMinAreaM2 = 0.002;

/// The area that two faces in nearly the same plane, seen from the same side, have in common.
double common_m2(const Face& one, const Face& other, const Vector3d& normal) {
  const Vector3d across = normal.unitOrthogonal();
  const Vector3d along = normal.cross(across);
  const auto flat = [&](const Face& face) {
    std::vector<Vector2d> corners;
    for (const Vector3d& corner : face.corners) {
      corners.emplace_back(across.dot(corner), along.dot(corner));
    }
    return corners;
  };
  std::vector<Vector2d> common = flat(one);
  const std::vector<Vector2d> cutter = flat(other);
  const double sign =
      geometry::cross(Vector2d(cutter[1] - cutter[0]), Vector2d(cutter[2] - cutter[0])) > 0 ? 1
                                                                                            : -1;
  for (std::size_t i = 0; i < 3 && common.size() > 2; ++i) {
    const Vector2d from = cutter[i];
    const Vector2d side = cutter[(i + 1) % 3] - from;
    common = geometry::clipped(common, [&](const Vector2d& p) {
      return -sign * geometry::cross(side, Vector2d(p - from));
    });
  }
  return common.size() < 3 ? 0 : std::abs(geometry::signed_area(common));
}

/// Descriptions of faces of different instances that coincide, with a place each.
std::map<std::string, std::pair<double, Vector3d>> coinciding(const std::vector<Face>& faces,
                                                              double apart_m = kApartM) {
  struct Flat {
    std::size_t face;
    Vector3d normal;
    double offset_m;
    Eigen::AlignedBox3d box;
  };
  constexpr double kCellM = 4;
  constexpr double kCosine = 0.9998;
  std::map<std::array<int, 3>, std::vector<Flat>> cells;
  std::map<std::string, std::pair<double, Vector3d>> found;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto& [a, b, c] = faces[i].corners;
    const Vector3d normal = (b - a).cross(c - a);
    if (!(normal.norm() > 2e-4)) continue;
    Flat flat{i, normal.normalized(), normal.normalized().dot(a), {}};
    for (const Vector3d& corner : faces[i].corners) flat.box.extend(corner);
    const Eigen::Array3d reach(apart_m, apart_m, apart_m);
    flat.box = Eigen::AlignedBox3d(Vector3d(flat.box.min().array() - reach),
                                   Vector3d(flat.box.max().array() + reach));
    std::vector<std::size_t> compared;
    const Eigen::Array3i first = (flat.box.min().array() / kCellM).floor().cast<int>();
    const Eigen::Array3i last = (flat.box.max().array() / kCellM).floor().cast<int>();
    for (int x = first.x(); x <= last.x(); ++x) {
      for (int y = first.y(); y <= last.y(); ++y) {
        for (int z = first.z(); z <= last.z(); ++z) {
          std::vector<Flat>& cell = cells[{x, y, z}];
          for (const Flat& other : cell) {
            const Face& there = faces[other.face];
            const double cosine = flat.normal.dot(other.normal);
            const bool is_either_side = there.is_two_sided || faces[i].is_two_sided;
            if (there.id == faces[i].id || (is_either_side ? std::abs(cosine) : cosine) < kCosine ||
                !flat.box.intersects(other.box)) {
              continue;
            }
            const Vector3d middle = (a + b + c) / 3;
            if (std::abs(other.normal.dot(middle) - other.offset_m) > apart_m) continue;
            if (std::find(compared.begin(), compared.end(), other.face) != compared.end()) continue;
            compared.push_back(other.face);
            const double m2 = common_m2(faces[i], there, flat.normal);
            if (m2 < kMinAreaM2) continue;
            auto& [sum_m2, at] = found[there.part + " and " + faces[i].part];
            sum_m2 += m2;
            at = middle;
          }
          cell.push_back(flat);
        }
      }
    }
  }
  return found;
}

void expect_apart(const world::Scenario& scenario, const std::string& name) {
  auto found = coinciding(list_faces(scenario));
  found.merge(coinciding(list_ground_layers(scenario), kLayersApartM));
  for (const auto& [parts, where] : found) {
    ADD_FAILURE() << name << ": " << parts << " coincide on " << where.first << " m2, near "
                  << where.second.transpose();
  }
}

TEST(CoincidingSurfaces, AreFoundWhereTheyAre) {
  world::Scenario scenario;
  world::Building building;
  building.footprint = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  building.height_m = 2;
  scenario.buildings = {building, building};
  for (Vector2d& corner : scenario.buildings[1].footprint) corner += Vector2d(2, 0.001);
  const auto found = coinciding(list_faces(scenario));
  EXPECT_NEAR(found.at("wall and wall").first, 2 * (2 * 2), 1e-3);
  EXPECT_NEAR(found.at("roof and roof").first, 2 * 2.999, 1e-3);
  for (Vector2d& corner : scenario.buildings[1].footprint) corner += Vector2d(2, 0);
  EXPECT_TRUE(coinciding(list_faces(scenario)).empty()) << "they stand side by side";
}

TEST(CoincidingSurfaces, AreInNoShippedScenario) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(source_folder() / "scenarios")) {
    const std::string name = entry.path().filename().string();
    const bool is_scenario =
        name.ends_with(".json") && !name.ends_with(".job.json") && name != "study.json";
    if (is_scenario) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  EXPECT_GT(files.size(), 15U);
  for (const std::filesystem::path& file : files) {
    expect_apart(scenarios::load_scenario(file, "shipped"), file.string());
  }
}

TEST(CoincidingSurfaces, AreInNoGeneratedScenario) {
  for (const char* kind : {"plaza", "street", "campus", "block"}) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      scenarios::GeneratorSpec spec;
      spec.kind = kind;
      spec.seed = seed;
      expect_apart(scenarios::load_generated(spec), kind + (" " + std::to_string(seed)));
    }
  }
}

}  // namespace
}  // namespace throng::render
