// Meshes of MakeHuman.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "skinning/population.h"

namespace throng::skinning {

/// Skinning weights of a vertex for each Bone, and for kStillBone; they sum to 1.
using BoneWeights = std::array<float, kBoneCount + 1>;

/// A face: indices of its vertices and of its texture coordinates.
struct Quad {
  std::array<std::uint32_t, 4> vertex;
  std::array<std::uint32_t, 4> uv;
};

/// A worn mesh (MakeHuman's term), each of whose vertices is attached to three vertices of the
/// body.
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
  std::vector<bool> hides;                 ///< per body vertex: covered and not rendered
  std::vector<bool> tucks;                 ///< per body vertex: covered and moved inward
};

}  // namespace throng::skinning
