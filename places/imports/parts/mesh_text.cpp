#include "places/imports/parts/mesh_text.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <iterator>

#include "places/imports/parts/scenario_name.h"

namespace throng::imports {

MeshText mesh_text(const Object& object, const std::string& materials_file) {
  MeshText text;
  text.triangles = fmt::format("mtllib {}\n", materials_file);
  auto out = std::back_inserter(text.triangles);
  int vertices = 0;
  int normals = 0;
  for (std::size_t i = 0; i < object.solids.size(); ++i) {
    const Solid& solid = object.solids[i];
    text.materials += fmt::format("newmtl m{}\nKd {:.4f} {:.4f} {:.4f}\n", i, solid.rgb.x(),
                                  solid.rgb.y(), solid.rgb.z());
    fmt::format_to(out, "usemtl m{}\n", i);
    for (const auto& triangle : solid.triangles) {
      for (const Eigen::Vector3d& p : triangle) {
        fmt::format_to(out, "v {:.4f} {:.4f} {:.4f}\n", p.x(), p.z(), -p.y());
      }
      // With its own normal: readers make those that are missing smooth, and boxes round.
      const Eigen::Vector3d across = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
      const Eigen::Vector3d n =
          across.norm() > 0 ? Eigen::Vector3d(across.normalized()) : Eigen::Vector3d(0, 0, 1);
      ++normals;
      fmt::format_to(out, "vn {:.4f} {:.4f} {:.4f}\nf {}//{} {}//{} {}//{}\n", n.x(), n.z(), -n.y(),
                     vertices + 1, normals, vertices + 2, normals, vertices + 3, normals);
      vertices += 3;
    }
  }
  return text;
}

std::string mesh_name(const ImportedScenario& scenario, std::size_t object) {
  const std::string word = scenario_name_from(scenario.objects[object].name);
  return fmt::format("{}_meshes/{:03}_{}", scenario.name, object, word.substr(0, 40));
}

}  // namespace throng::imports
