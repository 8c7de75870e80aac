#include "tests/skinning/rigged_scene.h"

#include <Eigen/Geometry>
#include <assimp/Exporter.hpp>
#include <map>
#include <stdexcept>
#include <vector>

#include "skinning/animate/gait.h"
#include "tests/skinning/walkers.h"

namespace throng::skinning {

namespace {

constexpr std::array<const char*, kBoneCount> kMixamo = {
    "Hips",      "Spine",       "Spine2",      "Neck",          "Head",        "LeftShoulder",
    "LeftArm",   "LeftForeArm", "LeftHand",    "RightShoulder", "RightArm",    "RightForeArm",
    "RightHand", "LeftUpLeg",   "LeftLeg",     "LeftFoot",      "LeftToeBase", "RightUpLeg",
    "RightLeg",  "RightFoot",   "RightToeBase"};

Bone mirrored(Bone bone) {
  const int i = static_cast<int>(bone);
  if (i < static_cast<int>(Bone::left_clavicle)) return bone;
  const int in_pair = (i - static_cast<int>(Bone::left_clavicle)) % 8;
  return static_cast<Bone>(in_pair < 4 ? i + 4 : i - 4);
}

/// A limb as a box around the line from a joint.
struct Limb3 {
  Bone bone;
  Eigen::Vector3f low;
  Eigen::Vector3f high;
};

class SceneMaker {
 public:
  explicit SceneMaker(const RiggedOptions& options)
      : options_(&options), scene_(std::make_unique<aiScene>()), joints_(made_up_joints()) {
    if (options.t_pose) raise_arms();
  }

  std::unique_ptr<aiScene> make() {
    add_nodes();
    add_material();
    add_mesh();
    if (options_->walks) add_walk();
    return std::move(scene_);
  }

 private:
  aiVector3D to_file(const Eigen::Vector3f& v) const {
    const float unit = options_->unit;
    if (options_->z_up) return {unit * v.y(), -unit * v.x(), unit * v.z()};
    return {unit * v.y(), unit * v.z(), unit * v.x()};
  }

  aiVector3D direction(const Eigen::Vector3f& v) const {
    aiVector3D file = to_file(v);
    return file.Normalize();
  }

  /// A rotation about our axes as one about the file's.
  aiQuaternion turn_to_file(const Eigen::Matrix3f& turn) const {
    const Eigen::Quaternionf q(turn);
    if (options_->z_up) return {q.w(), q.y(), -q.x(), q.z()};
    return {q.w(), q.y(), q.z(), q.x()};
  }

  void raise_arms() {
    for (const Side side : kSides) {
      const Eigen::Vector3f out(0, side_sign(side), 0);
      for (const Bone bone : {Bone::left_forearm, Bone::left_hand}) {
        const std::size_t at = index_from(on(side, bone));
        const Joints rest = made_up_joints();
        joints_[at] = joints_[at - 1] + (rest[at] - rest[at - 1]).norm() * out;
      }
    }
  }

  std::string to_string(Bone bone) const {
    return options_->name(options_->swapped ? mirrored(bone) : bone);
  }

  /// The bone itself or the nearest one above it that the rig has.
  Bone held_by(Bone bone) const {
    while (to_string(bone).empty()) bone = kParent[index_from(bone)];
    return bone;
  }

  static aiNode* child(aiNode* parent, const std::string& name, const aiVector3D& shift) {
    auto* node = new aiNode(name);
    aiMatrix4x4::Translation(shift, node->mTransformation);
    parent->addChildren(1, &node);
    return node;
  }

  void add_nodes() {
    scene_->mRootNode = new aiNode("Scene");
    aiNode* armature = child(scene_->mRootNode, "Armature", {});
    for (std::size_t i = 0; i < kBoneCount; ++i) {
      const auto bone = static_cast<Bone>(i);
      if (to_string(bone).empty()) continue;
      const bool root = i == 0;
      const Bone parent = root ? bone : held_by(kParent[i]);
      const Eigen::Vector3f offset =
          root ? joints_[i] : Eigen::Vector3f(joints_[i] - joints_[index_from(parent)]);
      nodes_[bone] = child(root ? armature : nodes_.at(parent), to_string(bone), to_file(offset));
    }
    if (!options_->fingers) return;
    for (const Bone hand : {Bone::left_hand, Bone::right_hand}) {
      child(nodes_.at(hand), to_string(hand) + "Middle1", to_file(Eigen::Vector3f(0, 0, -0.08F)));
    }
  }

  void add_material() {
    auto* material = new aiMaterial;
    aiString name("cloth");
    material->AddProperty(&name, AI_MATKEY_NAME);
    aiColor4D color(0.6F, 0.2F, 0.1F, 1);
    material->AddProperty(&color, 1, AI_MATKEY_COLOR_DIFFUSE);
    material->AddProperty(&color, 1, AI_MATKEY_BASE_COLOR);
    if (!options_->image.empty()) {
      aiString file(options_->image);
      material->AddProperty(&file, AI_MATKEY_TEXTURE_DIFFUSE(0));
      material->AddProperty(&file, AI_MATKEY_TEXTURE(aiTextureType_BASE_COLOR, 0));
    }
    scene_->mNumMaterials = 1;
    scene_->mMaterials = new aiMaterial* [1] { material };
  }

  std::vector<Limb3> limbs() const {
    std::vector<Limb3> limbs;
    const auto around = [&](Bone bone, const Eigen::Vector3f& end, float half) {
      const Eigen::Vector3f& start = joints_[index_from(bone)];
      limbs.push_back(
          {bone, start.cwiseMin(end).array() - half, start.cwiseMax(end).array() + half});
    };
    const auto to = [&](Bone bone, Bone end, float half) {
      around(bone, joints_[index_from(end)], half);
    };
    to(Bone::hips, Bone::spine, 0.1F);
    to(Bone::spine, Bone::chest, 0.1F);
    to(Bone::chest, Bone::neck, 0.1F);
    to(Bone::neck, Bone::head, 0.04F);
    limbs.push_back({Bone::head, {-0.08F, -0.08F, 1.58F}, {0.1F, 0.08F, 1.8F}});
    for (const Side side : kSides) {
      to(on(side, Bone::left_clavicle), on(side, Bone::left_upper_arm), 0.03F);
      to(on(side, Bone::left_upper_arm), on(side, Bone::left_forearm), 0.035F);
      to(on(side, Bone::left_forearm), on(side, Bone::left_hand), 0.03F);
      const Bone hand = on(side, Bone::left_hand);
      const Eigen::Vector3f finger = options_->t_pose
                                         ? Eigen::Vector3f(0, 0.16F * side_sign(side), 0)
                                         : Eigen::Vector3f(0, 0, -0.16F);
      around(hand, joints_[index_from(hand)] + finger, 0.02F);
      to(on(side, Bone::left_thigh), on(side, Bone::left_shin), 0.06F);
      to(on(side, Bone::left_shin), on(side, Bone::left_foot), 0.04F);
      const float y = 0.085F * side_sign(side);
      limbs.push_back(
          {on(side, Bone::left_foot), {-0.06F, y - 0.04F, 0}, {0.14F, y + 0.04F, 0.1F}});
      limbs.push_back({on(side, Bone::left_toe), {0.14F, y - 0.04F, 0}, {0.22F, y + 0.04F, 0.05F}});
    }
    return limbs;
  }

  /// One face of a box, u x v pointing outwards.
  void add_face(const Limb3& limb, const Eigen::Vector3f& corner, const Eigen::Vector3f& u,
                const Eigen::Vector3f& v) {
    const auto first = static_cast<unsigned>(points_.size());
    const int cuts = options_->cuts;
    for (int row = 0; row <= cuts; ++row) {
      for (int column = 0; column <= cuts; ++column) {
        const float s = static_cast<float>(column) / static_cast<float>(cuts);
        const float t = static_cast<float>(row) / static_cast<float>(cuts);
        points_.push_back(corner + s * u + t * v);
        normals_.push_back(u.cross(v).normalized());
        uvs_.emplace_back(s, t);
        bones_.push_back(limb.bone);
      }
    }
    const auto side = static_cast<unsigned>(cuts + 1);
    for (unsigned row = 0; row + 1 < side; ++row) {
      for (unsigned column = 0; column + 1 < side; ++column) {
        const unsigned a = first + row * side + column;
        faces_.push_back({a, a + 1, a + side + 1});
        faces_.push_back({a, a + side + 1, a + side});
      }
    }
  }

  void add_boxes() {
    for (const Limb3& limb : limbs()) {
      const Eigen::Vector3f size = limb.high - limb.low;
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::Vector3f u = Eigen::Vector3f::Zero();
        Eigen::Vector3f v = Eigen::Vector3f::Zero();
        u[(axis + 1) % 3] = size[(axis + 1) % 3];
        v[(axis + 2) % 3] = size[(axis + 2) % 3];
        Eigen::Vector3f upper = limb.low;
        upper[axis] = limb.high[axis];
        add_face(limb, upper, u, v);
        add_face(limb, limb.low, v, u);
      }
    }
  }

  void add_mesh() {
    add_boxes();
    auto* mesh = new aiMesh;
    mesh->mName = "Body";
    mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    mesh->mNumVertices = static_cast<unsigned>(points_.size());
    mesh->mVertices = new aiVector3D[points_.size()];
    mesh->mNormals = new aiVector3D[points_.size()];
    mesh->mTextureCoords[0] = new aiVector3D[points_.size()];
    mesh->mNumUVComponents[0] = 2;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      mesh->mVertices[i] = to_file(options_->mesh_scale * points_[i]);
      mesh->mNormals[i] = direction(normals_[i]);
      mesh->mTextureCoords[0][i] = {uvs_[i].x(), uvs_[i].y(), 0};
    }
    mesh->mNumFaces = static_cast<unsigned>(faces_.size());
    mesh->mFaces = new aiFace[faces_.size()];
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      mesh->mFaces[i].mNumIndices = 3;
      mesh->mFaces[i].mIndices = new unsigned[3]{faces_[i][0], faces_[i][1], faces_[i][2]};
    }
    if (options_->bones) add_weights(*mesh);
    scene_->mNumMeshes = 1;
    scene_->mMeshes = new aiMesh* [1] { mesh };
    aiNode* node = child(scene_->mRootNode, "Body", {});
    node->mNumMeshes = 1;
    node->mMeshes = new unsigned[1]{0};
  }

  /// The bone of the rig that a vertex hangs on, by name.
  std::string holder_of(std::size_t vertex) const {
    const Bone bone = bones_[vertex];
    const bool finger = options_->fingers &&
                        (bone == Bone::left_hand || bone == Bone::right_hand) &&
                        points_[vertex].z() < joints_[index_from(bone)].z() - 0.08F;
    return to_string(held_by(bone)) + (finger ? "Middle1" : "");
  }

  void add_weights(aiMesh& mesh) const {
    std::map<std::string, std::vector<unsigned>> vertices;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      vertices[holder_of(i)].push_back(static_cast<unsigned>(i));
    }
    mesh.mNumBones = static_cast<unsigned>(vertices.size());
    mesh.mBones = new aiBone*[vertices.size()];
    std::size_t at = 0;
    for (const auto& [name, held] : vertices) {
      auto* bone = new aiBone;
      bone->mName = name;
      aiMatrix4x4 rest;
      for (const aiNode* node = scene_->mRootNode->FindNode(name.c_str()); node != nullptr;
           node = node->mParent) {
        rest = node->mTransformation * rest;
      }
      bone->mOffsetMatrix = rest.Inverse();
      bone->mNode = scene_->mRootNode->FindNode(name.c_str());
      bone->mNumWeights = static_cast<unsigned>(held.size());
      bone->mWeights = new aiVertexWeight[held.size()];
      for (std::size_t i = 0; i < held.size(); ++i) bone->mWeights[i] = {held[i], 1};
      mesh.mBones[at++] = bone;
    }
  }

  void add_walk() {
    const Walker walker = made_up_walker();
    constexpr double kStrideM = 1.2;
    const Stride stride(walker, {false, kStrideM / static_cast<double>(walker.stature_m)});
    constexpr unsigned kKeys = 31;
    auto* clip = new aiAnimation;
    clip->mName = "Stroll";
    clip->mTicksPerSecond = 1;  // the one rate that all of assimp's exporters agree on
    clip->mDuration = kStrideM / kStrollSpeedMps;
    clip->mNumChannels = static_cast<unsigned>(nodes_.size());
    clip->mChannels = new aiNodeAnim*[nodes_.size()];
    std::size_t at = 0;
    for (const auto& [bone, node] : nodes_) {
      auto* channel = new aiNodeAnim;
      channel->mNodeName = node->mName;
      channel->mNumPositionKeys = channel->mNumRotationKeys = channel->mNumScalingKeys = kKeys;
      channel->mPositionKeys = new aiVectorKey[kKeys];
      channel->mRotationKeys = new aiQuatKey[kKeys];
      channel->mScalingKeys = new aiVectorKey[kKeys];
      for (unsigned key = 0; key < kKeys; ++key) {
        const double share = static_cast<double>(key) / (kKeys - 1);
        Pose pose = solve(walker, stride.at(share));
        // Waving at somebody.
        pose.of(Bone::left_upper_arm) = turn_x(170 * 3.14159265 / 180);
        pose.of(Bone::left_forearm) = pose.of(Bone::left_hand) = pose.of(Bone::left_upper_arm);
        const bool root = bone == Bone::hips;
        const Eigen::Matrix3f above =
            root ? Eigen::Matrix3f::Identity()
                 : pose.rotation[index_from(held_by(kParent[index_from(bone)]))];
        const Eigen::Matrix3f turn = above.transpose() * pose.of(bone);
        const aiVector3D shift(node->mTransformation.a4, node->mTransformation.b4,
                               node->mTransformation.c4);
        const double time = share * clip->mDuration;
        channel->mPositionKeys[key] = {time, root ? shift + to_file(pose.shift) : shift};
        channel->mRotationKeys[key] = {time, turn_to_file(turn)};
        channel->mScalingKeys[key] = {time, aiVector3D(1, 1, 1)};
      }
      clip->mChannels[at++] = channel;
    }
    scene_->mNumAnimations = 1;
    scene_->mAnimations = new aiAnimation* [1] { clip };
  }

  const RiggedOptions* options_;
  std::unique_ptr<aiScene> scene_;
  Joints joints_;
  std::map<Bone, aiNode*> nodes_;
  std::vector<Eigen::Vector3f> points_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<Eigen::Vector2f> uvs_;
  std::vector<Bone> bones_;
  std::vector<std::array<unsigned, 3>> faces_;
};

}  // namespace

std::string mixamo_name(Bone bone) { return std::string("mixamorig:") + kMixamo[index_from(bone)]; }

std::unique_ptr<aiScene> rigged_scene(const RiggedOptions& options) {
  return SceneMaker(options).make();
}

void write_scene(const aiScene& scene, const std::string& format,
                 const std::filesystem::path& file) {
  Assimp::Exporter exporter;
  if (exporter.Export(&scene, format, file.string()) != aiReturn_SUCCESS) {
    throw std::runtime_error(std::string("assimp cannot write: ") + exporter.GetErrorString());
  }
}

}  // namespace throng::skinning
