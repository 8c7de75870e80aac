// Light by rays, against what is known of simple places.
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "base/compute/parallel.h"
#include "render/gl/shaders.h"
#include "render/ground/ground_texture.h"
#include "render/light/light_bake.h"
#include "render/light/place_light.h"
#include "render/light/refine.h"
#include "render/light/surfaces.h"
#include "render/scenery/scenery.h"
#include "tests/render/stage.h"
#include "world/stand_seats.h"

namespace throng::render {
namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

Environment make_sky(Weather weather, double elevation_deg = 45) {
  Environment environment;
  environment.sun_azimuth_rad = 0;
  environment.sun_elevation_rad = elevation_deg * kDegree;
  environment.weather = weather;
  return environment;
}

/// The light of a place, ready for questions.
struct Lit {
  explicit Lit(const world::Scenario& scenario,
               const Environment& environment = make_sky(Weather::clear), bool with_lamps = true)
      : day(daylight(environment)), sky(environment, day) {
    meshes = place_meshes(scenario, false);
    add_place(meshes, scenario, (day.lamps / day.exposure).cast<float>(), rays);
    light.emplace(rays, sky, day,
                  day.lamps_on && with_lamps ? all_lamps(scenario) : std::vector<Lamp>());
  }
  Array3f up(float x, float y, float z = 0, int paths = 512) const {
    return light->received({x, y, z}, Vector3f::UnitZ(), paths).value();
  }
  Array3f open_sky() const { return (day.sky / day.exposure).cast<float>(); }

  Daylight day;
  SkyLight sky;
  PlaceMeshes meshes;
  RayScene rays;
  std::optional<LightRays> light;
};

double relative(const Array3f& a, const Array3f& b) {
  return (a - b).abs().maxCoeff() / b.maxCoeff();
}

TEST(SkyLight, GivesLevelGroundTheLightOfTheHour) {
  for (const Weather weather : {Weather::clear, Weather::overcast, Weather::fog, Weather::rain}) {
    for (const double elevation_deg : {60.0, 20.0, 2.0, -5.0, -30.0}) {
      const Lit lit(open_ground(), make_sky(weather, elevation_deg));
      EXPECT_LT(relative(lit.up(0, 0), lit.open_sky()), 0.02) << elevation_deg;
    }
  }
}

TEST(SkyLight, IsBrightAroundTheSunAndDarkestAcrossTheZenith) {
  const Lit lit(open_ground(), make_sky(Weather::clear, 45));
  const auto from = [&](double azimuth_deg, double elevation_deg) {
    return lit.sky.radiance(Vector3f(
        static_cast<float>(std::cos(azimuth_deg * kDegree) * std::cos(elevation_deg * kDegree)),
        static_cast<float>(std::sin(azimuth_deg * kDegree) * std::cos(elevation_deg * kDegree)),
        static_cast<float>(std::sin(elevation_deg * kDegree))));
  };
  EXPECT_GT(from(0, 40).mean(), 3 * from(180, 50).mean());
  EXPECT_GT(from(180, 5).mean(), 1.3 * from(180, 50).mean()) << "the horizon is brighter";
  const Array3f blue = from(180, 60);
  EXPECT_GT(blue.z(), 1.3 * blue.x());
  const Array3f horizon = from(90, 4);
  EXPECT_LT(horizon.z() / horizon.x(), blue.z() / blue.x()) << "and whiter";
}

TEST(SkyLight, OfACloudCoverIsThreeTimesAsBrightAboveAsAtTheHorizon) {
  // With the soft light from above that is not in it (Daylight::sun).
  const Lit lit(open_ground(), make_sky(Weather::overcast));
  const double total = (lit.day.sky + lit.day.sun).mean() / lit.day.exposure;
  const double with_sine = 1.5 * kSoftShare * total;
  const double zenith = lit.sky.radiance({0, 0.02F, 0.9998F}).mean() + with_sine;
  const double horizon = lit.sky.radiance({0.9999F, 0, 0.014F}).mean() + 0.014 * with_sine;
  EXPECT_NEAR(zenith / horizon, 3, 0.2);
}

TEST(LightRays, HalfOfAnEvenSkyIsLeftAtTheFootOfALongHighWall) {
  // Night: the sky is even. The wall is black enough to throw little back.
  world::Scenario scenario = open_ground({block(5, 6, -39, 39, 300)});
  scenario.buildings[0].facade = world::Facade::hedge;
  const Lit lit(scenario, make_sky(Weather::clear, -30), false);
  const Array3f half = 0.5F * lit.open_sky();
  EXPECT_LT(relative(lit.up(4.9F, 0), half), 0.08);
  // In a distance d of a wall of height h: (1 + cos(atan(h / d))) / 2.
  scenario.buildings[0].height_m = 10;
  const Lit low(scenario, make_sky(Weather::clear, -30), false);
  const float share = 0.5F * (1 + std::cos(std::atan(10.0F / 5)));
  EXPECT_LT(relative(low.up(0, 0), Array3f(share * low.open_sky())), 0.06);
}

TEST(LightRays, ASunlitGroundLightsTheWallBesideItAndABlackOneDoesNot) {
  const auto on_wall = [](const std::string& material) {
    world::Scenario scenario = open_ground({block(5, 9, -30, 30, 12)});
    scenario.ground_material = material;
    const Lit lit(scenario, [] {
      Environment afternoon = make_sky(Weather::clear, 45);
      afternoon.sun_azimuth_rad = 180 * kDegree;
      return afternoon;
    }());
    return lit.light->received({5, 0, 2}, -Vector3f::UnitX(), 512).value();
  };
  const Array3f bright = on_wall("concrete");
  const Array3f dark = on_wall("asphalt");
  EXPECT_GT(bright.mean(), 1.3F * dark.mean());
  EXPECT_GT(bright.x() / bright.z(), dark.x() / dark.z()) << "sunlight is warmer than the sky";
  // Half of the hemisphere is ground of albedo a, lit by sun and sky; half is sky, of which the
  // wall sees no more than is there.
  const Daylight day = daylight(make_sky(Weather::clear, 45));
  const double ground = ((day.sun * day.direction.z() + day.sky) / day.exposure).mean() * 0.375;
  EXPECT_GT(bright.mean(), 0.45 * ground);
  EXPECT_LT(bright.mean(), 0.55 * ground + (day.sky / day.exposure).mean());
}

TEST(LightRays, UnderARoofThereIsWhatComesInFromTheSides) {
  world::Scenario scenario = open_ground();
  world::Prop tent;
  tent.kind = world::PropKind::tent;
  scenario.props = {tent};
  const Lit lit(scenario, make_sky(Weather::overcast));
  EXPECT_LT(lit.up(0, 0).mean(), 0.5 * lit.open_sky().mean());
  EXPECT_GT(lit.up(0, 0).mean(), 0.02 * lit.open_sky().mean());
  EXPECT_GT(lit.up(12, 0).mean(), 0.9 * lit.open_sky().mean());
}

TEST(LightRays, HaveNoValueWithinABuilding) {
  const Lit lit(open_ground({block(0, 10, -5, 5, 8)}));
  EXPECT_FALSE(lit.light->received({5, 0, 0}, Vector3f::UnitZ(), 64).has_value());
  EXPECT_FALSE(lit.light->field({5, 0, 1}, 64).has_value());
  EXPECT_TRUE(lit.light->field({-2, 0, 1}, 64).has_value());
}

TEST(LightRays, LampsDoNotShineThroughWalls) {
  const world::Scenario scenario = open_ground({block(0, 6, -5, 5, 8), block(-8, -6, -5, 5, 8)});
  Environment night = make_sky(Weather::clear, -30);
  const Daylight day = daylight(night);
  const SkyLight sky(night, day);
  RayScene rays;
  add_place(place_meshes(scenario, false), scenario, Array3f::Zero(), rays);
  const LightRays light(rays, sky, day, {Lamp{{-0.4, 0, 4.2}, {-1, 0}}});
  const LightRays without(rays, sky, day, {});
  const auto lamp_at = [&](float x, float y) {
    const Array3f with = light.received({x, y, 0}, Vector3f::UnitZ(), 256).value();
    return (with - without.received({x, y, 0}, Vector3f::UnitZ(), 256).value()).mean();
  };
  const double below = lamp_at(-3, 0);
  EXPECT_GT(below, 1e-4);
  EXPECT_LT(lamp_at(-10, 0), 0.05 * below) << "behind the other building";
  EXPECT_LT(lamp_at(8, 0), 0.01 * below) << "behind its own wall";
  EXPECT_EQ(lamp_at(-3, 39), 0) << "out of reach";
}

TEST(LightField, EqualsWhatLevelAndUprightSurfacesReceive) {
  const Lit lit(open_ground({block(5, 9, -30, 30, 12)}), make_sky(Weather::overcast));
  const LightField field = lit.light->field({2, 0, 1.5F}, 4096).value();
  for (const Vector3f& normal :
       {Vector3f(0, 0, 1), Vector3f(-1, 0, 0), Vector3f(1, 0, 0), Vector3f(0, 1, 0)}) {
    const Array3f exact = lit.light->received({2, 0, 1.5F}, normal, 2048).value();
    // Two bands of spherical harmonics are exact within some percent for level surfaces and within
    // some 40 % on sides that face away from most of the light (Ramamoorthi and Hanrahan 2001).
    EXPECT_LT(relative(field.received(normal), exact), normal.z() > 0 ? 0.12 : 0.4)
        << normal.transpose();
  }
}

TEST(Surfaces, HaveTheMeanAlbedoOfTheirTextures) {
  const Stage stage(open_ground());  // makes a context current
  const std::array<std::pair<std::string_view, std::string_view>, 5> materials = {{
      {"pavers", embedded::shader_ground_pavers},
      {"asphalt", embedded::shader_ground_asphalt},
      {"grass", embedded::shader_ground_grass},
      {"concrete", embedded::shader_ground_concrete},
      {"dirt", embedded::shader_ground_dirt},
  }};
  for (const auto& [material, shader] : materials) {
    const Texture texture = bake_ground(shader, 512);
    std::vector<std::uint8_t> texels(std::size_t{4} * 512 * 512);
    glGetTextureImage(texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(texels.size()), texels.data());
    Array3f sum = Array3f::Zero();
    for (std::size_t i = 0; i < texels.size(); i += 4) {
      const Array3f root = Array3f(texels[i], texels[i + 1], texels[i + 2]) / 255;
      sum += root * root;
    }
    const Array3f mean = sum / (512.0F * 512.0F);
    const RaySurface surface = ground_surface(material);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(surface.albedo.at(static_cast<std::size_t>(c)) / 255.0, mean[c], 0.012)
          << material << ' ' << mean.transpose();
    }
  }
}

TEST(Refined, TrianglesStayJoinedAndCoverTheSame) {
  SceneryMesh mesh = scenery_mesh(open_ground({block(0, 10, -5, 5, 8)}));
  const std::span<const std::uint32_t> ground =
      std::span(mesh.indices).subspan(mesh.ground.first, mesh.ground.count);
  const auto area = [&](std::span<const std::uint32_t> indices) {
    double sum = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      const auto at = [&](std::size_t k) {
        return Vector3f(mesh.vertices[indices[i + k]].position.data());
      };
      const float twice = (at(1) - at(0)).cross(at(2) - at(0)).z();
      EXPECT_GT(twice, 0);
      sum += 0.5 * twice;
    }
    return sum;
  };
  const double before = area(ground);
  const std::vector<std::uint32_t> cut =
      refined(ground, mesh.vertices, [](const SceneryVertex& a, const SceneryVertex& b) {
        const Vector3f edge = Vector3f(b.position.data()) - Vector3f(a.position.data());
        const float x = 0.5F * (a.position[0] + b.position[0]);
        return edge.norm() > (std::abs(x) < 8 ? 1.3F : 6.0F);
      });
  EXPECT_GT(cut.size(), 2 * ground.size());
  EXPECT_NEAR(area(cut), before, 1e-3 * before);
  // Each edge within the ground has a triangle on both sides: no corner lies on another's edge.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t i = 0; i < cut.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(cut[i + k], cut[i + (k + 1) % 3])];
  }
  for (const auto& [edge, count] : edges) {
    if (count == 2) continue;
    const auto& a = mesh.vertices[edge.first].position;
    const auto& b = mesh.vertices[edge.second].position;
    const bool is_border =
        (a[0] == b[0] && std::abs(a[0]) == 40) || (a[1] == b[1] && std::abs(a[1]) == 40);
    EXPECT_TRUE(is_border) << a[0] << ' ' << a[1];
  }
}

TEST(LitScenario, DoesNotDependOnTheNumberOfThreads) {
  const world::Scenario scenario = open_ground({block(0, 10, -5, 5, 8), block(-12, -8, -9, 9, 5)});
  const auto lit_by = [&](int threads) {
    PlaceMeshes meshes = place_meshes(scenario, false);
    const Environment environment = make_sky(Weather::clear, 30);
    const ProbeGrid air = ThreadLimit(threads).run([&] {
      return light_place(scenario, environment, daylight(environment),
                         quality_settings(Quality::standard), {}, meshes);
    });
    std::vector<std::array<float, 3>> light;
    for (const SceneryVertex& vertex : meshes.scenery.vertices) light.push_back(vertex.light);
    const LightField field = air.at({-4, 0, 1});
    light.push_back({field.even.x(), field.toward(0, 0), field.toward(2, 1)});
    return light;
  };
  EXPECT_EQ(lit_by(1), lit_by(4));
}

TEST(LitScenario, PeopleAreDarkInAPassageAndWarmBesideASunlitWall) {
  // A passage 3 m wide between two high buildings along x, open ground west of it; the sun shines
  // from the west.
  world::Scenario scenario = open_ground({block(0, 30, 1.5, 12, 15), block(0, 30, -12, -1.5, 15)});
  scenario.buildings[0].facade = world::Facade::brick;
  scenario.buildings[1].facade = world::Facade::brick;
  Environment environment = make_sky(Weather::clear, 35);
  environment.sun_azimuth_rad = 180 * kDegree;
  PlaceMeshes meshes = place_meshes(scenario, false);
  const ProbeGrid air = light_place(scenario, environment, daylight(environment),
                                    quality_settings(Quality::standard), {}, meshes);
  const auto mean = [](const Array3f& color) { return color.mean(); };
  const Array3f open = air.at({-25, 25, 1}).received(Vector3f::UnitZ());
  EXPECT_LT(mean(air.at({20, 0, 1}).received(Vector3f::UnitZ())), 0.35F * mean(open));
  const Array3f beside = air.at({-1, 7, 1}).received(Vector3f::UnitX());
  const Array3f in_the_open = air.at({-25, 25, 1}).received(Vector3f::UnitX());
  EXPECT_GT(beside.x() / beside.z(), 1.2F * in_the_open.x() / in_the_open.z());
}

TEST(LitScenario, LampsReachPeopleOnAStand) {
  world::Scenario scenario = open_ground();
  world::Stand stand;
  stand.id = "stand";
  stand.from = {-20, 0};
  stand.to = {20, 0};
  scenario.stands = {stand};
  world::Prop mast;
  mast.kind = world::PropKind::floodlight_mast;
  mast.position = {0, 25};
  mast.yaw_rad = -90 * kDegree;
  scenario.props = {mast};
  PlaceMeshes meshes = place_meshes(scenario, false);
  const Environment environment = make_sky(Weather::clear, -30);
  const ProbeGrid air = light_place(scenario, environment, daylight(environment),
                                    quality_settings(Quality::standard), {}, meshes);
  const Eigen::Vector2d row = world::point_on(stand, 20, 14);
  const auto floor_m = static_cast<float>(world::elevation_m(scenario.stands, row));
  ASSERT_GT(floor_m, 6);
  const Vector3f person(static_cast<float>(row.x()), static_cast<float>(row.y()), floor_m + 1);
  const Array3f lit = air.at(person).received(Vector3f::UnitZ());
  // The light of the open air, which people as high above the ground have, knows no lamps.
  EXPECT_GT(lit.mean(), 1.5F * air.open().received(Vector3f::UnitZ()).mean());
}

TEST(LitScenario, LabelsAreThoseOfCoarserTriangles) {
  // Cutting moves no surface: ids are the same and depths equal but for rounding.
  const world::Scenario scenario = open_ground({block(4, 10, -5, 5, 8)});
  Stage coarse(scenario, {}, {.quality = Quality::draft});
  Stage fine(scenario, {}, {.quality = Quality::standard});
  const camera::Camera camera = camera_at({-15, 3, 9}, 0, -25);
  const Frame a = coarse.draw(camera);
  const Frame b = fine.draw(camera);
  std::size_t others = 0;
  for (std::size_t i = 0; i < a.id.size(); ++i) {
    others += a.id[i] == b.id[i] ? 0 : 1;
    if (a.id[i] != b.id[i]) continue;
    EXPECT_NEAR(a.depth_m[i], b.depth_m[i], 1e-3 * b.depth_m[i]);
  }
  EXPECT_LE(others, 4U) << "of pixels on edges";
}

}  // namespace
}  // namespace throng::render
