#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "skinning/glb.h"

namespace throng::skinning {

using nlohmann::json;

namespace {

// Numbers of the glTF 2.0 specification.
constexpr int kFloat = 5126;
constexpr int kByte = 5121;
constexpr int kUnsigned = 5125;
constexpr int kVertexBuffer = 34962;
constexpr int kIndexBuffer = 34963;
constexpr std::uint32_t kMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

std::array<float, 3> gltf_axes(const std::array<float, 3>& v) { return {v[1], v[2], v[0]}; }

class Writer {
 public:
  explicit Writer(const CharacterAsset& asset) : asset_(&asset) {}

  std::string encode() {
    document_["asset"] = {{"version", "2.0"}, {"generator", "throng"}};
    document_["scene"] = 0;
    add_joints();
    add_images();
    json roots = json::array({0, kStillBone});
    for (std::size_t level = 0; level < asset_->levels.size(); ++level) {
      roots.push_back(document_["nodes"].size());
      add_level(level);
    }
    document_["scenes"] = json::array({{{"nodes", roots}}});
    document_["buffers"] = json::array({{{"byteLength", binary_.size()}}});
    return pack();
  }

 private:
  template <typename T>
  void append(const T& value) {
    const std::size_t at = binary_.size();
    binary_.resize(at + sizeof(T));
    std::memcpy(binary_.data() + at, &value, sizeof(T));
  }

  // A view of all that was appended since `start`.
  std::size_t add_view(std::size_t start, int target) {
    json view = {{"buffer", 0}, {"byteOffset", start}, {"byteLength", binary_.size() - start}};
    if (target != 0) view["target"] = target;
    document_["bufferViews"].push_back(view);
    binary_.resize((binary_.size() + 3) / 4 * 4);
    return document_["bufferViews"].size() - 1;
  }

  std::size_t add_accessor(std::size_t start, int target, int component, const char* type,
                           std::size_t count) {
    json accessor = {{"bufferView", add_view(start, target)},
                     {"componentType", component},
                     {"type", type},
                     {"count", count}};
    document_["accessors"].push_back(accessor);
    return document_["accessors"].size() - 1;
  }

  void add_joints() {
    json joints = json::array();
    const std::size_t start = binary_.size();
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      const Eigen::Vector3f& joint = asset_->joints[bone];
      const bool root = bone == 0;
      const Eigen::Vector3f offset =
          root ? joint : joint - asset_->joints[index_from(kParent[bone])];
      json node = {{"name", kBoneNames[bone]},
                   {"translation", {offset.y(), offset.z(), offset.x()}}};
      for (std::size_t child = bone + 1; child < kBoneCount; ++child) {
        if (index_from(kParent[child]) == bone) node["children"].push_back(child);
      }
      document_["nodes"].push_back(node);
      joints.push_back(bone);
      // Column-major inverse of a translation.
      const std::array<float, 16> inverse = {1, 0, 0, 0, 0,          1,          0,          0,
                                             0, 0, 1, 0, -joint.y(), -joint.z(), -joint.x(), 1};
      append(inverse);
    }
    document_["nodes"].push_back({{"name", kStillName}});
    joints.push_back(kStillBone);
    append(std::array<float, 16>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    const std::size_t matrices = add_accessor(start, 0, kFloat, "MAT4", joints.size());
    document_["skins"] = json::array({{{"joints", joints}, {"inverseBindMatrices", matrices}}});
  }

  void add_images() {
    if (asset_->images.empty()) return;
    document_["samplers"] = json::array({json::object()});
    for (const std::string& image : asset_->images) {
      const std::size_t start = binary_.size();
      binary_ += image;
      const std::size_t view = add_view(start, 0);
      document_["textures"].push_back({{"sampler", 0}, {"source", document_["textures"].size()}});
      document_["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
    }
  }

  std::size_t material_of(const Part& part) {
    const auto key = std::make_tuple(part.texture, part.shades, part.tint, part.alpha_tested);
    const auto found = materials_.find(key);
    if (found != materials_.end()) return found->second;
    json surface = {{"metallicFactor", 0}, {"roughnessFactor", 0.9}};
    if (part.texture >= 0) surface["baseColorTexture"] = {{"index", part.texture}};
    json material = {{"name", kTintNames[static_cast<std::size_t>(part.tint)]},
                     {"pbrMetallicRoughness", surface}};
    // Without a factor it does not shine, in other programs either.
    if (part.shades >= 0) material["emissiveTexture"] = {{"index", part.shades}};
    if (part.alpha_tested) {
      material["alphaMode"] = "MASK";
      material["alphaCutoff"] = 0.5;
      material["doubleSided"] = true;
    }
    document_["materials"].push_back(material);
    const std::size_t number = document_["materials"].size() - 1;
    materials_[key] = number;
    return number;
  }

  // Each part gets vertices of its own, so that readers which take a primitive for a mesh keep
  // them as they are.
  json primitive_of(const Mesh& mesh, const Part& part) {
    std::map<std::uint32_t, std::uint32_t> place;
    std::vector<std::uint32_t> indices;
    std::vector<const Vertex*> vertices;
    for (std::uint32_t at = 0; at < part.index_count; ++at) {
      const std::uint32_t index = mesh.indices[part.first_index + at];
      const auto [entry, is_new] =
          place.try_emplace(index, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.push_back(&mesh.vertices[index]);
      indices.push_back(entry->second);
    }
    json attributes;
    const auto column = [&](const char* name, int component, const char* type,
                            const auto& tag_value) {
      const std::size_t start = binary_.size();
      for (const Vertex* vertex : vertices) append(tag_value(*vertex));
      attributes[name] = add_accessor(start, kVertexBuffer, component, type, vertices.size());
    };
    column("POSITION", kFloat, "VEC3",
           [](const Vertex& vertex) { return gltf_axes(vertex.position); });
    add_bounds(attributes["POSITION"].get<std::size_t>(), vertices);
    column("NORMAL", kFloat, "VEC3", [](const Vertex& vertex) { return gltf_axes(vertex.normal); });
    column("TEXCOORD_0", kFloat, "VEC2", [](const Vertex& vertex) { return vertex.uv; });
    column("JOINTS_0", kByte, "VEC4", [](const Vertex& vertex) { return vertex.bones; });
    // As floats: assimp 5.2 does not read normalized bytes.
    column("WEIGHTS_0", kFloat, "VEC4", [](const Vertex& vertex) {
      std::array<float, 4> weights{};
      for (std::size_t i = 0; i < 4; ++i) weights[i] = static_cast<float>(vertex.weights[i]) / 255;
      return weights;
    });
    const std::size_t start = binary_.size();
    for (const std::uint32_t index : indices) append(index);
    const std::size_t accessor =
        add_accessor(start, kIndexBuffer, kUnsigned, "SCALAR", indices.size());
    return {{"attributes", attributes}, {"indices", accessor}, {"material", material_of(part)}};
  }

  void add_bounds(std::size_t accessor, const std::vector<const Vertex*>& vertices) {
    std::array<float, 3> low = gltf_axes(vertices.front()->position);
    std::array<float, 3> high = low;
    for (const Vertex* vertex : vertices) {
      const auto position = gltf_axes(vertex->position);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], position[axis]);
        high[axis] = std::max(high[axis], position[axis]);
      }
    }
    document_["accessors"][accessor]["min"] = low;
    document_["accessors"][accessor]["max"] = high;
  }

  void add_level(std::size_t level) {
    const Mesh& mesh = asset_->levels[level];
    const std::string name = "level" + std::to_string(level);
    json primitives = json::array();
    for (const Part& part : mesh.parts) primitives.push_back(primitive_of(mesh, part));
    document_["meshes"].push_back({{"name", name}, {"primitives", primitives}});
    document_["nodes"].push_back(
        {{"name", name}, {"mesh", document_["meshes"].size() - 1}, {"skin", 0}});
  }

  std::string pack() const {
    std::string text = document_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string binary = binary_;
    binary.resize((binary.size() + 3) / 4 * 4);
    std::string file;
    const auto put = [&](std::size_t value) {
      const auto number = static_cast<std::uint32_t>(value);
      file.append(reinterpret_cast<const char*>(&number), sizeof(number));
    };
    put(kMagic);
    put(2);
    put(12 + 8 + text.size() + 8 + binary.size());
    put(text.size());
    put(kJsonChunk);
    file += text;
    put(binary.size());
    put(kBinaryChunk);
    file += binary;
    return file;
  }

  const CharacterAsset* asset_;
  json document_;
  std::string binary_;
  std::map<std::tuple<int, int, Tint, bool>, std::size_t> materials_;
};

}  // namespace

std::string encode_glb(const CharacterAsset& asset) { return Writer(asset).encode(); }

}  // namespace throng::skinning
