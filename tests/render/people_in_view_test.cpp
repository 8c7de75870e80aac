// People of a scene in view, and those who need textures.
#include "render/people/people_in_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/compute/random.h"
#include "skinning/levels.h"
#include "tests/render/stage.h"

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
    QualitySettings quality = quality_settings(Quality::standard);
    quality.textured_levels = 0;
    quality.people_positions = count;
    return quality;
  }

  std::vector<Seen> seen(std::uint32_t count, int people_positions) const {
    return PeopleFinder(people_, places(people_positions))
        .find(crowd(people_, count), watching(), measured_pixels(watching().intrinsics));
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
  const std::vector<Seen> one =
      finder.find(scene, watching(), measured_pixels(watching().intrinsics));
  std::reverse(scene.people.begin(), scene.people.end());
  const std::vector<Seen> other =
      finder.find(scene, watching(), measured_pixels(watching().intrinsics));
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].truth.agent, other[i].truth.agent);
    EXPECT_EQ(one[i].draw.shading, other[i].draw.shading) << one[i].truth.agent;
  }
}

/// How far the vertices of all levels leave a person's box in space, m, and how far its sides are
/// beyond them. It is measured in the person's pose: distant people are drawn in a frame near it,
/// but boxes in space are the same for all cameras.
struct Misfit {
  double outside_m = 0;
  double loose_m = 0;
};

Misfit measure_misfit(const skinning::Population& people, const PersonInstance& person,
                      const PersonInView& truth) {
  const skinning::Character& character = people.characters[person.appearance.character];
  const skinning::PoseBlend& pose = person.pose;
  const skinning::Palette a = people.palette(person.appearance.character, pose.a);
  const skinning::Palette b = people.palette(person.appearance.character, pose.b);
  const Eigen::AngleAxisd back(-static_cast<double>(truth.yaw_rad), Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd turned(static_cast<double>(person.yaw_rad), Eigen::Vector3d::UnitZ());
  const Eigen::Array3d half = 0.5 * truth.box_size.cast<double>();
  Eigen::Array3d above = Eigen::Array3d::Constant(1e9);  // of the nearest vertex to each side
  Eigen::Array3d below = above;
  Misfit misfit;
  for (std::size_t level = 0; level < character.levels.size(); ++level) {
    if (level >= skinning::kDrawnLevels) break;  // casts shadows only
    const skinning::Mesh& mesh = character.levels[level];
    for (const skinning::Part& part : select_parts(character, mesh, Share::body)) {
      for (std::uint32_t i = 0; i < part.index_count; ++i) {
        const skinning::Vertex& vertex = mesh.vertices[mesh.indices[part.first_index + i]];
        Eigen::Vector3d model = Eigen::Vector3d::Zero();
        for (std::size_t k = 0; k < vertex.weights.size(); ++k) {
          const Eigen::Matrix<double, 3, 4> bone =
              (1 - static_cast<double>(pose.blend)) * a[vertex.bones[k]].cast<double>() +
              static_cast<double>(pose.blend) * b[vertex.bones[k]].cast<double>();
          const Eigen::Vector3d rest = Eigen::Vector3f(vertex.position.data()).cast<double>();
          model += vertex.weights[k] / 255.0 * (bone * rest.homogeneous());
        }
        model.z() = std::max(model.z(), 0.002);
        const Eigen::Vector3d world = person.position.cast<double>() + turned * model;
        const Eigen::Array3d off = (back * (world - truth.box_middle.cast<double>())).array();
        misfit.outside_m = std::max(misfit.outside_m, (off.abs() - half).maxCoeff());
        above = above.min(half - off);
        below = below.min(half + off);
      }
    }
  }
  misfit.loose_m = std::max(above.maxCoeff(), below.maxCoeff());
  return misfit;
}

/// Boxes of many poses, between frames and between motions.
void expect_boxes_fit(const skinning::Population& people) {
  const PeopleFinder finder(people, quality_settings(Quality::standard));
  std::uint64_t draws = 0;
  for (std::uint32_t i = 0; i < 300; ++i) {
    Random random(9, Stream::crowd_generator, i);
    PersonInstance person = standing(people, i, 4 + 60 * random.uniform(), 0);
    person.appearance.character = i % static_cast<std::uint32_t>(people.characters.size());
    person.yaw_rad = static_cast<float>(random.uniform(-3, 3));
    const auto palettes = static_cast<double>(people.palettes_per_character - 1);
    person.pose.a = static_cast<std::uint32_t>(random.uniform(0, palettes));
    person.pose.b =
        i % 3 == 0 ? static_cast<std::uint32_t>(random.uniform(0, palettes)) : person.pose.a + 1;
    person.pose.blend = i % 5 == 0 ? 0 : static_cast<float>(random.uniform());
    Scene scene;
    scene.people = {person};
    const camera::Camera above = camera_at({0, 0, 6}, 0, -20, 1280, 960, 90);
    for (const Seen& seen : finder.find(scene, above, measured_pixels(above.intrinsics))) {
      const Misfit misfit = measure_misfit(people, person, seen.truth);
      EXPECT_LT(misfit.outside_m, 1e-4) << i;
      EXPECT_LT(misfit.loose_m, 1.2e-3) << i;
      ++draws;
    }
  }
  EXPECT_GT(draws, 200U);
}

TEST(BoxesInTheWorld, HoldAllThatIsRenderedOfABody) { expect_boxes_fit(synthetic_people()); }

TEST(BoxesInTheWorld, HoldAllThatIsRenderedOfRealPeople) {
  const std::filesystem::path folder = skinning::population_folder();
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no people in " << folder;
  expect_boxes_fit(skinning::load_population(folder));
}

}  // namespace
}  // namespace throng::render
