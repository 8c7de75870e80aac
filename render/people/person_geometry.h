// Skinning and projection of people's meshes on the CPU, equal to shaders/person.vert.glsl, for
// ground truth that is measured instead of rendered.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/camera.h"
#include "render/frame/frame.h"
#include "render/props/scene.h"
#include "skinning/landmarks.h"
#include "skinning/population.h"

namespace throng::render {

/// Distance (m) of people's soles above the ground; also in shaders/person.vert.glsl.
inline constexpr float kAboveGround = 0.002F;

/// Heights of the centers of head and pelvis of a standing person, as shares of stature.
inline constexpr float kHeadShare = 0.93F;
inline constexpr float kHipsShare = 0.53F;

/// The pose in which a person is drawn and measured at a level of detail: in the distance, the
/// nearer one of the two that it blends.
skinning::PoseBlend drawn_pose(const skinning::PoseBlend& pose, std::size_t level);

/// The blend of the instance's two palettes.
skinning::Palette blended_palette(const skinning::Population& population,
                                  const PersonInstance& person);

/// A place to stand, and a turn about the vertical.
struct Stance {
  explicit Stance(const PersonInstance& person);

  Eigen::Vector3d position;  ///< m
  Eigen::Matrix3d turn;      ///< model axes to the world's
};

/// Position (m, world) in the pose of a point that moves with `bone` and is on the body's axis at
/// `height_m` in the standing rest pose.
Eigen::Vector3d posed_point(const skinning::Palette& palette, const Stance& stance,
                            skinning::Bone bone, float height_m);

/// A point of a mesh with its skinning weights.
struct SkinPoint {
  Eigen::Vector4f rest;          ///< rest position, m, model axes; w = 1
  std::array<float, 4> weights;  ///< the first `bone_count` are greater than 0 and sum to 1
  std::array<std::uint8_t, 4> bones;
  std::uint32_t bone_count;
};

/// The body or the umbrella of a person's mesh.
enum class Share : std::uint8_t { body, umbrella };
std::vector<skinning::Part> select_parts(const skinning::Character& character,
                                         const skinning::Mesh& mesh, Share share);

/// Parts of a mesh with the distinct positions of their vertices. The mesh must outlive this
/// object.
struct BodyShape {
  BodyShape(const skinning::Mesh& of_mesh, std::vector<skinning::Part> its_parts);

  const skinning::Mesh* mesh;
  std::vector<skinning::Part> parts;
  std::vector<SkinPoint> points;
  std::vector<SkinPoint> head;  ///< points that move mostly with the head: skin, hair, headwear
};

/// Sets keypoints and upright box of `truth`; `box` is the box in the model's axes (m).
void measure_body(const Eigen::AlignedBox3f& box, const skinning::Landmarks& landmarks,
                  const skinning::Palette& palette, const Stance& stance, PersonInView& truth);
/// Sets the turns of the bones.
void measure_turns(const skinning::Palette& palette, const Stance& stance, PersonInView& truth);

/// Model space to (u z, v z, z, height above the feet), where (u, v) are box coordinates of a
/// pinhole camera and z is the depth.
Eigen::Matrix4f image_from_model(const Stance& stance, const camera::Camera& camera);

/// Bounds in box coordinates of a mesh in the image of a pinhole camera, without the parts behind
/// the near plane; empty if everything is behind it.
Eigen::AlignedBox2d silhouette_box(const BodyShape& shape, const skinning::Palette& palette,
                                   const Stance& stance, const camera::Camera& camera);

/// Rows [first, end) of an image. Rows at its upper and lower border extend beyond it.
struct Rows {
  int first = 0;
  int end = 0;

  bool are_all(const camera::Intrinsics& image) const { return first == 0 && end == image.height; }
};

/// The pixels within which people and objects are measured: three times the image around its
/// center, since a person close to the camera would extend over thousands of pixels.
Eigen::AlignedBox2i measured_pixels(const camera::Intrinsics& image);
/// Those of them that are in these rows.
Eigen::AlignedBox2i measured_pixels(const camera::Intrinsics& image, const Rows& rows);

/// Bounds in box coordinates of a person's head points in the image of a camera with any lens,
/// limited to measured_pixels(). Points outside of the camera's view are ignored; empty if all are.
Eigen::AlignedBox2d head_box(std::span<const SkinPoint> head, const skinning::Palette& palette,
                             const Stance& stance, const camera::Camera& camera);

/// Bounds in box coordinates of the parts of a mesh in these rows of the image of a camera with any
/// lens, from vertices and edges within the lens model's valid range; limited to measured_pixels().
/// Empty if there are none. Sets `is_cut` if some vertices have no position in the image.
Eigen::AlignedBox2d shown_box(const skinning::Mesh& mesh, const std::vector<skinning::Part>& parts,
                              const skinning::Palette& palette, const Stance& stance,
                              const camera::Camera& camera, const Rows& rows, bool& is_cut);

}  // namespace throng::render
