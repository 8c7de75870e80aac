#include "skinning/animate/gait.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/geometry/angle.h"
#include "base/geometry/smoothstep.h"
#include "skinning/animate/gait_tables.h"
#include "skinning/animate/posture.h"

namespace throng::skinning {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 40;  // per stride, where heights are settled

double wrapped(double phase) { return phase - std::floor(phase); }

double wave(double phase) { return std::cos(2 * kPi * phase); }

// Periodic Catmull-Rom spline through a table whose last sample is its first.
double sample(const std::array<float, GaitTable::kSamples>& table, double phase) {
  constexpr int kCount = static_cast<int>(GaitTable::kSamples) - 1;
  const double at = wrapped(phase) * kCount;
  const int i = static_cast<int>(at) % kCount;
  const double t = at - std::floor(at);
  const auto value = [&](int k) -> double { return table[(i + k + kCount) % kCount]; };
  const double a = value(-1);
  const double b = value(0);
  const double c = value(1);
  const double d = value(2);
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

const GaitTable& gait_table(const Gait& gait) { return gait.runs ? kRunTable : kWalkTable; }

double own_phase(Side side, double phase) {
  return wrapped(side == Side::left ? phase : phase + 0.5);
}

// The arm swings against the leg of its side.
Arm arm_swing(const Gait& gait, const Manner& manner, double own) {
  const double forward = -wave(own);
  const double swing = manner.arm_swing;
  if (gait.bearing == Bearing::arms_up)
    return {72 - 14 * wave(2 * own + 0.1), 66 + 12 * forward, 0, 12, 52};
  if (gait.runs) {
    // The faster, the more the elbows are bent.
    const double elbow = std::clamp(62 + 45 * (gait.stride - 0.9), 60.0, 85.0);
    return {-8 + 25 * std::min(swing, 1.2) * forward, elbow + 17 * forward, 6 + manner.arms_out_deg,
            22};
  }
  const double reach = swing * std::clamp(30 * gait.stride - 7, 4.0, 24.0);
  // People who walk at jogging speed bend the elbows.
  const double elbow = 16 + manner.elbow_deg + 30 * geometry::smoothstep(0.9, 1.1, gait.stride);
  return {1 + reach * forward, elbow + 0.5 * reach * forward, manner.arms_out_deg, 4};
}

}  // namespace

double duty(const Gait& gait) {
  if (gait.runs) return std::clamp(0.39 - 0.075 * (gait.stride - 0.95), 0.31, 0.40);
  return std::clamp(0.645 - 0.15 * (gait.stride - 0.74), 0.59, 0.68);
}

double middle(const Gait& gait) {
  if (gait.runs) return std::clamp(0.13 + 0.04 * (gait.stride - 1), 0.12, 0.16);
  return kWalkMiddle;
}

// How far hips swing for a stride: measured on this rig with the tables' angles (a stride of 0.77
// statures for walking as in the table, 0.91 for running).
Stride::Stride(const Walker& walker, const Gait& gait, const OwnMotion::Cycle* own)
    : walker_(&walker),
      gait_(gait),
      own_(own),
      swing_(gait.runs ? (gait.stride + 0.07) / 0.98 : gait.stride / 0.77),
      duty_(duty(gait)) {
  // Faster walking swings the hips further but bends knees and ankles hardly more (Schwartz et
  // al. 2008); slower walking reduces both.
  bend_ = swing_ < 1 ? std::max(swing_, 0.35) : 1 + 0.15 * (swing_ - 1);
  if (own_ != nullptr) {
    height_m_ = {own_->gait.mean_height_m(), 0, 0};
  } else if (gait.runs) {
    settle_running_height();
  } else {
    settle_walking_height();
  }
  height_m_[0] -= std::max(excess_height_m(), 0.0);
}

// The clip's, as high as the legs allow.
Pose Stride::own_trunk_at(double phase) const {
  Pose pose = own_->gait.trunk(phase);
  pose.shift.x() = 0;
  pose.shift.z() += static_cast<float>(height_m_[0] - own_->gait.mean_height_m());
  return pose;
}

Pose Stride::trunk_at(double phase) const {
  if (own_ != nullptr) return own_trunk_at(phase);
  Pose pose;
  const double vigour = std::min(swing_, 1.2) * walker_->manner.liveliness;
  Trunk trunk;
  trunk.hips_yaw = -(gait_.runs ? 7.0 : 5.0) * kDegree * vigour * wave(phase);
  trunk.chest_yaw = -1.2 * trunk.hips_yaw;
  trunk.tilt = (gait_.runs ? 4.5 : 3.5) * kDegree * vigour * wave(phase - 0.15);
  trunk.lean = (gait_.runs ? 7.0 : 2.5) * kDegree;
  bear_trunk(gait_.bearing, phase, trunk);
  pose_trunk(*walker_, trunk, pose);
  // The hips swing over the foot that stands.
  const double sway = (gait_.runs ? 0.006 : 0.012) * std::max(1.4 - 0.4 * swing_, 0.8);
  pose.shift.y() = static_cast<float>(sway * walker_->stature_m * wave(phase - 0.3));
  const double step = 2 * phase;
  pose.shift.z() = static_cast<float>(height_m_[0] + height_m_[1] * wave(step) +
                                      height_m_[2] * wave(step - 0.25));
  return pose;
}

Figure Stride::at(double phase) const {
  Figure figure;
  figure.pose = trunk_at(phase);
  if (own_ == nullptr) {
    pose_arms(
        *walker_,
        {arm_swing(gait_, walker_->manner, phase), arm_swing(gait_, walker_->manner, phase + 0.5)},
        figure.pose);
    bear_arms(*walker_, gait_.bearing, phase, figure.pose);
  }
  for (const Side side : kSides) {
    figure.of(side) = foot_at(side, own_phase(side, phase), figure.pose);
  }
  return figure;
}

bool Stride::supported(double phase) const {
  return own_phase(Side::left, phase) <= duty_ || own_phase(Side::right, phase) <= duty_;
}

double Stride::measured_pitch_deg(Side side, double own) const {
  if (own_ != nullptr) return own_->gait.pitch_rad(side, own) / kDegree;
  const GaitTable& table = gait_table(gait_);
  return swing_ * (sample(table.hip, own) - table.pelvis_tilt_deg) +
         bend_ * (sample(table.ankle, own) - sample(table.knee, own));
}

// Pitch of the foot while it stands: as measured, but flat in between.
double Stride::pitch_rad(Side side, double own) const {
  const double measured = measured_pitch_deg(side, own);
  const double at = wrapped(own);
  if (at > duty_) return measured * kDegree;
  const double down = gait_.runs ? 0.08 : 0.10;
  const double up = gait_.runs ? 0.14 : 0.30;
  const double flat = geometry::smoothstep(0.2 * down, down, at) *
                      (1 - geometry::smoothstep(up, std::min(up + 0.2, duty_), at));
  return (1 - flat) * std::clamp(measured, -62.0, 26.0) * kDegree;
}

Foot Stride::stance_foot(Side side, double own) const {
  const double standing_x = walker_->joints[index_from(on(side, Bone::left_toe))].x();
  const double passed_m = (own - middle(gait_)) * length_m();
  return standing_foot(*walker_, side, standing_x - passed_m, pitch_rad(side, own));
}

// Foot position during swing from the measured joint angles.
Foot Stride::swung_foot(Side side, double own, const Pose& pose) const {
  if (own_ != nullptr) {
    Eigen::Vector3f leg = own_->gait.leg(side, own);
    leg.x() *= static_cast<float>(gait_.stride / own_->stride);
    Foot foot;
    foot.ankle = hip_position(*walker_, pose, side) + leg;
    foot.pitch_rad = own_->gait.pitch_rad(side, own);
    return foot;
  }
  const GaitTable& table = gait_table(gait_);
  const double hip = swing_ * (sample(table.hip, own) - table.pelvis_tilt_deg);
  const double knee = bend_ * sample(table.knee, own);
  const Limb leg = find_leg(*walker_, side);
  Foot foot;
  foot.ankle = hip_position(*walker_, pose, side) + turn_y(-hip * kDegree) * leg.upper +
               turn_y(-(hip - knee) * kDegree) * leg.lower;
  foot.pitch_rad = (hip - knee + bend_ * sample(table.ankle, own)) * kDegree;
  return foot;
}

Foot Stride::foot_at(Side side, double own, const Pose& pose) const {
  if (own <= duty_) return stance_foot(side, own);
  // The swing leads from where the foot stood to where it will stand.
  const double other = side == Side::left ? 0 : 0.5;
  const Foot left_from = stance_foot(side, duty_);
  Foot strikes_at = stance_foot(side, 0);
  const Foot swung_from = swung_foot(side, duty_, trunk_at(duty_ + other));
  const Foot swung_to = swung_foot(side, 1, trunk_at(other));
  const double t = (own - duty_) / (1 - duty_);
  const auto share = static_cast<float>(geometry::smoothstep(0, 1, t));
  Foot foot = swung_foot(side, own, pose);
  foot.ankle += (1 - share) * (left_from.ankle - swung_from.ankle) +
                share * (strikes_at.ankle - swung_to.ankle);
  foot.pitch_rad += (1 - share) * (left_from.pitch_rad - swung_from.pitch_rad) +
                    share * (strikes_at.pitch_rad - swung_to.pitch_rad);
  // Toes that were flat on the ground come back to the foot's line.
  const double bent = 1 - geometry::smoothstep(0, 0.3, t);
  foot.toes_rad = foot.pitch_rad < 0 ? (1 - bent) * foot.pitch_rad : foot.pitch_rad;
  const double arch = std::sin(kPi * t);
  foot.ankle.y() += static_cast<float>(0.008 * arch) * side_sign(side);
  const double wanted_m =
      (gait_.runs ? 0.04 : 0.012 + 0.01 * walker_->manner.liveliness * gait_.stride) * arch;
  const double missing_m = wanted_m - clearance_m(*walker_, side, foot);
  foot.ankle.z() += static_cast<float>(std::max(missing_m, 0.0));
  return foot;
}

// How far up the hips are carried by a standing leg whose knee is bent by this much.
double Stride::hip_height_m(double phase, Side side, double own, double knee_rad) const {
  Pose pose = trunk_at(phase);
  pose.shift.z() = 0;
  const Eigen::Vector3f hip = hip_position(*walker_, pose, side);
  const Foot foot = stance_foot(side, own);
  const double chord = chord_m(find_leg(*walker_, side), knee_rad);
  const double across = (hip - foot.ankle).head<2>().norm();
  return foot.ankle.z() - hip.z() + std::sqrt(std::max(chord * chord - across * across, 0.01));
}

// Walkers are highest in the middle of a stance, on an almost straight leg, and sink between two
// stances just as far as both legs need to reach the ground.
void Stride::settle_walking_height() {
  constexpr double kMaxAngleRad = 0.30;
  const double knee = std::clamp(12 * bend_, 7.0, 14.0) * kDegree;
  const double high = hip_height_m(kMaxAngleRad, Side::left, kMaxAngleRad, knee);
  const double step = 2 * kMaxAngleRad;
  const double max_m = 0.022 * walker_->stature_m;
  for (double half_m = 0.003; half_m <= max_m; half_m += 0.001) {
    height_m_ = {high - half_m, half_m * wave(step), half_m * wave(step - 0.25)};
    if (excess_height_m() <= 0) break;
  }
}

// Runners are lowest in the middle of a stance and fly between two: the hips move up and down by
// 4.5 % of stature (Fukuchi 2017).
void Stride::settle_running_height() {
  const double middle = 0.5 * duty_;
  const double knee = bend_ * sample(kRunTable.knee, middle) * kDegree;
  const double low = hip_height_m(middle, Side::left, middle, knee);
  const double half_m = 0.5 * 0.045 * walker_->stature_m;
  const double step = 2 * middle;
  height_m_ = {low + half_m, -half_m * wave(step), -half_m * wave(step - 0.25)};
}

// How much higher the hips are than the legs that stand can carry them, at worst.
double Stride::excess_height_m() const {
  double excess = -1;
  for (int i = 0; i < kSamples; ++i) {
    const double phase = static_cast<double>(i) / kSamples;
    const double height = trunk_at(phase).shift.z();
    for (const Side side : kSides) {
      const double own = own_phase(side, phase);
      if (own > duty_) continue;
      constexpr double kStraightest = 3 * kDegree;
      excess = std::max(excess, height - hip_height_m(phase, side, own, kStraightest));
    }
  }
  return excess;
}

}  // namespace throng::skinning
