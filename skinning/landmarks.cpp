#include "skinning/landmarks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "skinning/population.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

namespace {

constexpr std::size_t kNose = index_from(Joint::nose);
constexpr std::size_t kLeftEye = index_from(Joint::left_eye);
constexpr std::size_t kRightEye = index_from(Joint::right_eye);
constexpr std::size_t kLeftEar = index_from(Joint::left_ear);
constexpr std::size_t kRightEar = index_from(Joint::right_ear);
constexpr std::size_t kLeftShoulder = index_from(Joint::left_shoulder);

/// Bones that begin at the keypoints from the left shoulder on.
constexpr std::array kJointBones = {
    Bone::left_upper_arm, Bone::right_upper_arm, Bone::left_forearm, Bone::right_forearm,
    Bone::left_hand,      Bone::right_hand,      Bone::left_thigh,   Bone::right_thigh,
    Bone::left_shin,      Bone::right_shin,      Bone::left_foot,    Bone::right_foot,
};
static_assert(kLeftShoulder + kJointBones.size() == kKeypointCount);

Eigen::Vector3f vertex_position(const Vertex& vertex) {
  return {vertex.position[0], vertex.position[1], vertex.position[2]};
}

/// The head's own surface, without hair, hats and glasses: skin, and eyeballs if they are apart.
struct Face {
  std::vector<Eigen::Vector3f> skin;
  std::vector<Eigen::Vector3f> eyes;
};

Face measure_face(const Mesh& mesh) {
  constexpr std::size_t kMaxEyeCorners = 1200;  // triangle corners of both eyeballs
  Face face;
  for (const Part& part : mesh.parts) {
    if (part.tint != Tint::none || part.alpha_tested) continue;
    std::vector<Eigen::Vector3f> points;
    bool is_all_head = true;
    for (std::uint32_t i = 0; i < part.index_count; ++i) {
      const Vertex& vertex = mesh.vertices[mesh.indices[part.first_index + i]];
      if (moves_mostly_with(vertex, {Bone::head})) {
        points.push_back(vertex_position(vertex));
      } else {
        is_all_head = false;
      }
    }
    const bool are_eyes = is_all_head && points.size() <= kMaxEyeCorners && !face.skin.empty();
    std::vector<Eigen::Vector3f>& kind = are_eyes ? face.eyes : face.skin;
    kind.insert(kind.end(), points.begin(), points.end());
  }
  return face;
}

/// The middle of the eyeball on one side (+1: left).
std::optional<Eigen::Vector3f> eyeball(const std::vector<Eigen::Vector3f>& eyes, float side) {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Vector3f high = -low;
  for (const Eigen::Vector3f& point : eyes) {
    if (side * point.y() <= 0) continue;
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  if (low.x() > high.x()) return std::nullopt;
  return Eigen::Vector3f(0.5F * (low + high));
}

/// The point of `points` at these heights that lies farthest along `direction`.
std::optional<Eigen::Vector3f> farthest(const std::vector<Eigen::Vector3f>& points, float low_m,
                                        float high_m, const Eigen::Vector3f& direction) {
  std::optional<Eigen::Vector3f> best;
  for (const Eigen::Vector3f& point : points) {
    if (point.z() < low_m || point.z() > high_m) continue;
    if (!best || direction.dot(point) > direction.dot(*best)) best = point;
  }
  return best;
}

/// Joints of the rig beside COCO's, with the bones that begin there.
struct RigJoint {
  Joint joint;
  Bone bone;
};
constexpr std::array kRigJoints = {
    RigJoint{Joint::neck, Bone::neck},
    RigJoint{Joint::chest, Bone::chest},
    RigJoint{Joint::spine, Bone::spine},
    RigJoint{Joint::pelvis, Bone::hips},
    RigJoint{Joint::left_clavicle, Bone::left_clavicle},
    RigJoint{Joint::right_clavicle, Bone::right_clavicle},
};

/// Points of the surface that move with one of two bones by more than a half, but for carried
/// items.
std::vector<Eigen::Vector3f> surface_points(const Mesh& mesh, Bone one, Bone other) {
  std::vector<Eigen::Vector3f> points;
  for (const Part& part : mesh.parts) {
    if (part.tint == Tint::item) continue;
    for (std::uint32_t i = 0; i < part.index_count; ++i) {
      const Vertex& vertex = mesh.vertices[mesh.indices[part.first_index + i]];
      if (moves_mostly_with(vertex, {one, other})) points.push_back(vertex_position(vertex));
    }
  }
  return points;
}

constexpr float kLowest = -std::numeric_limits<float>::infinity();
constexpr float kHighest = std::numeric_limits<float>::infinity();

/// Hand, toes and heel of one side (+1: left).
void add_ends_of_limbs(const Character& character, float side, Landmarks& landmarks) {
  const bool is_left = side > 0;
  const auto set = [&](Joint left, Bone bone, const Eigen::Vector3f& at) {
    const std::size_t joint = index_from(left) + (is_left ? 0 : 1);
    landmarks.bone[joint] = bone;
    landmarks.rest[joint] = at;
  };
  const Bone hand = is_left ? Bone::left_hand : Bone::right_hand;
  const Bone foot = is_left ? Bone::left_foot : Bone::right_foot;
  const Bone toe = is_left ? Bone::left_toe : Bone::right_toe;
  const Eigen::Vector3f wrist = character.joints[index_from(hand)];
  const Eigen::Vector3f ankle = character.joints[index_from(foot)];
  std::vector<Eigen::Vector3f> of_hand;
  std::vector<Eigen::Vector3f> of_foot;
  if (!character.levels.empty()) {
    of_hand = surface_points(character.levels.front(), hand, hand);
    of_foot = surface_points(character.levels.front(), foot, toe);
  }
  Eigen::AlignedBox3f bounds;
  // Hands are 0.108 of stature long; what is farther from the wrist is carried.
  for (const Eigen::Vector3f& point : of_hand) {
    if ((point - wrist).norm() <= 0.115F * character.stature_m) bounds.extend(point);
  }
  set(Joint::left_hand, hand, bounds.isEmpty() ? wrist : Eigen::Vector3f(bounds.center()));
  // The length of a foot without surface; a quarter of it is behind the ankle.
  const float length_m = 0.152F * character.stature_m;
  const float half_width_m = 0.15F * length_m;
  const auto at_foot = [&](const Eigen::Vector3f& direction, float ahead_m, float out_m) {
    return farthest(of_foot, kLowest, kHighest, direction)
        .value_or(Eigen::Vector3f(ankle.x() + ahead_m, ankle.y() + side * out_m, 0));
  };
  set(Joint::left_big_toe, toe, at_foot({1, -0.5F * side, 0}, 0.75F * length_m, -half_width_m));
  set(Joint::left_small_toe, toe, at_foot({0.7F, side, 0}, 0.6F * length_m, half_width_m));
  set(Joint::left_heel, foot, at_foot({-1, 0, -0.3F}, -0.25F * length_m, 0));
}

}  // namespace

const std::array<std::string_view, kJointCount>& joint_names() {
  static constexpr std::array<std::string_view, kJointCount> kNames = [] {
    std::array<std::string_view, kJointCount> names = {};
    std::copy(kKeypointNames.begin(), kKeypointNames.end(), names.begin());
    constexpr std::array<std::string_view, kJointCount - kKeypointCount> kOthers = {
        "head_top",       "head_center",     "neck",          "chest",
        "spine",          "pelvis",          "left_clavicle", "right_clavicle",
        "left_hand",      "right_hand",      "left_big_toe",  "right_big_toe",
        "left_small_toe", "right_small_toe", "left_heel",     "right_heel"};
    std::copy(kOthers.begin(), kOthers.end(), names.begin() + kKeypointCount);
    return names;
  }();
  return kNames;
}

const std::array<std::string_view, kBoneCount>& bone_names() { return kBoneNames; }

Landmarks find_landmarks(const Character& character) {
  const Eigen::Vector3f head = character.joints[index_from(Bone::head)];
  // Sizes of a head of average proportions, in statures.
  const float stature = character.stature_m;
  const float eye_height = 0.936F * stature;
  const float half_eyes = 0.018F * stature;
  const float half_ears = 0.042F * stature;
  const Face face = character.levels.empty() ? Face{} : measure_face(character.levels.front());

  float foremost = face.skin.empty() ? head.x() + 0.055F * stature : face.skin.front().x();
  for (const Eigen::Vector3f& point : face.skin) foremost = std::max(foremost, point.x());

  Landmarks landmarks;
  std::fill_n(landmarks.bone.begin(), kLeftShoulder, Bone::head);
  const auto eye = [&](float side) {
    return eyeball(face.eyes, side)
        .value_or(Eigen::Vector3f(foremost - 0.01F * stature, side * half_eyes, eye_height));
  };
  landmarks.rest[kLeftEye] = eye(1);
  landmarks.rest[kRightEye] = eye(-1);
  const Eigen::Vector3f eyes = 0.5F * (landmarks.rest[kLeftEye] + landmarks.rest[kRightEye]);
  constexpr float kNoseBelow = 0.035F;  // statures below the eyes, at most
  constexpr float kEarsReach = 0.02F;   // statures above and below the eyes
  landmarks.rest[kNose] =
      farthest(face.skin, eyes.z() - kNoseBelow * stature, eyes.z(), Eigen::Vector3f::UnitX())
          .value_or(Eigen::Vector3f(foremost, 0, eyes.z() - 0.02F * stature));
  landmarks.rest[kNose].y() = 0.5F * (landmarks.rest[kLeftEye].y() + landmarks.rest[kRightEye].y());
  for (const std::size_t ear : {kLeftEar, kRightEar}) {
    const float side = ear == kLeftEar ? 1.0F : -1.0F;
    landmarks.rest[ear] =
        farthest(face.skin, eyes.z() - kEarsReach * stature, eyes.z() + kEarsReach * stature,
                 {0, side, 0})
            .value_or(Eigen::Vector3f(head.x() + 0.01F * stature, side * half_ears, eyes.z()));
  }
  for (std::size_t i = 0; i < kJointBones.size(); ++i) {
    landmarks.bone[kLeftShoulder + i] = kJointBones[i];
    landmarks.rest[kLeftShoulder + i] = character.joints[index_from(kJointBones[i])];
  }
  for (const RigJoint& rig : kRigJoints) {
    landmarks.bone[index_from(rig.joint)] = rig.bone;
    landmarks.rest[index_from(rig.joint)] = character.joints[index_from(rig.bone)];
  }
  for (const Joint joint : {Joint::head_top, Joint::head_center}) {
    landmarks.bone[index_from(joint)] = Bone::head;
  }
  landmarks.rest[index_from(Joint::head_center)] =
      0.5F * (landmarks.rest[kLeftEar] + landmarks.rest[kRightEar]);
  landmarks.rest[index_from(Joint::head_top)] =
      farthest(face.skin, kLowest, kHighest, Eigen::Vector3f::UnitZ())
          .value_or(Eigen::Vector3f(head.x(), 0, stature));
  for (const float side : {1.0F, -1.0F}) add_ends_of_limbs(character, side, landmarks);
  return landmarks;
}

Keypoints posed_keypoints(const Landmarks& landmarks, const Palette& palette) {
  Keypoints posed;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const BoneMatrix& bone = palette[index_from(landmarks.bone[i])];
    posed[i] = bone.leftCols<3>() * landmarks.rest[i] + bone.col(3);
  }
  return posed;
}

}  // namespace throng::skinning
