// The renderer's ground truth of each person, against the pixels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/compute/random.h"
#include "render/people/person_geometry.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

constexpr double kPixel = 1.0;

/// Somebody in the middle of a step.
PersonInstance walking(const Stage& stage, std::uint32_t agent, double x, double y, double yaw_rad,
                       double phase) {
  PersonInstance person = stage.standing(agent, x, y, yaw_rad);
  const skinning::Clip& walk = stage.people().clips[1];
  const double position = phase * walk.frames;
  const auto frame = static_cast<std::uint32_t>(position);
  person.pose = {walk.first + frame % walk.frames, walk.first + (frame + 1) % walk.frames,
                 static_cast<float>(position - frame)};
  return person;
}

std::vector<PersonInstance> scatter_people(const Stage& stage, std::uint32_t count,
                                           double reach_m) {
  std::vector<PersonInstance> crowd;
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(11, Stream::crowd_generator, i);
    crowd.push_back(walking(stage, i, random.uniform(-reach_m, reach_m),
                            random.uniform(-reach_m, reach_m), random.uniform(-3, 3),
                            random.uniform()));
  }
  return crowd;
}

TEST(GroundTruth, BoxIsTightAroundAnUnoccludedMask) {
  Stage stage(open_ground());
  for (std::uint32_t i = 0; i < 12; ++i) {
    const Frame frame = stage.draw(camera_at({-6, 0, 5}, 0, -35),
                                   {walking(stage, i, 0.1 * i, 0.2 * i - 1, 0.7 * i, i / 12.0)});
    const Mask mask = instance_mask(frame, id_of_agent(i));
    const Eigen::AlignedBox2d& box = find_person(frame, i).amodal_box;
    EXPECT_NEAR(box.min().x(), mask.box.min().x(), kPixel);
    EXPECT_NEAR(box.min().y(), mask.box.min().y(), kPixel);
    EXPECT_NEAR(box.max().x(), mask.box.max().x(), kPixel);
    EXPECT_NEAR(box.max().y(), mask.box.max().y(), kPixel);
    // A pixel belongs to the mask if its middle is covered.
    EXPECT_GE(mask.box.min().x() + 0.5, box.min().x() - 0.02);
    EXPECT_LE(mask.box.max().x() - 0.5, box.max().x() + 0.02);
    EXPECT_GE(mask.box.min().y() + 0.5, box.min().y() - 0.02);
    EXPECT_LE(mask.box.max().y() - 0.5, box.max().y() + 0.02);
  }
}

TEST(GroundTruth, BoxHoldsTheSkinnedVertices) {
  Stage stage(open_ground());
  const PersonInstance person = walking(stage, 0, 1, 0.5, 0.8, 0.3);
  const camera::Camera camera = camera_at({-6, 0, 5}, 0, -35);
  const Frame frame = stage.draw(camera, {person});
  const skinning::Population& people = stage.people();
  Eigen::AlignedBox2d expected;
  for (const skinning::Vertex& vertex : people.characters[0].levels[0].vertices) {
    const Eigen::Vector3d model =
        skinning::skin(vertex, people.palette(0, person.pose.a), people.palette(0, person.pose.b),
                       person.pose.blend)
            .cast<double>();
    const Eigen::Vector3d world =
        person.position.cast<double>() +
        Eigen::AngleAxisd(person.yaw_rad, Eigen::Vector3d::UnitZ()) * model;
    expected.extend(Eigen::Vector2d(camera.project(world).pixel.array() + 0.5));
  }
  const Eigen::AlignedBox2d& box = find_person(frame, 0).amodal_box;
  EXPECT_LT((box.min() - expected.min()).norm(), 0.1);
  EXPECT_LT((box.max() - expected.max()).norm(), 0.1);
}

TEST(GroundTruth, TheMiddleOfTheBodyIsInsideItsBoxFromAnySide) {
  Stage stage(open_ground());
  const std::vector<PersonInstance> crowd = scatter_people(stage, 60, 5);
  for (const double pitch_deg : {-89.0, -60.0, -25.0}) {
    const camera::Camera camera = camera_at({0, 0, 9}, 0.4, pitch_deg);
    for (const PersonInView& person : stage.draw(camera, crowd).people) {
      const Eigen::Vector2d middle = camera.project(person.hips).pixel.array() + 0.5;
      EXPECT_TRUE(person.amodal_box.contains(middle)) << "agent " << person.agent;
    }
  }
}

TEST(GroundTruth, HidingSomebodyLeavesTheirAmodalAreaAsItWas) {
  Stage stage(open_ground({block(-1, 0, -3, 3, 1.2)}));
  const camera::Camera camera = camera_at({-8, 0, 3}, 0, -14);
  const PersonInstance person = stage.standing(5, 4, 0.7, 0.4);
  const std::uint64_t visible_behind_wall =
      instance_mask(stage.draw(camera, {person}), id_of_agent(5)).pixels;

  Stage open(open_ground());
  const Frame alone = open.draw(camera, {person});
  const std::uint64_t all = instance_mask(alone, id_of_agent(5)).pixels;
  EXPECT_EQ(find_person(alone, 5).amodal_area_px, all);

  const Frame behind_wall = stage.draw(camera, {person});
  EXPECT_LT(visible_behind_wall, all);
  EXPECT_EQ(find_person(behind_wall, 5).amodal_area_px, all);

  const Frame behind_somebody = open.draw(camera, {person, open.standing(6, 3, 0.5)});
  EXPECT_LT(instance_mask(behind_somebody, id_of_agent(5)).pixels, all);
  EXPECT_EQ(find_person(behind_somebody, 5).amodal_area_px, all);
  EXPECT_TRUE(
      find_person(behind_somebody, 5).amodal_box.isApprox(find_person(alone, 5).amodal_box, 0));
}

TEST(GroundTruth, SomebodyHiddenWhollyIsStillReported) {
  Stage stage(open_ground({block(0, 1, -6, 6, 5)}));
  const Frame frame = stage.draw(camera_at({-8, 0, 2}, 0, 0), {stage.standing(1, 5, 0)});
  EXPECT_EQ(instance_mask(frame, id_of_agent(1)).pixels, 0U);
  EXPECT_GT(find_person(frame, 1).amodal_area_px, 100U);
}

/// Everybody rendered together, and each alone: the exact figures.
TEST(GroundTruth, AmodalAreaIsTheVisibleAreaWithNobodyElseAround) {
  Stage stage(open_ground());
  const camera::Camera camera = camera_at({-14, 0, 9}, 0, -33);
  const std::vector<PersonInstance> crowd = scatter_people(stage, 60, 4);
  const Frame together = stage.draw(camera, crowd);
  std::size_t hidden = 0;
  for (const PersonInstance& person : crowd) {
    const Frame alone = stage.draw(camera, {person});
    const std::uint64_t all = instance_mask(alone, id_of_agent(person.agent)).pixels;
    const std::uint64_t visible = instance_mask(together, id_of_agent(person.agent)).pixels;
    ASSERT_TRUE(alone.people[0].amodal_box.min().minCoeff() > 1) << "stays inside the image";
    EXPECT_EQ(find_person(together, person.agent).amodal_area_px, all) << "agent " << person.agent;
    EXPECT_LE(visible, all);
    hidden += visible < all ? 1 : 0;
  }
  EXPECT_GT(hidden, 10U) << "the crowd is dense enough to prove anything";
}

TEST(GroundTruth, AmodalAreaCountsPartsOutsideTheImage) {
  Stage stage(open_ground());
  const PersonInstance person = stage.standing(2, 0, 0);
  const camera::Camera whole = camera_at({-5, 0, 1}, 0, 0, 320, 240);
  camera::Camera part = whole;
  part.intrinsics.width = 160;  // the right half of the person is cut off
  const std::uint64_t all = instance_mask(stage.draw(whole, {person}), id_of_agent(2)).pixels;
  const Frame cut = stage.draw(part, {person});
  EXPECT_LT(instance_mask(cut, id_of_agent(2)).pixels, 0.6 * static_cast<double>(all));
  EXPECT_EQ(find_person(cut, 2).amodal_area_px, all);
  EXPECT_GT(find_person(cut, 2).amodal_box.max().x(), 160);
}

TEST(GroundTruth, VisibleNeverExceedsAmodalNorLeavesTheBox) {
  Stage stage(open_ground({block(2, 5, -2, 1, 2)}));
  const std::vector<PersonInstance> crowd = scatter_people(stage, 250, 7);
  for (const camera::Camera& camera :
       {camera_at({-9, 2, 4}, -10, -20), camera_at({0, 0, 12}, 40, -90),
        camera_at({0.3, 0.2, 1.5}, 70, -5)}) {
    const Frame frame = stage.draw(camera, crowd);
    EXPECT_GT(frame.people.size(), 30U);
    for (const PersonInView& person : frame.people) {
      const Mask mask = instance_mask(frame, id_of_agent(person.agent));
      EXPECT_LE(mask.pixels, person.amodal_area_px) << "agent " << person.agent;
      if (mask.pixels == 0) continue;
      EXPECT_GE(mask.box.min().x() + 0.5, person.amodal_box.min().x() - 0.02);
      EXPECT_GE(mask.box.min().y() + 0.5, person.amodal_box.min().y() - 0.02);
      EXPECT_LE(mask.box.max().x() - 0.5, person.amodal_box.max().x() + 0.02);
      EXPECT_LE(mask.box.max().y() - 0.5, person.amodal_box.max().y() + 0.02);
    }
    // And everybody who shows is reported.
    for (const std::uint32_t id : frame.id) {
      if (!is_agent(id)) continue;
      ASSERT_NO_THROW(find_person(frame, agent_of_id(id)));
    }
  }
}

TEST(GroundTruth, PeopleAreOrderedByAgentAndOnlyThoseInView) {
  Stage stage(open_ground());
  const Frame frame =
      stage.draw(camera_at({0, 0, 2}, 0, 0),
                 {stage.standing(9, 6, 1), stage.standing(4, 6, -1), stage.standing(1, -6, 0)});
  std::vector<std::uint32_t> agents;
  for (const PersonInView& person : frame.people) agents.push_back(person.agent);
  EXPECT_THAT(agents, testing::ElementsAre(4, 9));
}

TEST(GroundTruth, HeadIsWhereTheHeadIsDrawn) {
  Stage stage(open_ground());
  const camera::Camera camera = camera_at({4, 0, 1.7}, 180, 0);
  const Frame frame = stage.draw(camera, {stage.standing(3, 0, 0)});
  const PersonInView& person = find_person(frame, 3);
  EXPECT_NEAR(person.head.z(), 0.93 * kSyntheticStatureM, 1e-5);
  const Eigen::Vector2d pixel = camera.project(person.head).pixel;
  EXPECT_EQ(frame.id[pixel_index(frame, static_cast<int>(std::lround(pixel.x())),
                                 static_cast<int>(std::lround(pixel.y())))],
            id_of_agent(3));
  EXPECT_NEAR(person.stature_m, kSyntheticStatureM, 1e-6);
}

TEST(GroundTruth, SomebodyAtTheCameraIsBoundedAndHarmless) {
  Stage stage(open_ground());
  std::vector<PersonInstance> crowd;
  for (std::uint32_t i = 0; i < 8; ++i) {
    crowd.push_back(stage.standing(i, 0.25 * std::cos(i), 0.25 * std::sin(i)));
  }
  crowd.push_back(stage.standing(8, 0, 0));
  for (const double pitch_deg : {-90.0, -30.0, 0.0, 60.0}) {
    const Frame frame = stage.draw(camera_at({0, 0, 1.4}, 20, pitch_deg), crowd);
    for (const PersonInView& person : frame.people) {
      EXPECT_TRUE(person.amodal_box.min().allFinite() && person.amodal_box.max().allFinite());
      EXPECT_LE(person.amodal_box.sizes().x(), 3 * 320);
      EXPECT_LE(person.amodal_box.sizes().y(), 3 * 240);
      EXPECT_LE(instance_mask(frame, id_of_agent(person.agent)).pixels, person.amodal_area_px);
    }
  }
}

}  // namespace
}  // namespace throng::render
