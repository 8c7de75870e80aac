// Hazards whose reach and visitors are known.
#include "annotate/people/hazard_view.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/geometry/angle.h"

namespace throng::annotate {
namespace {

using nlohmann::json;

/// A fire at (10, 0) from 2 s on, 1 m to 3 m, growing by 1 m/s, and an attacker, agent 1,
/// walking along y from 4 s on.
world::Scenario dangerous_place() {
  world::Scenario scenario;
  world::Disaster fire;
  fire.kind = world::DisasterKind::fire;
  fire.agent = 2;
  fire.position = {10, 0};
  fire.start_s = 2;
  fire.radius_m = 1;
  fire.growth_mps = 1;
  fire.max_radius_m = 3;
  world::Disaster attacker;
  attacker.kind = world::DisasterKind::attacker;
  attacker.agent = 1;
  attacker.position = {-50, 0};
  attacker.start_s = 4;
  attacker.radius_m = 0.5;
  attacker.max_radius_m = 0.5;
  scenario.disasters = {fire, attacker};
  return scenario;
}

/// 10 s of steps of 0.5 s: agent 0 stands at (11.8, 0), agent 1 is at (-50, t), agent 2 the fire.
world::Trace still_trace() {
  world::Trace trace;
  trace.header.dt_s = 0.5;
  trace.header.role.resize(3);
  for (int step = 0; step <= 20; ++step) {
    const float time_s = 0.5F * static_cast<float>(step);
    trace.time_s.push_back(static_cast<double>(time_s));
    trace.position.insert(trace.position.end(), {{11.8F, 0}, {-50, time_s}, {10, 0}});
    trace.flags.insert(trace.flags.end(), 3, world::kPresent);
  }
  return trace;
}

camera::Camera from_above() {
  return {camera::intrinsics_from_hfov(400, 400, 90 * kDegree),
          camera::pose_looking({10, 0, 20}, 0, -89.9 * kDegree)};
}

TEST(HazardView, HasNoneBeforeTheyBegin) {
  const world::Trace trace = still_trace();
  HazardView view(dangerous_place(), trace);
  view.advance(1.9);
  EXPECT_EQ(view.json(from_above()), "[]");
  EXPECT_FALSE(view.danger(0, {10, 0}).has_value());
}

TEST(HazardView, GrowsUpToItsLimit) {
  const world::Trace trace = still_trace();
  HazardView view(dangerous_place(), trace);
  view.advance(2.5);
  json hazards = json::parse(view.json(from_above()));
  ASSERT_EQ(hazards.size(), 1);
  EXPECT_EQ(hazards[0]["kind"], "fire");
  EXPECT_EQ(hazards[0]["radius_m"], 1.5);
  EXPECT_EQ(hazards[0]["position"], json({10, 0}));
  // 20 m below the camera a meter has 10 pixels.
  Eigen::AlignedBox2d area;
  for (const json& corner : hazards[0]["area"]) {
    area.extend(Eigen::Vector2d(corner[0].get<double>(), corner[1].get<double>()));
  }
  EXPECT_NEAR(area.sizes().x(), 30, 0.3);
  EXPECT_NEAR(area.center().x(), 200, 1);
  view.advance(9);
  EXPECT_EQ(json::parse(view.json(from_above()))[0]["radius_m"], 3);
}

TEST(HazardView, FollowsAnAttacker) {
  const world::Trace trace = still_trace();
  HazardView view(dangerous_place(), trace);
  view.advance(6.25);
  const json hazards = json::parse(view.json(from_above()));
  ASSERT_EQ(hazards.size(), 2);
  EXPECT_EQ(hazards[1]["kind"], "attacker");
  EXPECT_EQ(hazards[1]["position"], json({-50, 6.25}));
  EXPECT_EQ(hazards[1]["area"], json::array()) << "outside of the image";
  const std::optional<Danger> danger = view.danger(0, {-50, 8.25});
  ASSERT_TRUE(danger.has_value());
  EXPECT_EQ(danger->hazard, 1U);
  EXPECT_DOUBLE_EQ(danger->distance_m, 1.5);
}

TEST(HazardView, CountsTimeWithinReach) {
  const world::Trace trace = still_trace();
  HazardView view(dangerous_place(), trace);
  view.advance(2.4);
  EXPECT_NEAR(view.danger(0, {11.8, 0})->distance_m, 0.4, 1e-9);
  EXPECT_EQ(view.danger(0, {11.8, 0})->inside_s, 0);
  // The fire reaches 1.8 m at 2.8 s: the steps from 3 s to 5 s are within.
  view.advance(5);
  EXPECT_EQ(view.danger(0, {11.8, 0})->distance_m, 0);
  EXPECT_DOUBLE_EQ(view.danger(0, {11.8, 0})->inside_s, 2.5);
  HazardView in_one_go(dangerous_place(), trace);
  in_one_go.advance(5);
  EXPECT_DOUBLE_EQ(in_one_go.danger(0, {11.8, 0})->inside_s, 2.5);
}

}  // namespace
}  // namespace throng::annotate
