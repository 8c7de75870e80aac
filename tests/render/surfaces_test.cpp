// Surface ground truth beyond color: normals, motion, body parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/compute/random.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

const RenderOptions kEverything = {
    .quality = Quality::draft, .normals = true, .flow = true, .parts = true};

Eigen::Vector3d normal_at(const Frame& frame, int x, int y) {
  const std::size_t i = pixel_index(frame, x, y) * 3;
  return (Eigen::Vector3d(frame.normal[i], frame.normal[i + 1], frame.normal[i + 2]).array() -
          128) /
         127;
}

TEST(Surfaces, FlowCarriesEachPersonsMaskToTheNextFrame) {
  Stage stage(open_ground(), {}, kEverything);
  Scene now;
  NeighborFrame next;
  next.camera = camera_at({-9.6, 0.3, 7.1}, 1.5, -34, 960, 720);
  for (std::uint32_t i = 0; i < 12; ++i) {
    Random random(5, Stream::crowd_generator, i);
    const Eigen::Vector2d at(2.5 * (i / 4) - 2, 2.2 * (i % 4) - 3.3);
    const double yaw_rad = random.uniform(-3, 3);
    const double phase = random.uniform();
    const Eigen::Vector2d step(0.13 * std::cos(yaw_rad), 0.13 * std::sin(yaw_rad));
    now.people.push_back(stepping(stage, i, at, yaw_rad, phase));
    next.scene.people.push_back(stepping(stage, i, at + step, yaw_rad + 0.05, phase + 0.1));
  }
  // Looking people up must not depend on their order.
  std::reverse(next.scene.people.begin(), next.scene.people.end());
  const Frame here = stage.renderer().draw(now, camera_at({-10, 0, 7}, 0, -35, 960, 720), &next);
  const Frame there = stage.renderer().draw(next.scene, next.camera);
  int measured = 0;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const auto is_whole = [&](const Frame& frame) {
      return instance_mask(frame, id_of_agent(i)).pixels == find_person(frame, i).amodal_area_px;
    };
    if (!is_whole(here) || !is_whole(there)) continue;
    EXPECT_GE(carried_overlap(here, there, i), 0.9) << "agent " << i;
    ++measured;
  }
  EXPECT_GE(measured, 6);
}

TEST(Surfaces, StillSurfacesMoveWithTheCamera) {
  Stage stage(open_ground({block(2, 4, -1, 1, 3)}), {}, kEverything);
  NeighborFrame next;
  next.camera = camera_at({-9, 1, 6.5}, 8, -28);
  const Frame frame = stage.renderer().draw({}, camera_at({-10, 0, 7}, 0, -25), &next);
  int measured = 0;
  for (int y = 3; y < frame.height(); y += 20) {
    for (int x = 3; x < frame.width(); x += 20) {
      const std::size_t i = pixel_index(frame, x, y);
      const float depth_m = frame.depth_m[i];
      const bool sky = std::isinf(depth_m);
      // A point of the sky is far away.
      const Eigen::Vector3d point = frame.camera.unproject({x, y}, sky ? 1e7 : depth_m);
      const Eigen::Vector2d moved = next.camera.project(point).pixel - Eigen::Vector2d(x, y);
      EXPECT_NEAR(frame.flow[i * 2], moved.x(), 0.02) << x << ' ' << y;
      EXPECT_NEAR(frame.flow[i * 2 + 1], moved.y(), 0.02) << x << ' ' << y;
      ++measured;
    }
  }
  EXPECT_GT(measured, 100);
}

TEST(Surfaces, LeavingPeopleHaveNoFlow) {
  Stage stage(open_ground(), {}, kEverything);
  const camera::Camera camera = camera_at({-6, 0, 3}, 0, -15);
  const Scene now{0, 0, {stage.standing(3, 0, 0)}, {}};
  const NeighborFrame next{{}, camera};
  for (const NeighborFrame* given : {&next, static_cast<const NeighborFrame*>(nullptr)}) {
    const Frame frame = stage.renderer().draw(now, camera, given);
    for (std::size_t i = 0; i < frame.id.size(); ++i) {
      if (is_agent(frame.id[i])) {
        ASSERT_TRUE(std::isnan(frame.flow[i * 2]));
      }
      if (!is_agent(frame.id[i]) && given != nullptr) {
        ASSERT_NEAR(frame.flow[i * 2], 0, 0.01);
      }
    }
  }
}

TEST(Surfaces, NormalsOfPlanesAreTheirs) {
  Stage stage(open_ground({block(2, 4, -1, 1, 3)}), {}, kEverything);
  const Frame frame = stage.renderer().draw({}, camera_at({-5, 0, 6}, 0, -35, 640, 480), nullptr);
  const camera::Camera& camera = frame.camera;
  const auto at = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector2d pixel = camera.project(point).pixel;
    return normal_at(frame, static_cast<int>(std::lround(pixel.x())),
                     static_cast<int>(std::lround(pixel.y())));
  };
  constexpr double kStep = 0.012;
  EXPECT_LT((at({0, 0.5, 0}) - Eigen::Vector3d(0, 0, 1)).norm(), kStep);
  EXPECT_LT((at({2, 0.3, 1.5}) - Eigen::Vector3d(-1, 0, 0)).norm(), kStep) << "the wall";
  EXPECT_LT((at({3, -0.4, 3}) - Eigen::Vector3d(0, 0, 1)).norm(), kStep) << "the roof";
  for (std::size_t i = 0; i < frame.id.size(); ++i) {
    if (std::isinf(frame.depth_m[i])) {
      ASSERT_EQ(frame.normal[i * 3], 0) << "the sky has none";
    }
  }
}

TEST(Surfaces, PeopleHaveNormalsAndPartsOnEveryPixelOfTheirs) {
  Stage stage(open_ground(), {}, kEverything);
  const Frame frame = stage.renderer().draw({0, 0, {stage.standing(1, 0, 0, std::numbers::pi)}, {}},
                                            camera_at({-4, 0, 1.2}, 0, -3, 640, 480), nullptr);
  std::array<int, 10> count{};
  std::array<double, 10> row_sum{};
  std::array<double, 10> column_sum{};
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const std::size_t i = pixel_index(frame, x, y);
      const std::uint8_t part = frame.part[i];
      ASSERT_EQ(part != 0, is_agent(frame.id[i]));
      ++count.at(part);
      row_sum.at(part) += y;
      column_sum.at(part) += x;
      if (part == 0) continue;
      ASSERT_NEAR(normal_at(frame, x, y).norm(), 1, 0.02);
      ASSERT_LT(normal_at(frame, x, y).x(), 0.1) << "what is seen faces the camera";
    }
  }
  const auto of = [](BodyPart part) { return static_cast<std::size_t>(part); };
  const auto row = [&](BodyPart part) { return row_sum[of(part)] / count[of(part)]; };
  const auto column = [&](BodyPart part) { return column_sum[of(part)] / count[of(part)]; };
  for (std::size_t part = of(BodyPart::head); part < of(BodyPart::item); ++part) {
    EXPECT_GT(count[part], 30) << "part " << part;
  }
  EXPECT_LT(row(BodyPart::head), row(BodyPart::torso));
  EXPECT_LT(row(BodyPart::torso), row(BodyPart::left_leg));
  EXPECT_LT(row(BodyPart::left_leg), row(BodyPart::left_foot));
  // Somebody who faces the camera has their left on its right.
  EXPECT_GT(column(BodyPart::left_arm), column(BodyPart::right_arm));
}

TEST(Surfaces, CostNothingAndChangeNothingUnlessAskedFor) {
  Stage with(open_ground(), {}, {.normals = true, .flow = true, .parts = true});
  Stage without(open_ground());
  const camera::Camera camera = camera_at({-6, 0, 3}, 0, -15);
  const Frame asked = with.draw(camera, {with.standing(3, 0, 0)});
  const Frame plain = without.draw(camera, {without.standing(3, 0, 0)});
  EXPECT_EQ(asked.rgb, plain.rgb);
  EXPECT_EQ(asked.id, plain.id);
  EXPECT_TRUE(plain.normal.empty() && plain.flow.empty() && plain.part.empty());
}

}  // namespace
}  // namespace throng::render
