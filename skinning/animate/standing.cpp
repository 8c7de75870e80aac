#include "skinning/animate/standing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/geometry/angle.h"
#include "base/geometry/smoothstep.h"

namespace throng::skinning {

namespace {

double sine(double phase) { return std::sin(2 * std::numbers::pi * phase); }

// Flat feet where they are at rest, and hips as high as knees that are bent by this carry them.
void put_feet(const Walker& walker, double knee_rad, Figure& figure) {
  double height = 1e3;
  figure.pose.shift.z() = 0;
  for (const Side side : kSides) {
    Foot& foot = figure.of(side);
    foot = standing_foot(walker, side, walker.joints[index_from(on(side, Bone::left_toe))].x(), 0);
    const Eigen::Vector3f hip = hip_position(walker, figure.pose, side);
    const double chord = chord_m(find_leg(walker, side), knee_rad);
    const double across = (hip - foot.ankle).head<2>().norm();
    height = std::min(height, foot.ankle.z() - hip.z() +
                                  std::sqrt(std::max(chord * chord - across * across, 0.01)));
  }
  figure.pose.shift.z() = static_cast<float>(height);
}

std::array<Arm, 2> hanging_arms(const Manner& manner, double breath) {
  const Arm arm = {1 + 1.2 * breath, 11 + manner.elbow_deg, manner.arms_out_deg, 6};
  return {arm, arm};
}

Figure standing(const Walker& walker, Trunk trunk, double breath, double sway_m) {
  constexpr double kKnee = 7 * kDegree;
  trunk.lean += (1.0 + 0.4 * breath) * kDegree;
  return upright(walker, trunk, hanging_arms(walker.manner, breath), sway_m, kKnee);
}

// A foot moving from its position in another figure.
Foot blended(const Foot& from, const Foot& to, double share) {
  Foot foot = to;
  foot.ankle = from.ankle + static_cast<float>(share) * (to.ankle - from.ankle);
  foot.pitch_rad = std::lerp(from.pitch_rad, to.pitch_rad, share);
  foot.toes_rad = std::lerp(from.toes_rad, to.toes_rad, share);
  return foot;
}

Foot lifted(const Walker& walker, Side side, Foot foot, double wanted_m) {
  const double missing = wanted_m - clearance_m(walker, side, foot);
  foot.ankle.z() += static_cast<float>(std::max(missing, 0.0));
  return foot;
}

// One of the poses that a fall goes through, and when.
struct Key {
  double share;
  Pose pose;
};

struct Limbs {
  double trunk;  // all pitches forwards, degrees
  double thigh;
  double shin;
  double foot;
  double shift_x;
};

Pose sunk(const Limbs& limbs, double stature_m) {
  Pose pose;
  for (const Bone bone : {Bone::hips, Bone::spine, Bone::chest, Bone::neck, Bone::head,
                          Bone::left_clavicle, Bone::right_clavicle}) {
    pose.of(bone) = turn_y(limbs.trunk * kDegree);
  }
  for (const Side side : kSides) {
    pose.of(on(side, Bone::left_thigh)) = turn_y(limbs.thigh * kDegree);
    pose.of(on(side, Bone::left_shin)) = turn_y(limbs.shin * kDegree);
    pose.of(on(side, Bone::left_foot)) = turn_y(limbs.foot * kDegree);
    pose.of(on(side, Bone::left_toe)) = turn_y(0.8 * limbs.foot * kDegree);
  }
  pose.shift.x() = static_cast<float>(limbs.shift_x * stature_m / 1.75);
  return pose;
}

void put_arms(double shoulder_deg, double elbow_deg, double out_deg, Pose& pose) {
  for (const Side side : kSides) {
    const Eigen::Matrix3f base = turn_x(side_sign(side) * out_deg * kDegree);
    pose.of(on(side, Bone::left_upper_arm)) = base * turn_y(-shoulder_deg * kDegree);
    pose.of(on(side, Bone::left_forearm)) = base * turn_y(-(shoulder_deg + elbow_deg) * kDegree);
    pose.of(on(side, Bone::left_hand)) = pose.of(on(side, Bone::left_forearm));
  }
}

std::vector<Key> fall_on_the_face(const Walker& walker) {
  const auto stature = static_cast<double>(walker.stature_m);
  Pose buckling = sunk({30, -42, 38, 0, 0.02}, stature);
  put_arms(30, 40, 12, buckling);
  Pose kneeling = sunk({34, 6, 84, 100, 0.1}, stature);
  put_arms(70, 25, 15, kneeling);
  Pose lying = sunk({89, 86, 92, 150, 0.25}, stature);
  for (const Side side : kSides) {
    const double sign = side_sign(side);
    // Upper arms out to the sides, forearms ahead, flat on the ground.
    lying.of(on(side, Bone::left_upper_arm)) =
        turn_z(sign * -25 * kDegree) * turn_x(sign * 84 * kDegree);
    lying.of(on(side, Bone::left_forearm)) = turn_z(sign * 20 * kDegree) * turn_y(-88 * kDegree);
    lying.of(on(side, Bone::left_hand)) = lying.of(on(side, Bone::left_forearm));
    lying.of(on(side, Bone::left_thigh)) = turn_z(-sign * 8 * kDegree) * turn_y(87 * kDegree);
    lying.of(on(side, Bone::left_shin)) = turn_z(-sign * 8 * kDegree) * turn_y(91 * kDegree);
  }
  // One cheek on the ground.
  lying.of(Bone::head) = turn_x(55 * kDegree) * turn_y(86 * kDegree);
  lying.of(Bone::neck) = turn_x(25 * kDegree) * turn_y(86 * kDegree);
  return {{0.32, buckling}, {0.58, kneeling}, {1, lying}};
}

std::vector<Key> fall_on_the_back(const Walker& walker) {
  const auto stature = static_cast<double>(walker.stature_m);
  Pose squatting = sunk({12, -72, 28, 0, -0.18}, stature);
  put_arms(25, 30, 18, squatting);
  Pose sitting = sunk({-28, -108, 18, -10, -0.42}, stature);
  put_arms(-35, 10, 20, sitting);
  Pose lying = sunk({-88, -88, -91, -58, -0.5}, stature);
  for (const Side side : kSides) {
    const double sign = side_sign(side);
    lying.of(on(side, Bone::left_upper_arm)) = turn_z(sign * 32 * kDegree) * turn_y(-88 * kDegree);
    lying.of(on(side, Bone::left_forearm)) = turn_z(sign * 8 * kDegree) * turn_y(-91 * kDegree);
    lying.of(on(side, Bone::left_hand)) = lying.of(on(side, Bone::left_forearm));
    const Eigen::Matrix3f apart = turn_z(sign * 9 * kDegree);
    for (const Bone bone : {Bone::left_thigh, Bone::left_shin, Bone::left_foot, Bone::left_toe}) {
      lying.of(on(side, bone)) = apart * lying.of(on(side, bone));
    }
  }
  lying.of(Bone::head) = turn_x(20 * kDegree) * turn_y(-84 * kDegree);
  return {{0.38, squatting}, {0.62, sitting}, {1, lying}};
}

Pose body_in_fall(const Walker& walker, bool forwards, double share) {
  Key before = {0, solve(walker, ready(walker))};
  before.pose.shift.z() = 0;
  for (const Key& key : forwards ? fall_on_the_face(walker) : fall_on_the_back(walker)) {
    if (share <= key.share) {
      // Quicker and quicker down to the knees, then to the ground.
      const double t = (share - before.share) / (key.share - before.share);
      return mix(before.pose, key.pose, t);
    }
    before = key;
  }
  return before.pose;
}

}  // namespace

Figure upright(const Walker& walker, const Trunk& trunk, const std::array<Arm, 2>& arms,
               double aside_m, double knee_rad) {
  Figure figure;
  pose_trunk(walker, trunk, figure.pose);
  figure.pose.shift.y() = static_cast<float>(aside_m);
  put_feet(walker, knee_rad, figure);
  pose_arms(walker, arms, figure.pose);
  return figure;
}

Figure ready(const Walker& walker) { return stand(walker, 0, 0); }

Figure stand(const Walker& walker, double weight, double aside) {
  // Hips and back go along with the head, so that small turns of it move the whole body.
  const double sway = std::sin(std::numbers::pi * aside);
  const double bow = 1 - std::cos(std::numbers::pi * aside);
  Trunk trunk;
  trunk.hips_yaw = 0.05 * aside;
  trunk.chest_yaw = 0.18 * aside;
  trunk.tilt = 0.034 * sway + 0.06 * weight;
  trunk.lean = 0.012 * bow;
  trunk.head_yaw = 0.9 * aside * walker.manner.liveliness;
  trunk.head_down = 0.04 * bow - 0.03 * weight;
  return standing(walker, trunk, 0.5 * bow * weight,
                  (0.016 * sway + 0.02 * weight) * walker.stature_m);
}

Figure look_up(const Walker& walker, double yaw_rad, double raised, double phase) {
  Trunk trunk;
  trunk.lean = -5 * kDegree;
  trunk.hips_yaw = 0.1 * yaw_rad;
  trunk.chest_yaw = 0.35 * yaw_rad;
  trunk.head_yaw = yaw_rad * (1 + 0.06 * sine(phase));
  trunk.head_down = (-40 + 2 * sine(phase)) * kDegree;
  return mix(ready(walker), standing(walker, trunk, 0, 0.004 * sine(phase)),
             geometry::smoothstep(raised));
}

Figure look_at_phone(const Walker& walker, double raised, double phase) {
  Trunk trunk;
  trunk.lean = 3 * kDegree;
  trunk.tilt = 0.02 * sine(phase);
  trunk.chest_yaw = 0.06 * sine(phase);
  trunk.head_yaw = trunk.chest_yaw;
  trunk.head_down = (30 + 4 * sine(phase)) * kDegree;
  Figure figure = standing(walker, trunk, 0, 0.014 * sine(phase));
  const Side side = phone_hand(walker.manner);
  const Bone upper_arm = on(side, Bone::left_upper_arm);
  const Eigen::Vector3f shoulder = pose_joints(walker.joints, figure.pose)[index_from(upper_arm)];
  const float stature = walker.stature_m;
  hold(walker, side,
       shoulder + Eigen::Vector3f(0.165F * stature, -0.075F * side_sign(side) * stature,
                                  (-0.09F + 0.003F * static_cast<float>(sine(phase))) * stature),
       figure.pose);
  return mix(ready(walker), figure, geometry::smoothstep(raised));
}

Figure turn_on_the_spot(const Walker& walker, double angle_rad, double share) {
  Figure figure = ready(walker);
  for (const Side side : kSides) {
    const double begin = side == Side::left ? 0.04 : 0.54;
    const double t = std::clamp((share - begin) / 0.42, 0.0, 1.0);
    Foot& foot = figure.of(side);
    // In the world the foot stays, steps, and stays again; the body turns all the time.
    foot.yaw_rad = angle_rad * (geometry::smoothstep(t) - share);
    foot.ankle = turn_z(foot.yaw_rad) * foot.ankle;
    foot.ankle.z() += static_cast<float>(0.05 * std::sin(std::numbers::pi * t));
    foot.pitch_rad = foot.toes_rad = -0.15 * std::sin(std::numbers::pi * t);
  }
  const double over = sine(share);  // first the right foot carries, then the left one
  figure.pose.shift.y() -= static_cast<float>(0.015 * over);
  figure.pose.shift.z() -= static_cast<float>(0.012 * over * over);
  return figure;
}

Figure start(const Walker& walker, const Stride& stride, Side side, double share) {
  const double middle = kWalkMiddle + (side == Side::left ? 0 : 0.5);
  const Side other = side == Side::left ? Side::right : Side::left;
  const Figure from = ready(walker);
  const Figure under = stride.at(middle);
  const Figure walking = stride.at(middle + 0.25 * share);
  Figure figure = walking;
  figure.pose = mix(from.pose, walking.pose, geometry::smoothstep(share));
  Foot at_first = from.of(other);
  at_first.ankle += walking.of(other).ankle - under.of(other).ankle;
  at_first.pitch_rad += walking.of(other).pitch_rad - under.of(other).pitch_rad;
  at_first.toes_rad += walking.of(other).toes_rad - under.of(other).toes_rad;
  figure.of(other) =
      lifted(walker, other, blended(at_first, walking.of(other), geometry::smoothstep(share)),
             0.03 * std::sin(std::numbers::pi * share));
  return figure;
}

Figure stop(const Walker& walker, const Stride& stride, Side side, double share) {
  const double middle = kWalkMiddle + (side == Side::left ? 0 : 0.5);
  const Side other = side == Side::left ? Side::right : Side::left;
  const Figure to = ready(walker);
  const Figure walking = stride.at(middle - kStopStrides * (1 - share));
  Figure figure = walking;
  figure.pose = mix(walking.pose, to.pose, geometry::smoothstep(share));
  figure.of(other) =
      lifted(walker, other, blended(walking.of(other), to.of(other), geometry::smoothstep(share)),
             0.02 * std::sin(std::numbers::pi * share));
  return figure;
}

Pose fall(const Walker& walker, bool forwards, double share) {
  Pose pose = body_in_fall(walker, forwards, share);
  if (walker.manner.carries == Carry::walking_stick) {
    // It falls to the right, and is level before the hand is down.
    constexpr double kLevelShare = 0.25;
    Pose level = pose;
    level.of(Bone::right_hand) = turn_x(-92 * kDegree);
    pose = mix(pose, level, geometry::smoothstep(share / kLevelShare));
  }
  return pose;
}

}  // namespace throng::skinning
