#include "skinning/landmarks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "skinning/skeleton.h"

namespace throng::skinning {

namespace {

// Places in kKeypointNames.
constexpr std::size_t kNose = 0;
constexpr std::size_t kLeftEye = 1;
constexpr std::size_t kRightEye = 2;
constexpr std::size_t kLeftEar = 3;
constexpr std::size_t kRightEar = 4;
constexpr std::size_t kLeftShoulder = 5;

/// Bones that begin at the keypoints from the left shoulder on.
constexpr std::array kJointBones = {
    Bone::left_upper_arm, Bone::right_upper_arm, Bone::left_forearm, Bone::right_forearm,
    Bone::left_hand,      Bone::right_hand,      Bone::left_thigh,   Bone::right_thigh,
    Bone::left_shin,      Bone::right_shin,      Bone::left_foot,    Bone::right_foot,
};
static_assert(kLeftShoulder + kJointBones.size() == kKeypointCount);

Eigen::Vector3f position_of(const Vertex& vertex) {
  return {vertex.position[0], vertex.position[1], vertex.position[2]};
}

bool belongs_to_head(const Vertex& vertex) {
  int weight = 0;
  for (std::size_t i = 0; i < vertex.bones.size(); ++i) {
    if (vertex.bones[i] == static_cast<std::uint8_t>(Bone::head)) weight += vertex.weights[i];
  }
  return weight > 127;
}

/// The head's own surface, without hair, hats and glasses: skin, and eyeballs if they are apart.
struct Face {
  std::vector<Eigen::Vector3f> skin;
  std::vector<Eigen::Vector3f> eyes;
};

Face face_of(const Mesh& mesh) {
  constexpr std::size_t kMaxEyeCorners = 1200;  // triangle corners of both eyeballs
  Face face;
  for (const Part& part : mesh.parts) {
    if (part.tint != Tint::none || part.alpha_tested) continue;
    std::vector<Eigen::Vector3f> points;
    bool is_all_head = true;
    for (std::uint32_t i = 0; i < part.index_count; ++i) {
      const Vertex& vertex = mesh.vertices[mesh.indices[part.first_index + i]];
      if (belongs_to_head(vertex)) {
        points.push_back(position_of(vertex));
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

}  // namespace

Landmarks landmarks_of(const Character& character) {
  const Eigen::Vector3f head = character.joints[index_of(Bone::head)];
  // Sizes of a head of average proportions, in statures.
  const float stature = character.stature_m;
  const float eye_height = 0.936F * stature;
  const float half_eyes = 0.018F * stature;
  const float half_ears = 0.042F * stature;
  const Face face = character.levels.empty() ? Face{} : face_of(character.levels.front());

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
    landmarks.rest[kLeftShoulder + i] = character.joints[index_of(kJointBones[i])];
  }
  return landmarks;
}

Keypoints posed_keypoints(const Landmarks& landmarks, const Palette& palette) {
  Keypoints posed;
  for (std::size_t i = 0; i < kKeypointCount; ++i) {
    const BoneMatrix& bone = palette[index_of(landmarks.bone[i])];
    posed[i] = bone.leftCols<3>() * landmarks.rest[i] + bone.col(3);
  }
  return posed;
}

}  // namespace throng::skinning
