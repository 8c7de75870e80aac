// A person's mesh on the CPU: the same skinning and projection as shaders/person.vert.glsl, for the
// ground truth that is measured rather than rendered.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/camera.h"
#include "render/frame.h"
#include "render/scene.h"
#include "skinning/landmarks.h"
#include "skinning/population.h"

namespace throng::render {

/// People are kept so far above their feet's ground (m); also in shaders/person.vert.glsl.
inline constexpr float kAboveGround = 0.002F;

/// Heights of a standing person's mid-head and mid-pelvis as shares of stature.
inline constexpr float kHeadShare = 0.93F;
inline constexpr float kHipsShare = 0.53F;

/// The blend of the instance's two palettes.
skinning::Palette blended_palette(const skinning::Population& population,
                                  const PersonInstance& person);

/// Position (m, world) of a point on the body's axis, `height_m` above the ground when standing,
/// after a bone of the posed person has moved it.
Eigen::Vector3d posed_point(const skinning::Palette& palette, const PersonInstance& person,
                            skinning::Bone bone, float height_m);

/// A place on a mesh that moves with its bones.
struct SkinPoint {
  Eigen::Vector4f rest;          ///< m, model axes; 1
  std::array<float, 4> weights;  ///< the first `bone_count` are greater than 0 and sum to 1
  std::array<std::uint8_t, 4> bones;
  std::uint32_t bone_count;
};

/// Split of a person's mesh into the body and the umbrella.
enum class Share : std::uint8_t { body, umbrella };
std::vector<skinning::Part> select_parts(const skinning::Character& character,
                                         const skinning::Mesh& mesh, Share share);

/// A share of a mesh and where its vertices are, each place once however many normals or texture
/// coordinates it has. The mesh must outlive it.
struct BodyShape {
  BodyShape(const skinning::Mesh& of_mesh, std::vector<skinning::Part> its_parts);

  const skinning::Mesh* mesh;
  std::vector<skinning::Part> parts;
  std::vector<SkinPoint> points;
  std::vector<SkinPoint> head;  ///< those that move mostly with the head: skin, hair and headwear
};

/// Sets the person's keypoints, and the upright box: `box` in the model's axes.
void measure_body(const Eigen::AlignedBox3f& box, const skinning::Landmarks& landmarks,
                  const skinning::Palette& palette, const PersonInstance& person,
                  PersonInView& truth);

/// Image bounds of a mesh.
struct Silhouette {
  /// Bounds in box coordinates. Parts behind the near plane are cut off; what remains is limited to
  /// three times the image around its middle, where somebody right at the camera would otherwise
  /// reach thousands of pixels out. Empty if everything is behind.
  Eigen::AlignedBox2d box;
};

Silhouette silhouette(const BodyShape& shape, const skinning::Palette& palette,
                      const PersonInstance& person, const camera::Camera& camera);

/// Bounds in box coordinates of a person's head points in the image of a camera with any lens,
/// limited like Silhouette::box. Points that the camera does not see are left out; empty if it sees
/// none.
Eigen::AlignedBox2d head_box(std::span<const SkinPoint> head, const skinning::Palette& palette,
                             const PersonInstance& person, const camera::Camera& camera);

/// Rows [first, end) of an image. Those at its border go on beyond it.
struct Rows {
  int first = 0;
  int end = 0;
};

/// Bounds in box coordinates of what a camera with any lens shows of these parts of a mesh in these
/// rows of its image, from their vertices and edges, which end where the lens's model does; limited
/// like Silhouette::box. Empty if there is nothing. Sets `is_cut` if some of the vertices are
/// nowhere in the image.
Eigen::AlignedBox2d shown_box(const skinning::Mesh& mesh, const std::vector<skinning::Part>& parts,
                              const skinning::Palette& palette, const PersonInstance& person,
                              const camera::Camera& camera, const Rows& rows, bool& is_cut);

}  // namespace throng::render
