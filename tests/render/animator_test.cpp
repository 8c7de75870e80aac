#include "render/animator.h"

#include <gtest/gtest.h>

#include "stage.h"

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

TEST_F(AnimatorTest, TheDisasterIsNotAPerson) {
  const Scene scene = animator_.scene_at(1, 0);
  ASSERT_EQ(scene.people.size(), 2U);
  EXPECT_EQ(scene.people[0].agent, 0U);
  EXPECT_EQ(scene.people[1].agent, 1U);
}

TEST_F(AnimatorTest, WhoHasNotArrivedOrHasLeftIsNotThere) {
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

TEST_F(AnimatorTest, WhoWalksStrides) {
  const skinning::PoseBlend before = animator_.scene_at(1.0, 0).people[0].pose;
  const skinning::PoseBlend after = animator_.scene_at(1.3, 0).people[0].pose;
  EXPECT_TRUE(before.a != after.a || before.b != after.b);
  EXPECT_GE(before.a, people_.clips[1].first) << "not the idle clip";
}

}  // namespace
}  // namespace throng::render
