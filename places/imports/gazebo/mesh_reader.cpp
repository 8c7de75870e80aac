#include "places/imports/gazebo/mesh_reader.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/core.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/files/files.h"

namespace throng::imports {

namespace {

constexpr std::size_t kMaxTriangles = 1'000'000;
constexpr std::uintmax_t kMaxFileBytes = 256U << 20U;

Eigen::Vector3d to_z_up(const aiVector3D& p, bool y_is_up) {
  if (y_is_up) return {p.x, -p.z, p.y};
  return {p.x, p.y, p.z};
}

/// Why a file may be no mesh, by how it begins.
std::string unreadable_file(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  if (text.empty()) return fmt::format("{}, which is empty", file.string());
  if (text.starts_with("version https://git-lfs")) {
    return fmt::format("{}, a pointer of Git LFS (`git lfs pull` fetches the mesh)", file.string());
  }
  return fmt::format("{}, in which no mesh can be read", file.string());
}

class MeshReader {
 public:
  explicit MeshReader(const std::filesystem::path& file) : file_(file) {
    const std::string suffix = file.extension().string();
    y_is_up_ = suffix == ".dae" || suffix == ".gltf" || suffix == ".glb";
  }

  std::vector<Solid> read_all() {
    const aiScene& scene = open(aiProcess_PreTransformVertices);
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) add(scene, *scene.mMeshes[m], aiMatrix4x4());
    return std::move(solids_);
  }

  /// aiProcess_PreTransformVertices joins meshes of one material, so nodes are followed here.
  std::vector<Solid> read_one(const std::string& submesh) {
    const aiScene& scene = open(0);
    add_node(scene, *scene.mRootNode, aiMatrix4x4(), submesh);
    return std::move(solids_);
  }

 private:
  const aiScene& open(unsigned more_steps) {
    const aiScene* scene = importer_.ReadFile(
        file_.string(), aiProcess_Triangulate | aiProcess_SortByPType | more_steps);
    if (scene == nullptr) {
      throw InputError({file_.string(), "", unreadable_file(file_),
                        "a mesh of COLLADA (.dae), STL, OBJ, glTF or FBX"});
    }
    return *scene;
  }

  void add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent,
                const std::string& submesh) {
    const aiMatrix4x4 pose = parent * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
      const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
      if (submesh == mesh.mName.C_Str()) add(scene, mesh, pose);
    }
    for (unsigned child = 0; child < node.mNumChildren; ++child) {
      add_node(scene, *node.mChildren[child], pose, submesh);
    }
  }

  void add(const aiScene& scene, const aiMesh& mesh, const aiMatrix4x4& pose) {
    Solid solid;
    aiColor3D rgb(0.6F, 0.6F, 0.6F);
    if (mesh.mMaterialIndex < scene.mNumMaterials) {
      scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_COLOR_DIFFUSE, rgb);
    }
    solid.rgb = Eigen::Vector3d(rgb.r, rgb.g, rgb.b).cwiseMax(0).cwiseMin(1);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      auto& triangle = solid.triangles.emplace_back();
      for (unsigned k = 0; k < 3; ++k) {
        triangle[k] = to_z_up(pose * mesh.mVertices[face.mIndices[k]], y_is_up_);
        if (!triangle[k].allFinite()) {
          throw InputError({file_.string(), "", "a corner that is no number", "numbers"});
        }
      }
    }
    triangles_ += solid.triangles.size();
    if (triangles_ > kMaxTriangles) {
      throw InputError({file_.string(), "", fmt::format("{} triangles and more", triangles_),
                        fmt::format("at most {}", kMaxTriangles)});
    }
    if (!solid.triangles.empty()) solids_.push_back(std::move(solid));
  }

  const std::filesystem::path& file_;
  Assimp::Importer importer_;
  bool y_is_up_ = false;
  std::vector<Solid> solids_;
  std::size_t triangles_ = 0;
};

}  // namespace

std::vector<Solid> read_mesh(const std::filesystem::path& file, const std::string& submesh) {
  if (std::filesystem::file_size(file) > kMaxFileBytes) {
    throw InputError({file.string(), "", "a file of more than 256 MB", "a smaller mesh"});
  }
  MeshReader reader(file);
  return submesh.empty() ? reader.read_all() : reader.read_one(submesh);
}

}  // namespace throng::imports
