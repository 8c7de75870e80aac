#include "render/animator.h"
#include "base/geometry/angle.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/render/stage.h"

namespace throng::render {
namespace {

/// Agent 0 walks along +x at 1.5 m/s, agent 1 turns on the spot from 170 to -170 degrees in the
/// first step and stays, agent 2 is the disaster.
world::Trace made_trace() {
  world::Trace trace;
  trace.header.dt_s = 0.1;
  trace.header.seed = 5;
  trace.header.role = {world::AgentRole::person, world::AgentRole::person,
                       world::AgentRole::disaster};
  trace.header.radius_m = {0.3F, 0.3F, 2.0F};
  for (int step = 0; step < 51; ++step) {
    const auto time = static_cast<float>(0.1 * step);
    trace.time_s.push_back(0.1 * step);
    for (const Eigen::Vector2f& p :
         {Eigen::Vector2f(1.5F * time, 2), Eigen::Vector2f(4, 4), Eigen::Vector2f(9, 9)}) {
      trace.position.push_back(p);
    }
    for (const Eigen::Vector2f& v :
         {Eigen::Vector2f(1.5F, 0), Eigen::Vector2f(0, 0), Eigen::Vector2f(1, 1)}) {
      trace.velocity.push_back(v);
    }
    const auto turned = static_cast<float>((step == 0 ? 170 : -170) * kDegree);
    for (const float yaw : {0.0F, turned, 0.0F}) trace.yaw_rad.push_back(yaw);
    trace.flags.insert(trace.flags.end(), 3, world::kPresent);
  }
  return trace;
}

class AnimatorTest : public testing::Test {
 protected:
  skinning::Population people_ = synthetic_people();
  world::Trace trace_ = made_trace();
  Animator animator_{trace_, people_};
};

TEST_F(AnimatorTest, PositionsAreInterpolatedBetweenSteps) {
  const Scene scene = animator_.scene_at(2.345, 17);
  EXPECT_EQ(scene.index, 17);
  EXPECT_EQ(scene.time_s, 2.345);
  EXPECT_NEAR(scene.people[0].position.x(), 1.5 * 2.345, 1e-5);
  EXPECT_NEAR(scene.people[0].position.y(), 2, 1e-6);
}

TEST_F(AnimatorTest, AnAttackerIsSeenAsAPerson) {
  trace_.header.role[2] = world::AgentRole::attacker;
  const Scene scene = Animator(trace_, people_).scene_at(1, 0);
  ASSERT_EQ(scene.people.size(), 3U);
  EXPECT_EQ(scene.people[2].agent, 2U);
  EXPECT_TRUE(scene.dangers.empty());
}

TEST_F(AnimatorTest, TheDisasterIsNotAPerson) {
  const Scene scene = animator_.scene_at(1, 0);
  ASSERT_EQ(scene.people.size(), 2U);
  EXPECT_EQ(scene.people[0].agent, 0U);
  EXPECT_EQ(scene.people[1].agent, 1U);
}

TEST_F(AnimatorTest, PeopleBeforeArrivalAndAfterLeavingAreAbsent) {
  for (std::size_t step = 0; step < trace_.steps(); ++step) {
    if (step < 10 || step > 20) trace_.flags[trace_.at(step, 0)] = 0;
  }
  EXPECT_EQ(animator_.scene_at(0.95, 0).people.size(), 1U);
  EXPECT_EQ(animator_.scene_at(1.05, 0).people.size(), 2U);
  EXPECT_EQ(animator_.scene_at(2.05, 0).people.size(), 2U);
  EXPECT_EQ(animator_.scene_at(2.15, 0).people.size(), 1U);
}

TEST_F(AnimatorTest, HeadingsTurnTheShortWay) {
  const float yaw = animator_.scene_at(0.05, 0).people[1].yaw_rad;
  EXPECT_NEAR(std::cos(yaw), -1, 1e-5);
}

TEST_F(AnimatorTest, TimesOutsideTheTraceAreClamped) {
  EXPECT_NEAR(animator_.scene_at(-3, 0).people[0].position.x(), 0, 1e-6);
  EXPECT_NEAR(animator_.scene_at(99, 0).people[0].position.x(), 7.5, 1e-5);
}

TEST_F(AnimatorTest, IsAFunctionOfTimeAlone) {
  const Scene first = animator_.scene_at(3.21, 0);
  animator_.scene_at(0.5, 1);
  const Animator other(trace_, people_);
  for (const Scene& again : {animator_.scene_at(3.21, 0), other.scene_at(3.21, 0)}) {
    for (std::size_t i = 0; i < first.people.size(); ++i) {
      EXPECT_EQ(first.people[i].position, again.people[i].position);
      EXPECT_EQ(first.people[i].pose.a, again.people[i].pose.a);
      EXPECT_EQ(first.people[i].pose.b, again.people[i].pose.b);
      EXPECT_EQ(first.people[i].pose.blend, again.people[i].pose.blend);
    }
  }
}

TEST_F(AnimatorTest, FramesCanBeAskedForInAnyOrder) {
  std::vector<Scene> in_order;
  for (int frame = 0; frame < 60; ++frame) in_order.push_back(animator_.scene_at(frame / 12.0, 0));
  const Animator other(trace_, people_);
  for (int i = 0; i < 60; ++i) {
    const int frame = (i * 37) % 60;
    const Scene scene = other.scene_at(frame / 12.0, 0);
    ASSERT_EQ(scene.people.size(), in_order[frame].people.size());
    for (std::size_t k = 0; k < scene.people.size(); ++k) {
      EXPECT_EQ(scene.people[k].pose.a, in_order[frame].people[k].pose.a);
      EXPECT_EQ(scene.people[k].pose.b, in_order[frame].people[k].pose.b);
      EXPECT_EQ(scene.people[k].pose.blend, in_order[frame].people[k].pose.blend);
    }
  }
}

TEST_F(AnimatorTest, ReturningPeopleHaveAPlanForEachStay) {
  for (std::size_t step = 20; step < 30; ++step) trace_.flags[trace_.at(step, 0)] = 0;
  trace_.position[trace_.at(20, 0)] = {1e6F, 1e6F};  // where somebody is who is not there
  const Animator animator(trace_, people_);
  EXPECT_EQ(animator.scene_at(1.95, 0).people.size(), 2U);
  EXPECT_LT(animator.scene_at(1.95, 0).people[0].position.x(), 4);
  EXPECT_EQ(animator.scene_at(2.5, 0).people.size(), 1U);
  EXPECT_EQ(animator.scene_at(3.5, 0).people.size(), 2U);
}

class AnimatorWithClipsTest : public AnimatorTest {
 protected:
  /// As character library have them, each of one frame.
  void add_clip(const char* name, std::uint32_t frames) {
    people_.clips.push_back({name, 0, people_.palettes_per_character, frames, 0, 0, false});
    people_.palettes_per_character += frames;
    const skinning::Palette palette = people_.palettes[0];
    while (people_.palettes.size() < people_.characters.size() * people_.palettes_per_character) {
      people_.palettes.push_back(palette);
    }
  }
  std::string find_clip(const Animator& animator, double time_s, std::size_t person) {
    const std::uint32_t palette = animator.scene_at(time_s, 0).people[person].pose.a;
    std::string name;
    for (const skinning::Clip& clip : people_.clips) {
      if (clip.first <= palette) name = clip.name;
    }
    return name;
  }
};

TEST_F(AnimatorWithClipsTest, TheTracesFlagMakesPeopleLie) {
  add_clip("fall_forwards", 4);
  add_clip("fall_backwards", 4);
  for (std::size_t step = 20; step < trace_.steps(); ++step) {
    trace_.flags[trace_.at(step, 1)] |= world::kFallen;
  }
  const Animator animator(trace_, people_);
  EXPECT_EQ(find_clip(animator, 1.0, 1), "idle");
  EXPECT_EQ(find_clip(animator, 4.5, 1).substr(0, 4), "fall");
  EXPECT_EQ(find_clip(animator, 4.5, 0), "walk");
}

TEST_F(AnimatorWithClipsTest, SomeLookUpAtADroneThatIsNearAndHigh) {
  add_clip("look_up", 9);
  const auto lookers = [&](const Eigen::Vector3d& drone) {
    // Forty people who stand for a minute, facing +x.
    trace_ = {};
    trace_.header.dt_s = 0.5;
    trace_.header.role.assign(40, world::AgentRole::person);
    for (int step = 0; step <= 120; ++step) trace_.time_s.push_back(0.5 * step);
    const std::size_t all = 40 * trace_.time_s.size();
    trace_.position.assign(all, Eigen::Vector2f::Zero());
    trace_.velocity.assign(all, Eigen::Vector2f::Zero());
    trace_.yaw_rad.assign(all, 0);
    trace_.flags.assign(all, world::kPresent);
    world::DroneSample sample;
    sample.position = drone;
    trace_.drones = {{sample}};
    const Animator animator(trace_, people_);
    int count = 0;
    for (double time = 0.3; time < 60; time += 3) {
      for (std::size_t person = 0; person < 40; ++person) {
        count += find_clip(animator, time, person) == "look_up" ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_GT(lookers({10, 0, 15}), 40);
  EXPECT_EQ(lookers({200, 0, 15}), 0) << "too far";
  EXPECT_EQ(lookers({10, 0, 2}), 0) << "too low";
  EXPECT_EQ(lookers({-20, 0, 15}), 0) << "behind";
}

TEST_F(AnimatorTest, WalkingPeopleStride) {
  const skinning::PoseBlend before = animator_.scene_at(1.0, 0).people[0].pose;
  const skinning::PoseBlend after = animator_.scene_at(1.3, 0).people[0].pose;
  EXPECT_TRUE(before.a != after.a || before.b != after.b);
  EXPECT_GE(before.a, people_.clips[1].first) << "not the idle clip";
}

}  // namespace
}  // namespace throng::render
