#include "annotate/exits/exit_view.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace throng::annotate {
namespace {

using nlohmann::json;

/// One door of 2 m in the wall y = 10, and what happened there at 0 s and 1 s.
ExitView one_door() {
  world::Scenario scenario;
  world::Exit exit;
  exit.id = "a \"north\"";
  exit.from = {-1, 10};
  exit.to = {1, 10};
  exit.outward = {0, 1};
  scenario.exits = {exit};
  metrics::ExitSeries series;
  series.exit_id = exit.id;
  series.samples.resize(2);
  series.samples[1].queue = 7;
  series.samples[1].clogging_index = 0.25;
  series.samples[1].state = metrics::ExitState::clogged;
  return {scenario, {series}, {0, 1}};
}

camera::Camera camera_looking(double yaw_rad) {
  return {camera::intrinsics_from_hfov(400, 300, 1.2),
          camera::pose_looking({0, 0, 6}, yaw_rad, -0.5)};
}

constexpr double kNorth = 1.5707963267948966;

TEST(ExitView, ShowsTheExitAtTheTime) {
  const camera::Camera camera = camera_looking(kNorth);
  const json before = json::parse(one_door().json(camera, 0.99)).at(0);
  EXPECT_EQ(before.at("state"), "idle");
  const json then = json::parse(one_door().json(camera, 1)).at(0);
  EXPECT_EQ(then.at("id"), "a \"north\"");
  EXPECT_EQ(then.at("state"), "clogged");
  EXPECT_EQ(then.at("queue"), 7);
  EXPECT_EQ(then.at("clogging_index"), 0.25);
}

TEST(ExitView, OutlinesAreWhereTheCameraSeesThem) {
  const camera::Camera camera = camera_looking(kNorth);
  const json exit = json::parse(one_door().json(camera, 0)).at(0);
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(-1, 10, 0), Eigen::Vector3d(1, 10, 0)}) {
    const Eigen::Vector2d at = camera.project(corner).pixel.array() + 0.5;
    double nearest = 1e9;
    for (const json& point : exit.at("door")) {
      nearest = std::min(
          nearest, std::hypot(point[0].get<double>() - at.x(), point[1].get<double>() - at.y()));
    }
    EXPECT_LT(nearest, 0.01);
  }
  // The zone is a half disc of 3 m on the inner side: nearer, and so lower in the image.
  const double inner = camera.project({0, 7, 0}).pixel.y() + 0.5;
  double lowest = 0;
  for (const json& point : exit.at("zone")) lowest = std::max(lowest, point[1].get<double>());
  EXPECT_NEAR(lowest, inner, 0.5);
}

TEST(ExitView, OutlinesThatAreNotInTheImageAreEmpty) {
  const json exit = json::parse(one_door().json(camera_looking(-kNorth), 0)).at(0);
  EXPECT_TRUE(exit.at("door").empty());
  EXPECT_TRUE(exit.at("zone").empty());
}

// Straight above the door, half of the ground is behind a camera that looks ahead.
TEST(ExitView, CutsOffPartsBehindTheCamera) {
  camera::Camera camera = camera_looking(kNorth);
  camera.pose = camera::pose_looking({0, 8.5, 0.8}, kNorth, -0.3);
  const json exit = json::parse(one_door().json(camera, 0)).at(0);
  ASSERT_GT(exit.at("zone").size(), 10U);
  for (const json& point : exit.at("zone")) EXPECT_GT(point[1].get<double>(), 0);
}

}  // namespace
}  // namespace throng::annotate
