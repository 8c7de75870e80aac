// The height of the ground, and what slopes do.
#include "crowd/navigation/elevation.h"

#include <gtest/gtest.h>
#include <png.h>

#include <array>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

/// Ten by four pixels, one meter each, that rise from west to east by 25.5 of 255 per pixel.
void write_slope(const test::TemporaryFolder& folder) {
  std::array<std::uint8_t, 40> pixels{};
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels[i] = static_cast<std::uint8_t>(25 * (i % 10));
  }
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = 10;
  header.height = 4;
  header.format = PNG_FORMAT_GRAY;
  std::string bytes(4096, '\0');
  png_alloc_size_t size = bytes.size();
  ASSERT_NE(png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels.data(), 0, nullptr),
            0);
  bytes.resize(size);
  folder.write("slope.png", bytes);
  folder.write("slope.ht", R"(<HeightField file_name="slope.png" cell_size="1" vert_scale="25.5"
    x="-5" y="-2" kernel="biweight"/>)");
}

const std::string kStand = R"(<BFSM><State name="Start" final="0"/></BFSM>)";

TEST(Elevation, HeightFieldsAreInterpolated) {
  const test::TemporaryFolder folder;
  write_slope(folder);
  const std::string agents = test::agent_at(-4.5, 0) + test::agent_at(-3, 0) +
                             test::agent_at(4.5, 1.9) + test::agent_at(50, 0);
  const Simulation crowd(
      folder.write("s.xml",
                   test::scene_with(agents, "", "Start",
                                    R"(<Elevation type="height_field" file_name="slope.ht"/>)")),
      folder.write("b.xml", kStand), {});
  EXPECT_NEAR(crowd.ground_m(0), 0, 1e-4);
  EXPECT_NEAR(crowd.ground_m(1), 3.75, 1e-4) << "between the second and the third pixel";
  EXPECT_NEAR(crowd.ground_m(2), 22.5, 1e-4);
  EXPECT_NEAR(crowd.ground_m(3), 22.5, 1e-4) << "beside the image as at its rim";
}

TEST(Elevation, MeshesGiveTheirPlanes) {
  const test::TemporaryFolder folder;
  folder.write("m.nav", R"(4
0 0
10 0
10 10
0 10
0
0
ramp
1
5 5
4 0 1 2 3
0.5 0 2
0
0
)");
  const std::string mesh = R"(<Elevation type="nav_mesh" file_name="m.nav"/>)";
  const auto scene = [&](const std::string& extra) {
    return folder.write("s.xml", test::scene_with(test::agent_at(4, 5) + test::agent_at(20, 5), "",
                                                  "Start", extra));
  };
  const auto behavior = folder.write("b.xml", kStand);
  const Simulation crowd(scene(mesh), behavior, {});
  EXPECT_FLOAT_EQ(crowd.ground_m(0), 4);
  EXPECT_FLOAT_EQ(crowd.ground_m(1), 7) << "beside the mesh as at its edge";
  EXPECT_THROW(Simulation(scene(mesh + mesh), behavior, {}), InputError);
}

TEST(Elevation, SlopesTurnAndSlowPeople) {
  const test::TemporaryFolder folder;
  write_slope(folder);
  const auto speed = [&](const std::string& direction) {
    const Simulation crowd(folder.write("s.xml", test::scene_with(test::agent_at(0, 0))),
                           folder.write("b.xml", fmt::format(R"(<BFSM><State name="Start" final="0">
      <VelComponent type="const_dir" {}/>
      <VelModifier type="height_field" file_name="slope.ht" dir_weight="0.1" up_hill_scale="0.2"
        down_hill_scale="0.04"/></State></BFSM>)",
                                                             direction)),
                           {});
    return crowd.preferred_velocity(0);
  };
  const Eigen::Vector2f up = speed(R"(x="1" y="0")");
  const Eigen::Vector2f down = speed(R"(x="-1" y="0")");
  const Eigen::Vector2f along = speed(R"(x="0" y="1")");
  EXPECT_NEAR(up.x(), 1.34 * (1 - 0.2 * 2.5), 1e-3);
  EXPECT_NEAR(down.x(), -1.34 * (1 + 0.04 * 2.5), 1e-3);
  EXPECT_NEAR(along.x() / along.y(), -0.25, 1e-3) << "downhill is west";
}

TEST(Elevation, ImagesThatAreNoneAreReported) {
  const test::TemporaryFolder folder;
  folder.write("slope.png", "no image");
  folder.write("slope.ht", R"(<HeightField file_name="slope.png" cell_size="1" vert_scale="1"/>)");
  const auto scene = folder.write(
      "s.xml", test::scene_with(test::agent_at(0, 0), "", "Start",
                                R"(<Elevation type="height_field" file_name="slope.ht"/>)"));
  try {
    const Simulation crowd(scene, folder.write("b.xml", kStand), {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems()[0].source, "slope.png");
  }
}

}  // namespace
}  // namespace throng::crowd
