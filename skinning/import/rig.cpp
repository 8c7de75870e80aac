#include "skinning/import/rig.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.h"
#include "skinning/body/neutral.h"

namespace throng::skinning {

namespace {

Eigen::Vector3f node_position(const std::vector<Eigen::Matrix4f>& nodes, int node) {
  return nodes[static_cast<std::size_t>(node)].topRightCorner<3, 1>();
}

Eigen::Matrix3f rotation_part(const Eigen::Matrix4f& matrix) {
  return Eigen::Affine3f(matrix).rotation();
}

// The rotation by whole quarter turns nearest to one, if it is near: models are made upright.
Eigen::Matrix3f squared(const Eigen::Matrix3f& turn) {
  Eigen::Matrix3f square = Eigen::Matrix3f::Zero();
  for (Eigen::Index row = 0; row < 3; ++row) {
    Eigen::Index column = 0;
    turn.row(row).cwiseAbs().maxCoeff(&column);
    square(row, column) = turn(row, column) > 0 ? 1.0F : -1.0F;
  }
  constexpr float kNear = 0.94F;  // cosine of 20 degrees
  const bool near = (square.cwiseProduct(turn).rowwise().sum().array() > kNear).all();
  return near && std::abs(square.determinant() - 1) < 0.1F ? square : turn;
}

class Fitter {
 public:
  Fitter(const RiggedModel& model, const BoneNodes& nodes) : model_(&model), rest_(model.rest()) {
    rig_.nodes = nodes;
  }

  Rig fit() {
    own_the_nodes();
    turn_upright();
    place_joints();
    rig_.neutral = neutral_pose(rig_.rest, 0);
    return std::move(rig_);
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw InputError({model_->file, "", found, expected});
  }

  bool has(Bone bone) const { return rig_.nodes[index_from(bone)] >= 0; }
  Eigen::Vector3f raw(Bone bone) const {
    return node_position(rest_, rig_.nodes[index_from(bone)]);
  }

  void own_the_nodes() {
    rig_.bone_of_node.assign(model_->nodes.size(), Bone::hips);
    for (std::size_t i = 0; i < model_->nodes.size(); ++i) {
      const int parent = model_->nodes[i].parent;
      if (parent >= 0) rig_.bone_of_node[i] = rig_.bone_of_node[static_cast<std::size_t>(parent)];
      for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
        if (rig_.nodes[bone] == static_cast<int>(i)) rig_.bone_of_node[i] = static_cast<Bone>(bone);
      }
    }
  }

  void turn_upright() {
    const Eigen::Vector3f feet = 0.5F * (raw(Bone::left_foot) + raw(Bone::right_foot));
    const Eigen::Vector3f up = (raw(Bone::head) - feet).normalized();
    Eigen::Vector3f left = raw(Bone::left_thigh) - raw(Bone::right_thigh);
    left -= left.dot(up) * up;
    if (!up.allFinite() || !(left.norm() > 1e-9F)) {
      fail("head, feet and thighs in one place", "bones that stand where the body's joints are");
    }
    left.normalize();
    Eigen::Matrix3f turn;
    turn << left.cross(up).transpose(), left.transpose(), up.transpose();
    rig_.to_ours = squared(turn);
    for (const Side side : {Side::left, Side::right}) check_leg(side);
  }

  enum class Side : std::uint8_t { left, right };
  static Bone on(Side side, Bone left) {
    return side == Side::left ? left : static_cast<Bone>(index_from(left) + 4);
  }

  void check_leg(Side side) const {
    const Bone thigh = on(side, Bone::left_thigh);
    const Eigen::Vector3f leg = rig_.to_ours * (raw(on(side, Bone::left_foot)) - raw(thigh));
    constexpr float kMaxSplayed = 0.75F;  // cosine
    if (-leg.z() < kMaxSplayed * leg.norm()) {
      fail(fmt::format("a pose at rest in which the bone \"{}\" does not point down",
                       model_->nodes[static_cast<std::size_t>(rig_.nodes[index_from(thigh)])].name),
           "a standing pose at rest (T or A), upright, the left bones on the person's left");
    }
    const Bone toe = on(side, Bone::left_toe);
    if (!has(toe)) return;
    const Eigen::Vector3f foot = rig_.to_ours * (raw(toe) - raw(on(side, Bone::left_foot)));
    if (foot.x() < -0.2F * foot.norm()) {
      fail("toes that point backwards",
           "left bones on the person's left: swap left and right in \"bones\" or in the model");
    }
  }

  void place_joints() {
    Joints& joints = rig_.rest;
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      if (rig_.nodes[bone] >= 0)
        joints[bone] = rig_.to_ours * node_position(rest_, rig_.nodes[bone]);
    }
    const auto at = [&](Bone bone) -> Eigen::Vector3f& { return joints[index_from(bone)]; };
    const auto between = [&](Bone a, Bone b, float share) {
      return Eigen::Vector3f((1 - share) * at(a) + share * at(b));
    };
    at(Bone::hips) = between(Bone::left_thigh, Bone::right_thigh, 0.5F);
    if (!has(Bone::spine)) at(Bone::spine) = between(Bone::hips, Bone::chest, 0.5F);
    if (!has(Bone::neck)) at(Bone::neck) = between(Bone::chest, Bone::head, 0.75F);
    for (const Side side : {Side::left, Side::right}) {
      const Bone upper_arm = on(side, Bone::left_upper_arm);
      const Bone forearm = on(side, Bone::left_forearm);
      const Bone foot = on(side, Bone::left_foot);
      if (!has(on(side, Bone::left_clavicle))) {
        at(on(side, Bone::left_clavicle)) = between(Bone::neck, upper_arm, 0.25F);
      }
      if (!has(on(side, Bone::left_hand))) {
        at(on(side, Bone::left_hand)) = between(upper_arm, forearm, 1.9F);
      }
      if (!has(on(side, Bone::left_toe))) {
        const float leg = (at(on(side, Bone::left_thigh)) - at(foot)).norm();
        at(on(side, Bone::left_toe)) = at(foot) + leg * Eigen::Vector3f(0.17F, 0, -0.06F);
      }
    }
  }

  const RiggedModel* model_;
  std::vector<Eigen::Matrix4f> rest_;
  Rig rig_;
};

}  // namespace

Rig fit_rig(const RiggedModel& model, const BoneNodes& nodes) { return Fitter(model, nodes).fit(); }

std::vector<Pose> sample_poses(const RiggedModel& model, const Rig& rig,
                               const ModelAnimation& animation, int count, float scale) {
  const std::vector<Eigen::Matrix4f> rest = model.rest();
  const auto hips_in = [&](const std::vector<Eigen::Matrix4f>& nodes) {
    return Eigen::Vector3f(rig.to_ours * 0.5F *
                           (node_position(nodes, rig.nodes[index_from(Bone::left_thigh)]) +
                            node_position(nodes, rig.nodes[index_from(Bone::right_thigh)])));
  };
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const std::vector<Eigen::Matrix4f> moved =
        model.at(animation, animation.duration_s * i / count);
    Pose& pose = poses.emplace_back();
    pose.shift = scale * (hips_in(moved) - hips_in(rest));
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      if (rig.nodes[bone] < 0) {
        // A joint of our own making moves with what carries it.
        pose.rotation[bone] = pose.rotation[index_from(kParent[bone])];
        continue;
      }
      const auto node = static_cast<std::size_t>(rig.nodes[bone]);
      const Eigen::Matrix3f turn =
          rotation_part(moved[node]) * rotation_part(rest[node]).transpose();
      pose.rotation[bone] =
          rig.to_ours * turn * rig.to_ours.transpose() * rig.neutral.rotation[bone].transpose();
    }
  }
  return poses;
}

}  // namespace throng::skinning
