// Fields on the ground: what they sum to, and that they and the images speak of the same people.
#include "annotate/rasters/ground_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "annotate/rasters/density.h"
#include "annotate/rasters/field_levels.h"
#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "camera/camera.h"

namespace throng::annotate {
namespace {

world::Trace ground_crowd(std::size_t agents) {
  world::Trace trace;
  trace.header.role.assign(agents, world::AgentRole::person);
  trace.time_s = {0, 0.5};
  for (std::size_t i = 0; i < 2 * agents; ++i) {
    Random random(9, Stream::crowd_generator, i);
    const auto x = static_cast<float>(random.uniform(-12, 12));
    trace.position.emplace_back(x, static_cast<float>(random.uniform(-6, 6)));
    trace.velocity.emplace_back(1.0F, -0.5F);
    trace.flags.push_back(world::kPresent);
  }
  return trace;
}

world::Scenario yard() {
  world::Scenario scenario;
  scenario.ground = {{-10, -5}, {10, 5.5}};
  return scenario;
}

double people_in(const std::vector<float>& density, const GroundGrid& grid) {
  return std::accumulate(density.begin(), density.end(), 0.0) * grid.cell_m() * grid.cell_m();
}

std::size_t cell_at(const GroundGrid& grid, double x, double y) {
  const Eigen::Vector2d at = (Eigen::Vector2d(x, y) - grid.origin()) / grid.cell_m();
  return static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(grid.columns()) +
         static_cast<std::size_t>(at.x());
}

TEST(GroundField, SumsToThePeopleOnTheGround) {
  world::Trace trace = ground_crowd(400);
  trace.header.role[3] = world::AgentRole::disaster;
  trace.flags[400 + 5] = 0;  // has left by the second step
  world::Scenario scenario = yard();
  // Walls beside which kernels have to be made up for, and people within one.
  scenario.buildings.push_back({"b", {{-4, -2}, {4, -2}, {4, 2.1}, {-4, 2.1}}, 10});
  const GroundGrid grid(scenario);
  EXPECT_EQ(grid.cell_m(), 0.25);
  EXPECT_EQ(grid.columns(), 80);
  EXPECT_EQ(grid.rows(), 42);
  const GroundField field = ground_field(trace, grid, 0.5);
  std::int64_t expected = 0;
  for (std::size_t agent = 0; agent < 400; ++agent) {
    const Eigen::Vector2f& at = trace.position[400 + agent];
    const bool is_counted = agent != 3 && agent != 5;
    expected += is_counted && at.x() >= -10 && at.x() < 10 && at.y() >= -5 && at.y() < 5.5 ? 1 : 0;
  }
  EXPECT_EQ(field.people, expected);
  EXPECT_NEAR(people_in(field.density, grid), static_cast<double>(expected), 1e-3);
  for (const float value : field.density) EXPECT_GE(value, 0);
}

TEST(GroundField, IsThatOfItsOwnTime) {
  world::Trace trace = ground_crowd(2);
  trace.position = {{-4.875F, 0.125F}, {5.125F, 2.125F}, {-2.875F, 0.125F}, {5.125F, 2.125F}};
  trace.flags[2 + 1] = 0;  // has left by the second step
  const GroundGrid grid(yard());
  for (const double time_s : {0.125, 0.375}) {
    const GroundField field = ground_field(trace, grid, time_s);
    EXPECT_EQ(field.people, 2) << "nobody has left before the second step";
    const double x = -4.875 + 4 * time_s;
    const auto densest = std::max_element(field.density.begin(), field.density.end());
    EXPECT_EQ(field.density[cell_at(grid, x, 0.125)], *densest);
    EXPECT_NEAR(field.velocity_x[cell_at(grid, x, 0.125)], 4, 1e-5) << "2 m in 0.5 s";
    EXPECT_NEAR(field.velocity_y[cell_at(grid, x, 0.125)], 0, 1e-5);
  }
  EXPECT_EQ(ground_field(trace, grid, 0.5).people, 1);
}

TEST(GroundField, NobodyIsInsideOfBuildingsUnlessTheyAre) {
  world::Trace trace = ground_crowd(2);
  world::Scenario scenario = yard();
  scenario.buildings.push_back({"b", {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, 10});
  const GroundGrid grid(scenario);
  trace.position[0] = {-4.1F, 0};  // leans on the wall
  trace.position[1] = {8, 3};
  const GroundField outside = ground_field(trace, grid, 0);
  EXPECT_EQ(outside.density[cell_at(grid, -3.9, 0.1)], 0);
  EXPECT_EQ(outside.voronoi[cell_at(grid, -3.9, 0.1)], 0);
  EXPECT_GT(outside.density[cell_at(grid, -4.1, 0.1)], 1) << "all of the kernel is on this side";
  trace.position[0] = {1.1F, 0.1F};
  const GroundField within = ground_field(trace, grid, 0);
  EXPECT_FLOAT_EQ(within.density[cell_at(grid, 1.1, 0.1)], 16) << "one in a cell of 0.25 m";
}

TEST(GroundField, OneKernelIsAGaussian) {
  world::Trace trace = ground_crowd(1);
  trace.position[0] = {0.125F, 0.125F};  // the middle of a cell
  const GroundGrid grid(yard());
  const GroundField field = ground_field(trace, grid, 0);
  constexpr double kPi = 3.14159265358979;
  const double peak = 1 / (kPi * kFieldKernelM * kFieldKernelM);
  EXPECT_NEAR(field.density[cell_at(grid, 0.1, 0.1)], peak, 2e-3 * peak);
  EXPECT_NEAR(field.density[cell_at(grid, 0.8, 0.1)], peak * std::exp(-0.75 * 0.75 / 0.49),
              2e-3 * peak);
  EXPECT_EQ(field.density[cell_at(grid, 2.4, 0.1)], 0) << "beyond three times 0.7 m";
}

TEST(GroundField, VoronoiDensitiesSumToThePeople) {
  // Some share a place, some stand beside buildings; all cells end before the grid does.
  world::Trace trace = ground_crowd(60);
  world::Scenario scenario = yard();
  scenario.buildings.push_back({"round", {{-3, -1}, {-1, -1.3}, {0.1, 0.4}, {-2, 1.1}}, 10});
  Random random(7, Stream::crowd_generator, 0);
  for (Eigen::Vector2f& place : trace.position) {
    do {
      place = Eigen::Vector2d(random.uniform(-7.9, 7.9), random.uniform(-2.9, 3.3)).cast<float>();
    } while (geometry::signed_distance_to(scenario.buildings[0].footprint, place.cast<double>()) <
             0.05);
  }
  trace.position[4] = trace.position[5] = trace.position[6];
  const GroundGrid grid(scenario);
  const GroundField field = ground_field(trace, grid, 0);
  ASSERT_EQ(field.people, 60);
  EXPECT_NEAR(people_in(field.voronoi, grid), 60, 1e-4);
  EXPECT_EQ(field.voronoi[cell_at(grid, -1.5, 0)], 0) << "nobody is in the building";
}

TEST(GroundField, HasMeanVelocitiesAndTheVoronoiDensityOfALattice) {
  world::Trace trace = ground_crowd(40 * 20);
  for (std::size_t i = 0; i < 800; ++i) {  // 4 /m²
    trace.position[i] = {-9.75F + 0.5F * static_cast<float>(i % 40),
                         -4.75F + 0.5F * static_cast<float>(i / 40)};
    trace.velocity[i] = {trace.position[i].x() < 0 ? 1.0F : 3.0F, -0.5F};
  }
  const GroundGrid grid(yard());
  const GroundField field = ground_field(trace, grid, 0);
  EXPECT_NEAR(field.voronoi[cell_at(grid, 1.1, 0.1)], 4, 1e-4);
  EXPECT_NEAR(field.density[cell_at(grid, 1.1, 0.1)], 4, 0.05);
  EXPECT_NEAR(field.velocity_x[cell_at(grid, 5.1, 0.1)], 3, 1e-5);
  EXPECT_NEAR(field.velocity_x[cell_at(grid, -5.1, 0.1)], 1, 1e-5);
  const float between = field.velocity_x[cell_at(grid, 0.1, 0.1)];
  EXPECT_GT(between, 1.5F);
  EXPECT_LT(between, 2.5F);
  EXPECT_NEAR(field.velocity_y[cell_at(grid, 0.1, 0.1)], -0.5, 1e-5);
  const std::string bytes = npy_bytes(grid, field);
  EXPECT_NE(bytes.find("'shape': (4, 42, 80)"), std::string::npos);
  EXPECT_EQ(bytes.size() % 64, (4 * 42 * 80 * 4) % 64);
}

TEST(GroundField, LargeGroundsHaveLargerCells) {
  world::Scenario scenario;
  scenario.ground = {{-70, -60}, {60, 60}};
  const GroundGrid square(scenario);
  EXPECT_EQ(square.cell_m(), 0.5);
  EXPECT_EQ(square.columns(), 260);
  scenario.ground = {{0, 0}, {3000, 3000}};
  EXPECT_LE(GroundGrid(scenario).cells(), 131072U);
}

// Seen by the camera, the ground's field counts the people of any part of the image that the
// image's own map counts there.
TEST(GroundField, AgreesWithTheImagesMapInEveryRegion) {
  constexpr double kHeadM = 1.6;
  constexpr int kWidth = 640;
  constexpr int kHeight = 480;
  constexpr int kRegions = 3;  // in each direction
  const std::size_t agents = 600;
  world::Trace trace = ground_crowd(agents);
  const GroundGrid grid(yard());
  const GroundField field = ground_field(trace, grid, 0);
  const camera::Camera view{camera::intrinsics_from_hfov(kWidth, kHeight, 1.2),
                            camera::pose_looking({0, -12, 14}, 1.5708, -0.9)};
  // In box coordinates, half a pixel from those of the projection.
  const auto seen_at = [&](const Eigen::Vector2d& place) -> Eigen::Vector2d {
    return view.project({place.x(), place.y(), kHeadM}).pixel + Eigen::Vector2d(0.5, 0.5);
  };
  std::vector<Eigen::Vector2d> heads;
  for (std::size_t i = 0; i < agents; ++i) {
    const Eigen::Vector2d place = trace.position[i].cast<double>();
    if (place.x() < -10 || place.x() >= 10 || place.y() < -5 || place.y() >= 5.5) continue;
    heads.push_back(seen_at(place));
  }
  const DensityMap map = density_map(heads, kWidth, kHeight, 4);
  std::array<std::array<double, kRegions>, kRegions> in_image{};
  std::array<std::array<double, kRegions>, kRegions> on_ground{};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      in_image[y * kRegions / kHeight][x * kRegions / kWidth] +=
          map.value[static_cast<std::size_t>(y) * kWidth + x];
    }
  }
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const Eigen::Vector2d middle =
          grid.origin() + grid.cell_m() * Eigen::Vector2d(column + 0.5, row + 0.5);
      const Eigen::Vector2d pixel = seen_at(middle);
      if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() >= kWidth || pixel.y() >= kHeight) continue;
      on_ground[static_cast<int>(pixel.y()) * kRegions / kHeight]
               [static_cast<int>(pixel.x()) * kRegions / kWidth] +=
          field.density[static_cast<std::size_t>(row) * grid.columns() + column] * grid.cell_m() *
          grid.cell_m();
    }
  }
  double seen = 0;
  for (int row = 0; row < kRegions; ++row) {
    for (int column = 0; column < kRegions; ++column) {
      seen += in_image[row][column];
      EXPECT_NEAR(on_ground[row][column], in_image[row][column],
                  std::max(2.0, 0.05 * in_image[row][column]))
          << "region " << row << ", " << column;
    }
  }
  EXPECT_GT(seen, 200) << "most of them are in the image";
}

TEST(FieldLevels, HaveTheSamePeopleAtTheSamePositions) {
  const world::Trace trace = ground_crowd(300);
  const GroundGrid grid(yard());
  const GroundField fine = ground_field(trace, grid, 0.5);
  for (const double cell_m : {0.25, 0.5, 1.0, 3.7, 50.0}) {
    const FieldLevel level = field_level(grid, cell_m);
    const GroundField coarse = field_on(level, grid, fine);
    EXPECT_EQ(level.columns, static_cast<int>(std::ceil(20 / cell_m)));
    EXPECT_EQ(level.rows, static_cast<int>(std::ceil(10.5 / cell_m)));
    ASSERT_EQ(coarse.density.size(), static_cast<std::size_t>(level.columns * level.rows));
    double people = 0;
    double moving = 0;
    for (std::size_t i = 0; i < coarse.density.size(); ++i) {
      people += static_cast<double>(coarse.density[i]) * cell_m * cell_m;
      moving += static_cast<double>(coarse.density[i] * coarse.velocity_x[i]) * cell_m * cell_m;
    }
    EXPECT_NEAR(people, static_cast<double>(fine.people), 2e-3) << cell_m;
    EXPECT_NEAR(moving, static_cast<double>(fine.people), 2e-3) << "everybody has 1 m/s";
  }
}

TEST(FieldLevels, ShareCellsByTheirAreas) {
  world::Scenario scenario;
  scenario.ground = {{0, 0}, {1, 0.25}};
  const GroundGrid grid(scenario);
  ASSERT_EQ(grid.cells(), 4U);
  const GroundField fine{.density = {16, 0, 8, 0},
                         .velocity_x = {1, 0, 2, 0},
                         .velocity_y = {0, 0, 0, 0},
                         .voronoi = {4, 4, 0, 0},
                         .people = 2};
  // Cells of 0.625 m: the first has cells 0, 1 and half of cell 2, the second the rest; both are
  // higher than the ground.
  const FieldLevel level = field_level(grid, 0.625);
  const GroundField coarse = field_on(level, grid, fine);
  const double cell_m2 = 0.625 * 0.625;
  ASSERT_EQ(coarse.density.size(), 2U);
  EXPECT_NEAR(coarse.density[0] * cell_m2, 1 + 0.25, 1e-6);
  EXPECT_NEAR(coarse.density[1] * cell_m2, 0.25, 1e-6);
  EXPECT_NEAR(coarse.velocity_x[0], (1 * 1 + 0.25 * 2) / 1.25, 1e-6);
  EXPECT_NEAR(coarse.voronoi[0] * cell_m2, 0.5, 1e-6);
  EXPECT_EQ(level_folder(0.625), "cell_0.625");
  EXPECT_EQ(level_folder(2), "cell_2");
}

}  // namespace
}  // namespace throng::annotate
