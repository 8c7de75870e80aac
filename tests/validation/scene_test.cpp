// Set-ups: rooms, doors, corridors and where people begin. The oracle is a point-in-polygon test
// and the area by the shoelace formula, with sizes from docs/validation.md.
#include "validation/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "validation/floors.h"
#include "validation/flow.h"
#include "validation/run.h"
#include "validation/walking.h"

namespace throng::validation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;

double signed_area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& a = polygon[i];
    const Vector2d& b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return twice / 2;
}

bool inside(const Polygon& polygon, const Vector2d& p) {
  bool is_inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& a = polygon[i];
    const Vector2d& b = polygon[(i + 1) % polygon.size()];
    const bool crosses = (a.y() > p.y()) != (b.y() > p.y());
    if (crosses && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      is_inside = !is_inside;
    }
  }
  return is_inside;
}

bool blocked(const std::vector<Polygon>& walls, const Vector2d& p) {
  return std::any_of(walls.begin(), walls.end(), [&](const Polygon& w) { return inside(w, p); });
}

double total_area(const std::vector<Polygon>& walls) {
  double sum = 0;
  for (const Polygon& wall : walls) sum += signed_area(wall);
  return sum;
}

std::vector<Vector2d> all_places(const TestScene& scene) {
  std::vector<Vector2d> places;
  for (const Group& group : scene.groups) {
    places.insert(places.end(), group.places.begin(), group.places.end());
  }
  return places;
}

/// People stand in no wall and, with their random displacement, do not overlap much at the start.
void expect_free_places(const TestScene& scene) {
  for (const Vector2d& place : all_places(scene)) {
    EXPECT_FALSE(blocked(scene.walls, place)) << place.transpose();
  }
}

TEST(Box, RunsCounterClockwise) {
  EXPECT_DOUBLE_EQ(signed_area(box(-1, 2, 3, 4.5)), 4 * 2.5);
  const Polygon corners = box(-1, 2, 3, 4);
  EXPECT_EQ(corners.front(), Vector2d(-1, 2));
  EXPECT_EQ(corners.size(), 4);
}

TEST(Lattice, HasPlacesInTheMiddleOfItsCells) {
  const auto places = lattice({10, 0}, {14, 2}, 8);
  ASSERT_EQ(places.size(), 8);
  for (const double x : {10.5, 11.5, 12.5, 13.5}) {
    for (const double y : {0.5, 1.5}) {
      EXPECT_EQ(
          std::count_if(places.begin(), places.end(),
                        [&](const Vector2d& p) { return (p - Vector2d(x, y)).norm() < 1e-9; }),
          1)
          << x << " " << y;
    }
  }
}

TEST(Lattice, KeepsPeopleApartForAnyNumber) {
  for (const std::size_t count : {1U, 2U, 7U, 53U, 150U, 999U}) {
    const auto places = lattice({0, 0}, {10, 9}, count);
    ASSERT_EQ(places.size(), count);
    const double spacing = std::sqrt(90.0 / static_cast<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GT((places[i] - places[j]).norm(), 0.6 * spacing) << count;
      }
    }
  }
}

TEST(Lattice, IsOneRowInAFlatBox) {
  for (const Vector2d& place : lattice({0, 0}, {10, 0.1}, 5)) {
    EXPECT_DOUBLE_EQ(place.y(), 0.05);
  }
}

TEST(Room, IsClosedWithoutDoors) {
  const auto walls = room(8, 5, {});
  EXPECT_NEAR(total_area(walls), 8.4 * 5.4 - 8 * 5, 1e-9) << "walls do not overlap";
  for (double x = -0.19; x < 8.2; x += 0.1) {
    EXPECT_TRUE(blocked(walls, {x, -0.1})) << x;
    EXPECT_TRUE(blocked(walls, {x, 5.1})) << x;
  }
  for (double y = 0.05; y < 5; y += 0.1) {
    EXPECT_TRUE(blocked(walls, {-0.1, y})) << y;
    EXPECT_TRUE(blocked(walls, {8.1, y})) << y;
    EXPECT_FALSE(blocked(walls, {4, y})) << y;
  }
}

TEST(Room, HasDoorsOfTheirWidthAtTheirPositions) {
  const auto walls = room(30, 20,
                          {{Side::left, 15, 1},
                           {Side::left, 5, 1.2},
                           {Side::bottom, 20, 2},
                           {Side::top, 3, 0.9},
                           {Side::right, 10, 0.8}});
  EXPECT_NEAR(total_area(walls), 30.4 * 20.4 - 600 - 0.2 * (1 + 1.2 + 2 + 0.9 + 0.8), 1e-9);
  const auto expect_door = [&](const Vector2d& middle, const Vector2d& along, double width) {
    EXPECT_FALSE(blocked(walls, middle));
    EXPECT_FALSE(blocked(walls, middle + along * (width / 2 - 0.01)));
    EXPECT_FALSE(blocked(walls, middle - along * (width / 2 - 0.01)));
    EXPECT_TRUE(blocked(walls, middle + along * (width / 2 + 0.01)));
    EXPECT_TRUE(blocked(walls, middle - along * (width / 2 + 0.01)));
  };
  expect_door({-0.1, 15}, {0, 1}, 1);
  expect_door({-0.1, 5}, {0, 1}, 1.2);
  expect_door({20, -0.1}, {1, 0}, 2);
  expect_door({3, 20.1}, {1, 0}, 0.9);
  expect_door({30.1, 10}, {0, 1}, 0.8);
}

TEST(RoomWithDoor, IsTheRoomOfTheTable) {
  for (const auto& [width, depth] : {std::pair(0.8, 0.2), std::pair(2.0, 4.0)}) {
    const TestScene scene = room_with_door({width, depth, 150});
    // 10 m x 10 m inside.
    for (const double x : {-9.99, -5.0, -0.01}) {
      for (const double y : {-4.99, 0.0, 4.99}) {
        EXPECT_FALSE(blocked(scene.walls, {x, y})) << x << " " << y;
      }
      EXPECT_TRUE(blocked(scene.walls, {x, 5.01}));
      EXPECT_TRUE(blocked(scene.walls, {x, -5.01}));
    }
    for (const double y : {-4.99, 0.0, 4.99}) EXPECT_TRUE(blocked(scene.walls, {-10.01, y}));
    for (const double x : {0.01, depth / 2, depth - 0.01}) {
      for (const int side : {-1, 1}) {
        EXPECT_FALSE(blocked(scene.walls, {x, side * (width / 2 - 0.01)})) << x;
        EXPECT_TRUE(blocked(scene.walls, {x, side * (width / 2 + 0.01)})) << x;
        EXPECT_TRUE(blocked(scene.walls, {x, side * 4.99})) << x;
      }
    }
    EXPECT_FALSE(blocked(scene.walls, {depth + 0.01, 3})) << "free behind the wall";
    EXPECT_EQ(all_places(scene).size(), 150);
    expect_free_places(scene);
    for (const Vector2d& place : all_places(scene)) {
      EXPECT_LT(std::abs(place.x() + 5), 5 - 0.3) << "a body's radius and displacement off walls";
      EXPECT_LT(std::abs(place.y()), 5 - 0.3);
    }
  }
}

TEST(TwoRooms, HaveACorridorOf10By2Meters) {
  const TestScene scene = two_rooms(50);
  for (const double x : {0.01, 5.0, 9.99}) {
    for (const int side : {-1, 1}) {
      EXPECT_FALSE(blocked(scene.walls, {x, side * 0.99}));
      EXPECT_TRUE(blocked(scene.walls, {x, side * 1.01}));
      EXPECT_TRUE(blocked(scene.walls, {x, side * 4.99}));
    }
  }
  for (const double x : {-0.01, 10.01}) EXPECT_FALSE(blocked(scene.walls, {x, 3})) << "rooms";
  ASSERT_EQ(scene.groups.size(), 2);
  EXPECT_EQ(scene.groups[0].places.size(), 100);
  EXPECT_EQ(scene.groups[1].places.size(), 50);
  expect_free_places(scene);
  for (const Vector2d& place : scene.groups[0].places) EXPECT_LT(place.x(), -0.2);
  for (const Vector2d& place : scene.groups[1].places) EXPECT_GT(place.x(), 10.2);
  EXPECT_EQ(two_rooms(0).groups.size(), 1);
}

TEST(Ring, HasTwoWallsAndPeopleBetween) {
  Ring spec;
  spec.radius_m = 10;
  spec.width_m = 2;
  spec.people = 77;
  const TestScene scene = ring(spec);
  ASSERT_EQ(scene.walls.size(), 2);
  // A regular polygon of n corners has the area n / 2 r^2 sin(2 pi / n).
  const double unit = 60 * std::sin(2 * M_PI / 120);
  EXPECT_NEAR(signed_area(scene.walls[0]), 81 * unit, 1e-6) << "solid: counter-clockwise";
  EXPECT_NEAR(signed_area(scene.walls[1]), -121 * unit, 1e-6) << "outer wall: clockwise";
  const std::vector<Vector2d> places = all_places(scene);
  ASSERT_EQ(places.size(), 77);
  std::array<int, 4> quadrants{};
  for (const Vector2d& place : places) {
    EXPECT_GT(place.norm(), 9.2);
    EXPECT_LT(place.norm(), 10.8);
    ++quadrants[(place.x() > 0 ? 0U : 1U) + (place.y() > 0 ? 0U : 2U)];
  }
  for (const int people : quadrants) EXPECT_NEAR(people, 77.0 / 4, 3) << "all around";
}

TEST(Load, PutsPeopleNearTheirPlacesBySeed) {
  TestScene scene = room_with_door({1, 0.2, 40});
  scene.groups[0].aside_m = 0.15;
  const crowd::Simulation one = load(scene, {"orca"}, 7);
  const crowd::Simulation same = load(scene, {"weidmann"}, 7);
  const crowd::Simulation other = load(scene, {"orca"}, 8);
  ASSERT_EQ(one.agent_count(), 40);
  int moved = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    const Vector2f place = scene.groups[0].places[i].cast<float>();
    EXPECT_LE((one.positions()[i] - place).norm(), 0.15F + 1e-5F);
    EXPECT_EQ(one.positions()[i], same.positions()[i]) << "the model changes no start";
    if (one.positions()[i] != other.positions()[i]) ++moved;
  }
  EXPECT_EQ(moved, 40) << "another seed, another start";
}

TEST(Load, PutsPeopleExactlyWhereNothingIsRandom) {
  TestScene scene = room_with_door({1, 0.2, 10});
  scene.groups[0].aside_m = 0;
  scene.groups[0].radius_m = 0.31;
  scene.groups[0].speed = Sampled::constant(0.9);
  const crowd::Simulation crowd = load(scene, {"orca"}, 3);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(crowd.positions()[i], scene.groups[0].places[i].cast<float>());
    EXPECT_FLOAT_EQ(crowd.radii_m()[i], 0.31F);
    EXPECT_FLOAT_EQ(crowd.desired_speeds_mps()[i], 0.9F);
  }
}

TEST(Load, SamplesWeidmannsFreeSpeedsByDefault) {
  const crowd::Simulation crowd = load(room_with_door({1, 0.2, 2000}), {"dummy"}, 1);
  double sum = 0;
  double squares = 0;
  for (const float speed : crowd.desired_speeds_mps()) {
    EXPECT_GE(speed, 0.58F);
    EXPECT_LE(speed, 2.1F);
    sum += speed;
    squares += speed * speed;
  }
  const double mean = sum / 2000;
  EXPECT_NEAR(mean, 1.34, 4 * 0.26 / std::sqrt(2000.0));
  EXPECT_NEAR(std::sqrt(squares / 2000 - mean * mean), 0.26, 0.02);
}

TEST(Load, KeepsTheSceneTimeStepForEveryModel) {
  TestScene scene = room_with_door({1, 0.2, 5});
  for (const char* model : {"orca", "helbing"}) {
    crowd::Simulation crowd = load(scene, {model}, 1);
    crowd.step();
    EXPECT_NEAR(crowd.time_s(), 0.1, 1e-6) << model;
  }
  scene.dt_s = 0.05;
  EXPECT_NEAR(load(scene, {"orca"}, 1).dt_s(), 0.05, 1e-6);
}

}  // namespace
}  // namespace throng::validation
