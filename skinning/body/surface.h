// A person in the making: textured surfaces in two poses at once, the A-pose in which clothes fit
// and the neutral stance from which everything is animated.
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

/// One vertex per (source vertex, texture coordinate).
struct Surface {
  std::vector<std::uint32_t> source;       ///< vertex of the body or proxy that it came from
  std::vector<Eigen::Vector3f> fitted;     ///< in the A-pose
  std::vector<Eigen::Vector3f> positions;  ///< standing neutrally
  std::vector<Eigen::Vector3f> normals;    ///< standing neutrally, smooth across texture seams
  std::vector<Eigen::Vector2f> uvs;
  std::vector<BoneWeights> weights;
  std::vector<std::uint32_t> indices;
  std::string texture;  ///< key of a texture
  Tint tint = Tint::none;
  bool alpha_tested = false;
  bool painted = false;  ///< lies on the skin: colors it but gives it no shape of its own
};

/// Splits quads into triangles and shared vertices into one per texture coordinate. `positions`
/// and `fitted` and `weights` are by source vertex.
Surface make_surface(std::span<const Quad> quads, std::span<const Eigen::Vector2f> uvs,
                     std::span<const Eigen::Vector3f> fitted, std::span<const BoneWeights> weights,
                     const Palette& to_neutral);

/// Linear blend skinning with dense weights.
Eigen::Vector3f move_point(const Eigen::Vector3f& point, const BoneWeights& weights,
                           const Palette& palette);

/// Keeps the triangles for which `keep(first index)` holds.
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

/// Keeps the part of the surface where the value, linear over each triangle, is not negative: cuts
/// the triangles that the border runs through. One value per vertex.
void cut_surface(Surface& surface, std::span<const float> value);

/// Reduces the surface to about this many triangles; its open borders keep their shape if asked.
void simplify(Surface& surface, std::size_t triangles, bool keep_borders = false);

/// The surfaces as one mesh. `texture_of` gives a texture's number by its key.
Mesh assemble(std::span<const Surface> surfaces, const std::map<std::string, int>& texture_of);

/// Adds a copy of a vertex that faces the opposite direction; returns its number.
std::uint32_t add_turned(Surface& surface, std::uint32_t vertex);

/// Appends the parts of another mesh.
void append(Mesh& mesh, const Mesh& more);

/// Bones and weights as they go into a vertex: the four strongest, summing to exactly 255.
void set_weights(Vertex& vertex, const BoneWeights& weights);

}  // namespace throng::skinning
