// Color, id and depth against the camera's geometry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

/// First intersection of the camera ray through a box-coordinate point with an axis-aligned box or
/// the ground: id and camera depth.
struct Hit {
  std::uint32_t id = kIdNothing;
  double depth_m = std::numeric_limits<double>::infinity();
};

struct Solid {
  Eigen::Vector3d min;
  Eigen::Vector3d max;
};

Hit cast(const camera::Camera& camera, const Solid& solid, double u, double v) {
  const Eigen::Vector3d from = camera.pose.center();
  // Depth along this ray grows by one per unit.
  const Eigen::Vector3d ray = camera.unproject({u - 0.5, v - 0.5}, 1.0) - from;
  Hit hit;
  if (ray.z() < 0) hit = {kIdGround, -from.z() / ray.z()};
  double enter = 0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (solid.min[axis] - from[axis]) / ray[axis];
    const double b = (solid.max[axis] - from[axis]) / ray[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter < leave && enter < hit.depth_m) hit = {kIdBuilding, enter};
  return hit;
}

class BlockView : public testing::TestWithParam<camera::Camera> {};

TEST_P(BlockView, IdsAndDepthsAreThoseOfARayCast) {
  const Solid solid = {{6, -4, 0}, {14, 3, 5}};
  Stage stage(open_ground({block(6, 14, -4, 3, 5)}));
  const camera::Camera& camera = GetParam();
  const Frame frame = stage.draw(camera);
  std::size_t blocks = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const Hit expected = cast(camera, solid, x + 0.5, y + 0.5);
      const std::size_t i = pixel_index(frame, x, y);
      blocks += frame.id[i] == kIdBuilding ? 1 : 0;
      // Corners lie on a grid of 1/256 pixel, so the surface seen is that of a ray nearby.
      std::set<std::uint32_t> near_ids = {expected.id};
      double nearest = expected.depth_m;
      double farthest = expected.depth_m;
      for (const double du : {-0.01, 0.01}) {
        for (const double dv : {-0.01, 0.01}) {
          const Hit nearby = cast(camera, solid, x + 0.5 + du, y + 0.5 + dv);
          near_ids.insert(nearby.id);
          nearest = std::min(nearest, nearby.depth_m);
          farthest = std::max(farthest, nearby.depth_m);
        }
      }
      ASSERT_EQ(near_ids.count(frame.id[i]), 1U) << "pixel " << x << ", " << y;
      if (near_ids.size() > 1 || farthest > 1000) continue;
      ASSERT_GE(frame.depth_m[i], nearest - 1e-3) << "pixel " << x << ", " << y;
      ASSERT_LE(frame.depth_m[i], farthest + 1e-3) << "pixel " << x << ", " << y;
      if (expected.depth_m > 60) continue;
      ASSERT_NEAR(frame.depth_m[i], expected.depth_m, 0.01) << "pixel " << x << ", " << y;
    }
  }
  EXPECT_GT(blocks, 1000U);
}

INSTANTIATE_TEST_SUITE_P(Views, BlockView,
                         testing::Values(camera_at({0, 0, 12}, 10, -35),
                                         camera_at({-12, 9, 30}, -20, -50),
                                         camera_at({10, 0, 25}, 77, -90, 320, 200),
                                         camera_at({-20, -1, 1.7}, 3, 4, 200, 240, 40)));

TEST(Image, SkyIsInfinitelyFarAndNobody) {
  Stage stage(open_ground());
  const Frame frame = stage.draw(camera_at({0, 0, 5}, 0, 20));
  const std::size_t top = pixel_index(frame, 160, 0);
  EXPECT_EQ(frame.id[top], kIdNothing);
  EXPECT_EQ(frame.depth_m[top], std::numeric_limits<float>::infinity());
}

TEST(Image, GroundReachesTheHorizonWithoutGaps) {
  Stage stage(open_ground());
  const Frame frame = stage.draw(camera_at({3, 2, 25}, 30, -40));
  EXPECT_THAT(frame.id, testing::Each(kIdGround));
}

TEST(Image, UnprojectedGroundPixelsLieOnTheGround) {
  Stage stage(open_ground({block(6, 14, -4, 3, 5)}));
  const camera::Camera camera = camera_at({-5, 3, 18}, -15, -40);
  const Frame frame = stage.draw(camera);
  for (int y = 0; y < frame.height(); y += 3) {
    for (int x = 0; x < frame.width(); x += 3) {
      const std::size_t i = pixel_index(frame, x, y);
      if (frame.id[i] != kIdGround) continue;
      const Eigen::Vector3d point = camera.unproject(Eigen::Vector2d(x, y), frame.depth_m[i]);
      ASSERT_NEAR(point.z(), 0, 2e-3) << "pixel " << x << ", " << y;
    }
  }
}

TEST(Image, IsNeitherFlippedNorMirrored) {
  Stage stage(open_ground());
  // Looking along +x, left is +y.
  const Frame frame =
      stage.draw(camera_at({-10, 0, 4}, 0, -15),
                 {stage.standing(0, 5, 3), stage.standing(1, 5, -3), stage.standing(2, 20, 0)});
  const Mask left = instance_mask(frame, id_of_agent(0));
  const Mask right = instance_mask(frame, id_of_agent(1));
  const Mask far = instance_mask(frame, id_of_agent(2));
  EXPECT_LT(left.box.max().x(), 160);
  EXPECT_GT(right.box.min().x(), 160);
  EXPECT_LT(far.box.max().y(), left.box.max().y()) << "farther feet are higher in the image";
  const PersonInView& person = find_person(frame, 0);
  const double head_v = frame.camera.project(person.head).pixel.y();
  EXPECT_LT(head_v, left.box.center().y()) << "the head is the upper end";
}

TEST(Image, IdsTellEveryoneAndEveryBuildingApart) {
  Stage stage(open_ground({block(20, 25, -9, -1, 4), block(20, 25, 1, 9, 4)}));
  std::vector<PersonInstance> crowd;
  for (std::uint32_t i = 0; i < 30; ++i) {
    crowd.push_back(stage.standing(i, 2 + 2 * (i % 6), -4.0 + 2 * static_cast<double>(i / 6)));
  }
  const Frame frame = stage.draw(camera_at({-8, 0, 15}, 0, -35), crowd);
  const std::set<std::uint32_t> ids(frame.id.begin(), frame.id.end());
  EXPECT_EQ(ids.count(kIdBuilding), 1U);
  EXPECT_EQ(ids.count(kIdBuilding + 1), 1U);
  for (std::uint32_t i = 0; i < 30; ++i) {
    EXPECT_EQ(ids.count(id_of_agent(i)), 1U) << "agent " << i;
  }
}

TEST(Image, ShadowsFallAwayFromTheSun) {
  Environment lighting;
  lighting.sun_azimuth_rad = 30 * kDegree;
  lighting.sun_elevation_rad = 45 * kDegree;
  Stage stage(open_ground({block(-1, 1, -1, 1, 4)}), lighting);
  const camera::Camera camera = camera_at({0, 0, 30}, 0, -90);
  const Frame frame = stage.draw(camera);
  const auto ground_brightness = [&](double distance) {
    const Eigen::Vector2d away(-std::cos(30 * kDegree), -std::sin(30 * kDegree));
    const Eigen::Vector3d point(distance * away.x(), distance * away.y(), 0);
    const Eigen::Vector2d pixel = camera.project(point).pixel;
    return brightness(frame, static_cast<int>(std::lround(pixel.x())),
                      static_cast<int>(std::lround(pixel.y())));
  };
  const int shade = ground_brightness(3);
  const int lit = ground_brightness(-3);
  EXPECT_LT(shade, 0.75 * lit);
  EXPECT_GT(ground_brightness(7), 0.9 * lit) << "the shadow of 4 m at 45 degrees ends before 7 m";
}

TEST(Image, ShadowsTurnAndShortenWithTheHours) {
  // From a low sun in the east over a high one in the south to a low one in the west.
  const camera::Camera camera = camera_at({0, 0, 30}, 0, -90, 480, 480);
  for (const auto& [azimuth_deg, elevation_deg] :
       {std::pair(10, 25), {-40, 45}, {-90, 60}, {-140, 45}, {-190, 25}}) {
    Environment lighting;
    lighting.sun_azimuth_rad = azimuth_deg * kDegree;
    lighting.sun_elevation_rad = elevation_deg * kDegree;
    Stage stage(open_ground({block(-1, 1, -1, 1, 3)}), lighting);
    const Frame frame = stage.draw(camera);
    const Frame bare = Stage(open_ground(), lighting).draw(camera);
    // The dark ground, and where it lies from the block.
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    double farthest = 0;
    int dark = 0;
    for (int y = 0; y < 480; ++y) {
      for (int x = 0; x < 480; ++x) {
        const std::size_t i = pixel_index(frame, x, y);
        const bool is_dark = brightness(frame, x, y) < 0.7 * brightness(bare, x, y);
        if (frame.id[i] != kIdGround || !is_dark) continue;
        const Eigen::Vector2d at = camera.unproject({x, y}, frame.depth_m[i]).head<2>();
        if (at.cwiseAbs().maxCoeff() < 1.5) continue;  // beside the walls it is dark anyway
        middle += at;
        farthest = std::max(farthest, at.norm());
        ++dark;
      }
    }
    ASSERT_GT(dark, 100) << azimuth_deg;
    const Eigen::Vector2d away(-std::cos(azimuth_deg * kDegree), -std::sin(azimuth_deg * kDegree));
    EXPECT_GT(middle.normalized().dot(away), 0.99) << azimuth_deg;
    // From the corner of the block whose shadow reaches farthest.
    const double corner = std::abs(away.x()) + std::abs(away.y());
    EXPECT_NEAR(farthest, 3 / std::tan(elevation_deg * kDegree) + corner, 0.45) << azimuth_deg;
  }
}

TEST(Image, PeopleCastShadowsOnTheGround) {
  Environment lighting;
  lighting.sun_azimuth_rad = 0;
  lighting.sun_elevation_rad = 45 * kDegree;
  Stage stage(open_ground(), lighting);
  const camera::Camera camera = camera_at({0, 0, 15}, 0, -90);
  const Frame empty = stage.draw(camera);
  const Frame frame = stage.draw(camera, {stage.standing(0, 0, 0)});
  const auto change = [&](double x) {
    const Eigen::Vector2d pixel = camera.project({x, 0, 0}).pixel;
    const int column = static_cast<int>(std::lround(pixel.x()));
    const int row = static_cast<int>(std::lround(pixel.y()));
    return brightness(frame, column, row) - brightness(empty, column, row);
  };
  EXPECT_LT(change(-1.2), -60) << "chest height throws its shadow here";
  EXPECT_NEAR(change(1.2), 0, 2) << "towards the sun nothing changes";
}

TEST(Image, IsIndependentOfTheFramesDrawnBefore) {
  Stage stage(open_ground({block(6, 14, -4, 3, 5)}));
  const camera::Camera first = camera_at({-8, 1, 9}, 5, -30);
  const camera::Camera second = camera_at({3, 12, 20}, -70, -50, 200, 300);
  std::vector<PersonInstance> crowd;
  for (std::uint32_t i = 0; i < 40; ++i) {
    crowd.push_back(stage.standing(i, 0.13 * i, std::sin(i) * 3, i));
  }
  const Frame a = stage.draw(first, crowd);
  stage.draw(second, {stage.standing(7, 0, 0)});
  std::reverse(crowd.begin(), crowd.end());
  const Frame again = stage.draw(first, crowd);
  EXPECT_EQ(a.rgb, again.rgb);
  EXPECT_EQ(a.id, again.id);
  EXPECT_EQ(a.depth_m, again.depth_m);
  ASSERT_EQ(a.people.size(), again.people.size());
  for (std::size_t i = 0; i < a.people.size(); ++i) {
    EXPECT_EQ(a.people[i].agent, again.people[i].agent);
    EXPECT_EQ(a.people[i].amodal_area_px, again.people[i].amodal_area_px);
    EXPECT_TRUE(a.people[i].amodal_box.isApprox(again.people[i].amodal_box, 0));
  }
}

TEST(Image, TwoRenderersGiveTheSameBytes) {
  Stage one(open_ground({block(6, 14, -4, 3, 5)}));
  Stage two(open_ground({block(6, 14, -4, 3, 5)}));
  const camera::Camera camera = camera_at({-8, 1, 9}, 5, -30);
  EXPECT_EQ(one.draw(camera, {one.standing(3, 1, 1)}).rgb,
            two.draw(camera, {two.standing(3, 1, 1)}).rgb);
}

TEST(Image, TintColorsClothesAndNotSkin) {
  Stage stage(open_ground());
  PersonInstance red = stage.standing(0, 0, 0);
  PersonInstance blue = stage.standing(0, 0, 0);
  red.appearance.tint.fill({200, 30, 30});
  blue.appearance.tint.fill({30, 30, 200});
  const camera::Camera camera = camera_at({4, 0, 1.2}, 180, 0);
  const auto pixel_at = [&](const Frame& frame, double height) {
    const Eigen::Vector2d pixel = camera.project({0.12, 0, height}).pixel;
    const std::size_t i = 3 * pixel_index(frame, static_cast<int>(std::lround(pixel.x())),
                                          static_cast<int>(std::lround(pixel.y())));
    return Eigen::Vector3i(frame.rgb[i], frame.rgb[i + 1], frame.rgb[i + 2]);
  };
  const Frame in_red = stage.draw(camera, {red});
  const Frame in_blue = stage.draw(camera, {blue});
  EXPECT_GT(pixel_at(in_red, 1.3).x(), 2 * pixel_at(in_red, 1.3).z());
  EXPECT_GT(pixel_at(in_blue, 1.3).z(), 2 * pixel_at(in_blue, 1.3).x());
  EXPECT_EQ(pixel_at(in_red, 1.56), pixel_at(in_blue, 1.56)) << "chin";
}

// Every color at once, as the lower levels of detail have them: where a portrait defines that all
// of a texel is of one tint, it looks like a part of that tint.
TEST(Image, PortraitsAreTintedTexelByTexel) {
  using skinning::Tint;
  const skinning::Population people = synthetic_people(1);
  skinning::Population portraits = people;
  const std::size_t texels = people.textures.front().rgba.size() / 4;
  const auto add = [&](const std::array<std::uint8_t, 4>& texel) {
    skinning::Texture& texture = portraits.textures.emplace_back();
    for (std::size_t i = 0; i < texels; ++i) {
      texture.rgba.insert(texture.rgba.end(), texel.begin(), texel.end());
    }
    return static_cast<std::int32_t>(portraits.textures.size() - 1);
  };
  constexpr std::uint8_t kCloth = 235;        // as the synthetic people's cloth
  constexpr std::uint8_t kLinearCloth = 212;  // alpha is linear
  const std::int32_t black = add({0, 0, 0, 255});
  const std::map<Tint, std::int32_t> shades = {{Tint::top, add({kCloth, 0, 0, 0})},
                                               {Tint::bottom, add({0, kCloth, 0, 0})},
                                               {Tint::shoes, add({0, 0, 0, kLinearCloth})}};
  for (skinning::Mesh& mesh : portraits.characters.front().levels) {
    for (skinning::Part& part : mesh.parts) {
      const auto shade = shades.find(part.tint);
      if (shade == shades.end()) continue;
      part.texture = black;
      part.shades = shade->second;
      part.tint = Tint::portrait;
    }
  }
  Scene scene;
  scene.people = {standing(people, 0, 0, 0)};
  for (std::size_t tint = 0; tint < skinning::kTintCount; ++tint) {
    const auto step = static_cast<std::uint8_t>(30 * tint);
    scene.people.front().appearance.tint[tint] = {static_cast<std::uint8_t>(200 - step), step, 90};
  }
  const camera::Camera camera = camera_at({4, 0, 1.2}, 180, 0);
  const world::Scenario ground = open_ground();
  const Frame parts = Renderer(ground, people, {}, {"software"}).draw(scene, camera);
  const Frame whole = Renderer(ground, portraits, {}, {"software"}).draw(scene, camera);
  int max_difference = 0;
  for (std::size_t i = 0; i < parts.rgb.size(); ++i) {
    max_difference = std::max(max_difference, std::abs(parts.rgb[i] - whole.rgb[i]));
  }
  EXPECT_LE(max_difference, 2);
}

TEST(Image, EveryGroundMaterialDrawsAndUnknownOnesAreNamed) {
  std::set<std::string> images;
  for (const char* material : {"pavers", "asphalt", "grass", "concrete"}) {
    world::Scenario scenario = open_ground();
    scenario.ground_material = material;
    Stage stage(scenario);
    const Frame frame = stage.draw(camera_at({0, 0, 10}, 0, -50));
    images.emplace(frame.rgb.begin(), frame.rgb.end());
  }
  EXPECT_EQ(images.size(), 4U);
  world::Scenario lava = open_ground();
  lava.ground_material = "lava";
  EXPECT_THROW(Stage{lava}, InputError);
}

TEST(Image, AnImageTooLargeForTheDeviceIsRefused) {
  Stage stage(open_ground());
  EXPECT_THROW(stage.draw(camera_at({0, 0, 10}, 0, -50, 100000, 10)), EnvironmentError);
  EXPECT_NO_THROW(stage.draw(camera_at({0, 0, 10}, 0, -50, 17, 5)));
}

}  // namespace
}  // namespace throng::render
