#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <span>

#include "base/error.h"
#include "skinning/glb.h"

namespace throng::skinning {

namespace {

class Reader {
 public:
  Reader(std::string path, const aiScene& scene) : path_(std::move(path)), scene_(&scene) {}

  CharacterAsset read() {
    CharacterAsset asset;
    read_joints(asset);
    read_images(asset);
    for (int level = 0;; ++level) {
      const aiNode* node = scene_->mRootNode->FindNode(fmt::format("level{}", level).c_str());
      if (node == nullptr) break;
      Mesh mesh;
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        read_part(*scene_->mMeshes[node->mMeshes[i]], asset.images.size(), mesh);
      }
      asset.levels.push_back(std::move(mesh));
    }
    if (asset.levels.empty()) fail("no node \"level0\"", "a mesh node for each level of detail");
    return asset;
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw InputError(
        {path_, "", found,
         expected + " (run `throng people build` to build the character library again)"});
  }

  // Rest joints from the node tree, which holds translations only.
  void read_joints(CharacterAsset& asset) const {
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      const std::string name(kBoneNames[bone]);
      const aiNode* node = scene_->mRootNode->FindNode(name.c_str());
      if (node == nullptr) fail("no bone \"" + name + "\"", "the 21 bones of throng's rig");
      const Eigen::Vector3f offset(node->mTransformation.c4, node->mTransformation.a4,
                                   node->mTransformation.b4);
      asset.joints[bone] = bone == 0 ? offset : asset.joints[index_from(kParent[bone])] + offset;
    }
  }

  void read_images(CharacterAsset& asset) const {
    for (unsigned i = 0; i < scene_->mNumTextures; ++i) {
      const aiTexture& texture = *scene_->mTextures[i];
      if (texture.mHeight != 0) fail(fmt::format("uncompressed texture {}", i), "embedded PNG");
      asset.images.emplace_back(reinterpret_cast<const char*>(texture.pcData), texture.mWidth);
    }
  }

  void read_material(const aiMesh& mesh, std::size_t images, Part& part) const {
    const aiMaterial& material = *scene_->mMaterials[mesh.mMaterialIndex];
    const std::string name = material.GetName().C_Str();
    const auto tint = std::find(kTintNames.begin(), kTintNames.end(), name);
    if (tint == kTintNames.end()) {
      fail("material \"" + name + "\"", "none, top, bottom, hair, shoes, item or portrait");
    }
    part.tint = static_cast<Tint>(tint - kTintNames.begin());
    int two_sided = 0;
    material.Get(AI_MATKEY_TWOSIDED, two_sided);
    part.alpha_tested = two_sided != 0;
    part.texture = image_of(material, images, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    part.shades = image_of(material, images, {aiTextureType_EMISSIVE});
    if (part.tint == Tint::portrait && (part.texture < 0 || part.shades < 0)) {
      fail("a portrait with one image", "a base color texture and an emissive one");
    }
  }

  // The number of the first image that there is; -1 for none.
  std::int32_t image_of(const aiMaterial& material, std::size_t images,
                        std::initializer_list<aiTextureType> types) const {
    for (const aiTextureType type : types) {
      aiString image;
      if (material.GetTexture(type, 0, &image) != aiReturn_SUCCESS) continue;
      const std::string reference = image.C_Str();  // "*3" is embedded image 3
      const bool embedded = reference.size() > 1 && reference.front() == '*' &&
                            reference.find_first_not_of("0123456789", 1) == std::string::npos;
      const std::int32_t number = embedded ? std::stoi(reference.substr(1)) : -1;
      if (!embedded || static_cast<std::size_t>(number) >= images) {
        fail("texture \"" + reference + "\"", "an embedded image");
      }
      return number;
    }
    return -1;
  }

  void read_part(const aiMesh& source, std::size_t images, Mesh& mesh) const {
    const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
    Part part;
    part.first_index = static_cast<std::uint32_t>(mesh.indices.size());
    read_material(source, images, part);
    if (!source.HasNormals() || !source.HasTextureCoords(0)) {
      fail("a mesh without normals or texture coordinates", "both");
    }
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      const aiVector3D& position = source.mVertices[i];
      const aiVector3D& normal = source.mNormals[i];
      const aiVector3D& uv = source.mTextureCoords[0][i];
      Vertex vertex{};
      vertex.position = {position.z, position.x, position.y};
      vertex.normal = {normal.z, normal.x, normal.y};
      vertex.uv = {uv.x, 1 - uv.y};  // assimp counts rows from the bottom
      mesh.vertices.push_back(vertex);
    }
    read_weights(source, std::span(mesh.vertices).subspan(first_vertex));
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
      const aiFace& face = source.mFaces[i];
      if (face.mNumIndices != 3) fail("a face that is not a triangle", "triangles");
      for (unsigned corner = 0; corner < 3; ++corner) {
        mesh.indices.push_back(first_vertex + face.mIndices[corner]);
      }
    }
    part.index_count = static_cast<std::uint32_t>(mesh.indices.size()) - part.first_index;
    mesh.parts.push_back(part);
  }

  void read_weights(const aiMesh& source, std::span<Vertex> vertices) const {
    std::vector<int> slots(vertices.size(), 0);
    for (unsigned i = 0; i < source.mNumBones; ++i) {
      const aiBone& bone = *source.mBones[i];
      const std::string_view name = bone.mName.C_Str();
      const auto known = std::find(kBoneNames.begin(), kBoneNames.end(), name);
      if (known == kBoneNames.end() && name != kStillName) {
        fail(fmt::format("bone \"{}\"", name), "the 21 bones of throng's rig");
      }
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& weight = bone.mWeights[w];
        const auto share = static_cast<std::uint8_t>(std::lround(weight.mWeight * 255));
        if (share == 0) continue;
        int& slot = slots[weight.mVertexId];
        if (slot == 4) fail("a vertex with more than four bones", "at most four");
        vertices[weight.mVertexId].bones[slot] =
            static_cast<std::uint8_t>(known - kBoneNames.begin());
        vertices[weight.mVertexId].weights[slot++] = share;
      }
    }
    for (const Vertex& vertex : vertices) {
      const int sum = vertex.weights[0] + vertex.weights[1] + vertex.weights[2] + vertex.weights[3];
      if (sum != 255) fail(fmt::format("bone weights that sum to {}/255", sum), "255/255");
    }
  }

  std::string path_;
  const aiScene* scene_;
};

}  // namespace

CharacterAsset read_glb(const std::filesystem::path& path) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw InputError(
        {path.string(), "", importer.GetErrorString(),
         "a character as GLB (run `throng people build` to build the character library)"});
  }
  CharacterAsset asset = Reader(path.string(), *scene).read();
  asset.name = path.stem().string();
  return asset;
}

}  // namespace throng::skinning
