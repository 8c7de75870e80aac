#include "imports/mesh_text.h"

#include <fmt/format.h>

#include <iterator>

#include "imports/place_writer.h"

namespace throng::imports {

MeshText mesh_text(const Thing& thing, const std::string& materials_file) {
  MeshText text;
  text.triangles = fmt::format("mtllib {}\n", materials_file);
  auto out = std::back_inserter(text.triangles);
  int vertices = 0;
  for (std::size_t i = 0; i < thing.solids.size(); ++i) {
    const Solid& solid = thing.solids[i];
    text.materials += fmt::format("newmtl m{}\nKd {:.4f} {:.4f} {:.4f}\n", i, solid.rgb.x(),
                                  solid.rgb.y(), solid.rgb.z());
    fmt::format_to(out, "usemtl m{}\n", i);
    for (const auto& triangle : solid.triangles) {
      for (const Eigen::Vector3d& p : triangle) {
        fmt::format_to(out, "v {:.4f} {:.4f} {:.4f}\n", p.x(), p.z(), -p.y());
      }
      fmt::format_to(out, "f {} {} {}\n", vertices + 1, vertices + 2, vertices + 3);
      vertices += 3;
    }
  }
  return text;
}

std::string mesh_name(const Place& place, std::size_t thing) {
  const std::string word = place_name_of(place.things[thing].name);
  return fmt::format("{}_meshes/{:03}_{}", place.name, thing, word.substr(0, 40));
}

}  // namespace throng::imports
