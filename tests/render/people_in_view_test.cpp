// People of a scene in view, and those who need textures.
#include "render/people/people_in_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stage.h"

namespace throng::render {
namespace {

camera::Camera watching() { return camera_at({0, 0, 20}, 0, -45, 1280, 720, 60); }

/// Rows of people ahead of the camera, one behind the other.
Scene crowd(const skinning::Population& people, std::uint32_t count) {
  Scene scene;
  for (std::uint32_t i = 0; i < count; ++i) {
    scene.people.push_back(
        standing(people, i, 16 + 0.4 * (i % 40), 0.5 * std::floor(i / 40.0) - 3));
  }
  return scene;
}

std::size_t with(const std::vector<Seen>& seen, Shading shading) {
  std::size_t count = 0;
  for (const Seen& person : seen) count += person.draw.shading == shading ? 1U : 0U;
  return count;
}

class Textures : public ::testing::Test {
 protected:
  static QualitySettings places(int count) {
    QualitySettings quality = settings_of(Quality::standard);
    quality.textured_levels = 0;
    quality.people_places = count;
    return quality;
  }

  std::vector<Seen> seen(std::uint32_t count, int people_places) const {
    return PeopleFinder(people_, places(people_places)).find(crowd(people_, count), watching());
  }

  skinning::Population people_ = synthetic_people();
};

TEST_F(Textures, AreForAllOfASmallCrowd) {
  const std::vector<Seen> found = seen(100, 200);
  EXPECT_EQ(found.size(), 100U);
  EXPECT_EQ(with(found, Shading::lit_by_corners), 100U);
}

TEST_F(Textures, AreForTheNearestOfALargerOne) {
  const std::vector<Seen> found = seen(160, 200);
  EXPECT_EQ(with(found, Shading::lit_by_corners), 40U);
  float max_textured = 0;
  float nearest_plain = 1e9F;
  for (const Seen& person : found) {
    if (person.draw.shading == Shading::lit_by_corners) {
      max_textured = std::max(max_textured, person.draw.depth_m);
    } else {
      nearest_plain = std::min(nearest_plain, person.draw.depth_m);
    }
  }
  EXPECT_LE(max_textured, nearest_plain);
}

TEST_F(Textures, AreForNobodyInACrush) {
  EXPECT_EQ(with(seen(250, 200), Shading::by_corners), 250U);
}

TEST_F(Textures, DoNotHangOnTheOrderOfThePeople) {
  Scene scene = crowd(people_, 160);
  const PeopleFinder finder(people_, places(200));
  const std::vector<Seen> one = finder.find(scene, watching());
  std::reverse(scene.people.begin(), scene.people.end());
  const std::vector<Seen> other = finder.find(scene, watching());
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].truth.agent, other[i].truth.agent);
    EXPECT_EQ(one[i].draw.shading, other[i].draw.shading) << one[i].truth.agent;
  }
}

}  // namespace
}  // namespace throng::render
