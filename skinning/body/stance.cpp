#include "skinning/body/stance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "skinning/body/neutral.h"
#include "skinning/body/surface.h"

namespace throng::skinning {

namespace {

// MakeHuman's joints at which our bones start, in palette order.
constexpr std::array<const char*, kBoneCount> kJointNames = {
    "",  // the hips turn about the middle between the hip joints
    "spine04____head",
    "spine02____head",
    "neck01____head",
    "head____head",
    "clavicle.L____head",
    "upperarm01.L____head",
    "lowerarm01.L____head",
    "wrist.L____head",
    "clavicle.R____head",
    "upperarm01.R____head",
    "lowerarm01.R____head",
    "wrist.R____head",
    "upperleg01.L____head",
    "lowerleg01.L____head",
    "foot.L____head",
    "toe2-1.L____head",
    "upperleg01.R____head",
    "lowerleg01.R____head",
    "foot.R____head",
    "toe2-1.R____head",
};

Joints find_joints(const MakeHuman& makehuman, std::span<const Eigen::Vector3f> body) {
  Joints joints;
  for (std::size_t bone = 1; bone < kBoneCount; ++bone) {
    joints[bone] = makehuman.joint(kJointNames[bone], body);
  }
  joints[0] = 0.5F * (joints[index_from(Bone::left_thigh)] + joints[index_from(Bone::right_thigh)]);
  return joints;
}

Stance stand(const MakeHuman& makehuman, const BodyShape& shape) {
  Stance stance;
  stance.body = makehuman.morph(shape);
  const Joints joints = find_joints(makehuman, stance.body);
  const Pose pose = neutral_pose(joints, std::max(0.0, shape.weight - 0.5));
  stance.a_pose = joints;
  stance.joints = pose_joints(joints, pose);
  stance.to_neutral = pose_palette(joints, pose);
  stance.lowest = std::numeric_limits<float>::max();
  stance.highest = std::numeric_limits<float>::lowest();
  for (const Quad& quad : makehuman.skin()) {
    const std::uint32_t vertex = quad.vertex[0];
    const BoneWeights& weights = makehuman.weights()[vertex];
    const float z = move_point(stance.body[vertex], weights, stance.to_neutral).z();
    stance.lowest = std::min(stance.lowest, z);
    stance.highest = std::max(stance.highest, z);
  }
  return stance;
}

}  // namespace

// The height slider acts steeply and differently for every body: solve it.
Stance stand_at_height(const MakeHuman& makehuman, BodyShape shape, double height_m) {
  double low = 0;
  double high = 1;
  constexpr int kSteps = 12;  // to 0.3 mm
  for (int step = 0; step < kSteps; ++step) {
    shape.height = 0.5 * (low + high);
    const Stance stance = stand(makehuman, shape);
    (stance.highest - stance.lowest < height_m ? low : high) = shape.height;
  }
  return stand(makehuman, shape);
}

}  // namespace throng::skinning
