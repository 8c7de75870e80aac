#include "skinning/animate/acts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "base/geometry/smoothstep.h"
#include "skinning/animate/standing.h"
#include "skinning/animate/touch.h"

namespace throng::skinning {

namespace {

constexpr double kStraightKnee = 7 * kDegree;
constexpr double kAnyAge = 200;

double turn_sine(double phase) { return std::sin(2 * std::numbers::pi * phase); }

/// Once per repetition from 0 to 1, held there for a while, and back.
double dip(double phase) {
  const double from_middle = std::abs(phase - 0.5);
  return 1 - geometry::smoothstep(0.15, 0.4, from_middle);
}

Side main_hand(const Walker& walker) { return phone_hand(walker.manner); }
Side other_hand(const Walker& walker) {
  return main_hand(walker) == Side::left ? Side::right : Side::left;
}

std::array<Arm, 2> pair_arms(const Walker& walker, const Arm& main, const Arm& other) {
  std::array<Arm, 2> arms;
  arms[static_cast<std::size_t>(main_hand(walker))] = main;
  arms[static_cast<std::size_t>(other_hand(walker))] = other;
  return arms;
}

Arm hanging(const Walker& walker) {
  return {1, 11 + walker.manner.elbow_deg, walker.manner.arms_out_deg, 6};
}

/// Standing calmly with the weight on the leg that somebody prefers, swaying `aside` (-1 to 1) and
/// looking there, by a share of `look`.
Figure calm(const Walker& walker, double aside, double look, double head_down_deg,
            double lean_deg) {
  const double weight = walker.manner.liveliness > 1 ? 1 : -1;
  const double sway = turn_sine(0.5 * aside);
  Trunk trunk;
  trunk.hips_yaw = 0.04 * aside;
  trunk.chest_yaw = 0.16 * aside * look;
  trunk.tilt = 0.034 * sway + 0.055 * weight;
  trunk.lean = lean_deg * kDegree + 0.012 * std::abs(aside);
  trunk.head_yaw = 0.8 * aside * look * walker.manner.liveliness;
  trunk.head_down = head_down_deg * kDegree + 0.04 * std::abs(aside);
  return upright(walker, trunk, {hanging(walker), hanging(walker)},
                 (0.016 * sway + 0.018 * weight) * walker.stature_m, kStraightKnee);
}

Figure lively(const Walker& walker, const Trunk& trunk, const Arm& main, const Arm& other,
              double knee_deg = 7) {
  return upright(walker, trunk, pair_arms(walker, main, other), 0, knee_deg * kDegree);
}

void put_both(const Walker& walker, HandSpot spot, Figure& figure) {
  for (const Side side : kSides) {
    if (!is_hand_busy(walker, side)) put_hand(walker, side, spot, figure);
  }
}

/// Hips near the heels, on feet that stay where they are.
Figure folded(const Walker& walker, double aside, double lean_deg, double head_down_deg) {
  Trunk trunk;
  trunk.lean = lean_deg * kDegree;
  trunk.chest_yaw = 0.12 * aside;
  trunk.head_yaw = 0.7 * aside;
  trunk.head_down = head_down_deg * kDegree;
  Figure figure = upright(walker, trunk, {hanging(walker), hanging(walker)}, 0, kStraightKnee);
  const float hips_m = walker.joints[index_from(Bone::left_thigh)].z();
  figure.pose.shift.x() = -0.085F * walker.stature_m;
  figure.pose.shift.z() = 0.2F * walker.stature_m - hips_m;
  for (const Side side : kSides) {
    Foot& foot = figure.of(side);
    foot.yaw_rad = 14 * kDegree * static_cast<double>(side_sign(side));
  }
  return figure;
}

Figure pockets(const Walker& walker, double at) {
  Figure figure = calm(walker, at, 1, 4, -2);
  put_both(walker, HandSpot::pocket, figure);
  return figure;
}

Figure arms_crossed(const Walker& walker, double at) {
  Figure figure = calm(walker, at, 1, 0, -3);
  put_both(walker, HandSpot::elbow, figure);
  return figure;
}

Figure akimbo(const Walker& walker, double at) {
  Figure figure = calm(walker, at, 1, 0, -2);
  put_both(walker, HandSpot::waist, figure);
  return figure;
}

Figure hands_behind(const Walker& walker, double at) {
  Figure figure = calm(walker, at, 1, 5, -2);
  put_both(walker, HandSpot::back, figure);
  return figure;
}

Figure call(const Walker& walker, double at) {
  Figure figure = calm(walker, at, 0.6, 5, 0);
  put_hand(walker, main_hand(walker), HandSpot::ear, figure);
  return figure;
}

Figure film(const Walker& walker, double at) {
  Figure figure = calm(walker, at, 0.3, -6, -4);
  put_both(walker, HandSpot::eyes, figure);
  return figure;
}

Figure film_high(const Walker& walker, double at) {
  Figure figure = calm(walker, at, 0.3, -10, -5);
  put_hand(walker, main_hand(walker), HandSpot::overhead, figure);
  return figure;
}

Figure read_map(const Walker& walker, double at) {
  Figure figure = calm(walker, at, 0.25, 34, 5);
  put_both(walker, HandSpot::chest, figure);
  return figure;
}

Figure squat(const Walker& walker, double at) {
  Figure figure = folded(walker, at, 26, -6);
  put_both(walker, HandSpot::knee, figure);
  return figure;
}

Figure cower(const Walker& walker, double at) {
  Figure figure = folded(walker, 0.35 * at, 46, 22);
  put_both(walker, HandSpot::crown, figure);
  return figure;
}

Figure hold_head(const Walker& walker, double at) {
  Figure figure = calm(walker, at, 1, 2, -3);
  put_both(walker, HandSpot::crown, figure);
  return figure;
}

/// To the mouth with the main hand and back, as people eat, drink and smoke; the other hand waits.
Figure to_mouth(const Walker& walker, double at, double back_deg, HandSpot other_spot) {
  const double up = dip(at);
  Figure figure = calm(walker, 0.25 * turn_sine(at), 1, 8 - (8 + back_deg) * up, 1);
  const Side other = other_hand(walker);
  if (!is_hand_busy(walker, other)) put_hand(walker, other, other_spot, figure);
  put_hand(walker, main_hand(walker), HandSpot::chest, HandSpot::mouth, up, figure);
  return figure;
}
Figure eat(const Walker& walker, double at) { return to_mouth(walker, at, -6, HandSpot::chest); }
Figure drink(const Walker& walker, double at) { return to_mouth(walker, at, 14, HandSpot::pocket); }
Figure smoke(const Walker& walker, double at) { return to_mouth(walker, at, 4, HandSpot::pocket); }

Figure talk(const Walker& walker, double at) {
  Trunk trunk;
  trunk.lean = 1 * kDegree;
  trunk.chest_yaw = 0.05 * turn_sine(at);
  trunk.head_yaw = 0.16 * turn_sine(at + 0.3);
  trunk.head_down = 3 * kDegree * turn_sine(2 * at);
  return lively(walker, trunk, {26 + 12 * turn_sine(at), 70 + 16 * turn_sine(2 * at + 0.2), 10, 12},
                hanging(walker));
}

Figure talk_with_both(const Walker& walker, double at) {
  Trunk trunk;
  trunk.lean = 3 * kDegree;
  trunk.tilt = 0.03 * turn_sine(at);
  trunk.head_yaw = 0.12 * turn_sine(at);
  trunk.head_down = 4 * kDegree * turn_sine(2 * at + 0.4);
  const auto arm = [&](double own) {
    return Arm{24 + 10 * turn_sine(own), 74 + 18 * turn_sine(own + 0.2),
               12 + 6 * turn_sine(2 * own), 6};
  };
  return lively(walker, trunk, arm(at), arm(at + 0.15));
}

Figure point_out(const Walker& walker, double at) {
  Trunk trunk;
  trunk.chest_yaw = 0.05 * turn_sine(at);
  trunk.head_yaw = trunk.chest_yaw;
  return lively(walker, trunk,
                {90 + 4 * turn_sine(at), 5 + 3 * turn_sine(2 * at), 4, 0, 8 + 12 * turn_sine(at)},
                hanging(walker));
}

Figure wave_hand(const Walker& walker, double at) {
  Trunk trunk;
  trunk.head_down = -5 * kDegree;
  trunk.tilt = 0.02 * turn_sine(at);
  return lively(walker, trunk, {150, 34, 12, 0, 12 + 20 * turn_sine(at)}, hanging(walker));
}

Figure clap(const Walker& walker, double at) {
  Trunk trunk;
  trunk.lean = 2 * kDegree;
  const Arm arm{42, 84, 8, 36 + 13 * turn_sine(at)};
  return lively(walker, trunk, arm, arm);
}

Figure arms_up(const Walker& walker, double at) {
  Trunk trunk;
  trunk.lean = -5 * kDegree;
  trunk.head_down = -10 * kDegree;
  trunk.tilt = 0.05 * turn_sine(at);
  const double sway = 9 * turn_sine(at);
  const double sign = side_sign(main_hand(walker));
  return lively(walker, trunk, {158, 20, 8, 0, 22 + sign * sway},
                {158, 20, 8, 0, 22 - sign * sway});
}

Figure raise_fist(const Walker& walker, double at) {
  Trunk trunk;
  trunk.lean = -6 * kDegree;
  trunk.head_down = -12 * kDegree;
  return lively(walker, trunk, {154 + 14 * turn_sine(at), 34 - 22 * turn_sine(at), 14, 0, 8},
                hanging(walker), 12 + 6 * turn_sine(at));
}

Figure dance(const Walker& walker, double at) {
  Trunk trunk;
  trunk.hips_yaw = 11 * kDegree * turn_sine(at);
  trunk.chest_yaw = -8 * kDegree * turn_sine(at);
  trunk.tilt = 5 * kDegree * turn_sine(at + 0.1);
  trunk.lean = (4 + 4 * turn_sine(2 * at)) * kDegree;
  trunk.head_yaw = -0.1 * turn_sine(at);
  trunk.head_down = 5 * kDegree * turn_sine(2 * at + 0.2);
  const auto arm = [&](double own) {
    return Arm{38 + 24 * turn_sine(own), 82 + 16 * turn_sine(own + 0.25), 15, 18};
  };
  return upright(walker, trunk, pair_arms(walker, arm(at), arm(at + 0.5)),
                 0.028 * walker.stature_m * turn_sine(at), (24 + 13 * turn_sine(2 * at)) * kDegree);
}

/// Up and down on both feet, as children do.
Figure hop(const Walker& walker, double at) {
  Trunk trunk;
  trunk.lean = 4 * kDegree;
  const double up = std::max(turn_sine(at), 0.0);
  const double down = std::max(-turn_sine(at), 0.0);
  const Arm arm{20 + 45 * up - 20 * down, 60 + 10 * up, 14 + 10 * up, 10};
  Figure figure = lively(walker, trunk, arm, arm, 10 + 34 * down);
  const auto height_m = static_cast<float>(0.075 * up * walker.stature_m);
  figure.pose.shift.z() += height_m;
  for (const Side side : kSides) {
    figure.of(side).ankle.z() += height_m;
    figure.of(side).pitch_rad = figure.of(side).toes_rad = -0.45 * up;
  }
  return figure;
}

struct NamedAct {
  Act act;
  Figure (*figure)(const Walker&, double);
};

// Frequencies are estimates.
const std::array kActs = {
    NamedAct{{"act_pockets", Actions(Action::stand), 2, 8, kAnyAge, 0, {10, 7, 5, 0}}, pockets},
    NamedAct{{"act_crossed", Actions(Action::stand), 2, 10, kAnyAge, 0, {6, 6, 8, 0}},
             arms_crossed},
    NamedAct{{"act_akimbo", Actions(Action::stand), 2, 10, kAnyAge, 0, {3, 3, 3, 1}}, akimbo},
    NamedAct{{"act_behind", Actions(Action::stand), 2, 40, kAnyAge, 0, {5, 3, 2, 0}}, hands_behind},
    NamedAct{{"act_call", Actions(Action::stand, Action::call), 1, 10, kAnyAge, 0, {5, 2, 0, 2}},
             call},
    NamedAct{{"act_film", Actions(Action::stand, Action::film), 2, 9, 75, 0, {2, 2, 8, 2}}, film},
    NamedAct{{"act_film_high", Actions(Action::stand, Action::film), 1, 14, 60, 0, {0, 0, 6, 1}},
             film_high},
    NamedAct{{"act_map", Actions(Action::stand, Action::read), 2, 14, kAnyAge, 0, {2, 2, 0, 0}},
             read_map},
    NamedAct{{"act_squat", Actions(Action::squat), 2, 0, 60, 0, {1.5, 1.5, 0, 0}}, squat},
    NamedAct{{"act_cower", Actions(Action::cower), 2, 0, kAnyAge, 0, {0, 0, 0, 6}}, cower},
    NamedAct{{"act_head", Actions(Action::stand, Action::panic), 2, 0, kAnyAge, 0, {0, 0, 0, 6}},
             hold_head},
    NamedAct{{"act_eat", Actions(Action::stand, Action::eat), 1, 0, kAnyAge, 4.5, {3, 3, 1, 0}},
             eat},
    NamedAct{{"act_drink", Actions(Action::stand, Action::drink), 1, 3, kAnyAge, 7, {3, 4, 4, 0}},
             drink},
    NamedAct{{"act_smoke", Actions(Action::stand, Action::smoke), 1, 18, kAnyAge, 9, {2, 2, 1, 0}},
             smoke},
    NamedAct{{"act_talk", Actions(Action::stand, Action::talk), 1, 4, kAnyAge, 2.6, {0, 14, 2, 0}},
             talk},
    NamedAct{
        {"act_talk_both", Actions(Action::stand, Action::talk), 2, 6, kAnyAge, 2.1, {0, 9, 1, 1}},
        talk_with_both},
    NamedAct{{"act_point", Actions(Action::stand, Action::point), 1, 2, kAnyAge, 3, {0.4, 3, 1, 2}},
             point_out},
    NamedAct{{"act_wave", Actions(Action::stand, Action::wave), 1, 2, kAnyAge, 0.6, {0.6, 1, 2, 2}},
             wave_hand},
    NamedAct{{"act_clap", Actions(Action::stand, Action::clap), 2, 2, kAnyAge, 0.4, {0, 0, 14, 0}},
             clap},
    NamedAct{{"act_arms_up", Actions(Action::stand, Action::cheer), 2, 4, 70, 2.2, {0, 0, 9, 0}},
             arms_up},
    NamedAct{{"act_fist", Actions(Action::stand, Action::cheer), 1, 10, 60, 0.9, {0, 0, 6, 0}},
             raise_fist},
    NamedAct{{"act_dance", Actions(Action::stand, Action::dance), 2, 3, 70, 1, {0, 0.4, 14, 0}},
             dance},
    NamedAct{{"act_hop", Actions(Action::stand, Action::dance), 2, 3, 13, 0.7, {6, 6, 12, 0}}, hop},
};

const std::array<Act, kActs.size()>& bare_acts() {
  static const std::array<Act, kActs.size()> all = [] {
    std::array<Act, kActs.size()> found;
    std::transform(kActs.begin(), kActs.end(), found.begin(),
                   [](const NamedAct& named) { return named.act; });
    return found;
  }();
  return all;
}

}  // namespace

std::span<const Act> acts() { return bare_acts(); }

const Act* find_act(std::string_view clip) {
  for (const Act& act : acts()) {
    if (act.clip == clip) return &act;
  }
  return nullptr;
}

Figure act_figure(const Walker& walker, const Act& act, double raised, double at) {
  const auto found = std::find_if(kActs.begin(), kActs.end(), [&](const NamedAct& named) {
    return named.act.clip == act.clip;
  });
  check(found != kActs.end(), "an act is one of the table");
  const Figure figure = found->figure(walker, at);
  return raised < 1 ? mix(ready(walker), figure, geometry::smoothstep(raised)) : figure;
}

bool is_airborne(const Act& act) { return act.clip == "act_hop"; }

}  // namespace throng::skinning
