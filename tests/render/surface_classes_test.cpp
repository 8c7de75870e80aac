// Semantic classes of pixels, against the place that was rendered.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>

#include "render/lens/exposure.h"
#include "render/lens/lens.h"
#include "tests/render/stage.h"
#include "world/semantic_class.h"

namespace throng::render {
namespace {

using world::Facade;
using world::SemanticClass;

constexpr double kHouseM = 9;
constexpr double kLowM = 1.5;

/// A house, a low wall and a hedge; a lawn with a kerb, a road with a painted line, and one of each
/// kind of prop in rows.
world::Scenario varied_place() {
  world::Scenario scenario =
      open_ground({block(-30, -20, -8, 8, kHouseM), block(-14, -13, -8, 8, kLowM),
                   block(-10, -8, -8, 8, kLowM)});
  scenario.buildings[0].id = "house";
  scenario.buildings[1].facade = Facade::plaster;
  scenario.buildings[2].facade = Facade::hedge;
  scenario.areas.push_back({{{-4, -8}, {4, -8}, {4, 0}, {-4, 0}}, "grass", true});
  scenario.areas.push_back({{{-4, 2}, {30, 2}, {30, 8}, {-4, 8}}, "asphalt", false});
  scenario.areas.push_back({{{10, -8}, {14, -8}, {14, 0}, {10, 0}}, "dirt", false});
  scenario.areas.push_back({{{16, -8}, {20, -8}, {20, 0}, {16, 0}}, "pavers", false});
  scenario.markings.push_back({"line", {0, 5}, {25, 5}, 0.5});
  for (std::size_t kind = 0; kind < world::kPropKinds; ++kind) {
    world::Prop prop;
    prop.kind = static_cast<world::PropKind>(kind);
    prop.position = {-14.0 + 7.0 * static_cast<double>(kind % 7),
                     16.0 + 12.0 * static_cast<double>(kind / 7)};
    scenario.props.push_back(prop);
  }
  return scenario;
}

/// The class that a point of the ground has, by the lists above; nothing near edges.
std::optional<SemanticClass> ground_class_at(const Eigen::Vector2d& p) {
  constexpr double kMarginM = 0.3;
  constexpr double kKerbM = 0.16;
  const auto within = [&](double x0, double x1, double y0, double y1, double margin) {
    return p.x() > x0 + margin && p.x() < x1 - margin && p.y() > y0 + margin && p.y() < y1 - margin;
  };
  const auto near = [&](double x0, double x1, double y0, double y1) {
    return within(x0, x1, y0, y1, -kMarginM) && !within(x0, x1, y0, y1, kMarginM);
  };
  if (within(0, 25, 4.75, 5.25, 0.1)) return SemanticClass::marking;
  if (within(0, 25, 4.75, 5.25, -0.1)) return std::nullopt;
  if (within(-4, 4, -8, 0, 0.04) && !within(-4, 4, -8, 0, kKerbM - 0.04)) {
    return SemanticClass::kerb;
  }
  if (near(-4, 4, -8, 0) || near(-4, 30, 2, 8) || near(10, 14, -8, 0) || near(16, 20, -8, 0)) {
    return std::nullopt;
  }
  if (within(-4, 4, -8, 0, 0)) return SemanticClass::grass;
  if (within(-4, 30, 2, 8, 0)) return SemanticClass::road;
  if (within(10, 14, -8, 0, 0)) return SemanticClass::dirt;
  if (within(16, 20, -8, 0, 0)) return SemanticClass::pavement;
  if (within(-40, 40, -40, 40, kMarginM)) return SemanticClass::pavement;
  if (within(-40, 40, -40, 40, -kMarginM)) return std::nullopt;
  return SemanticClass::terrain;
}

std::optional<SemanticClass> building_class_at(std::uint32_t building, double height_m) {
  constexpr double kMarginM = 0.002;
  if (building == 1) return SemanticClass::wall;
  if (building == 2) return SemanticClass::hedge;
  if (height_m > kHouseM - kMarginM) return SemanticClass::roof;
  if (height_m > kHouseM - 100 * kMarginM) return std::nullopt;
  return SemanticClass::building;
}

/// The class of the surface that a pixel shows, from its id and depth.
std::optional<SemanticClass> expected_class(const Frame& frame, int x, int y) {
  const std::size_t pixel = pixel_index(frame, x, y);
  const std::uint32_t id = frame.id[pixel];
  if (id == kIdNothing) return SemanticClass::sky;
  if (is_agent(id)) return SemanticClass::person;
  if (id >= kIdProp && id < kIdDrone) {
    return world::prop_type(static_cast<world::PropKind>(id - kIdProp)).semantic_class;
  }
  const Eigen::Vector3d point = frame.camera.unproject({x, y}, frame.depth_m[pixel]);
  if (id == kIdGround) return ground_class_at(point.head<2>());
  return building_class_at(id - kIdBuilding, point.z());
}

/// The same for a pixel whose neighbors show the same, so that no edge runs through it.
std::optional<SemanticClass> expected_within(const Frame& frame, int x, int y) {
  const auto expected = expected_class(frame, x, y);
  for (const auto& [dx, dy] :
       {std::array{-1, 0}, std::array{1, 0}, std::array{0, -1}, std::array{0, 1}}) {
    const int other_x = std::clamp(x + dx, 0, frame.width() - 1);
    const int other_y = std::clamp(y + dy, 0, frame.height() - 1);
    if (expected_class(frame, other_x, other_y) != expected) return std::nullopt;
  }
  return expected;
}

using Counts = std::map<SemanticClass, int>;

/// Pixels by class; fails where one differs from the place.
Counts compared(const Frame& frame) {
  Counts counts;
  int wrong = 0;
  EXPECT_EQ(frame.surface.size(), frame.id.size());
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const auto shown = static_cast<SemanticClass>(frame.surface[pixel_index(frame, x, y)]);
      ++counts[shown];
      const auto expected = expected_within(frame, x, y);
      if (!expected || *expected == shown) continue;
      if (++wrong <= 5) {
        ADD_FAILURE() << x << ' ' << y << ": " << world::semantic_class_info(shown).name
                      << ", expected " << world::semantic_class_info(*expected).name;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  return counts;
}

const RenderOptions kSemantic{.semantic = true};

TEST(SurfaceClasses, AreThoseOfThePlaceInEveryQuality) {
  const camera::Camera oblique = camera_at({-5, -38, 22}, 90, -28, 640, 480, 80);
  for (const Quality quality : {Quality::draft, Quality::standard}) {
    RenderOptions options = kSemantic;
    options.quality = quality;
    Stage stage(varied_place(), {}, options);
    const Counts counts = compared(stage.draw(oblique, {stage.standing(0, 1, -4)}));
    for (const SemanticClass shown :
         {SemanticClass::sky, SemanticClass::terrain, SemanticClass::building, SemanticClass::roof,
          SemanticClass::wall, SemanticClass::hedge, SemanticClass::grass, SemanticClass::road,
          SemanticClass::dirt, SemanticClass::kerb, SemanticClass::marking, SemanticClass::pavement,
          SemanticClass::person, SemanticClass::tree, SemanticClass::car, SemanticClass::train}) {
      EXPECT_GT(counts.count(shown) == 0 ? 0 : counts.at(shown), 3)
          << world::semantic_class_info(shown).name;
    }
  }
}

TEST(SurfaceClasses, ChangeNothingElse) {
  const camera::Camera camera = camera_at({-5, -38, 22}, 90, -28);
  Stage with(varied_place(), {}, kSemantic);
  Stage without(varied_place());
  const Frame classified = with.renderer().draw({}, camera);
  const Frame plain = without.renderer().draw({}, camera);
  EXPECT_EQ(classified.id, plain.id);
  EXPECT_EQ(classified.rgb, plain.rgb);
  EXPECT_EQ(classified.depth_m, plain.depth_m);
  EXPECT_TRUE(plain.surface.empty());
}

TEST(SurfaceClasses, GoThroughALensAndARollingShutter) {
  Stage stage(varied_place(), {}, kSemantic);
  camera::Camera camera = camera_at({-5, -38, 22}, 90, -28);
  camera.intrinsics.distortion = camera::Distortion(camera::Distortion::Model::brown_conrady,
                                                    {-0.28, 0.08, 0.001, -0.0005, -0.01});
  Lens lens(stage.renderer(), stage.people());
  const Scene scene;
  const Counts counts = compared(lens.draw(scene, camera));
  EXPECT_GT(counts.at(SemanticClass::road), 100);
  camera::Exposure exposure;
  exposure.readout_s = 0.03;
  const auto moment = [&](double at_s) {
    camera::Camera moving = camera;
    moving.pose = camera::pose_looking({-5 + 20 * at_s, -38, 22}, 90 * kDegree, -28 * kDegree);
    return ShutterMoment{std::make_shared<Scene>(scene), moving};
  };
  const Exposed exposed = expose(lens, moment, 0, exposure);
  EXPECT_GT(exposed.strips, 1);
  EXPECT_EQ(exposed.frame.surface.size(), exposed.frame.id.size());
  for (std::size_t i = 0; i < exposed.frame.id.size(); ++i) {
    const auto shown = static_cast<SemanticClass>(exposed.frame.surface[i]);
    const bool is_prop = exposed.frame.id[i] >= kIdProp && exposed.frame.id[i] < kIdDrone;
    ASSERT_EQ(world::semantic_class_info(shown).group == world::SemanticGroup::prop, is_prop);
  }
}

}  // namespace
}  // namespace throng::render
