#include "skinning/animate/bearing.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/geometry/angle.h"
#include "skinning/animate/touch.h"

namespace throng::skinning {

namespace {

constexpr std::array kBearings = {
    BearingClips{"walk", Bearing::free, false, Actions(Action::walk), 23, 0.22, 0.04},
    BearingClips{"walk_look_up", Bearing::look_up, false,
                 Actions(Action::walk, Action::look_at_drone), 5, 0.46, 0.12},
    BearingClips{"walk_phone", Bearing::phone, false, Actions(Action::walk, Action::use_phone), 11,
                 0.5, 0.04},
    BearingClips{"walk_call", Bearing::call, false, Actions(Action::walk, Action::call), 11, 0.5,
                 0.04},
    BearingClips{"walk_pockets", Bearing::pockets, false, Actions(Action::walk), 11, 0.5, 0.04},
    BearingClips{"walk_talk", Bearing::talk, false, Actions(Action::walk, Action::talk), 11, 0.5,
                 0.04},
    BearingClips{"run", Bearing::free, true, Actions(Action::run), 14, 0.84, 0.07},
    BearingClips{"panic", Bearing::arms_up, true, Actions(Action::run, Action::panic), 6, 0.9,
                 0.16},
    BearingClips{"panic_cover", Bearing::cover, true, Actions(Action::run, Action::panic), 4, 0.96,
                 0.24},
    BearingClips{"panic_look_back", Bearing::look_back, true,
                 Actions(Action::run, Action::look_back), 4, 0.96, 0.24},
};

double bearing_wave(double phase) { return std::cos(2 * std::numbers::pi * phase); }

/// Palm and forearm of one arm, as angles, beside an arm that stays as it is.
void gesture(const Walker& walker, Side side, double phase, Pose& pose) {
  const auto ahead = static_cast<float>(0.15 + 0.02 * bearing_wave(2 * phase));
  const auto up = static_cast<float>(-0.17 + 0.045 * bearing_wave(phase + 0.2));
  const float s = walker.stature_m;
  const Joints joints = pose_joints(walker.joints, pose);
  const Eigen::Vector3f& shoulder = joints[index_from(on(side, Bone::left_upper_arm))];
  hold(walker, side,
       shoulder +
           pose.of(Bone::chest) * Eigen::Vector3f(ahead * s, 0.02F * s * side_sign(side), up * s),
       pose);
}

}  // namespace

std::span<const BearingClips> bearings() { return kBearings; }

const BearingClips* find_bearing(std::string_view clip) {
  for (const BearingClips& known : kBearings) {
    if (known.name == clip) return &known;
  }
  return nullptr;
}

void bear_trunk(Bearing bearing, double phase, Trunk& trunk) {
  switch (bearing) {
    case Bearing::look_up:
      trunk.head_down = -34 * kDegree;
      trunk.lean -= 3 * kDegree;
      break;
    case Bearing::phone:
      trunk.head_down = 30 * kDegree;
      trunk.lean += 1.5 * kDegree;
      break;
    case Bearing::call:
      trunk.head_down = 4 * kDegree;
      break;
    case Bearing::talk:
      trunk.head_yaw = 28 * kDegree;
      break;
    case Bearing::arms_up:
      trunk.lean += 7 * kDegree;
      break;
    case Bearing::cover:
      trunk.lean += 17 * kDegree;
      trunk.head_down = 12 * kDegree;
      break;
    case Bearing::look_back:
      trunk.chest_yaw += 22 * kDegree;
      trunk.head_yaw = (74 + 6 * bearing_wave(phase)) * kDegree;
      break;
    case Bearing::free:
    case Bearing::pockets:
      break;
  }
}

void bear_arms(const Walker& walker, Bearing bearing, double phase, Pose& pose) {
  Figure figure{pose, {}};
  const Side main = phone_hand(walker.manner);
  if (bearing == Bearing::phone || bearing == Bearing::call) {
    put_hand(walker, main, bearing == Bearing::call ? HandSpot::ear : HandSpot::chest, figure);
  }
  if (bearing == Bearing::pockets || bearing == Bearing::cover) {
    for (const Side side : kSides) {
      if (is_hand_busy(walker, side)) continue;
      put_hand(walker, side, bearing == Bearing::cover ? HandSpot::crown : HandSpot::pocket,
               figure);
    }
  }
  if (bearing == Bearing::talk) gesture(walker, main, phase, figure.pose);
  pose = figure.pose;
}

// Shares are estimates.
std::string_view choose_walk(Setting setting, double age_years, bool has_free_hands,
                             Random& random) {
  const double draw = random.uniform();
  if (setting == Setting::company && draw < 0.3) return "walk_talk";
  if (setting == Setting::fear || age_years < 11 || draw < 0.3) return "walk";
  if (draw < 0.39 && age_years < 70) return "walk_phone";
  if (draw < 0.44) return "walk_call";
  return draw < 0.58 && has_free_hands ? "walk_pockets" : "walk";
}

std::string_view choose_flight(bool has_free_hands, Random& random) {
  const double draw = random.uniform();
  if (draw < 0.35) return "panic";
  if (draw < 0.5) return has_free_hands ? "panic_cover" : "panic";
  return draw < 0.67 ? "panic_look_back" : "run";
}

}  // namespace throng::skinning
