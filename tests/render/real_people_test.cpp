// The baked population, where it has been built.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/render/stage.h"

namespace throng::render {
namespace {

TEST(RealPeople, AreDrawnWithTightBoxesAndExactAreas) {
  const std::filesystem::path folder = skinning::population_folder();
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no people in " << folder;
  const skinning::Population people = skinning::load_population(folder);
  const world::Scenario scenario = open_ground();
  Renderer renderer(scenario, people, {}, {"software"});
  Scene scene;
  // As many as the camera sees.
  const auto count =
      static_cast<std::uint32_t>(std::min<std::size_t>(people.characters.size(), 24));
  for (std::uint32_t i = 0; i < count; ++i) {
    PersonInstance person = standing(people, i, 1.5 * (i % 4), 1.5 * (i / 4));
    person.appearance = skinning::sample_appearance(people, 1, i);
    person.appearance.character = i;
    person.pose = skinning::pose_at(people, 0.1 * i, 1.4, 0);
    scene.people.push_back(person);
  }
  const Frame frame = renderer.draw(scene, camera_at({-9, 3.75, 5}, 0, -20, 1280, 960));
  EXPECT_EQ(frame.people.size(), count);
  for (const PersonInView& person : frame.people) {
    EXPECT_GT(person.stature_m, 0.8);
    EXPECT_LT(person.stature_m, 2.3);
    Scene alone;
    alone.people = {scene.people[person.agent]};
    const Frame single = renderer.draw(alone, frame.camera);
    const Mask mask = instance_mask(single, id_of_agent(person.agent));
    EXPECT_GT(mask.pixels, 400U);
    EXPECT_LE(instance_mask(frame, id_of_agent(person.agent)).pixels, person.amodal_area_px);
    if (instance_mask(single, id_of_umbrella(person.agent)).pixels > 0) {
      EXPECT_GT(person.amodal_area_px, mask.pixels);
      continue;
    }
    EXPECT_EQ(person.amodal_area_px, mask.pixels);
    // Hair may be cut out of its cards, so the pixels can stay a little inside the box.
    EXPECT_NEAR(person.amodal_box.min().y(), mask.box.min().y(), 4);
    EXPECT_NEAR(person.amodal_box.max().y(), mask.box.max().y(), 1.1);
    EXPECT_TRUE(person.amodal_box.contains(
        Eigen::Vector2d(frame.camera.project(person.head).pixel.array() + 0.5)));
  }
}

}  // namespace
}  // namespace throng::render
