#include "skinning/import/rigged_model.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <map>
#include <utility>

#include "base/compute/srgb.h"
#include "base/error.h"
#include "base/files/files.h"

namespace throng::skinning {

namespace fs = std::filesystem;

namespace {

Eigen::Matrix4f to_matrix(const aiMatrix4x4& from) {
  Eigen::Matrix4f matrix;
  matrix << from.a1, from.a2, from.a3, from.a4, from.b1, from.b2, from.b3, from.b4, from.c1,
      from.c2, from.c3, from.c4, from.d1, from.d2, from.d3, from.d4;
  return matrix;
}

Eigen::Vector3f to_vector(const aiVector3D& from) { return {from.x, from.y, from.z}; }

class ModelReader {
 public:
  ModelReader(const fs::path& path, const aiScene& scene) : path_(path), scene_(&scene) {}

  RiggedModel read(ModelUse use) {
    model_.file = path_.string();
    add_node(*scene_->mRootNode, -1);
    read_animations();
    if (use == ModelUse::motion) return std::move(model_);
    if (scene_->mNumMeshes == 0) fail("no mesh", "a character with a mesh and a skeleton");
    bool rigged = false;
    for (unsigned i = 0; i < scene_->mNumMeshes; ++i) rigged |= scene_->mMeshes[i]->HasBones();
    if (!rigged) {
      fail("a mesh without bones",
           "a rigged character: bind the mesh to a skeleton (in Blender: parent it to the armature "
           "with weights) and export both, with the skin");
    }
    read_materials();
    mark_bones();
    rest_ = model_.rest();
    add_meshes(*scene_->mRootNode);
    turn_outwards();
    return std::move(model_);
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw InputError({path_.string(), "", found, expected});
  }

  void add_node(const aiNode& node, int parent) {
    const auto number = static_cast<int>(model_.nodes.size());
    numbers_[&node] = number;
    by_name_.emplace(node.mName.C_Str(), number);
    model_.nodes.push_back({node.mName.C_Str(), parent, to_matrix(node.mTransformation), false});
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], number);
  }

  void read_animations() {
    for (unsigned i = 0; i < scene_->mNumAnimations; ++i) {
      const aiAnimation& source = *scene_->mAnimations[i];
      const double rate = source.mTicksPerSecond > 0 ? source.mTicksPerSecond : 25;
      ModelAnimation animation{source.mName.C_Str(), source.mDuration / rate, {}};
      for (unsigned k = 0; k < source.mNumChannels; ++k) {
        const aiNodeAnim& from = *source.mChannels[k];
        const auto node = by_name_.find(from.mNodeName.C_Str());
        if (node == by_name_.end()) continue;
        ModelChannel channel{node->second, {}, {}, {}};
        for (unsigned key = 0; key < from.mNumPositionKeys; ++key) {
          const aiVectorKey& value = from.mPositionKeys[key];
          channel.shifts.push_back({value.mTime / rate, to_vector(value.mValue)});
        }
        for (unsigned key = 0; key < from.mNumRotationKeys; ++key) {
          const aiQuatKey& value = from.mRotationKeys[key];
          const aiQuaternion& q = value.mValue;
          channel.turns.push_back(
              {value.mTime / rate, Eigen::Quaternionf(q.w, q.x, q.y, q.z).normalized()});
        }
        for (unsigned key = 0; key < from.mNumScalingKeys; ++key) {
          const aiVectorKey& value = from.mScalingKeys[key];
          channel.scales.push_back({value.mTime / rate, to_vector(value.mValue)});
        }
        animation.channels.push_back(std::move(channel));
      }
      model_.animations.push_back(std::move(animation));
    }
  }

  void mark_bones() {
    for (unsigned i = 0; i < scene_->mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_->mMeshes[i];
      for (unsigned k = 0; k < mesh.mNumBones; ++k) {
        const auto node = by_name_.find(mesh.mBones[k]->mName.C_Str());
        if (node != by_name_.end() && mesh.mBones[k]->mNumWeights > 0) {
          model_.nodes[static_cast<std::size_t>(node->second)].deforms = true;
        }
      }
    }
  }

  void read_materials() {
    for (unsigned i = 0; i < scene_->mNumMaterials; ++i) {
      model_.materials.push_back(material_of(*scene_->mMaterials[i]));
    }
    if (model_.materials.empty()) model_.materials.push_back({colored({200, 200, 200}), false});
  }

  ModelMaterial material_of(const aiMaterial& source) const {
    ModelMaterial material;
    aiColor4D color(0.8F, 0.8F, 0.8F, 1);
    if (source.Get(AI_MATKEY_BASE_COLOR, color) != aiReturn_SUCCESS) {
      source.Get(AI_MATKEY_COLOR_DIFFUSE, color);
    }
    aiString name;
    if (source.GetTexture(aiTextureType_BASE_COLOR, 0, &name) == aiReturn_SUCCESS ||
        source.GetTexture(aiTextureType_DIFFUSE, 0, &name) == aiReturn_SUCCESS) {
      material.image = image_of(name.C_Str());
    } else {
      material.image = colored(
          {srgb_from_linear(color.r), srgb_from_linear(color.g), srgb_from_linear(color.b)});
    }
    int two_sided = 0;
    source.Get(AI_MATKEY_TWOSIDED, two_sided);
    aiString alpha("OPAQUE");
    source.Get("$mat.gltf.alphaMode", 0, 0, alpha);  // AI_MATKEY_GLTF_ALPHAMODE
    aiString opacity;
    const bool masked = std::string(alpha.C_Str()) != "OPAQUE" ||
                        source.GetTexture(aiTextureType_OPACITY, 0, &opacity) == aiReturn_SUCCESS;
    if (!masked) {
      for (std::size_t at = 3; at < material.image.rgba.size(); at += 4) {
        material.image.rgba[at] = 255;
      }
    }
    material.alpha_tested = masked || two_sided != 0;
    return material;
  }

  static Image colored(const std::array<std::uint8_t, 3>& color) {
    Image image(4, 4);
    for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
      std::copy(color.begin(), color.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(at));
      image.rgba[at + 3] = 255;
    }
    return image;
  }

  Image image_of(std::string name) const {
    const aiTexture* embedded = scene_->GetEmbeddedTexture(name.c_str());
    if (embedded == nullptr) return images::read_image(texture_path(std::move(name)));
    if (embedded->mHeight == 0) {
      return images::decode_image(
          {reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth},
          fmt::format("{}, image {}", path_.string(), name));
    }
    Image image(static_cast<int>(embedded->mWidth), static_cast<int>(embedded->mHeight));
    for (std::size_t i = 0; 4 * i < image.rgba.size(); ++i) {
      const aiTexel& texel = embedded->pcData[i];
      image.rgba[4 * i] = texel.r;
      image.rgba[4 * i + 1] = texel.g;
      image.rgba[4 * i + 2] = texel.b;
      image.rgba[4 * i + 3] = texel.a;
    }
    return image;
  }

  // Texture paths in files are often those of another machine.
  fs::path texture_path(std::string name) const {
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path stated(name);
    const fs::path folder = path_.parent_path();
    for (const fs::path& place :
         {folder / stated, folder / stated.filename(), folder / "textures" / stated.filename()}) {
      if (fs::is_regular_file(place)) return place;
    }
    fail(fmt::format("the missing image \"{}\"", name),
         fmt::format("{} beside the model", stated.filename().string()));
  }

  void add_meshes(const aiNode& node) {
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_->mMeshes[node.mMeshes[i]];
      if (mesh.mNumFaces > 0) model_.parts.push_back(part_of(mesh, numbers_.at(&node)));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_meshes(*node.mChildren[i]);
  }

  ModelPart part_of(const aiMesh& mesh, int node) const {
    ModelPart part;
    part.material = mesh.mMaterialIndex;
    part.weights.resize(mesh.mNumVertices);
    std::vector<Eigen::Matrix4f> to_rest(mesh.mNumVertices, Eigen::Matrix4f::Zero());
    std::vector<float> sums(mesh.mNumVertices, 0);
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
      const aiBone& bone = *mesh.mBones[i];
      const auto found = by_name_.find(bone.mName.C_Str());
      if (found == by_name_.end()) continue;
      const Eigen::Matrix4f matrix =
          rest_[static_cast<std::size_t>(found->second)] * to_matrix(bone.mOffsetMatrix);
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& weight = bone.mWeights[w];
        if (weight.mVertexId >= mesh.mNumVertices || !(weight.mWeight > 0)) continue;
        to_rest[weight.mVertexId] += weight.mWeight * matrix;
        sums[weight.mVertexId] += weight.mWeight;
        part.weights[weight.mVertexId].push_back({found->second, weight.mWeight});
      }
    }
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      // Meshes without a bone follow the node that they are attached to.
      const bool loose = sums[i] < 1e-4F;
      if (loose) part.weights[i] = {{node, 1}};
      const Eigen::Matrix4f matrix =
          loose ? rest_[static_cast<std::size_t>(node)] : Eigen::Matrix4f(to_rest[i] / sums[i]);
      add_vertex(mesh, i, matrix, part);
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      part.indices.insert(part.indices.end(), face.mIndices, face.mIndices + 3);
    }
    return part;
  }

  void add_vertex(const aiMesh& mesh, unsigned i, const Eigen::Matrix4f& matrix,
                  ModelPart& part) const {
    const Eigen::Vector4f position = matrix * to_vector(mesh.mVertices[i]).homogeneous();
    if (!position.allFinite()) fail("vertices that are not numbers", "finite positions");
    part.positions.emplace_back(position.head<3>());
    const Eigen::Vector3f normal = matrix.topLeftCorner<3, 3>() * to_vector(mesh.mNormals[i]);
    const bool sound = normal.allFinite() && normal.norm() > 1e-12F;
    part.normals.push_back(sound ? Eigen::Vector3f(normal.normalized()) : Eigen::Vector3f::UnitZ());
    Eigen::Vector2f uv(0.5F, 0.5F);
    if (mesh.HasTextureCoords(0)) {
      uv = {mesh.mTextureCoords[0][i].x, 1 - mesh.mTextureCoords[0][i].y};
    }
    part.uvs.push_back(uv.allFinite() ? uv : Eigen::Vector2f(0.5F, 0.5F));
  }

  // Mirrored models have their triangles inside out, and some exporters store normals that point
  // inwards. The volume says which side is out, and the triangles say it of the normals.
  void turn_outwards() {
    double volume = 0;  // six times that of the model
    for (const ModelPart& part : model_.parts) {
      for (std::size_t at = 0; at + 2 < part.indices.size(); at += 3) {
        const auto corner = [&](std::size_t k) -> const Eigen::Vector3f& {
          return part.positions[part.indices[at + k]];
        };
        volume += corner(0).dot(corner(1).cross(corner(2)));
      }
    }
    for (ModelPart& part : model_.parts) {
      double agreement = 0;  // of normals and triangles, by area
      for (std::size_t at = 0; at + 2 < part.indices.size(); at += 3) {
        if (volume < 0) std::swap(part.indices[at + 1], part.indices[at + 2]);
        const std::uint32_t* const corner = &part.indices[at];
        const Eigen::Vector3f& a = part.positions[corner[0]];
        const Eigen::Vector3f turn =
            (part.positions[corner[1]] - a).cross(part.positions[corner[2]] - a);
        agreement +=
            turn.dot(part.normals[corner[0]] + part.normals[corner[1]] + part.normals[corner[2]]);
      }
      if (agreement >= 0) continue;
      for (Eigen::Vector3f& normal : part.normals) normal = -normal;
    }
  }

  fs::path path_;
  const aiScene* scene_;
  RiggedModel model_;
  std::map<const aiNode*, int> numbers_;
  std::map<std::string, int> by_name_;
  std::vector<Eigen::Matrix4f> rest_;
};

template <typename T, typename Mix>
T key_at(const std::vector<ModelChannel::Key<T>>& keys, double time_s, const Mix& mix) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), time_s,
                                      [](double t, const auto& key) { return t < key.time_s; });
  if (after == keys.begin()) return keys.front().value;
  if (after == keys.end()) return keys.back().value;
  const auto& before = *(after - 1);
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  return mix(before.value, after->value, static_cast<float>(share));
}

std::vector<Eigen::Matrix4f> chained(const std::vector<ModelNode>& nodes,
                                     std::vector<Eigen::Matrix4f> matrices) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent >= 0) {
      matrices[i] = matrices[static_cast<std::size_t>(nodes[i].parent)] * matrices[i];
    }
  }
  return matrices;
}

}  // namespace

std::vector<Eigen::Matrix4f> RiggedModel::rest() const {
  std::vector<Eigen::Matrix4f> matrices;
  matrices.reserve(nodes.size());
  for (const ModelNode& node : nodes) matrices.push_back(node.local);
  return chained(nodes, std::move(matrices));
}

std::vector<Eigen::Matrix4f> RiggedModel::at(const ModelAnimation& animation, double time_s) const {
  std::vector<Eigen::Matrix4f> matrices;
  matrices.reserve(nodes.size());
  for (const ModelNode& node : nodes) matrices.push_back(node.local);
  const auto mix = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b, float share) {
    return Eigen::Vector3f((1 - share) * a + share * b);
  };
  for (const ModelChannel& channel : animation.channels) {
    Eigen::Matrix4f& matrix = matrices[static_cast<std::size_t>(channel.node)];
    const Eigen::Affine3f rest(matrix);
    Eigen::Matrix3f turn;
    Eigen::Matrix3f stretch;
    rest.computeRotationScaling(&turn, &stretch);
    Eigen::Vector3f shift = rest.translation();
    if (!channel.shifts.empty()) shift = key_at(channel.shifts, time_s, mix);
    if (!channel.turns.empty()) {
      turn = key_at(channel.turns, time_s,
                    [](const Eigen::Quaternionf& a, const Eigen::Quaternionf& b, float share) {
                      return a.slerp(share, b);
                    })
                 .toRotationMatrix();
    }
    if (!channel.scales.empty()) stretch = key_at(channel.scales, time_s, mix).asDiagonal();
    matrix.topLeftCorner<3, 3>() = turn * stretch;
    matrix.topRightCorner<3, 1>() = shift;
  }
  return chained(nodes, std::move(matrices));
}

RiggedModel read_rigged_model(const fs::path& path, ModelUse use) {
  if (!fs::is_regular_file(path)) {
    throw InputError({path.string(), "", "no such file", "a rigged character (glTF, FBX, DAE)"});
  }
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  // Vertices may hang on any number of bones; they are cut to four later.
  const aiScene* scene =
      importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_GenSmoothNormals |
                                           aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw InputError({path.string(), "",
                      fmt::format("a file that assimp refuses ({})", importer.GetErrorString()),
                      "a file that assimp reads: glTF or GLB without compression, FBX, DAE"});
  }
  return ModelReader(path, *scene).read(use);
}

}  // namespace throng::skinning
