// The width of exits that buildings leave free.
#include "world/exits/exit_opening.h"

#include <gtest/gtest.h>

#include <cmath>

namespace throng::world {
namespace {

using Eigen::Vector2d;

Building box(const Vector2d& min, const Vector2d& max) {
  return {"box", {min, {max.x(), min.y()}, max, {min.x(), max.y()}}, 3};
}

/// An exit from (x, from) to (x, to) that leads toward +x.
Exit exit_at(double x, double from, double to) {
  Exit exit;
  exit.id = "door";
  exit.from = {x, from};
  exit.to = {x, to};
  return exit;
}

Exit trimmed(Exit exit, const std::vector<Building>& buildings) {
  std::vector<Exit> exits{std::move(exit)};
  trim_to_openings(buildings, exits);
  return exits[0];
}

/// A wall from x = 0 to 0.4 with an opening from y = -1 to 1.
const std::vector<Building> kWall{box({0, 1}, {0.4, 20}), box({0, -20}, {0.4, -1})};

TEST(ExitOpening, AnExitAsWideAsItsOpeningStaysAsItIs) {
  for (const double x : {-0.3, 0.0, 0.2, 0.4, 0.7}) {
    const Exit exit = trimmed(exit_at(x, -1, 1), kWall);
    EXPECT_DOUBLE_EQ(exit.width_m(), 2) << x;
    EXPECT_EQ(exit.drawn_m, std::nullopt) << x;
  }
}

TEST(ExitOpening, AnExitWiderThanItsOpeningEndsAtTheWalls) {
  for (const double x : {-0.3, 0.0, 0.2, 0.4, 0.7}) {
    for (const bool is_reversed : {false, true}) {
      Exit drawn = exit_at(x, -3, 5);
      if (is_reversed) std::swap(drawn.from, drawn.to);
      const Exit exit = trimmed(drawn, kWall);
      EXPECT_NEAR(exit.width_m(), 2, 1e-9) << x;
      EXPECT_NEAR(exit.middle().y(), 0, 1e-9) << x;
      EXPECT_DOUBLE_EQ(exit.drawn_m.value(), 8) << x;
      EXPECT_EQ(exit.free_m, std::nullopt) << "the rest is free";
    }
  }
}

TEST(ExitOpening, APillarTakesItsWidth) {
  std::vector<Building> buildings = kWall;
  buildings.push_back(box({0.1, -0.5}, {0.3, 0.3}));
  const Exit exit = trimmed(exit_at(0, -1, 1), buildings);
  EXPECT_NEAR(exit.width_m(), 1.2, 1e-9);
  EXPECT_NEAR(exit.length_m(), 2, 1e-9) << "people pass on both sides";
  buildings.back() = box({0.1, -0.9}, {0.3, 0.5});
  const Exit beside = trimmed(exit_at(0, -1, 1), buildings);
  EXPECT_NEAR(beside.width_m(), 0.5, 1e-9) << "nobody fits into 0.1 m";
  EXPECT_NEAR(beside.middle().y(), 0.75, 1e-9);
}

TEST(ExitOpening, WallsInAnyDirection) {
  const double angle_rad = 0.7;
  const auto turned = [&](const Vector2d& point) {
    return Vector2d(std::cos(angle_rad) * point.x() - std::sin(angle_rad) * point.y() + 30,
                    std::sin(angle_rad) * point.x() + std::cos(angle_rad) * point.y() - 7);
  };
  std::vector<Building> buildings = kWall;
  for (Building& building : buildings) {
    for (Vector2d& corner : building.footprint) corner = turned(corner);
  }
  Exit exit = exit_at(0.1, -4, 2);
  exit.outward = turned({1, 0}) - turned({0, 0});
  exit.from = turned(exit.from);
  exit.to = turned(exit.to);
  EXPECT_NEAR(trimmed(exit, buildings).width_m(), 2, 1e-9);
}

TEST(ExitOpening, ADoorDrawnInTheWallOfABuildingStays) {
  const Exit exit = trimmed(exit_at(0, -1, 1), {box({-0.2, -20}, {20, 20})});
  EXPECT_DOUBLE_EQ(exit.width_m(), 2);
  EXPECT_EQ(exit.drawn_m, std::nullopt);
}

}  // namespace
}  // namespace throng::world
