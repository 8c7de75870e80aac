#include "imports/mesh_reader.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/core.h>

#include <algorithm>
#include <assimp/Importer.hpp>

#include "base/error.h"

namespace throng::imports {

namespace {

constexpr std::size_t kMaxTriangles = 1'000'000;
constexpr std::uintmax_t kMaxFileBytes = 256U << 20U;

Eigen::Vector3d corner_of(const aiVector3D& p, bool y_is_up) {
  if (y_is_up) return {p.x, -p.z, p.y};
  return {p.x, p.y, p.z};
}

}  // namespace

std::vector<Solid> read_mesh(const std::filesystem::path& file, const std::string& submesh) {
  if (std::filesystem::file_size(file) > kMaxFileBytes) {
    throw InputError({file.string(), "", "a file of more than 256 MB", "a smaller mesh"});
  }
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                           aiProcess_SortByPType);
  if (scene == nullptr) {
    throw InputError({file.string(), "", importer.GetErrorString(), "a mesh"});
  }
  const std::string suffix = file.extension().string();
  const bool y_is_up = suffix == ".dae" || suffix == ".gltf" || suffix == ".glb";
  std::vector<Solid> solids;
  std::size_t triangles = 0;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    if (!submesh.empty() && submesh != mesh.mName.C_Str()) continue;
    Solid solid;
    aiColor3D rgb(0.6F, 0.6F, 0.6F);
    if (mesh.mMaterialIndex < scene->mNumMaterials) {
      scene->mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_COLOR_DIFFUSE, rgb);
    }
    solid.rgb = Eigen::Vector3d(rgb.r, rgb.g, rgb.b).cwiseMax(0).cwiseMin(1);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      auto& triangle = solid.triangles.emplace_back();
      for (unsigned k = 0; k < 3; ++k) {
        triangle[k] = corner_of(mesh.mVertices[face.mIndices[k]], y_is_up);
        if (!triangle[k].allFinite()) {
          throw InputError({file.string(), "", "a corner that is no number", "numbers"});
        }
      }
    }
    triangles += solid.triangles.size();
    if (triangles > kMaxTriangles) {
      throw InputError({file.string(), "", fmt::format("{} triangles and more", triangles),
                        fmt::format("at most {}", kMaxTriangles)});
    }
    if (!solid.triangles.empty()) solids.push_back(std::move(solid));
  }
  return solids;
}

}  // namespace throng::imports
