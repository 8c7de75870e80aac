// Output of the renderer for one instant and one camera: every buffer from the same draw.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "camera/camera.h"
#include "render/pixel_mask.h"
#include "skinning/animate/action.h"
#include "skinning/landmarks.h"
#include "world/semantic_class.h"

namespace throng::render {

/// Values of the instance id buffer.
inline constexpr std::uint32_t kIdNothing = 0;            ///< sky
inline constexpr std::uint32_t kIdUmbrella = 0x40000000;  ///< + id of who holds it
inline constexpr std::uint32_t kIdGround = 0xFFFF0000;    ///< the ground
inline constexpr std::uint32_t kIdBuilding = 0x80000000;  ///< + index of the building
inline constexpr std::uint32_t kIdProp = 0xC0000000;   ///< + index of the prop; then meshes, rubble
inline constexpr std::uint32_t kIdDrone = 0xE0000000;  ///< + number of the drone
inline constexpr std::uint32_t id_of_agent(std::uint32_t agent) { return agent + 1; }
inline constexpr bool is_agent(std::uint32_t id) { return id > 0 && id < kIdUmbrella; }
inline constexpr std::uint32_t id_of_umbrella(std::uint32_t agent) {
  return kIdUmbrella + id_of_agent(agent);
}
inline constexpr bool is_umbrella(std::uint32_t id) {
  return id >= kIdUmbrella && id < kIdBuilding;
}
inline constexpr bool is_drone(std::uint32_t id) { return id >= kIdDrone && id < kIdGround; }
/// Whether it is posed again in every frame: people and what they hold above themselves.
inline constexpr bool is_posed(std::uint32_t id) { return is_agent(id) || is_umbrella(id); }
inline constexpr std::uint32_t agent_of_id(std::uint32_t id) { return id - 1; }

/// Values of Frame::part.
enum class BodyPart : std::uint8_t {
  none,  ///< not a person
  head,  ///< with neck and hair
  torso,
  left_arm,
  right_arm,
  left_leg,
  right_leg,
  left_foot,
  right_foot,
  item,  ///< what is carried; an umbrella is none of the person
};

/// Ground truth of one person that touches the view, hidden or not.
struct PersonInView {
  std::uint32_t agent = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the ground, m
  Eigen::Vector3d hips = Eigen::Vector3d::Zero();      ///< middle of the pelvis, as posed, m
  Eigen::Vector3d head = Eigen::Vector3d::Zero();      ///< middle of the head, as posed, m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
  double yaw_rad = 0;
  double stature_m = 0;
  /// Bounds of the whole projected mesh in box coordinates (pixel i covers [i, i + 1)); may leave
  /// the image.
  Eigen::AlignedBox2d amodal_box;
  /// Pixels that the person would cover were nothing in front of it, image borders included.
  std::uint64_t amodal_area_px = 0;
  double blur_px = 0;       ///< motion of its middle in the image while the shutter is open
  std::uint32_t level = 0;  ///< of detail, that it was rendered with
  /// The middle of the head in box coordinates, where it does not follow from the frame's camera:
  /// rows of a rolling shutter see it from elsewhere.
  std::optional<Eigen::Vector2d> head_px = std::nullopt;
  /// Bounds of the head in the image with hair and headwear, hidden or not, like amodal_box; empty
  /// where the camera sees nothing of it.
  Eigen::AlignedBox2d head_box = Eigen::AlignedBox2d();
  /// Joints as posed, m, world.
  skinning::Keypoints keypoints = skinning::keypoints_at(Eigen::Vector3f::Zero());
  /// How each bone is turned from the rest pose, in which bodies face +x of the world.
  std::array<Eigen::Quaternionf, skinning::kBoneCount> bone_turns = {};
  skinning::Actions actions = {};  ///< that the pose is part of
  /// Upright box around the body with all it carries, turned by yaw_rad: its middle (m, world) and
  /// its size ahead, to the side and up (m).
  Eigen::Vector3f box_middle = Eigen::Vector3f::Zero();
  Eigen::Vector3f box_size = Eigen::Vector3f::Zero();
  /// Like head_px, of the keypoints: x and y in box coordinates and the camera's z (m); NaN where
  /// the camera sees nothing.
  std::optional<skinning::Keypoints> keypoints_px = std::nullopt;
  /// Amodal mask: the pixels that the person would cover without occluders; null unless
  /// RenderOptions asks for it.
  std::shared_ptr<const PixelMask> whole_mask = nullptr;
};

/// Ground truth of another drone or a vehicle that the camera sees, or would were nothing in front
/// of it.
struct ObjectInView {
  std::uint32_t id = 0;      ///< in the id buffer
  std::uint32_t number = 0;  ///< of the drone in the run's trace; of the vehicle in the scenario
  world::SemanticClass surface = world::SemanticClass::drone;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of a drone's middle or vehicle's foot, m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
  double yaw_rad = 0;
  /// As of people; areas beyond the image count as far as it is wide and high.
  Eigen::AlignedBox2d amodal_box;
  std::uint64_t amodal_area_px = 0;
  std::shared_ptr<const PixelMask> whole_mask = nullptr;
  Eigen::Vector3d box_middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();
};

/// The middle of a person's head in a frame of this camera, in box coordinates, also if hidden;
/// nothing if the camera cannot see there.
inline std::optional<Eigen::Vector2d> head_in(const PersonInView& person,
                                              const camera::Camera& camera) {
  if (person.head_px) return person.head_px;
  const camera::Camera::Projection seen = camera.project(person.head);
  if (!seen.visible) return std::nullopt;
  return Eigen::Vector2d(seen.pixel.array() + 0.5);
}

/// A person's keypoints in a frame of this camera, visible or not, as in keypoints_px.
inline skinning::Keypoints keypoints_in(const PersonInView& person, const camera::Camera& camera) {
  if (person.keypoints_px) return *person.keypoints_px;
  skinning::Keypoints seen;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const camera::Camera::Projection at = camera.project(person.keypoints[i].cast<double>());
    seen[i] << (at.pixel.array() + 0.5).cast<float>(), static_cast<float>(at.depth_m);
    if (!at.visible) seen[i].setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  return seen;
}

/// Channels of Frame::hazard_opacity.
enum class HazardMatter : std::uint8_t { fire, smoke, gas };

/// State, in the next frame of the camera, of what a pixel shows, for training of flow and for
/// masks of occlusion.
enum class FlowTarget : std::uint8_t {
  unknown,  ///< as its flow
  visible,
  hidden,  ///< inside of the image, behind something
  outside  ///< of the image
};

/// One rendered frame. Rows top-down, pixels row-major.
struct Frame {
  std::int64_t index = 0;  ///< frame number within the run, from 0
  double time_s = 0;
  camera::Camera camera;
  std::vector<std::uint8_t> rgb;      ///< width * height * 3, sRGB
  std::vector<std::uint32_t> id;      ///< width * height
  std::vector<float> depth_m;         ///< camera z; +infinity for sky
  std::vector<PersonInView> people;   ///< by agent id
  std::vector<ObjectInView> objects;  ///< drones and vehicles, by id; only where Lens renders
  // Only as asked for in RenderOptions, else empty.
  /// width * height * 3: world x, y, z of the surface's normal n as round(128 + 127 n); 0 for sky.
  std::vector<std::uint8_t> normal;
  /// width * height * 2: how far what a pixel shows moves until the next frame, right and down
  /// (px), also if it is hidden or outside there; NaN where that has no answer (it goes behind the
  /// camera, the person leaves, or there is no next frame).
  std::vector<float> flow;
  std::vector<float> flow_backward;  ///< likewise to the previous frame
  /// width * height: camera z that what a pixel shows has in the next frame (m), +infinity for sky;
  /// NaN where flow is.
  std::vector<float> flow_depth_m;
  /// width * height * 3: motion in the world until the next frame (m), 0 for what stands still; NaN
  /// for sky and where flow is.
  std::vector<float> scene_flow_m;
  /// width * height: FlowTarget. Filled by flow_targets() (render/truth/flow_targets.h).
  std::vector<std::uint8_t> flow_target;
  /// width * height * 3: how much of what a pixel shows is hidden by each HazardMatter, of 255;
  /// smoke includes dust.
  std::vector<std::uint8_t> hazard_opacity;
  std::vector<std::uint8_t> part;     ///< width * height: BodyPart
  std::vector<std::uint8_t> surface;  ///< width * height: world::SemanticClass

  int width() const { return camera.intrinsics.width; }
  int height() const { return camera.intrinsics.height; }
};

}  // namespace throng::render
