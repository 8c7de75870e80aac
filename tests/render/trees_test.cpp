// Trees, the land around a scenario, and water.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/geometry/angle.h"
#include "render/props/leaf_sprites.h"
#include "render/props/prop_shapes.h"
#include "render/scenery/scenery.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

world::Prop tree(std::uint64_t look, double x = 0, double y = 0) {
  world::Prop prop;
  prop.kind = world::PropKind::tree;
  prop.position = {x, y};
  prop.look = look;
  return prop;
}

world::Scenario with_props(std::vector<world::Prop> props) {
  world::Scenario scenario = open_ground();
  scenario.props = std::move(props);
  return scenario;
}

double covered_share(const std::vector<LeafTexel>& level) {
  const auto covered = std::count_if(level.begin(), level.end(),
                                     [](const LeafTexel& texel) { return texel.cover >= 128; });
  return static_cast<double>(covered) / static_cast<double>(level.size());
}

TEST(LeafSprites, CoverAsMuchFromAfarAsFromNear) {
  for (int sprite = 0; sprite < kLeafSprites; ++sprite) {
    const auto levels = draw_leaf_sprite(static_cast<LeafSprite>(sprite));
    ASSERT_EQ(levels.size(), 9U);
    EXPECT_EQ(levels.back().size(), 1U);
    const double share = covered_share(levels.front());
    EXPECT_GT(share, 0.2) << sprite;
    EXPECT_LT(share, 0.75) << sprite;
    // Levels of a few texels have steps of their own.
    for (std::size_t level = 1; level < 5; ++level) {
      EXPECT_NEAR(covered_share(levels[level]), share, 0.08) << sprite << ", level " << level;
    }
  }
}

TEST(Trees, AreOfSeveralSpeciesAndLowerThanShadowsReach) {
  std::set<int> sprites;
  std::set<long> widths_dm;
  std::set<long> heights_dm;
  for (std::uint64_t look = 0; look < 60; ++look) {
    const PropMesh mesh = prop_shape(tree(look), 0);
    Eigen::AlignedBox3f box;
    for (const PropVertex& vertex : mesh.vertices) {
      box.extend(Eigen::Vector3f(vertex.position.data()));
      if (vertex.paint[3] == static_cast<std::uint8_t>(Finish::leaves)) {
        sprites.insert(static_cast<int>(vertex.card[0]) / 2);
      }
    }
    EXPECT_GE(box.min().z(), 0);
    EXPECT_LE(box.max().z(), tallest_m(with_props({tree(look)}))) << look;
    widths_dm.insert(std::lround(10 * box.sizes().x()));
    heights_dm.insert(std::lround(10 * box.sizes().z()));
  }
  EXPECT_EQ(sprites.size(), 4U);
  EXPECT_GT(*widths_dm.rbegin(), 2 * *widths_dm.begin()) << "broad oaks and columns";
  EXPECT_GT(heights_dm.size(), 15U);
}

TEST(Trees, LightFallsThroughTheirCrowns) {
  Environment light;
  light.sun_azimuth_rad = 0;
  light.sun_elevation_rad = 45 * kDegree;
  Stage empty(open_ground(), light);
  Stage stage(with_props({tree(4)}), light);
  const camera::Camera camera = camera_at({-5, 0, 12}, 0, -90, 480, 360, 30);
  const Frame before = empty.draw(camera);
  const Frame after = stage.draw(camera);
  // Along the lines of the image: a shadow without holes would begin and end once in each.
  int changes = 0;
  int rows = 0;
  for (int y = 0; y < before.height(); ++y) {
    int changed = 0;
    bool was_dark = false;
    for (int x = 0; x < before.width(); ++x) {
      if (after.id[pixel_index(after, x, y)] != kIdGround) continue;
      const bool is_dark = brightness(after, x, y) < 0.8 * brightness(before, x, y);
      changed += is_dark != was_dark ? 1 : 0;
      was_dark = is_dark;
    }
    if (changed == 0) continue;
    changes += changed;
    ++rows;
  }
  ASSERT_GT(rows, 50);
  EXPECT_GT(static_cast<double>(changes) / rows, 6);
}

TEST(Trees, AreNotBlackBesideALampAtNight) {
  Environment night;
  night.sun_elevation_rad = -30 * kDegree;
  world::Prop lamp;
  lamp.kind = world::PropKind::lamp_post;
  lamp.position = {-5, 2};
  Stage stage(with_props({tree(4), lamp}), night);
  const Frame frame = stage.draw(camera_at({-9, 0, 5}, 0, -10, 320, 240));
  double sum = 0;
  int count = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      if (frame.id[pixel_index(frame, x, y)] != kIdProp) continue;
      sum += brightness(frame, x, y) / 3.0;
      ++count;
    }
  }
  ASSERT_GT(count, 500);
  EXPECT_GT(sum / count, 8);
}

/// Standard deviation of the brightness in some rows of an image.
double deviation(const Frame& frame, int first_row, int rows) {
  double sum = 0;
  double squares = 0;
  const int count = rows * frame.width();
  for (int y = first_row; y < first_row + rows; ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const double value = brightness(frame, x, y) / 3.0;
      sum += value;
      squares += value * value;
    }
  }
  return std::sqrt(squares / count - sum / count * (sum / count));
}

TEST(Land, IsNoPlainInOneColorAndStreetsGoOnThroughIt) {
  world::Scenario scenario = open_ground();
  Stage stage(scenario);
  const camera::Camera camera = camera_at({60, 0, 60}, 0, -25, 320, 240);
  const Frame fields = stage.draw(camera);
  EXPECT_GT(deviation(fields, 120, 100), 6);
  scenario.areas = {{{{-10, -4}, {40, -4}, {40, 4}, {-10, 4}}, "asphalt", false}};
  Stage street(scenario);
  const Frame with_street = street.draw(camera);
  const Eigen::Vector2d beyond = camera.project({200, 0, 0}).pixel;
  const auto x = static_cast<int>(beyond.x());
  const auto y = static_cast<int>(beyond.y());
  EXPECT_NE(brightness(with_street, x, y), brightness(fields, x, y));
  // Asphalt is gray.
  const std::size_t at = 3 * pixel_index(with_street, x, y);
  EXPECT_LT(std::abs(with_street.rgb[at] - with_street.rgb[at + 2]), 25);
}

TEST(Water, MovesAndMirrorsTheSky) {
  world::Prop fountain;
  fountain.kind = world::PropKind::fountain;
  Stage stage(with_props({fountain}));
  const camera::Camera camera = camera_at({-6, 0, 3}, 0, -25, 320, 240);
  const auto at_time = [&](double time_s) {
    Scene scene;
    scene.time_s = time_s;
    return stage.renderer().draw(scene, camera);
  };
  const Frame now = at_time(0);
  const Frame later = at_time(1);
  EXPECT_EQ(now.id, later.id) << "labels do not move";
  int changed = 0;
  for (std::size_t i = 0; i < now.id.size(); ++i) {
    const int change = std::abs(now.rgb[3 * i + 1] - later.rgb[3 * i + 1]);
    changed += now.id[i] == kIdProp && change > 1 ? 1 : 0;
  }
  EXPECT_GT(changed, 300);
}

}  // namespace
}  // namespace throng::render
