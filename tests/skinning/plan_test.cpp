#include "skinning/animate/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "base/geometry/angle.h"
#include "skinning/animate/footsteps.h"
#include "tests/skinning/walkers.h"

namespace throng::skinning {
namespace {

constexpr double kDtS = 0.1;

/// Baked once: an adult and a child.
const Population& two_people() {
  static const Population population = make_population({made_up_walker(1), made_up_walker(0.7F)});
  return population;
}

constexpr float kScale[2] = {1, 0.7F};

Contact worst_contact(const MotionPlan& plan, std::size_t character,
                      std::span<const Moment> moments) {
  Contact worst;
  for (const Side side : kSides) {
    for (const Vertex& mark : made_up_marks(side, kScale[character])) {
      const Contact contact = find_contact(two_people(), character, plan, moments, 0,
                                           static_cast<double>(moments.size() - 1), mark);
      worst.slide_m = std::max(worst.slide_m, contact.slide_m);
      worst.lowest_m = std::min(worst.lowest_m, contact.lowest_m);
      worst.landings += contact.landings;
    }
  }
  return worst;
}

MotionPlan plan_for(std::span<const Moment> moments, std::uint32_t character = 0,
                    float phase_offset = 0.3F, float amplitude = 1) {
  Appearance appearance;
  appearance.character = character;
  appearance.phase_offset = phase_offset;
  appearance.amplitude = amplitude;
  return {two_people(), appearance, 17, moments, kDtS};
}

/// The plan of one of many people.
MotionPlan plan_person(std::uint64_t key, std::span<const Moment> moments) {
  Appearance appearance;
  appearance.phase_offset = static_cast<float>(std::fmod(0.618 * static_cast<double>(key), 1));
  return {two_people(), appearance, key, moments, kDtS};
}

std::string clip_at(const MotionPlan& plan, double step) {
  const std::uint32_t palette = plan.at(step).a;
  std::string name;
  for (const Clip& clip : two_people().clips) {
    if (clip.first <= palette) name = clip.name;
  }
  return name;
}

std::vector<double> speeds(std::initializer_list<std::pair<int, double>> runs) {
  std::vector<double> all;
  for (const auto& [steps, speed] : runs) all.insert(all.end(), steps, speed);
  return all;
}

/// From rest to `top` and back, within `ramp` steps each.
std::vector<double> there_and_back(double top, int ramp, int cruise) {
  std::vector<double> all(15, 0);
  for (int i = 0; i < ramp; ++i) all.push_back(top * (i + 0.5) / ramp);
  for (int i = 0; i < cruise; ++i) all.push_back(top * (1 + 0.1 * std::sin(0.12 * i)));
  for (int i = 0; i < ramp; ++i) all.push_back(top * (ramp - i - 0.5) / ramp);
  all.insert(all.end(), 25, 0);
  return all;
}

TEST(Plan, FeetDoNotSkateAtAnySpeed) {
  double worst_m = 0;
  for (std::uint32_t character = 0; character < 2; ++character) {
    for (double speed = 0.3; speed <= 4.01; speed += 0.07) {
      for (const float amplitude : {0.88F, 1.0F, 1.13F}) {
        const std::vector<Moment> moments =
            straight_trajectory(std::vector<double>(45, speed), kDtS);
        const MotionPlan plan = plan_for(moments, character, 0.6F, amplitude);
        const Contact contact = worst_contact(plan, character, moments);
        worst_m = std::max(worst_m, contact.slide_m);
        EXPECT_LT(contact.slide_m, 0.015) << speed << " m/s, character " << character;
        EXPECT_GT(contact.lowest_m, -0.02) << speed;
        EXPECT_GT(contact.landings, 6) << speed;
      }
    }
  }
  RecordProperty("worst_slide_mm", static_cast<int>(1000 * worst_m));
}

TEST(Plan, FeetDoNotSkateWhenTheSpeedChanges) {
  for (std::uint32_t character = 0; character < 2; ++character) {
    for (double top = 0.3; top < 4; top += 0.17) {
      const std::vector<Moment> moments =
          straight_trajectory(there_and_back(top, 10, 30 + static_cast<int>(20 * top)), kDtS);
      const MotionPlan plan = plan_for(moments, character, static_cast<float>(0.2 * top));
      EXPECT_LT(worst_contact(plan, character, moments).slide_m, 0.015)
          << top << " m/s, character " << character;
    }
  }
}

TEST(Plan, ActionsAreThoseOfTheMotion) {
  std::vector<Moment> moments =
      straight_trajectory(speeds({{60, 0.0}, {60, 1.3}, {60, 3.2}, {60, 0.0}}), kDtS);
  const MotionPlan plan = plan_for(moments);
  EXPECT_TRUE(plan.actions_at(30).has(Action::stand));
  EXPECT_TRUE(plan.actions_at(90).has(Action::walk));
  EXPECT_EQ(plan.actions_at(150), Actions(Action::run));
  EXPECT_TRUE(plan.actions_at(230).has(Action::stand));
  for (std::size_t step = 100; step < moments.size(); ++step) moments[step].down = true;
  moments.resize(160);
  const MotionPlan falls = plan_for(moments);
  EXPECT_TRUE(falls.actions_at(95).has(Action::walk));
  EXPECT_EQ(falls.actions_at(102), Actions(Action::fall));
  EXPECT_EQ(falls.actions_at(150), Actions(Action::lie));
}

TEST(Plan, StridesFollowThePublishedLaw) {
  // Counts the strikes of the left heel over a long path.
  for (const double speed : {0.5, 0.8, 1.04, 1.32, 1.62, 1.9, 2.5, 3.0, 3.5}) {
    const std::vector<Moment> moments = straight_trajectory(std::vector<double>(600, speed), kDtS);
    const MotionPlan plan = plan_for(moments);
    std::vector<double> strikes;
    bool down = true;
    for (double step = 0; step < 600; step += 0.05) {
      const Eigen::Vector3f heel =
          placed(two_people(), 0, plan, moments, step, made_up_marks(Side::left)[0]);
      const bool now = heel.z() < 0.0005F;
      if (now && !down) strikes.push_back(step);
      down = now;
    }
    const double stride_m =
        (strikes.back() - strikes.front()) * kDtS * speed / static_cast<double>(strikes.size() - 1);
    const double law_m = stride_length_m(speed, 1.8);
    EXPECT_NEAR(stride_m, law_m, 0.05 * law_m) << speed;
  }
}

TEST(Plan, NothingJumps) {
  std::vector<double> trajectory = there_and_back(1.4, 8, 40);
  const std::vector<double> run = there_and_back(3.0, 12, 40);
  trajectory.insert(trajectory.end(), run.begin(), run.end());
  std::vector<Moment> moments = straight_trajectory(trajectory, kDtS);
  // A turn while standing in between.
  for (std::size_t step = 0; step < moments.size(); ++step) {
    const double t = std::clamp((static_cast<double>(step) - 75) / 12, 0.0, 1.0);
    moments[step].yaw_rad = static_cast<float>(0.4 * kDegree * 100 * t);
    moments[step].panicked = step > 140;
  }
  const MotionPlan plan = plan_for(moments);
  const Walker walker = made_up_walker();
  constexpr double kFrame = 1 / 60.0 / kDtS;
  for (const Vertex& vertex : walker.body) {
    Eigen::Vector3f before = placed(two_people(), 0, plan, moments, 0, vertex);
    for (double step = kFrame; step < static_cast<double>(trajectory.size()); step += kFrame) {
      const Eigen::Vector3f now = placed(two_people(), 0, plan, moments, step, vertex);
      const double speed = trajectory[static_cast<std::size_t>(step)];
      // A swinging foot is some three times as fast as the body, hands rise quickly.
      ASSERT_LT((now - before).norm(), (5.0 + 4.5 * speed) / 60)
          << "step " << step << " bone " << int{vertex.bones[0]} << " in " << clip_at(plan, step);
      before = now;
    }
  }
}

TEST(Plan, IsAFunctionOfTheMomentAlone) {
  const std::vector<Moment> moments = straight_trajectory(there_and_back(2.4, 10, 50), kDtS);
  const MotionPlan plan = plan_for(moments);
  std::vector<double> steps;
  for (double step = -2; step < static_cast<double>(moments.size()) + 3; step += 0.37) {
    steps.push_back(step);
  }
  std::vector<PoseBlend> in_order;
  in_order.reserve(steps.size());
  for (const double step : steps) in_order.push_back(plan.at(step));
  std::vector<std::size_t> order(steps.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  const MotionPlan again = plan_for(moments);
  for (const std::size_t i : order) {
    EXPECT_EQ(again.at(steps[i]).a, in_order[i].a);
    EXPECT_EQ(again.at(steps[i]).b, in_order[i].b);
    EXPECT_EQ(again.at(steps[i]).blend, in_order[i].blend);
  }
}

TEST(Plan, StandsWalksRunsAndPanics) {
  std::vector<Moment> moments =
      straight_trajectory(speeds({{30, 0}, {60, 1.3}, {60, 3.0}, {60, 3.0}, {40, 0}}), kDtS);
  for (std::size_t step = 150; step < moments.size(); ++step) moments[step].panicked = true;
  const MotionPlan plan = plan_for(moments);
  EXPECT_NE(clip_at(plan, 10), "walk");
  EXPECT_TRUE(clip_at(plan, 60).starts_with("walk")) << clip_at(plan, 60);
  EXPECT_EQ(clip_at(plan, 120), "run");
  EXPECT_FALSE(clip_at(plan, 240).starts_with("panic"));
  // Everybody flees by clips of one kind, and kinds differ.
  std::map<std::string, int> flights;
  for (std::uint64_t key = 0; key < 200; ++key) ++flights[clip_at(plan_person(key, moments), 180)];
  for (const char* name : {"panic", "panic_cover", "panic_look_back", "run"}) {
    EXPECT_GT(flights[name], 16) << name;
  }
}

TEST(Plan, StoppedPeopleStandOnBothFeet) {
  const std::vector<Moment> moments = straight_trajectory(there_and_back(1.3, 8, 33), kDtS);
  const MotionPlan plan = plan_for(moments);
  for (double step = static_cast<double>(moments.size()) - 15;
       step < static_cast<double>(moments.size()); step += 1) {
    for (const Side side : kSides) {
      for (const Vertex& mark : made_up_marks(side)) {
        EXPECT_LT(placed(two_people(), 0, plan, moments, step, mark).z(), 0.005F);
      }
    }
  }
}

TEST(Plan, TurningOnTheSpotTakesSteps) {
  std::vector<Moment> moments = straight_trajectory(std::vector<double>(200, 0), kDtS);
  for (std::size_t step = 120; step < moments.size(); ++step) {
    const double t = std::clamp((static_cast<double>(step) - 120) / 10, 0.0, 1.0);
    moments[step].yaw_rad = static_cast<float>(-80 * kDegree * t);
  }
  const MotionPlan plan = plan_for(moments);
  EXPECT_EQ(clip_at(plan, 125), "turn_90");
  EXPECT_NE(clip_at(plan, 150), "turn_90");
}

TEST(Plan, FallenPeopleFallLieAndGetUp) {
  std::vector<Moment> moments = straight_trajectory(speeds({{40, 1.5}, {160, 0}}), kDtS);
  for (std::size_t step = 40; step < 120; ++step) moments[step].down = true;
  const MotionPlan plan = plan_for(moments);
  const Vertex head =
      made_up_vertex(made_up_joints()[index_from(Bone::head)], Bone::head, Bone::head, 0);
  const auto height = [&](double step) {
    return placed(two_people(), 0, plan, moments, step, head).z();
  };
  EXPECT_GT(height(38), 1.4F);
  for (double step = 60; step < 95; step += 1) EXPECT_LT(height(step), 0.3F);
  EXPECT_GT(height(160), 1.4F);
  // Down from the first step on: no fall.
  for (Moment& moment : moments) moment.down = true;
  EXPECT_LT(placed(two_people(), 0, plan_for(moments), moments, 0, head).z(), 0.3F);
}

// Flags may change at any step, the last one included. The pose is that of the action, and a person
// is down in action exactly while the flag says so.
TEST(Plan, PoseActionAndFlagChangeTogether) {
  const Vertex head =
      made_up_vertex(made_up_joints()[index_from(Bone::head)], Bone::head, Bone::head, 0);
  const std::size_t last = 99;
  for (const auto& [from, to] : std::vector<std::pair<std::size_t, std::size_t>>{{40, 80},
                                                                                 {40, last},
                                                                                 {40, last + 1},
                                                                                 {90, last + 1},
                                                                                 {last, last + 1},
                                                                                 {0, last},
                                                                                 {0, 50},
                                                                                 {60, 70},
                                                                                 {60, 62},
                                                                                 {97, 99},
                                                                                 {20, 21}}) {
    SCOPED_TRACE(std::to_string(from) + " to " + std::to_string(to));
    std::vector<Moment> moments = straight_trajectory(speeds({{100, 0}}), kDtS);
    moments.resize(last + 1);
    for (std::size_t step = from; step < to; ++step) moments[step].down = true;
    const MotionPlan plan = plan_for(moments);
    float before_m = -1;
    for (double step = 0; step <= static_cast<double>(last); step += 0.25) {
      const Actions actions = plan.actions_at(step);
      const bool is_down =
          actions.has(Action::fall) || actions.has(Action::lie) || actions.has(Action::get_up);
      EXPECT_EQ(is_down, moments[static_cast<std::size_t>(step)].down) << step;
      const float head_m = placed(two_people(), 0, plan, moments, step, head).z();
      EXPECT_LT(head_m, actions.has(Action::lie) ? 0.3F : 2.0F) << step;
      EXPECT_GT(head_m, is_down ? -0.1F : 1.3F) << step;
      const bool is_slow = to - from > 20 || to > last;
      const float moved_m = is_slow && before_m >= 0 ? std::abs(head_m - before_m) : 0;
      EXPECT_LT(moved_m, 0.25F) << step;
      before_m = head_m;
    }
  }
}

TEST(Plan, PeopleLookUpAtDrones) {
  std::vector<Moment> moments = straight_trajectory(speeds({{150, 0}, {100, 1.3}}), kDtS);
  for (std::size_t step = 50; step < 100; ++step) moments[step].gaze = Gaze::left;
  for (std::size_t step = 180; step < 230; ++step) moments[step].gaze = Gaze::ahead;
  const MotionPlan plan = plan_for(moments);
  EXPECT_EQ(clip_at(plan, 75), "look_up_left");
  EXPECT_EQ(clip_at(plan, 210), "walk_look_up");
  EXPECT_NE(clip_at(plan, 130), "look_up_left");
}

TEST(Plan, PeopleDoNotStandInStep) {
  const std::vector<Moment> moments = straight_trajectory(std::vector<double>(600, 0), kDtS);
  std::vector<std::string> seen;
  int look_around = 0;
  for (std::uint64_t key = 0; key < 40; ++key) {
    const MotionPlan plan = plan_person(key, moments);
    for (double step = 0; step < 600; step += 7) {
      seen.push_back(clip_at(plan, step));
      look_around += plan.actions_at(step).has(Action::look_around) ? 1 : 0;
    }
  }
  for (const char* name : {"idle", "idle_left", "idle_right", "phone"}) {
    EXPECT_GT(std::count(seen.begin(), seen.end(), name), 100) << name;
  }
  EXPECT_GT(look_around, 100);
  EXPECT_LT(look_around, static_cast<int>(seen.size()) / 2);
}

/// Mean movement of all joints from one step to another, in meters.
double moved_m(const MotionPlan& plan, std::span<const Moment> moments, double from, double to) {
  double sum = 0;
  const Walker walker = made_up_walker();
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    // Somewhat ahead of the joint, so that turns count.
    const auto named = static_cast<Bone>(bone);
    const Vertex vertex =
        made_up_vertex(walker.joints[bone] + Eigen::Vector3f(0.1F, 0, 0), named, named, 0);
    sum += static_cast<double>((placed(two_people(), 0, plan, moments, to, vertex) -
                                placed(two_people(), 0, plan, moments, from, vertex))
                                   .norm());
  }
  return sum / kBoneCount;
}

// Images of a crowd that stands are worth taking: at no interval do people come back to a pose.
TEST(Plan, StandingPeopleAreNeverTheSameAgain) {
  const std::vector<Moment> moments = straight_trajectory(std::vector<double>(900, 0), kDtS);
  std::vector<MotionPlan> plans;
  for (std::uint64_t key = 0; key < 50; ++key) plans.push_back(plan_person(key, moments));
  for (const double interval_s : {1.0, 2.0, 5.0, 8.0, 10.0, 16.0, 20.0, 30.0, 40.0, 80.0}) {
    std::vector<double> moved;
    for (const MotionPlan& plan : plans) {
      for (double step = 0; step + interval_s / kDtS <= 900; step += 50) {
        moved.push_back(moved_m(plan, moments, step, step + interval_s / kDtS));
      }
    }
    std::sort(moved.begin(), moved.end());
    EXPECT_GT(moved[moved.size() / 2], interval_s < 5 ? 0.008 : 0.016) << interval_s << " s";
    EXPECT_GT(moved[moved.size() / 20], interval_s < 5 ? 0.0008 : 0.002) << interval_s << " s";
  }
}

TEST(Plan, PeopleStandDifferentlyAtTheFirstAndLastStep) {
  const std::vector<Moment> moments = straight_trajectory(std::vector<double>(100, 0), kDtS);
  for (const double step : {0.0, 100.0}) {
    std::set<std::pair<std::uint32_t, int>> poses;
    for (std::uint64_t key = 0; key < 50; ++key) {
      const PoseBlend pose = plan_person(key, moments).at(step);
      poses.insert({pose.a, static_cast<int>(10 * pose.blend)});
    }
    EXPECT_GT(poses.size(), 25U) << step;
  }
}

TEST(Plan, StandingPeopleMoveCalmlyOnFeetThatStay) {
  const std::vector<Moment> moments = straight_trajectory(std::vector<double>(600, 0), kDtS);
  const Walker walker = made_up_walker();
  constexpr double kFrame = 1 / 30.0 / kDtS;
  double worst_m = 0;
  for (std::uint64_t key = 0; key < 12; ++key) {
    const MotionPlan plan = plan_person(key, moments);
    EXPECT_LT(worst_contact(plan, 0, moments).slide_m, 0.008) << key;
    for (const Vertex& vertex : walker.body) {
      Eigen::Vector3f before = placed(two_people(), 0, plan, moments, 0, vertex);
      for (double step = kFrame; step <= 600; step += kFrame) {
        const Eigen::Vector3f now = placed(two_people(), 0, plan, moments, step, vertex);
        const std::string clip = clip_at(plan, step);
        const bool acts = clip == "phone" || clip.starts_with("act_");
        if (!acts) worst_m = std::max<double>(worst_m, (now - before).norm());
        before = now;
      }
    }
  }
  EXPECT_LT(worst_m, 0.02) << "within a thirtieth of a second";
}

TEST(Plan, JostlingIsNoWalk) {
  std::vector<Moment> moments(200);
  for (std::size_t step = 0; step < moments.size(); ++step) {
    moments[step].position = {0.01F * static_cast<float>(step % 2), 0};
  }
  const MotionPlan plan = plan_for(moments);
  for (double step = 0; step < 199; step += 1) EXPECT_NE(clip_at(plan, step), "walk") << step;
}

TEST(Plan, StepsAddUpToTheWay) {
  for (double top = 0.4; top < 3.5; top += 0.13) {
    const std::vector<Moment> moments = straight_trajectory(there_and_back(top, 7, 23), kDtS);
    const Trajectory trajectory(moments, kDtS);
    for (const Stretch& stretch : trajectory.stretches()) {
      if (stretch.activity != Activity::moving) continue;
      const ClipSet clips(two_people());
      const Walk walk = plan_walk(trajectory, stretch, true, true, clips, {});
      ASSERT_FALSE(walk.steps.empty());
      const Footstep& last = walk.steps.back();
      EXPECT_NEAR(last.begin_m + last.length_m,
                  trajectory.distance_m(static_cast<double>(stretch.last)), 1e-4);
      double at_m = trajectory.distance_m(static_cast<double>(stretch.first));
      Side side = walk.steps.front().side;
      for (const Footstep& step : walk.steps) {
        EXPECT_NEAR(step.begin_m, at_m, 1e-4);
        EXPECT_EQ(step.side, side);
        // Stretched by less than what is left over between two clips.
        EXPECT_NEAR(step.length_m, 0.5 * step.clip->stride * 1.75, 0.02);
        at_m += step.length_m;
        side = side == Side::left ? Side::right : Side::left;
      }
    }
  }
}

TEST(Plan, WorksWithFewClipsAndShortStays) {
  Population sparse;
  sparse.characters.resize(1);
  sparse.characters[0].stature_m = 1.8F;
  sparse.clips = {{"idle", 0, 0, 1}, {"walk", 1.3F, 1, 8, 0.8F, 0.25F}};
  sparse.palettes_per_character = 9;
  for (const std::size_t length : {1U, 2U, 3U, 40U}) {
    std::vector<Moment> moments = straight_trajectory(std::vector<double>(length - 1, 2.0), kDtS);
    for (const bool down : {false, true}) {
      for (Moment& moment : moments) {
        moment.down = down;
        moment.panicked = true;
        moment.gaze = Gaze::ahead;
      }
      const MotionPlan plan(sparse, {}, 1, moments, kDtS);
      for (double step = -1; step < static_cast<double>(length) + 1; step += 0.3) {
        EXPECT_LT(plan.at(step).a, 9U);
        EXPECT_LT(plan.at(step).b, 9U);
      }
    }
  }
}

}  // namespace
}  // namespace throng::skinning
