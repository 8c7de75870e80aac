// Backward flow, flow's occlusion and motion in the world.
#include "render/truth/flow_targets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/lens/lens.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

const RenderOptions kAllMotion = {.quality = Quality::draft,
                                  .flow = true,
                                  .flow_backward = true,
                                  .flow_depth = true,
                                  .scene_flow = true};

Eigen::Vector3f motion_at(const Frame& frame, std::size_t pixel) {
  return {frame.scene_flow_m[3 * pixel], frame.scene_flow_m[3 * pixel + 1],
          frame.scene_flow_m[3 * pixel + 2]};
}

FlowTarget target_at(const Frame& frame, std::size_t pixel) {
  return static_cast<FlowTarget>(frame.flow_target[pixel]);
}

/// A crowd that moves as a whole, stiffly, before and after.
struct StiffWalk {
  Scene now;
  NeighborFrame next;

  StiffWalk(const Stage& stage, const Eigen::Vector2d& step) {
    for (std::uint32_t i = 0; i < 9; ++i) {
      const Eigen::Vector2d at(2.0 * (i / 3) - 2, 1.8 * (i % 3) - 1.8);
      now.people.push_back(stepping(stage, i, at, 0.4 * i, 0.1 * i));
      next.scene.people.push_back(stepping(stage, i, at + step, 0.4 * i, 0.1 * i));
    }
  }
};

TEST(SceneFlow, IsTheStepOfWhoeverMovesStifflyAndZeroForTheGround) {
  Stage stage(open_ground({block(3, 5, -1, 1, 2)}), {}, kAllMotion);
  StiffWalk walk(stage, {0.2, -0.15});
  walk.next.camera = camera_at({-9.6, 0.3, 7.1}, 1.5, -34, 960, 720);
  const Frame frame =
      stage.renderer().draw(walk.now, camera_at({-10, 0, 7}, 0, -35, 960, 720), &walk.next);
  std::size_t people = 0;
  for (std::size_t i = 0; i < frame.id.size(); ++i) {
    if (std::isinf(frame.depth_m[i])) {
      ASSERT_TRUE(std::isnan(frame.scene_flow_m[3 * i])) << "sky";
    } else if (is_agent(frame.id[i])) {
      ASSERT_LT((motion_at(frame, i) - Eigen::Vector3f(0.2F, -0.15F, 0)).norm(), 0.002) << i;
      ++people;
    } else {
      ASSERT_EQ(motion_at(frame, i).norm(), 0) << i;
    }
  }
  EXPECT_GT(people, 5000U);
}

TEST(SceneFlow, ThroughALensIsTheSameMotion) {
  Stage stage(open_ground(), {}, kAllMotion);
  Lens lens(stage.renderer(), stage.people());
  StiffWalk walk(stage, {0.2, -0.15});
  camera::Camera camera = camera_at({-8, 0, 5}, 0, -35, 640, 480);
  camera.intrinsics.distortion =
      camera::Distortion(camera::Distortion::Model::brown_conrady, {-0.2, 0.04});
  walk.next.camera = camera;
  const Frame frame = lens.draw(walk.now, camera, &walk.next);
  std::size_t people = 0;
  for (std::size_t i = 0; i < frame.id.size(); ++i) {
    if (!is_agent(frame.id[i])) continue;
    ASSERT_LT((motion_at(frame, i) - Eigen::Vector3f(0.2F, -0.15F, 0)).norm(), 0.002) << i;
    ++people;
  }
  EXPECT_GT(people, 1000U);
}

TEST(BackwardFlow, UndoesForwardFlowWhereBothFramesShowTheSame) {
  Stage stage(open_ground({block(3, 5, -1, 1, 2)}), {}, kAllMotion);
  StiffWalk walk(stage, {0.2, -0.15});
  const camera::Camera camera = camera_at({-10, 0, 7}, 0, -35, 960, 720);
  walk.next.camera = camera_at({-9.6, 0.3, 7.1}, 1.5, -34, 960, 720);
  Frame now = stage.renderer().draw(walk.now, camera, &walk.next);
  const NeighborFrame previous{walk.now, camera};
  const Frame next =
      stage.renderer().draw(walk.next.scene, walk.next.camera, nullptr, {.previous = &previous});
  now.flow_target = flow_targets(now, next);
  std::size_t visible = 0;
  std::size_t apart = 0;
  std::size_t hidden = 0;
  std::size_t hidden_and_undone = 0;
  for (int y = 0; y < now.height(); ++y) {
    for (int x = 0; x < now.width(); ++x) {
      const std::size_t i = pixel_index(now, x, y);
      if (std::isinf(now.depth_m[i])) continue;
      const float u = static_cast<float>(x) + now.flow[2 * i];
      const float v = static_cast<float>(y) + now.flow[2 * i + 1];
      const bool is_inside = u >= 1 && v >= 1 && u < static_cast<float>(next.width()) - 2 &&
                             v < static_cast<float>(next.height()) - 2;
      if (!is_inside) continue;
      const std::size_t there =
          pixel_index(next, static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v)));
      const Eigen::Vector2f sum(now.flow[2 * i] + next.flow_backward[2 * there],
                                now.flow[2 * i + 1] + next.flow_backward[2 * there + 1]);
      const bool is_undone = sum.norm() < 1.0;
      if (target_at(now, i) == FlowTarget::visible) {
        ++visible;
        apart += is_undone ? 0 : 1;
      } else if (target_at(now, i) == FlowTarget::hidden) {
        ++hidden;
        hidden_and_undone += is_undone ? 1 : 0;
      }
    }
  }
  EXPECT_GT(visible, 500000U);
  EXPECT_LT(static_cast<double>(apart), 0.005 * static_cast<double>(visible));
  EXPECT_GT(hidden, 500U);
  EXPECT_LT(static_cast<double>(hidden_and_undone), 0.1 * static_cast<double>(hidden));
}

TEST(FlowTargets, OfAFrameThatIsRepeatedAreVisible) {
  Stage stage(open_ground({block(3, 5, -1, 1, 2)}), {}, kAllMotion);
  StiffWalk walk(stage, {0, 0});
  walk.next.camera = camera_at({-10, 0, 3}, 0, -10, 640, 480);
  const Frame frame = stage.renderer().draw(walk.now, walk.next.camera, &walk.next);
  for (const std::uint8_t target : flow_targets(frame, frame)) {
    ASSERT_EQ(static_cast<FlowTarget>(target), FlowTarget::visible);
  }
}

TEST(FlowTargets, MarkPointsThatGetHiddenOrLeaveTheImage) {
  Stage stage(open_ground({block(0, 0.5, -3, 0, 3)}), {}, kAllMotion);
  const camera::Camera camera = camera_at({-8, 0, 2}, 0, -5, 640, 480);
  Scene now{0, 0, {stage.standing(1, 4, 1.5), stage.standing(2, -2, 1.5)}, {}};
  NeighborFrame next{{0, 0, {stage.standing(1, 4, -1.5), stage.standing(2, -2, 8)}, {}}, camera};
  Frame frame = stage.renderer().draw(now, camera, &next);
  frame.flow_target = flow_targets(frame, stage.renderer().draw(next.scene, camera));
  for (std::size_t i = 0; i < frame.id.size(); ++i) {
    if (frame.id[i] == id_of_agent(1)) {
      ASSERT_EQ(target_at(frame, i), FlowTarget::hidden);
    }
    if (frame.id[i] == id_of_agent(2)) {
      ASSERT_EQ(target_at(frame, i), FlowTarget::outside);
    }
  }
  EXPECT_GT(instance_mask(frame, id_of_agent(1)).pixels, 100U);
  EXPECT_GT(instance_mask(frame, id_of_agent(2)).pixels, 100U);
}

}  // namespace
}  // namespace throng::render
