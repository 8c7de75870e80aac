// Textured surfaces of a person during a build, in two poses: the A-pose, to which clothes are
// fitted, and the neutral stance, the basis of all animation.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "skinning/body/makehuman.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// A triangle mesh with one vertex per pair of source vertex and texture coordinate.
struct Surface {
  std::vector<std::uint32_t> source;       ///< index of the vertex in the body or proxy
  std::vector<Eigen::Vector3f> fitted;     ///< in the A-pose
  std::vector<Eigen::Vector3f> positions;  ///< standing neutrally
  std::vector<Eigen::Vector3f> normals;    ///< standing neutrally, smooth across texture seams
  std::vector<Eigen::Vector2f> uvs;
  std::vector<BoneWeights> weights;
  std::vector<std::uint32_t> indices;
  std::string texture;  ///< key of a texture
  Tint tint = Tint::none;
  bool alpha_tested = false;
  bool painted = false;  ///< lies on the skin and changes only its color
};

/// Makes a surface: divides quads into triangles, and vertices by texture coordinate. `fitted`
/// (A-pose) and `weights` are by source vertex.
Surface make_surface(std::span<const Quad> quads, std::span<const Eigen::Vector2f> uvs,
                     std::span<const Eigen::Vector3f> fitted, std::span<const BoneWeights> weights,
                     const Palette& to_neutral);

/// The matrix of linear blend skinning with dense weights.
BoneMatrix mixed(const Palette& palette, const BoneWeights& weights);

/// Linear blend skinning with dense weights.
Eigen::Vector3f move_point(const Eigen::Vector3f& point, const BoneWeights& weights,
                           const Palette& palette);

/// Keeps the triangles for which `keep(at)` is true, `at` being the position of the first index.
template <typename Keep>
void keep_triangles(Surface& surface, const Keep& keep) {
  std::size_t kept = 0;
  for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
    if (!keep(at)) continue;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      surface.indices[kept + corner] = surface.indices[at + corner];
    }
    kept += 3;
  }
  surface.indices.resize(kept);
}

/// Keeps the part of the surface where `value` (per vertex, linear over each triangle) is not
/// negative; triangles on the border are cut.
void cut_surface(Surface& surface, std::span<const float> value);

/// Simplifies the surface to about this number of triangles, optionally preserving its open
/// borders.
void simplify(Surface& surface, std::size_t triangles, bool keep_borders = false);

/// The surfaces as one mesh. `texture_of` maps the keys of textures to indices.
Mesh assemble(std::span<const Surface> surfaces, const std::map<std::string, int>& texture_of);

/// Adds a copy of a vertex with the opposite normal; returns its index.
std::uint32_t add_turned(Surface& surface, std::uint32_t vertex);

/// Appends the parts of another mesh.
void append(Mesh& mesh, const Mesh& more);

/// Sets bones and weights of a vertex: the four strongest, with a sum of exactly 255.
void set_weights(Vertex& vertex, const BoneWeights& weights);

}  // namespace throng::skinning
