// Foreign models as read by assimp (glTF, FBX, DAE, ...): nodes, skinned meshes in the rest pose,
// images and animations, in the file's axes and unit.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "skinning/image.h"

namespace throng::skinning {

/// A node of the scene graph.
struct ModelNode {
  std::string name;
  int parent = -1;  ///< index of the parent, which precedes its children; -1: root
  Eigen::Matrix4f local = Eigen::Matrix4f::Identity();
  bool deforms = false;  ///< moves at least one vertex
};

/// The skinning weight of a node for a vertex.
struct NodeWeight {
  int node;
  float weight;
};

/// A mesh with one material, in the rest pose.
struct ModelPart {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Eigen::Vector2f> uvs;  ///< rows counted from the top
  std::vector<std::vector<NodeWeight>> weights;
  std::vector<std::uint32_t> indices;
  std::size_t material = 0;
};

/// A material of a model.
struct ModelMaterial {
  Image image;  ///< base color
  bool alpha_tested = false;
};

/// The animation of one node. An empty list of keys keeps the rest transform.
struct ModelChannel {
  template <typename T>
  struct Key {
    double time_s;
    T value;
  };
  int node;
  std::vector<Key<Eigen::Vector3f>> shifts;
  std::vector<Key<Eigen::Quaternionf>> turns;
  std::vector<Key<Eigen::Vector3f>> scales;
};

/// An animation of a model.
struct ModelAnimation {
  std::string name;
  double duration_s = 0;
  std::vector<ModelChannel> channels;
};

/// The content of a model.
struct RiggedModel {
  std::string file;
  std::vector<ModelNode> nodes;
  std::vector<ModelPart> parts;
  std::vector<ModelMaterial> materials;
  std::vector<ModelAnimation> animations;

  /// Global transforms of the nodes at rest, or at a time of an animation, in the file's axes.
  std::vector<Eigen::Matrix4f> rest() const;
  std::vector<Eigen::Matrix4f> at(const ModelAnimation& animation, double time_s) const;
};

/// Purpose for which a model is read.
enum class ModelUse : std::uint8_t { character, motion };

/// Reads a model; for ModelUse::motion only its nodes and animations. Throws InputError naming the
/// file if it is missing, if assimp cannot read it, or if a character has no mesh, no bones, or
/// images that are missing or neither PNG nor JPEG.
RiggedModel read_rigged_model(const std::filesystem::path& path, ModelUse use);

}  // namespace throng::skinning
