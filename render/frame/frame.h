// Output of the renderer for one camera at one time. All buffers come from the same draw.
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
#include "render/frame/pixel_mask.h"
#include "skinning/animate/action.h"
#include "skinning/landmarks.h"
#include "world/semantic_class.h"

namespace throng::render {

/// Values of the instance id buffer.
inline constexpr std::uint32_t kIdNothing = 0;  ///< sky
inline constexpr std::uint32_t kIdUmbrella =
    0x40000000;  ///< + id of who holds it, or leads what it is
inline constexpr std::uint32_t kIdGround = 0xFFFF0000;    ///< the ground
inline constexpr std::uint32_t kIdBuilding = 0x80000000;  ///< + index of the building
/// + index of the prop, mesh or rubble, in this order.
inline constexpr std::uint32_t kIdProp = 0xC0000000;
inline constexpr std::uint32_t kIdDrone = 0xE0000000;  ///< + index of the drone
inline constexpr std::uint32_t id_of_agent(std::uint32_t agent) { return agent + 1; }
inline constexpr bool is_agent(std::uint32_t id) { return id > 0 && id < kIdUmbrella; }
inline constexpr std::uint32_t id_of_umbrella(std::uint32_t agent) {
  return kIdUmbrella + id_of_agent(agent);
}
inline constexpr bool is_umbrella(std::uint32_t id) {
  return id >= kIdUmbrella && id < kIdBuilding;
}
inline constexpr bool is_drone(std::uint32_t id) { return id >= kIdDrone && id < kIdGround; }
/// Whether the id is that of an object that is posed in every frame: a person, an umbrella, or
/// what a person leads.
inline constexpr bool is_posed(std::uint32_t id) { return is_agent(id) || is_umbrella(id); }
inline constexpr std::uint32_t agent_of_id(std::uint32_t id) { return id - 1; }

/// Values of Frame::part.
enum class BodyPart : std::uint8_t {
  none,  ///< no person
  head,  ///< including neck and hair
  torso,
  left_arm,
  right_arm,
  left_leg,
  right_leg,
  left_foot,
  right_foot,
  item,  ///< carried items except umbrellas and led objects, which have ids of their own
};

/// Ground truth of one person within the view, visible or occluded.
struct PersonInView {
  std::uint32_t agent = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position on the ground, m
  Eigen::Vector3d hips = Eigen::Vector3d::Zero();      ///< center of the posed pelvis, m
  Eigen::Vector3d head = Eigen::Vector3d::Zero();      ///< center of the posed head, m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
  double yaw_rad = 0;
  double stature_m = 0;
  /// Bounds of the whole projected mesh in box coordinates (pixel i covers [i, i + 1)); may extend
  /// beyond the image.
  Eigen::AlignedBox2d amodal_box;
  /// Number of pixels that the person would cover without occluders and image borders.
  std::uint64_t amodal_area_px = 0;
  double blur_px = 0;       ///< motion of the person's center in the image during the exposure
  std::uint32_t level = 0;  ///< level of detail of the rendered mesh
  /// The center of the head in box coordinates, if it does not follow from the frame's camera
  /// because of a rolling shutter.
  std::optional<Eigen::Vector2d> head_px = std::nullopt;
  /// Amodal bounds of the head with hair and headwear, in box coordinates; empty if the head is
  /// outside of the camera's view.
  Eigen::AlignedBox2d head_box = Eigen::AlignedBox2d();
  /// The posed joints, m, world.
  skinning::Keypoints keypoints = skinning::keypoints_at(Eigen::Vector3f::Zero());
  /// The rotation of each bone from the rest pose, in which bodies face +x of the world; empty
  /// unless requested by RenderOptions::bone_turns.
  std::vector<Eigen::Quaternionf> bone_turns = {};
  skinning::Actions actions = {};  ///< actions to which the pose belongs
  /// The upright box around the body with carried items, rotated by yaw_rad: its center (m, world)
  /// and its size forward, sideways and up (m).
  Eigen::Vector3f box_middle = Eigen::Vector3f::Zero();
  Eigen::Vector3f box_size = Eigen::Vector3f::Zero();
  /// The keypoints in the image, in the same case as head_px: x and y in box coordinates and the
  /// camera's z (m); NaN outside of the camera's view.
  std::optional<skinning::Keypoints> keypoints_px = std::nullopt;
  /// Amodal mask: the pixels that the person would cover without occluders; null unless requested
  /// by RenderOptions::whole_masks.
  std::shared_ptr<const PixelMask> whole_mask = nullptr;
};

/// Ground truth of another drone or a vehicle within the view, visible or occluded.
struct ObjectInView {
  std::uint32_t id = 0;      ///< value in the id buffer
  std::uint32_t number = 0;  ///< index of the drone in the trace, or of the vehicle in the scenario
  world::SemanticClass surface = world::SemanticClass::drone;
  /// Center of a drone, or ground center of a vehicle, m.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
  double yaw_rad = 0;
  /// The following are as in PersonInView; areas beyond the image count up to its width and height.
  Eigen::AlignedBox2d amodal_box;
  std::uint64_t amodal_area_px = 0;
  std::shared_ptr<const PixelMask> whole_mask = nullptr;
  Eigen::Vector3d box_middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();
};

/// The center of a person's head in a frame of this camera, in box coordinates, visible or
/// occluded; nothing outside of the camera's view.
inline std::optional<Eigen::Vector2d> head_in(const PersonInView& person,
                                              const camera::Camera& camera) {
  if (person.head_px) return person.head_px;
  const camera::Camera::Projection seen = camera.project(person.head);
  if (!seen.visible) return std::nullopt;
  return Eigen::Vector2d(seen.pixel.array() + 0.5);
}

/// A person's keypoints in a frame of this camera, visible or occluded, as in keypoints_px.
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

/// The visibility, in the next frame of the camera, of the surface point that a pixel shows.
enum class FlowTarget : std::uint8_t {
  unknown,  ///< the flow is NaN
  visible,
  hidden,  ///< inside of the image, but occluded
  outside  ///< outside of the image
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
  std::vector<ObjectInView> objects;  ///< drones and vehicles, by id; only if rendered by Lens
  // Only if requested by RenderOptions, else empty.
  /// width * height * 3: world x, y, z of the surface's normal n as round(128 + 127 n); 0 for sky.
  std::vector<std::uint8_t> normal;
  /// width * height * 2: optical flow of the surface point that a pixel shows to the next frame,
  /// right and down (px), also if the point is occluded or outside there. NaN if it is undefined:
  /// the point moves behind the camera, the person leaves, or there is no next frame.
  std::vector<float> flow;
  std::vector<float> flow_backward;  ///< optical flow to the previous frame, in the same form
  /// width * height: camera z (m), in the next frame, of the surface point that a pixel shows;
  /// +infinity for sky; NaN where flow is.
  std::vector<float> flow_depth_m;
  /// width * height * 3: motion in the world until the next frame (m), 0 for static surfaces; NaN
  /// for sky and where flow is.
  std::vector<float> scene_flow_m;
  /// width * height: FlowTarget. Filled by flow_targets() (render/truth/flow_targets.h).
  std::vector<std::uint8_t> flow_target;
  /// width * height * 3: opacity of each HazardMatter in front of the surface, 0 to 255; smoke
  /// includes dust.
  std::vector<std::uint8_t> hazard_opacity;
  std::vector<std::uint8_t> part;     ///< width * height: BodyPart
  std::vector<std::uint8_t> surface;  ///< width * height: world::SemanticClass

  int width() const { return camera.intrinsics.width; }
  int height() const { return camera.intrinsics.height; }
};

}  // namespace throng::render
