#include "skinning/animate/figure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/compute/random.h"
#include "skinning/population.h"

namespace throng::skinning {

namespace {

struct Sole {
  Eigen::Vector3f ankle;
  Eigen::Vector3f toe;   // joint
  Eigen::Vector3f heel;  // rearmost point on the ground
  Eigen::Vector3f tip;   // foremost point on the ground
};

Sole place_sole(const Walker& walker, Side side) {
  const Bone foot = on(side, Bone::left_foot);
  Sole sole;
  sole.ankle = walker.joints[index_from(foot)];
  sole.toe = walker.joints[index_from(on(side, Bone::left_toe))];
  sole.heel = {sole.ankle.x() - 0.03F, sole.ankle.y(), 0};
  sole.tip = {sole.toe.x() + 0.04F, sole.toe.y(), 0};
  constexpr float kTouchingM = 0.015F;
  for (const Vertex& vertex : walker.soles) {
    const bool here = vertex.position[1] * side_sign(side) > 0;
    if (!here || vertex.position[2] > kTouchingM) continue;
    sole.heel.x() = std::min(sole.heel.x(), vertex.position[0]);
    sole.tip.x() = std::max(sole.tip.x(), vertex.position[0]);
  }
  return sole;
}

Eigen::Matrix3f foot_rotation(const Foot& foot) {
  return turn_z(foot.yaw_rad) * turn_y(-foot.pitch_rad);
}

Eigen::Matrix3f between(const Eigen::Matrix3f& a, const Eigen::Matrix3f& b, double share) {
  return Eigen::Quaternionf(a)
      .slerp(static_cast<float>(share), Eigen::Quaternionf(b))
      .toRotationMatrix();
}

bool on_foot(const Vertex& vertex) {
  int share = 0;
  for (std::size_t slot = 0; slot < 4; ++slot) {
    const auto bone = static_cast<Bone>(vertex.bones[slot]);
    const bool foot = bone == Bone::left_foot || bone == Bone::left_toe ||
                      bone == Bone::right_foot || bone == Bone::right_toe;
    if (foot) share += vertex.weights[slot];
  }
  return share > 127;
}

}  // namespace

Manner choose_manner(const Character& character) {
  // FNV-1a (Fowler, Noll, Vo 1991).
  std::uint64_t key = 14695981039346656037ULL;
  for (const char letter : character.name) {
    key = (key ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  }
  Random random(key, Stream::motion);
  Manner manner;
  manner.age_years = character.age_years;
  manner.carries = character.carries;
  manner.arm_swing = random.uniform(0.6, 1.4);
  manner.lean_deg = random.uniform(-1.5, 2.5);
  manner.liveliness = random.uniform(0.92, 1.08);
  manner.elbow_deg = random.uniform(-6, 10);
  manner.arms_out_deg = random.uniform(-1, 3);
  manner.left_handed = random.uniform() < 0.12;
  return manner;
}

Walker make_walker(const Joints& joints, float stature_m, const Mesh& level) {
  Walker walker{joints, stature_m, {}, {}, {}};
  std::vector<char> worn(level.vertices.size(), 0);
  for (const Part& part : level.parts) {
    if (part.tint == Tint::item) continue;
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
      worn[level.indices[i]] = 1;
    }
  }
  constexpr std::size_t kEvery = 7;  // of the vertices, to find what lies on the ground
  for (std::size_t i = 0; i < level.vertices.size(); ++i) {
    if (worn[i] == 0) continue;
    if (on_foot(level.vertices[i])) walker.soles.push_back(level.vertices[i]);
    if (i % kEvery == 0) walker.body.push_back(level.vertices[i]);
  }
  return walker;
}

Foot standing_foot(const Walker& walker, Side side, double toe_x_m, double pitch_rad) {
  const Sole sole = place_sole(walker, side);
  const Eigen::Vector3f moved(static_cast<float>(toe_x_m) - sole.toe.x(), 0, 0);
  const Eigen::Vector3f& pivot = pitch_rad > 0 ? sole.heel : sole.toe;
  Foot foot;
  foot.pitch_rad = pitch_rad;
  foot.toes_rad = std::max(pitch_rad, 0.0);
  foot.ankle = moved + pivot + foot_rotation(foot) * (sole.ankle - pivot);
  return foot;
}

double clearance_m(const Walker& walker, Side side, const Foot& foot) {
  const Sole sole = place_sole(walker, side);
  const Eigen::Matrix3f turn = foot_rotation(foot);
  const Eigen::Vector3f heel = foot.ankle + turn * (sole.heel - sole.ankle);
  const Eigen::Vector3f toe = foot.ankle + turn * (sole.toe - sole.ankle);
  const Eigen::Matrix3f toes = turn_z(foot.yaw_rad) * turn_y(-foot.toes_rad);
  const Eigen::Vector3f tip = toe + toes * (sole.tip - sole.toe);
  const Eigen::Vector3f ball = toe - toes * Eigen::Vector3f(0, 0, sole.toe.z());
  return std::min({heel.z(), tip.z(), ball.z()});
}

Limb find_leg(const Walker& walker, Side side) {
  const auto joint = [&](Bone left) { return walker.joints[index_from(on(side, left))]; };
  return {joint(Bone::left_shin) - joint(Bone::left_thigh),
          joint(Bone::left_foot) - joint(Bone::left_shin), Eigen::Vector3f::UnitX()};
}

Eigen::Vector3f hip_position(const Walker& walker, const Pose& pose, Side side) {
  const Eigen::Vector3f& hips = walker.joints[index_from(Bone::hips)];
  const Eigen::Vector3f& thigh = walker.joints[index_from(on(side, Bone::left_thigh))];
  return hips + pose.shift + pose.rotation[index_from(Bone::hips)] * (thigh - hips);
}

Pose mix(const Pose& a, const Pose& b, double share_of_b) {
  Pose pose;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    pose.rotation[bone] = between(a.rotation[bone], b.rotation[bone], share_of_b);
  }
  pose.shift = a.shift + static_cast<float>(share_of_b) * (b.shift - a.shift);
  return pose;
}

Figure mix(const Figure& a, const Figure& b, double share_of_b) {
  Figure figure;
  figure.pose = mix(a.pose, b.pose, share_of_b);
  for (const Side side : kSides) {
    const Foot& from = a.of(side);
    const Foot& to = b.of(side);
    Foot& foot = figure.of(side);
    foot.ankle = from.ankle + static_cast<float>(share_of_b) * (to.ankle - from.ankle);
    foot.pitch_rad = std::lerp(from.pitch_rad, to.pitch_rad, share_of_b);
    foot.toes_rad = std::lerp(from.toes_rad, to.toes_rad, share_of_b);
    foot.yaw_rad = std::lerp(from.yaw_rad, to.yaw_rad, share_of_b);
  }
  return figure;
}

Pose solve(const Walker& walker, const Figure& figure) {
  Pose pose = figure.pose;
  const Eigen::Vector3f ahead = pose.of(Bone::hips).col(0);
  const double hips_yaw = std::atan2(ahead.y(), ahead.x());
  for (const Side side : kSides) {
    const Foot& foot = figure.of(side);
    // Knees point to between where the hips and the foot point.
    const Eigen::Vector3f knee_to =
        turn_z(0.5 * (hips_yaw + foot.yaw_rad)) * Eigen::Vector3f::UnitX();
    const LimbTurn leg =
        reach(find_leg(walker, side), foot.ankle - hip_position(walker, pose, side), knee_to);
    pose.of(on(side, Bone::left_thigh)) = leg.upper;
    pose.of(on(side, Bone::left_shin)) = leg.lower;
    pose.of(on(side, Bone::left_foot)) = foot_rotation(foot);
    pose.of(on(side, Bone::left_toe)) = turn_z(foot.yaw_rad) * turn_y(-foot.toes_rad);
  }
  return pose;
}

Palette grounded(const Walker& walker, const Pose& pose, const std::vector<Vertex>& touching) {
  Palette palette = pose_palette(walker.joints, pose);
  float lowest = std::numeric_limits<float>::max();
  for (const Vertex& vertex : touching) {
    lowest = std::min(lowest, skin(vertex, palette, palette, 0).z());
  }
  if (touching.empty()) lowest = 0;
  for (BoneMatrix& matrix : palette) matrix(2, 3) -= lowest;
  return palette;
}

}  // namespace throng::skinning
