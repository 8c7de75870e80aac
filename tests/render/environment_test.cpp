// Light and weather on pixels.
#include <gtest/gtest.h>

#include "base/geometry/angle.h"
#include "render/scenery/daylight.h"
#include "render/scenery/lamps.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

Environment weather(Weather kind, double sun_elevation_deg = 45, double visibility_m = 5000) {
  Environment environment;
  environment.sun_azimuth_rad = 30 * kDegree;
  environment.sun_elevation_rad = sun_elevation_deg * kDegree;
  environment.weather = kind;
  environment.visibility_m = visibility_m;
  if (kind == Weather::rain) environment.rain_mm_per_h = 5;
  return environment;
}

/// Mean brightness of what a camera sees within a pixel's radius of a ground point.
double ground_brightness(const Frame& frame, double x, double y, int radius = 1) {
  const Eigen::Vector2d pixel = frame.camera.project({x, y, 0}).pixel;
  double sum = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      sum += brightness(frame, static_cast<int>(std::lround(pixel.x())) + dx,
                        static_cast<int>(std::lround(pixel.y())) + dy);
    }
  }
  return sum / ((2 * radius + 1) * (2 * radius + 1));
}

double mean_brightness(const Frame& frame) {
  double sum = 0;
  for (const std::uint8_t value : frame.rgb) sum += value;
  return sum / static_cast<double>(frame.rgb.size());
}

TEST(Weathers, OvercastHasNoHardShadows) {
  const camera::Camera camera = camera_at({0, 0, 30}, 0, -90);
  const auto shade_over_light = [&](Weather kind, double visibility_m) {
    Stage stage(open_ground({block(-1, 1, -1, 1, 4)}), weather(kind, 45, visibility_m));
    const Frame frame = stage.draw(camera);
    const Eigen::Vector2d sun(std::cos(30 * kDegree), std::sin(30 * kDegree));
    return ground_brightness(frame, -3 * sun.x(), -3 * sun.y()) /
           ground_brightness(frame, 3 * sun.x(), 3 * sun.y());
  };
  EXPECT_LT(shade_over_light(Weather::clear, 5000), 0.75);
  EXPECT_NEAR(shade_over_light(Weather::overcast, 5000), 1, 0.08);
  EXPECT_NEAR(shade_over_light(Weather::fog, 150), 1, 0.08);
}

TEST(Weathers, FogTakesContrastWithDistanceAsBeersLawSays) {
  const camera::Camera camera = camera_at({0, 0, 6}, 0, -10, 640, 480);
  const auto contrast = [&](Weather kind, double visibility_m, double x) {
    Stage stage(open_ground(), weather(kind, 45, visibility_m));
    const Frame empty = stage.draw(camera);
    PersonInstance dark = stage.standing(0, x, 0);
    dark.appearance.tint.fill({0, 0, 0});
    const Frame frame = stage.draw(camera, {dark});
    const Eigen::Vector2d chest = camera.project({x, 0, 1.1}).pixel;
    const int column = static_cast<int>(std::lround(chest.x()));
    const int row = static_cast<int>(std::lround(chest.y()));
    EXPECT_EQ(frame.id[pixel_index(frame, column, row)], id_of_agent(0));
    return std::abs(brightness(empty, column, row) - brightness(frame, column, row));
  };
  const int near_fog = contrast(Weather::fog, 60, 12);
  const int far_fog = contrast(Weather::fog, 60, 36);
  EXPECT_LT(far_fog, 0.6 * near_fog);
  EXPECT_LT(far_fog, 0.4 * contrast(Weather::clear, 5000, 36));
}

TEST(Weathers, RainWetsTheGroundAndStreaksTheColorOnly) {
  const camera::Camera camera = camera_at({0, 0, 12}, 0, -50);
  Stage dry(open_ground(), weather(Weather::overcast));
  Stage wet(open_ground(), weather(Weather::rain));
  const Frame in_dry = dry.draw(camera, {dry.standing(0, 8, 0)});
  const Frame in_rain = wet.draw(camera, {wet.standing(0, 8, 0)});
  EXPECT_LT(mean_brightness(in_rain), 0.9 * mean_brightness(in_dry));
  EXPECT_EQ(in_rain.id, in_dry.id);
  EXPECT_EQ(in_rain.depth_m, in_dry.depth_m);
  // Other drops in every frame, the same drops in the same frame.
  Scene scene;
  scene.people = {wet.standing(0, 8, 0)};
  scene.index = 1;
  const Frame next = wet.renderer().draw(scene, camera);
  EXPECT_NE(next.rgb, in_rain.rgb);
  EXPECT_EQ(next.rgb, wet.renderer().draw(scene, camera).rgb);
}

TEST(Hours, LampsMakePoolsOfLightAtNightAndShadowsAreGone) {
  Stage stage(open_ground({block(0, 4, -3, 3, 8)}), weather(Weather::clear, -30));
  const Frame frame = stage.draw(camera_at({0, 0, 45}, 0, -90));
  EXPECT_GT(ground_brightness(frame, -1, 0), 2 * ground_brightness(frame, 10, 23))
      << "below the lamp of the long wall";
  EXPECT_GT(ground_brightness(frame, -1, 0), 100) << "bright enough to see people there";
  EXPECT_NEAR(ground_brightness(frame, -14, 14), ground_brightness(frame, -14, -14), 10);
}

TEST(Hours, ExposureFollowsTheLight) {
  const camera::Camera camera = camera_at({0, 0, 30}, 0, -60);
  double previous = 1000;
  for (const double elevation_deg : {60.0, 8.0, -3.0, -20.0}) {
    Stage stage(open_ground({block(10, 14, -8, 8, 8)}), weather(Weather::clear, elevation_deg));
    const double now = mean_brightness(stage.draw(camera));
    EXPECT_LT(now, previous) << elevation_deg;
    EXPECT_GT(now, 15) << elevation_deg;
    previous = now;
  }
}

TEST(Hours, WindowsGlowAtNight) {
  const camera::Camera camera = camera_at({-14, 0, 5}, 0, 5);
  Stage night(open_ground({block(0, 8, -10, 10, 13)}), weather(Weather::clear, -30));
  const Frame frame = night.draw(camera);
  int warm = 0;
  int dark = 0;
  for (std::size_t i = 0; i < frame.id.size(); ++i) {
    if (frame.id[i] != kIdBuilding) continue;
    warm += frame.rgb[3 * i] > 140 ? 1 : 0;
    dark += frame.rgb[3 * i] < 70 ? 1 : 0;
  }
  EXPECT_GT(warm, 200);
  EXPECT_GT(dark, 5000);
}

TEST(Hours, TheSkyIsWarmAtSunsetAndBlueAtNoon) {
  const camera::Camera camera = camera_at({0, 0, 5}, 0, 20);
  const auto red_over_blue = [&](double elevation_deg) {
    Stage stage(open_ground(), weather(Weather::clear, elevation_deg));
    const Frame frame = stage.draw(camera);
    const std::size_t i = 3 * pixel_index(frame, 20, 150);  // just above the horizon
    EXPECT_EQ(frame.id[i / 3], kIdNothing);
    return static_cast<double>(frame.rgb[i]) / frame.rgb[i + 2];
  };
  EXPECT_LT(red_over_blue(50), 0.95);
  EXPECT_GT(red_over_blue(2), 1.05);
}

TEST(Daylight, TwilightIsContinuous) {
  for (double degrees = -20; degrees < 60; degrees += 0.25) {
    const Daylight a = daylight(weather(Weather::clear, degrees));
    const Daylight b = daylight(weather(Weather::clear, degrees + 0.01));
    EXPECT_NEAR(a.sky.mean(), b.sky.mean(), 0.06 * a.sky.mean() + 1e-6) << degrees;
    EXPECT_TRUE((a.sun >= 0).all() && (a.haze >= 0).all() && (a.zenith >= 0).all()) << degrees;
  }
}

TEST(Daylight, AClearSkyGivesAQuarterOfTheSunsLightAt45Degrees) {
  const Daylight light = daylight(weather(Weather::clear, 45));
  EXPECT_NEAR((light.sun * light.direction.z()).mean() / light.sky.mean(), 4, 0.2);
}

TEST(Film, SunlitWhiteIsJustBelowTheFilmsAndBlackIsBlack) {
  const camera::Camera camera = camera_at({0, 0, 12}, 0, -90);
  const auto shoulders = [&](std::uint8_t tint) {
    Stage stage(open_ground(), weather(Weather::clear, 45, 20000));
    PersonInstance person = stage.standing(0, 0, 0);
    person.appearance.tint.fill({tint, tint, tint});
    const Frame frame = stage.draw(camera, {person});
    int max = 0;
    int min = 3 * 255;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        if (frame.id[pixel_index(frame, x, y)] != id_of_agent(0)) continue;
        max = std::max(max, brightness(frame, x, y));
        min = std::min(min, brightness(frame, x, y));
      }
    }
    return std::pair(min, max);
  };
  const int white = shoulders(255).second;
  EXPECT_GT(white, 3 * 235);
  EXPECT_LT(white, 3 * 255) << "only glints are cut off";
  EXPECT_LT(shoulders(0).first, 3 * 20);
}

TEST(Smoke, HidesFromTheEyeAndNotFromTheGroundTruth) {
  const auto drawn = [](double smoke, double time_s) {
    Environment lighting;
    lighting.smoke = smoke;
    Stage stage(open_ground(), lighting);
    Scene scene;
    scene.time_s = time_s;
    scene.dangers = {{0, 0}};
    scene.people = {stage.standing(3, -1, 0), stage.standing(4, -1, 9)};
    return stage.renderer().draw(scene, camera_at({-14, 0, 6}, 0, -18));
  };
  const Frame clear = drawn(0, 20);
  const Frame thick = drawn(0.8, 20);
  EXPECT_EQ(clear.id, thick.id);
  EXPECT_EQ(clear.depth_m, thick.depth_m);
  EXPECT_EQ(find_person(clear, 3).amodal_area_px, find_person(thick, 3).amodal_area_px);
  const auto difference = [&](int x, int y) {
    return std::abs(brightness(clear, x, y) - brightness(thick, x, y));
  };
  int changed = 0;
  for (int y = 0; y < clear.height(); ++y) {
    EXPECT_LT(difference(3, y), 6) << "far from the danger";
    for (int x = 120; x < 200; ++x) changed += difference(x, y) > 30 ? 1 : 0;
  }
  EXPECT_GT(changed, 1500);
  EXPECT_EQ(drawn(0.8, 20).rgb, thick.rgb);
  EXPECT_NE(drawn(0.8, 21).rgb, thick.rgb) << "it drifts";
}

TEST(HazardOpacity, SaysWhereAndHowMuchAnImageIsHidden) {
  using Kind = world::DisasterKind;
  const auto drawn = [](Kind kind, double smoke) {
    world::Scenario scenario = open_ground({block(-6, -4, 1, 3, 4)});
    scenario.disasters = {{kind, 0, {0, 0}, 10, 2, 0.2, 4}};
    Environment lighting;
    lighting.smoke = smoke;
    Stage stage(scenario, lighting, {.hazard_opacity = true});
    Scene scene;
    scene.time_s = 20;
    return stage.renderer().draw(scene, camera_at({-16, 0, 7}, 0, -20));
  };
  for (const Kind kind : {Kind::fire, Kind::gas, Kind::collapse}) {
    const Frame clear = drawn(kind, 0);
    const Frame thick = drawn(kind, 0.8);
    ASSERT_EQ(thick.hazard_opacity.size(), thick.rgb.size());
    std::array<std::size_t, 3> shown{};
    std::size_t hidden = 0;
    std::size_t dimmer = 0;   // at edges, which are smoothed
    std::size_t changed = 0;  // though nothing is in front of it
    for (std::size_t i = 0; i < thick.id.size(); ++i) {
      ASSERT_EQ(clear.hazard_opacity[3 * i] + clear.hazard_opacity[3 * i + 1] +
                    clear.hazard_opacity[3 * i + 2],
                0);
      double through = 1;
      for (std::size_t c = 0; c < 3; ++c) {
        shown[c] += thick.hazard_opacity[3 * i + c] > 0 ? 1 : 0;
        through *= 1 - thick.hazard_opacity[3 * i + c] / 255.0;
      }
      // At least that part of the light of the clear image passes; each layer rounds.
      for (std::size_t c = 0; c < 3; ++c) {
        dimmer += thick.rgb[3 * i + c] < (through - 0.06) * clear.rgb[3 * i + c] - 3 ? 1 : 0;
        const int change = std::abs(int{thick.rgb[3 * i + c]} - int{clear.rgb[3 * i + c]});
        changed += through == 1 && change > 3 ? 1 : 0;
      }
      hidden += through < 0.5 ? 1 : 0;
    }
    EXPECT_GT(hidden, 300U);
    if (kind != Kind::fire) {  // which lights what is around it, and burns the ground
      EXPECT_LT(dimmer, thick.id.size() / 100);
      EXPECT_LT(changed, thick.id.size() / 100);
    }
    EXPECT_EQ(shown[0] > 0, kind == Kind::fire);
    EXPECT_EQ(shown[1] > 0, kind != Kind::gas);
    EXPECT_EQ(shown[2] > 0, kind == Kind::gas);
  }
}

Frame draw_fire(const std::vector<world::Disaster>& disasters, double time_s, double smoke) {
  world::Scenario scenario = open_ground();
  scenario.disasters = disasters;
  Environment lighting;
  lighting.smoke = smoke;
  Stage stage(scenario, lighting);
  Scene scene;
  scene.time_s = time_s;
  return stage.renderer().draw(scene, camera_at({-16, 0, 7}, 0, -20));
}

/// The pixels that the disaster makes redder than blue by more than `red`, with nobody about.
Mask flames(const world::Disaster& disaster, double time_s, double smoke, int red) {
  const Frame frame = draw_fire({disaster}, time_s, smoke);
  const Frame before = draw_fire({}, time_s, smoke);
  Mask mask;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const std::size_t at = 3 * pixel_index(frame, x, y);
      const int excess = frame.rgb[at] - frame.rgb[at + 2];
      if (excess <= red || excess <= before.rgb[at] - before.rgb[at + 2] + 5) continue;
      ++mask.pixels;
      mask.box.extend(Eigen::Vector2d(x, y));
    }
  }
  return mask;
}

TEST(Flames, BurnWhereTheFireIsFromItsStartOn) {
  // To the right of the camera, which looks along +x. Smoke dims old flames, but no other smoke or
  // dust of a fire is as red.
  constexpr int kRed = 45;
  const world::Disaster fire{world::DisasterKind::fire, 0, {0, -5}, 10, 2, 0.2, 4};
  EXPECT_EQ(flames(fire, 9.9, 1, kRed).pixels, 0U);
  const Mask young = flames(fire, 11, 1, kRed);
  EXPECT_GT(young.pixels, 500U);
  const Eigen::Vector2d foot =
      camera_at({-16, 0, 7}, 0, -20).project({fire.position.x(), fire.position.y(), 1.4}).pixel;
  EXPECT_LT((young.box.center() - foot).norm(), 12);
  EXPECT_GT(young.box.min().x(), 160) << "in the right half";
  const Mask old = flames(fire, 40, 1, kRed);
  EXPECT_GT(old.box.sizes().x(), 1.4 * young.box.sizes().x()) << "it has grown and burns on";
  EXPECT_EQ(flames(fire, 40, 0, kRed).pixels, 0U) << "nobody asked for smoke";
}

/// Mean red value of the pixels that show a square meter of the ground around a point.
double red_at(const Frame& frame, const Eigen::Vector2d& point) {
  double sum = 0;
  int count = 0;
  for (double x = -0.5; x <= 0.5; x += 0.25) {
    for (double y = -0.5; y <= 0.5; y += 0.25) {
      const Eigen::Vector2d at = frame.camera.project({point.x() + x, point.y() + y, 0}).pixel;
      sum += frame.rgb[3 * pixel_index(frame, static_cast<int>(std::lround(at.x())),
                                       static_cast<int>(std::lround(at.y())))];
      ++count;
    }
  }
  return sum / count;
}

TEST(Fires, LightTheGroundByNightAndLeaveItBurned) {
  const auto drawn = [](world::DisasterKind kind, double elevation_deg, double time_s) {
    world::Scenario scenario = open_ground();
    scenario.disasters = {{kind, 0, {0, 0}, 10, 3, 0, 3}};
    Environment lighting;
    lighting.sun_elevation_rad = elevation_deg * kDegree;
    lighting.smoke = 1;
    Stage stage(scenario, lighting);
    Scene scene;
    scene.time_s = time_s;
    return stage.renderer().draw(scene, camera_at({-16, 0, 9}, 0, -30));
  };
  using Kind = world::DisasterKind;
  // Four meters before the fire, on the camera's side, where no smoke is.
  const Eigen::Vector2d near(-4, 2.5);
  const double dark = red_at(drawn(Kind::fire, -20, 9), near);
  EXPECT_GT(red_at(drawn(Kind::fire, -20, 12), near), 1.5 * dark + 10);
  // Dust hides little of the ground as soon as an explosion is over, long after its fireball.
  const Eigen::Vector2d middle(-1, 0.5);
  const double before = red_at(drawn(Kind::explosion, 45, 9), middle);
  EXPECT_LT(red_at(drawn(Kind::explosion, 45, 30), middle), 0.75 * before);
  EXPECT_NEAR(red_at(drawn(Kind::gas, -20, 10.1), near), dark, 3) << "gas does not burn";
}

TEST(Screens, GlowByNight) {
  const auto mean_of = [](world::Facade facade) {
    world::Building wall = block(8, 10, -8, 8, 7);
    wall.facade = facade;
    Environment lighting;
    lighting.sun_elevation_rad = -20 * kDegree;
    Stage stage(open_ground({wall}), lighting);
    const Frame frame = stage.draw(camera_at({-6, 0, 4}, 0, 0));
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < frame.id.size(); ++i) {
      if (frame.id[i] != kIdBuilding) continue;
      const auto width = static_cast<std::size_t>(frame.width());
      const Eigen::Vector2d pixel(static_cast<double>(i % width), static_cast<double>(i / width));
      const double height_m = frame.camera.unproject(pixel, frame.depth_m[i]).z();
      if (height_m < 5.4 || height_m > 6.6) continue;  // above the lamps of walls
      sum += frame.rgb[3 * i] + frame.rgb[3 * i + 1] + frame.rgb[3 * i + 2];
      ++count;
    }
    EXPECT_GT(count, 200);
    return sum / (3 * count);
  };
  EXPECT_GT(mean_of(world::Facade::screen), 2 * mean_of(world::Facade::plaster));
}

TEST(Lamps, CastSoftShadowsOfPeople) {
  world::Scenario scenario = open_ground();
  world::Prop lamp;
  lamp.kind = world::PropKind::lamp_post;
  lamp.position = {0, 0};
  scenario.props = {lamp};
  Environment lighting;
  lighting.sun_elevation_rad = -20 * kDegree;
  Stage stage(scenario, lighting);
  const camera::Camera camera = camera_at({3, -6, 5}, 90, -38, 640, 480);
  Scene somebody;
  somebody.people = {stage.standing(1, 3, 0)};
  const Frame with = stage.renderer().draw(somebody, camera);
  const Frame without = stage.renderer().draw({}, camera);
  // The first point is behind the person, seen from the lamp, the second as far before them.
  EXPECT_LT(red_at(with, {4.2, 0}), 0.92 * red_at(without, {4.2, 0}));
  EXPECT_GT(red_at(with, {1.6, 0}), 0.97 * red_at(without, {1.6, 0}));
}

TEST(Smoke, DriftsWithTheWind) {
  // The mean column, in pixels, of what smoke makes darker in the sky of a camera that looks along
  // +x, so that +y is on its left.
  const auto column = [](double wind_mps) {
    const auto drawn = [&](double smoke) {
      world::Scenario scenario = open_ground();
      scenario.disasters = {{world::DisasterKind::fire, 0, {0, 0}, 0, 2, 0, 2}};
      Environment lighting;
      lighting.smoke = smoke;
      lighting.wind_mps = {0, wind_mps};
      Stage stage(scenario, lighting);
      Scene scene;
      scene.time_s = 20;
      return stage.renderer().draw(scene, camera_at({-40, 0, 8}, 0, 0));
    };
    const Frame clear = drawn(0);
    const Frame thick = drawn(1);
    double sum = 0;
    int count = 0;
    for (int y = 0; y < clear.height() / 2; ++y) {
      for (int x = 0; x < clear.width(); ++x) {
        if (brightness(clear, x, y) - brightness(thick, x, y) < 30) continue;
        sum += x;
        ++count;
      }
    }
    EXPECT_GT(count, 50);
    return sum / std::max(count, 1);
  };
  EXPECT_LT(column(2) + 30, column(-2));
}

TEST(Flames, AreThoseOfFireAndForAMomentOfAnExplosion) {
  world::Disaster disaster{world::DisasterKind::explosion, 0, {0, -5}, 10, 2, 0, 2};
  constexpr int kRed = 75;  // which gas is not
  EXPECT_GT(flames(disaster, 10.5, 1, kRed).pixels, 100U);
  EXPECT_EQ(flames(disaster, 15, 1, kRed).pixels, 0U);
  for (const auto kind :
       {world::DisasterKind::gas, world::DisasterKind::collapse, world::DisasterKind::attacker}) {
    disaster.kind = kind;
    EXPECT_EQ(flames(disaster, 11, 1, kRed).pixels, 0U);
  }
}

TEST(Flames, ChangeNeitherIdsNorDepth) {
  world::Scenario scenario = open_ground();
  scenario.disasters = {{world::DisasterKind::fire, 0, {0, 0}, 0, 3, 0, 3}};
  const auto drawn = [&](double smoke) {
    Environment lighting;
    lighting.smoke = smoke;
    Stage stage(scenario, lighting);
    Scene scene;
    scene.time_s = 8;
    scene.people = {stage.standing(3, 2, 0)};
    return stage.renderer().draw(scene, camera_at({-16, 0, 7}, 0, -20));
  };
  const Frame clear = drawn(0);
  const Frame burning = drawn(1);
  EXPECT_NE(clear.rgb, burning.rgb);
  EXPECT_EQ(clear.id, burning.id);
  EXPECT_EQ(clear.depth_m, burning.depth_m);
}

TEST(Smoke, RisesFromADisasterFromItsStartOnAndAsFarAsItHasGrown) {
  world::Scenario scenario = open_ground();
  scenario.disasters = {{world::DisasterKind::gas, 0, {0, 0}, 10, 2, 0.5, 12}};
  Environment lighting;
  const auto changed = [&](double time_s) {
    Scene scene;
    scene.time_s = time_s;
    const auto drawn = [&](double smoke) {
      lighting.smoke = smoke;
      Stage stage(scenario, lighting);
      return stage.renderer().draw(scene, camera_at({-30, 0, 14}, 0, -22));
    };
    const Frame clear = drawn(0);
    const Frame thick = drawn(1);
    int pixels = 0;
    for (int y = 0; y < clear.height(); ++y) {
      for (int x = 0; x < clear.width(); ++x) {
        const int difference = brightness(clear, x, y) - brightness(thick, x, y);
        pixels += std::abs(difference) > 8 ? 1 : 0;
      }
    }
    return pixels;
  };
  EXPECT_EQ(changed(9.9), 0);
  const int young = changed(14);
  EXPECT_GT(young, 100);
  EXPECT_GT(changed(30), 2 * young) << "it spreads";
}

}  // namespace
}  // namespace throng::render
