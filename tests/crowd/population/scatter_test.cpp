// People placed at random: where they may stand, and that every seed places them differently.
#include "crowd/population/scatter.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using Eigen::Vector2f;

float min_distance(const std::vector<Vector2f>& places) {
  float nearest = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      nearest = std::min(nearest, (places[i] - places[j]).norm());
    }
  }
  return nearest;
}

std::vector<Vector2f> rectangle(float x0, float y0, float x1, float y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(Scatter, KeepsPeopleApartInTheAreaAndOutOfWalls) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed, Stream::crowd_generator);
    Obstacles walls;
    for (int i = 0; i < 6; ++i) {
      const auto x = static_cast<float>(random.uniform(-9, 8));
      const auto y = static_cast<float>(random.uniform(-9, 8));
      walls.add_polygon(rectangle(x, y, x + 1.5F, y + 1), 1);
    }
    walls.build();
    ScatterSpec spec;
    spec.area = {{-10, -10}, {10, -8}, {0, 0}, {8, 10}, {-9, 9}};  // with a bight
    spec.count = 200;
    spec.apart_m = static_cast<float>(random.uniform(0.3, 0.6));
    const auto places = scatter(spec, walls, {}, Random(seed, Stream::crowd_generator, 7));
    ASSERT_EQ(places.size(), spec.count);
    EXPECT_GE(min_distance(places), spec.apart_m);
    Obstacles area;
    area.add_polygon(spec.area, 1);
    std::vector<Obstacles::Near> near;
    for (const Vector2f& place : places) {
      EXPECT_TRUE(area.encloses(area.polygons().front(), place)) << place.transpose();
      EXPECT_FALSE(walls.is_solid(place, 1)) << place.transpose();
      walls.near(place, spec.clearance_m, 1, near);
      EXPECT_TRUE(near.empty()) << place.transpose();
    }
  }
}

TEST(Scatter, IsEvenAndInNoOrder) {
  ScatterSpec spec;
  spec.area = rectangle(0, 0, 40, 40);
  spec.count = 4000;  // 2.5 per m^2
  spec.apart_m = 0.45F;
  const auto places = scatter(spec, {}, {}, Random(3, Stream::crowd_generator));
  ASSERT_EQ(places.size(), spec.count);
  // As many in each of 16 parts, and nobody in rank and file: a lattice 40 m / sqrt(4000) wide
  // would have every x at a few phases of it.
  std::array<int, 16> parts{};
  double along = 0;
  for (const Vector2f& place : places) {
    ++parts[static_cast<std::size_t>(place.x() / 10) +
            4 * static_cast<std::size_t>(place.y() / 10)];
    along += std::cos(2 * std::numbers::pi * place.x() / 0.6325);
  }
  EXPECT_THAT(parts, ::testing::Each(::testing::AllOf(::testing::Gt(215), ::testing::Lt(285))));
  EXPECT_LT(std::abs(along) / 4000, 0.06);
}

TEST(Scatter, LeavesRoomForPresentAgents) {
  const std::vector<Vector2f> taken = {{2, 2}, {3, 2.5}, {-5, 0}};
  ScatterSpec spec;
  spec.area = rectangle(0, 0, 4, 4);
  spec.count = 12;
  spec.apart_m = 0.7F;
  std::vector<Vector2f> all = scatter(spec, {}, taken, Random(1, Stream::crowd_generator));
  ASSERT_EQ(all.size(), 12U);
  all.insert(all.end(), taken.begin(), taken.end());
  EXPECT_GE(min_distance(all), 0.7F);
}

TEST(Scatter, EndsWhereThereIsNoRoom) {
  ScatterSpec spec;
  spec.area = rectangle(0, 0, 10, 10);
  spec.count = 100'000;
  spec.apart_m = 1;
  const std::size_t found = scatter(spec, {}, {}, Random(1, Stream::crowd_generator)).size();
  // Discs of 0.785 m^2 in 100 m^2 and a margin half as wide as one: 0.547 of 121 m^2 at the most.
  EXPECT_GT(found, 55U);
  EXPECT_LT(found, 84U);
}

const char* const kOneHut =
    R"(<ObstacleSet type="explicit" class="1"><Obstacle closed="1"><Vertex p_x="-1" p_y="-1"/>
       <Vertex p_x="1" p_y="-1"/><Vertex p_x="1" p_y="1"/><Vertex p_x="-1" p_y="1"/></Obstacle></ObstacleSet>)";

std::string scatter_scene(const std::string& attributes) {
  return fmt::format(R"(<Experiment version="2.0"><SpatialQuery type="kd-tree"/><Common/>
    <AgentProfile name="a"/><AgentGroup><ProfileSelector type="const" name="a"/>
    <StateSelector type="const" name="Start"/>
    <Generator type="explicit"><Agent p_x="2" p_y="2"/></Generator>
    <Generator type="scatter" {}>
      <Vertex p_x="-3" p_y="-3"/><Vertex p_x="3" p_y="-3"/><Vertex p_x="3" p_y="3"/><Vertex p_x="-3" p_y="3"/>
    </Generator></AgentGroup>{}</Experiment>)",
                     attributes, kOneHut);
}

std::vector<Vector2f> scattered(const std::string& attributes, std::uint64_t seed) {
  LoadOptions options;
  options.seed = seed;
  const Simulation crowd = test::load(scatter_scene(attributes), test::mirror_behavior(), options);
  return {crowd.positions().begin(), crowd.positions().end()};
}

TEST(ScatterGenerator, DrawsFreePlacesAnewForEverySeed) {
  const auto places = scattered(R"(count="30" apart="0.6" clearance="0.4")", 5);
  ASSERT_EQ(places.size(), 31U);
  EXPECT_GE(min_distance(places), 0.6F) << "nor too near to who was listed before";
  for (const Vector2f& place : places) {
    EXPECT_GE((place.cwiseAbs() - place.cwiseAbs().cwiseMin(1)).norm(), 0.4F);
  }
  EXPECT_EQ(places, scattered(R"(count="30" apart="0.6" clearance="0.4")", 5));
  EXPECT_NE(places, scattered(R"(count="30" apart="0.6" clearance="0.4")", 6));
}

TEST(ScatterGenerator, MindsTheWallsOfItsClassesOnly) {
  const auto in_the_box = [](const std::vector<Vector2f>& places) {
    return std::count_if(places.begin(), places.end(),
                         [](const Vector2f& place) { return place.cwiseAbs().maxCoeff() < 1; });
  };
  EXPECT_EQ(in_the_box(scattered(R"(count="40" obstacleSet="1")", 1)), 0);
  EXPECT_GT(in_the_box(scattered(R"(count="40" obstacleSet="2")", 1)), 0);
}

TEST(ScatterGenerator, DrawsAgainWhereTheFirstStoodInTheWay) {
  // About the hut there is room for five only if the first of them stand well: every other draw.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(scattered(R"(count="5" apart="2.6" clearance="0.2")", seed).size(), 6U) << seed;
  }
}

TEST(ScatterGenerator, SaysForHowManyThereIsRoom) {
  try {
    scattered(R"(count="500" apart="1")", 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("count"));
    EXPECT_THAT(error.what(), ::testing::ContainsRegex("500.*room: [0-9]+ people"));
  }
}

}  // namespace
}  // namespace throng::crowd
