#include "skinning/animate/own_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/geometry/smoothstep.h"
#include "skinning/animate/standing.h"

namespace throng::skinning {

namespace {

std::size_t index_of_side(Side side) { return static_cast<std::size_t>(side); }

// Two neighbors of a row that begins again where it ends.
struct Neighbors {
  std::size_t before;
  std::size_t after;
  double share;
};

Neighbors around(double share, std::size_t count) {
  const double at = (share - std::floor(share)) * static_cast<double>(count);
  const std::size_t before = static_cast<std::size_t>(at) % count;
  return {before, (before + 1) % count, at - std::floor(at)};
}

// Takes out of the hips' shift what gets on, so that the clip is on the spot.
std::vector<Pose> on_the_spot(std::vector<Pose> poses) {
  const auto count = static_cast<float>(poses.size());
  if (poses.size() < 2) return poses;
  // The last pose is one interval before the end.
  const Eigen::Vector3f travel = (poses.back().shift - poses.front().shift) * (count / (count - 1));
  const float on = travel.head<2>().norm();
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    // Swaying is not travel.
    constexpr float kMinTravelM = 0.3F;
    if (on > kMinTravelM) poses[i].shift -= travel * (static_cast<float>(i) / count);
    mean += poses[i].shift / count;
  }
  for (Pose& pose : poses) pose.shift.head<2>() -= mean.head<2>();
  return poses;
}

}  // namespace

OwnGait::OwnGait(const Walker& walker, const std::vector<Pose>& poses, double duration_s,
                 double middle)
    : duration_s_(duration_s) {
  std::vector<Joints> joints;
  for (const Pose& pose : on_the_spot(poses)) {
    const Joints& posed = joints.emplace_back(pose_joints(walker.joints, pose));
    Moment moment{pose, {}, {}};
    for (const Side side : kSides) {
      const std::size_t i = index_of_side(side);
      moment.leg[i] = posed[index_from(on(side, Bone::left_foot))] -
                      posed[index_from(on(side, Bone::left_thigh))];
      const Eigen::Vector3f ahead =
          pose.rotation[index_from(on(side, Bone::left_foot))] * Eigen::Vector3f::UnitX();
      moment.pitch_rad[i] = std::atan2(ahead.z(), ahead.head<2>().norm());
    }
    mean_height_m_ += pose.shift.z() / static_cast<double>(poses.size());
    moments_.push_back(moment);
  }
  find_stride(walker, joints, middle);
}

// The left foot is in stance when its toe passes from in front of its standing position to behind
// it while the foot is low: in swing it moves forward.
void OwnGait::find_stride(const Walker& walker, const std::vector<Joints>& joints, double middle) {
  const std::size_t count = joints.size();
  const std::size_t toe = index_from(Bone::left_toe);
  const float standing_x = walker.joints[toe].x();
  const auto x = [&](std::size_t i) { return joints[i % count][toe].x() - standing_x; };
  std::vector<double> passes;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(x(i) >= 0 && x(i + 1) < 0)) continue;
    const double share = x(i) / (x(i) - x(i + 1));
    passes.push_back((static_cast<double>(i) + share) / static_cast<double>(count));
    if (passes.size() > 1) continue;
    const auto around_it = std::max<std::size_t>(count / 16, 1);
    const double travel = x(i + count - around_it) - x(i + 1 + around_it);
    const double seconds =
        duration_s_ * static_cast<double>(2 * around_it + 1) / static_cast<double>(count);
    foot_speed_mps_ = travel / seconds;
  }
  if (passes.empty()) {
    throw std::invalid_argument("a clip in which the left foot never passes below the body");
  }
  strides_ = static_cast<double>(passes.size());
  duration_s_ /= strides_;
  zero_ = passes.front() - middle / strides_;
}

struct OwnGait::Blend {
  const Moment* before;
  const Moment* after;
  double share;
};

OwnGait::Blend OwnGait::place(double phase) const {
  // The first of several strides, repeated.
  const double own = phase - std::floor(phase);
  const Neighbors at = around(zero_ + own / strides_, moments_.size());
  return {&moments_[at.before], &moments_[at.after], at.share};
}

Pose OwnGait::trunk(double phase) const {
  const Blend at = place(phase);
  return mix(at.before->pose, at.after->pose, at.share);
}

Eigen::Vector3f OwnGait::leg(Side side, double own_phase) const {
  const Blend at = place(side == Side::left ? own_phase : own_phase + 0.5);
  const std::size_t i = index_of_side(side);
  return at.before->leg[i] + static_cast<float>(at.share) * (at.after->leg[i] - at.before->leg[i]);
}

double OwnGait::pitch_rad(Side side, double own_phase) const {
  const Blend at = place(side == Side::left ? own_phase : own_phase + 0.5);
  const std::size_t i = index_of_side(side);
  return std::lerp(at.before->pitch_rad[i], at.after->pitch_rad[i], at.share);
}

Figure stand_as(const Walker& walker, const std::vector<Pose>& poses, double share) {
  constexpr double kBlend = 0.15;
  Figure figure = ready(walker);
  const Neighbors at = around(share, poses.size());
  Pose own = mix(poses[at.before], poses[at.after], at.share);
  // Feet and hips stay where they are: what they carry moves.
  own.shift = figure.pose.shift;
  own.of(Bone::hips) = figure.pose.of(Bone::hips);
  figure.pose =
      mix(figure.pose, own,
          geometry::smoothstep(share / kBlend) * geometry::smoothstep((1 - share) / kBlend));
  return figure;
}

}  // namespace throng::skinning
