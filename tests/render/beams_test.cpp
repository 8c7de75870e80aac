// Beams of stages in the haze, and their colored lamps, after sunset.
#include <gtest/gtest.h>

#include <algorithm>

#include "render/scenery/lamps.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

Environment at_sun(double elevation_deg) {
  Environment environment;
  environment.sun_elevation_rad = elevation_deg * kDegree;
  return environment;
}

world::Scenario concert(world::PropKind kind) {
  world::Scenario scenario = open_ground();
  world::Prop prop;
  prop.kind = kind;
  prop.position = {0, 20};
  scenario.props = {prop};
  return scenario;
}

/// Pixels of the sky by how much brighter they are than the same pixels of the other frame.
std::size_t brighter_sky(const Frame& frame, const Frame& other) {
  constexpr int kSeen = 30;
  std::size_t count = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const std::size_t i = pixel_index(frame, x, y);
      if (frame.id[i] != kIdNothing || other.id[i] != kIdNothing) continue;
      count += brightness(frame, x, y) > brightness(other, x, y) + kSeen ? 1U : 0U;
    }
  }
  return count;
}

TEST(Beams, ShineAboveAMainStageAtNightAndLeaveTheTruthAlone) {
  const camera::Camera camera = camera_at({0, -25, 6}, 90, 8);
  for (const auto& [elevation_deg, shines] : {std::pair{-30.0, true}, std::pair{30.0, false}}) {
    SCOPED_TRACE(elevation_deg);
    Stage with(concert(world::PropKind::main_stage), at_sun(elevation_deg));
    Stage without(open_ground(), at_sun(elevation_deg));
    const Frame frame = with.draw(camera);
    const std::size_t brighter = brighter_sky(frame, without.draw(camera));
    if (shines) {
      EXPECT_GT(brighter, 150U);
    } else {
      EXPECT_LT(brighter, 20U) << "only what is mixed into the sky along edges";
    }
  }
}

TEST(Beams, SweepWithTime) {
  const camera::Camera camera = camera_at({0, -25, 6}, 90, 8);
  Stage stage(concert(world::PropKind::main_stage), at_sun(-30));
  Scene scene;
  const Frame first = stage.renderer().draw(scene, camera);
  scene.time_s = 1.5;
  const Frame later = stage.renderer().draw(scene, camera);
  EXPECT_GT(brighter_sky(first, later), 50U);
  EXPECT_GT(brighter_sky(later, first), 50U);
  EXPECT_EQ(first.id, later.id);
}

TEST(Lamps, ReachTheFartherTheStrongerTheyAre) {
  Lamp street;
  EXPECT_DOUBLE_EQ(lamp_reach_m(street), 26);
  Lamp flood;
  flood.strength = 20;
  EXPECT_GT(lamp_reach_m(flood), 80);
  EXPECT_LE(lamp_reach_m(flood), 104);
  EXPECT_GT(lamp_strength(flood, 60, 0.5), 0);
  EXPECT_NEAR(lamp_strength(flood, lamp_reach_m(flood), 0.5), 0, 1e-12);
}

TEST(Lamps, OfAStageColorThePeopleBeforeIt) {
  // So far from it that it does not bleach them; by day everybody is as white.
  const auto redness = [](const Frame& frame) {
    double red = 0;
    double green = 0;
    for (std::size_t i = 0; i < frame.id.size(); ++i) {
      if (!is_agent(frame.id[i])) continue;
      red += frame.rgb[3 * i];
      green += frame.rgb[3 * i + 1];
    }
    return red / std::max(green, 1.0);
  };
  const camera::Camera camera = camera_at({-10, -20, 6}, 180, -40);
  std::vector<double> ratios;
  for (const double elevation_deg : {-30.0, 30.0}) {
    Stage stage(concert(world::PropKind::main_stage), at_sun(elevation_deg));
    ratios.push_back(
        redness(stage.draw(camera, {stage.standing(0, -15, -19.5), stage.standing(1, -15, -21)})));
  }
  EXPECT_GT(ratios[0], 1.15 * ratios[1]) << "its lamps together are magenta";
}

}  // namespace
}  // namespace throng::render
