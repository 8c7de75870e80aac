#include "render/props/mesh_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/files/confine.h"

namespace throng::render {

namespace {

using Eigen::Vector3d;

/// A material's color, linear, then the finish; light gray when it has none.
std::array<std::uint8_t, 4> material_color(const aiMaterial& material, Finish finish) {
  aiColor4D color(0.6F, 0.6F, 0.6F, 1.0F);
  if (material.Get(AI_MATKEY_BASE_COLOR, color) != aiReturn_SUCCESS) {
    material.Get(AI_MATKEY_COLOR_DIFFUSE, color);
  }
  const auto byte = [](float share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0F, 1.0F)));
  };
  return {byte(color.r), byte(color.g), byte(color.b), static_cast<std::uint8_t>(finish)};
}

/// Files have y up; the world has z up.
Vector3d upright(const aiVector3D& v) { return {v.x, -v.z, v.y}; }

std::array<float, 3> three(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void append(const aiMesh& mesh, const std::array<std::uint8_t, 4>& paint,
            const Eigen::Affine3d& place, std::uint32_t id, PropMesh& all) {
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const Vector3d normal = (place.linear() * upright(mesh.mNormals[i])).normalized();
    all.vertices.push_back(
        {three(place * upright(mesh.mVertices[i])), three(normal), {0, 0}, paint, id, {}});
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    for (unsigned k = 0; k < 3; ++k) all.indices.push_back(first + face.mIndices[k]);
  }
}

/// Files as the library opens them: those that this thread may read.
class ConfinedFiles : public Assimp::DefaultIOSystem {
 public:
  bool Exists(const char* file) const override {
    return Confinement::allows(file) && DefaultIOSystem::Exists(file);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return Confinement::allows(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }
};

}  // namespace

PropMesh mesh_from_file(const world::PlacedMesh& placed, std::uint32_t id) {
  Assimp::Importer importer;
  importer.SetIOHandler(std::make_unique<ConfinedFiles>().release());  // which it deletes
  constexpr float kSmoothDeg = 35;  // edges between faces at a greater angle are sharp
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kSmoothDeg);
  const aiScene* scene = importer.ReadFile(
      placed.file.string(), aiProcess_Triangulate | aiProcess_GenSmoothNormals |
                                aiProcess_PreTransformVertices | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr) {
    throw InputError(Problem{placed.file.string(), "", importer.GetErrorString(),
                             "a mesh, for example glTF or OBJ"});
  }
  const Eigen::Affine3d place = Eigen::Translation3d(placed.position) *
                                Eigen::AngleAxisd(placed.yaw_rad, Vector3d::UnitZ()) *
                                Eigen::Scaling(placed.scale);
  const Finish finish =
      placed.semantic_class == world::SemanticClass::water ? Finish::water : Finish::matt;
  PropMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& part = *scene->mMeshes[i];
    if (!part.HasNormals()) continue;  // points and lines
    append(part, material_color(*scene->mMaterials[part.mMaterialIndex], finish), place, id, mesh);
  }
  if (mesh.indices.empty()) {
    throw InputError(Problem{placed.file.string(), "", "no triangles", "a mesh with triangles"});
  }
  return mesh;
}

}  // namespace throng::render
