#include "jobs/pipeline/checks/models_memory.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <vector>

#include "base/error.h"
#include "render/props/mesh_file.h"
#include "skinning/population.h"
#include "skinning/population_files.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

namespace {

constexpr double kMib = 1 << 20;

// Measured with grids of a million triangles as OBJ, STL and GLB, and with trees and cars by the
// thousand (largest resident memory of a worker).
constexpr double kReadTriangleBytes = 350;  // while a file is read
constexpr double kGrowth = 1.5;             // of a vector that is filled
constexpr double kCopies = 2.5;             // of vertices, with that of the graphics driver
constexpr double kPropBytes = 45'000;
constexpr double kCharacterCopies = 2.8;  // of its file, in memory
constexpr double kSharedTextures = 3.1;   // of a character of the shipped library

struct MeshSize {
  double bytes = 0;  // of vertices and indices
  double triangles = 0;
};

MeshSize measure_mesh(const world::PlacedMesh& placed) {
  const render::PropMesh mesh = render::mesh_from_file(placed, 0);
  return {static_cast<double>(mesh.vertices.size() * sizeof(mesh.vertices.front()) +
                              mesh.indices.size() * sizeof(mesh.indices.front())),
          static_cast<double>(mesh.indices.size()) / 3};
}

double scenario_bytes(const world::Scenario& scenario) {
  std::map<std::filesystem::path, MeshSize> sizes;
  double all = 0;
  double largest_read = 0;
  for (const world::PlacedMesh& placed : scenario.meshes) {
    auto size = sizes.find(placed.file);
    if (size == sizes.end()) size = sizes.emplace(placed.file, measure_mesh(placed)).first;
    all += size->second.bytes;
    largest_read = std::max(largest_read, size->second.triangles * kReadTriangleBytes);
  }
  return std::max(all * kCopies, all * kGrowth + largest_read) +
         static_cast<double>(scenario.props.size()) * kPropBytes;
}

double library_bytes() {
  const std::filesystem::path folder = skinning::population_folder();
  try {
    const skinning::PopulationIndex index = skinning::read_index(folder);
    double file_bytes = 0;
    for (const skinning::Character& character : index.characters) {
      file_bytes += static_cast<double>(
          std::filesystem::file_size(folder / (character.name + skinning::kMeshExtension)));
    }
    const double textures = index.textures > 0
                                ? static_cast<double>(index.textures)
                                : kSharedTextures * static_cast<double>(index.characters.size());
    const double texels = 1.0 * index.texture_size * index.texture_size * textures;
    // As read, and as the array of the graphics driver with its mipmaps.
    return texels * 4 * (1 + 4. / 3) + file_bytes * kCharacterCopies;
  } catch (const InputError&) {
  } catch (const std::filesystem::filesystem_error&) {
  }
  // The task will say what is wrong with it.
  return static_cast<double>(kShippedPeopleMib) * kMib;
}

}  // namespace

std::int64_t models_memory_mib(const world::Scenario& scenario) {
  return std::llround((library_bytes() + scenario_bytes(scenario)) / kMib);
}

}  // namespace throng::jobs
