#include "skinning/import/import_character.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "base/error.h"
#include "skinning/animate/clips.h"
#include "skinning/animate/gait.h"
#include "skinning/bake/mesh_levels.h"
#include "skinning/body/surface.h"
#include "skinning/glb.h"
#include "skinning/import/rig.h"
#include "skinning/packed.h"

namespace throng::skinning {

namespace {

constexpr int kPoses = 64;  // sampled from each clip

struct Extent {
  float low = std::numeric_limits<float>::max();
  float high = std::numeric_limits<float>::lowest();
  void add(float z) {
    low = std::min(low, z);
    high = std::max(high, z);
  }
  float height() const { return high - low; }
};

float leg_length(const Joints& joints) {
  return (joints[index_from(Bone::left_shin)] - joints[index_from(Bone::left_thigh)]).norm() +
         (joints[index_from(Bone::left_foot)] - joints[index_from(Bone::left_shin)]).norm();
}

/// Character::legs_stature_m. The legs of 96 built characters, from hip to ankle, have 0.45 to 0.50
/// of their statures, 0.48 on the average.
float legs_stature_m(const Joints& joints) {
  constexpr float kLegShare = 0.48F;
  return leg_length(joints) / kLegShare;
}

class Import {
 public:
  Import(const CharacterDescription& description, int texture_size)
      : description_(&description),
        texture_size_(texture_size),
        model_(read_rigged_model(description.model, ModelUse::character)),
        rig_(fit_rig(model_, map_bones(model_, description.bones, description.file.string()))) {}

  BakedPerson bake() {
    CharacterAsset asset;
    asset.name = description_->name;
    Mesh mesh = neutral_mesh();
    scale(mesh, asset);
    asset.levels = simplified_levels(mesh);
    add_images(asset);

    BakedPerson baked;
    Character& character = baked.character;
    character.name = description_->name;
    character.stature_m = static_cast<float>(description_->height_m);
    character.age_years = static_cast<float>(description_->age_years);
    character.male = description_->male;
    character.wears = description_->wears;
    character.legs_stature_m = legs_stature_m(asset.joints);
    Walker walker = make_walker(asset.joints, character.legs_stature_m, asset.levels.front());
    check_soles(walker);
    walker.manner = choose_manner(character);
    const OwnMotion own = own_motion(walker);
    for (const Clip& clip : standard_clips()) {
      baked.motion += pack(asset.joints, bake_clip(walker, clip, own));
    }
    baked.glb = encode_glb(asset);
    return baked;
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw InputError({model_.file, "", found, expected});
  }

  BoneWeights bone_weights(const std::vector<NodeWeight>& from) const {
    BoneWeights weights{};
    float sum = 0;
    for (const NodeWeight& weight : from) sum += weight.weight;
    for (const NodeWeight& weight : from) {
      const Bone bone = rig_.bone_of_node[static_cast<std::size_t>(weight.node)];
      weights[index_from(bone)] += weight.weight / sum;
    }
    return weights;
  }

  // All parts as one mesh that stands, in the file's unit; a part for each material.
  Mesh neutral_mesh() {
    const Palette to_neutral = pose_palette(rig_.rest, rig_.neutral);
    Mesh mesh;
    for (std::size_t material = 0; material < model_.materials.size(); ++material) {
      const auto first = static_cast<std::uint32_t>(mesh.indices.size());
      for (const ModelPart& part : model_.parts) {
        if (part.material == material) add_part(part, to_neutral, mesh);
      }
      const auto count = static_cast<std::uint32_t>(mesh.indices.size()) - first;
      if (count == 0) continue;
      mesh.parts.push_back({first, count, static_cast<std::int32_t>(material), Tint::none,
                            model_.materials[material].alpha_tested});
    }
    if (mesh.indices.empty()) fail("a mesh without triangles", "a character's surface");
    return mesh;
  }

  // Textures are not repeated when they are rendered: each triangle's part of an endless pattern is
  // moved into the image.
  void add_part(const ModelPart& part, const Palette& to_neutral, Mesh& mesh) {
    std::map<std::array<std::int64_t, 3>, std::uint32_t> known;
    for (std::size_t at = 0; at + 2 < part.indices.size(); at += 3) {
      Eigen::Vector2f middle = Eigen::Vector2f::Zero();
      for (std::size_t corner = 0; corner < 3; ++corner) {
        middle += part.uvs[part.indices[at + corner]] / 3;
      }
      constexpr float kMaxCoordinate = 1e6F;
      middle = middle.array().floor().max(-kMaxCoordinate).min(kMaxCoordinate);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t index = part.indices[at + corner];
        const auto [entry, is_new] = known.try_emplace(
            {index, static_cast<std::int64_t>(middle.x()), static_cast<std::int64_t>(middle.y())},
            static_cast<std::uint32_t>(mesh.vertices.size()));
        if (is_new) mesh.vertices.push_back(vertex_of(part, index, middle, to_neutral));
        mesh.indices.push_back(entry->second);
      }
    }
  }

  Vertex vertex_of(const ModelPart& part, std::uint32_t index, const Eigen::Vector2f& tile,
                   const Palette& to_neutral) const {
    const BoneWeights weights = bone_weights(part.weights[index]);
    const Eigen::Vector3f position =
        move_point(rig_.to_ours * part.positions[index], weights, to_neutral);
    Palette turns = to_neutral;
    for (BoneMatrix& matrix : turns) matrix.col(3).setZero();
    const Eigen::Vector3f normal =
        move_point(rig_.to_ours * part.normals[index], weights, turns).normalized();
    const Eigen::Vector2f uv = (part.uvs[index] - tile).array().max(0.0F).min(1.0F);
    Vertex vertex{};
    vertex.position = {position.x(), position.y(), position.z()};
    vertex.normal = {normal.x(), normal.y(), normal.z()};
    vertex.uv = {uv.x(), uv.y()};
    set_weights(vertex, weights);
    return vertex;
  }

  // To meters, on the ground below the hips.
  void scale(Mesh& mesh, CharacterAsset& asset) {
    Joints joints = pose_joints(rig_.rest, rig_.neutral);
    Extent body;
    for (const std::uint32_t index : mesh.indices) body.add(mesh.vertices[index].position[2]);
    check_extent(body, joints);
    scale_ = static_cast<float>(description_->height_m) / body.height();
    const Eigen::Vector3f origin(joints[0].x(), joints[0].y(), body.low);
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      asset.joints[bone] = scale_ * (joints[bone] - origin);
    }
    for (Vertex& vertex : mesh.vertices) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        vertex.position[axis] =
            scale_ * (vertex.position[axis] - origin[static_cast<Eigen::Index>(axis)]);
      }
    }
  }

  void check_extent(const Extent& body, const Joints& joints) const {
    const float ankle =
        std::min(joints[index_from(Bone::left_foot)].z(), joints[index_from(Bone::right_foot)].z());
    const float bones = joints[index_from(Bone::head)].z() - ankle;
    const float ratio = body.height() / bones;
    constexpr float kMinRatio = 0.95F;
    constexpr float kMaxRatio = 3;
    const bool around = body.low < ankle + 0.1F * bones && body.high > ankle + 0.8F * bones;
    if (std::isfinite(ratio) && ratio > kMinRatio && ratio < kMaxRatio && around) return;
    fail(fmt::format("a mesh from {:.4g} to {:.4g} on a skeleton from {:.4g} (ankles) to {:.4g} "
                     "(head), in the file's unit",
                     body.low, body.high, ankle, joints[index_from(Bone::head)].z()),
         "a mesh that encloses its skeleton: both in one unit and place (in Blender: apply "
         "location, rotation and scale of mesh and armature, then export)");
  }

  void check_soles(const Walker& walker) const {
    for (const Side side : kSides) {
      const bool any = std::any_of(
          walker.soles.begin(), walker.soles.end(),
          [&](const Vertex& vertex) { return vertex.position[1] * side_sign(side) > 0; });
      if (!any) {
        fail(fmt::format("no vertices that hang on the {} foot",
                         side == Side::left ? "left" : "right"),
             "feet that are weighted to the bones named left_foot and right_foot");
      }
    }
  }

  // Parts' textures are numbers of materials until here.
  void add_images(CharacterAsset& asset) const {
    std::map<std::int32_t, std::int32_t> numbers;
    for (Mesh& level : asset.levels) {
      for (Part& part : level.parts) {
        const auto [entry, is_new] =
            numbers.try_emplace(part.texture, static_cast<std::int32_t>(asset.images.size()));
        if (is_new) {
          const Image& image = model_.materials[static_cast<std::size_t>(part.texture)].image;
          asset.images.push_back(encode_png(resized(image, texture_size_)));
        }
        part.texture = entry->second;
      }
    }
  }

  static std::vector<std::string> material_names(const RiggedModel& model) {
    std::vector<std::string> names;
    for (const ModelAnimation& animation : model.animations) names.push_back(animation.name);
    return names;
  }

  // Blender exports "Armature|Walk" where its user sees "Walk".
  static const ModelAnimation* find(const RiggedModel& model, const std::string& name) {
    if (name.empty() && model.animations.size() == 1) return &model.animations.front();
    for (const bool whole : {true, false}) {
      for (const ModelAnimation& animation : model.animations) {
        const std::size_t bar = animation.name.rfind('|');
        const std::size_t begin = whole || bar == std::string::npos ? 0 : bar + 1;
        if (animation.name.substr(begin) == name) return &animation;
      }
    }
    return nullptr;
  }

  struct Sampled {
    std::vector<Pose> poses;
    double duration_s;
  };

  Sampled sample(const ClipDescription& clip, const char* key, const Walker& walker) const {
    if (clip.file.empty()) return sample_clip(model_, rig_, scale_, clip, key);
    const RiggedModel other = read_rigged_model(clip.file, ModelUse::motion);
    // Bone names that the user gives are those of the model; the same names in the clip mean the
    // same bones.
    std::map<std::string, std::string> overrides;
    for (const auto& [ours, theirs] : description_->bones) {
      const bool there =
          std::any_of(other.nodes.begin(), other.nodes.end(),
                      [&, &name = theirs](const ModelNode& node) { return node.name == name; });
      if (there) overrides[ours] = theirs;
    }
    const Rig rig = fit_rig(other, map_bones(other, overrides, description_->file.string()));
    return sample_clip(other, rig, leg_length(walker.joints) / leg_length(rig.rest), clip, key);
  }

  Sampled sample_clip(const RiggedModel& model, const Rig& rig, float scale,
                      const ClipDescription& clip, const char* key) const {
    const ModelAnimation* animation = find(model, clip.name);
    const std::vector<std::string> names = material_names(model);
    const std::string where = fmt::format("/clips/{}/name", key);
    if (animation == nullptr) {
      throw InputError(
          {description_->file.string(), where,
           clip.name.empty() ? "nothing" : "\"" + clip.name + "\"",
           names.empty()
               ? fmt::format("a clip, but {} has none: export it with its animations", model.file)
               : fmt::format("one of the clips of {}: {}", model.file, fmt::join(names, ", "))});
    }
    constexpr double kMinDurationS = 0.1;
    if (animation->duration_s < kMinDurationS) {
      throw InputError(
          {description_->file.string(), where,
           fmt::format("\"{}\", which lasts {:.3g} s", animation->name, animation->duration_s),
           "a clip of at least 0.1 s"});
    }
    return {sample_poses(model, rig, *animation, kPoses, scale), animation->duration_s};
  }

  std::optional<OwnMotion::Cycle> cycle(const std::optional<ClipDescription>& clip, const char* key,
                                        double middle, const Walker& walker) const {
    if (!clip) return {};
    const Sampled sampled = sample(*clip, key, walker);
    const std::string where = fmt::format("/clips/{}", key);
    try {
      const OwnGait gait(walker, sampled.poses, sampled.duration_s, middle);
      const double ratio = gait.foot_speed_mps() / clip->speed_mps;
      constexpr double kMaxMismatch = 2.2;
      if (!(ratio > 1 / kMaxMismatch && ratio < kMaxMismatch)) {
        throw InputError(
            {description_->file.string(), where + "/speed_mps",
             fmt::format("{:g}, but the standing foot moves at {:.2f} m/s for {:g} m",
                         clip->speed_mps, gait.foot_speed_mps(), description_->height_m),
             "the speed at which the clip's feet do not slide"});
      }
      return OwnMotion::Cycle{
          gait, clip->speed_mps * gait.duration_s() / static_cast<double>(walker.stature_m)};
    } catch (const std::invalid_argument& error) {
      throw InputError({description_->file.string(), where, error.what(),
                        "a clip of whole strides, of walking or running ahead or on the spot"});
    }
  }

  OwnMotion own_motion(const Walker& walker) const {
    OwnMotion own;
    own.walk = cycle(description_->walk, "walk", middle({false, 0.8}), walker);
    own.run = cycle(description_->run, "run", middle({true, 1.2}), walker);
    if (description_->idle) own.idle = sample(*description_->idle, "idle", walker).poses;
    return own;
  }

  const CharacterDescription* description_;
  int texture_size_;
  RiggedModel model_;
  Rig rig_;
  float scale_ = 1;
};

}  // namespace

BakedPerson import_character(const CharacterDescription& description, int texture_size) {
  return Import(description, texture_size).bake();
}

}  // namespace throng::skinning
