// People in the distance, whom the CPU paints.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "render/frame/view.h"
#include "render/people/distant_painter.h"
#include "skinning/levels.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

constexpr std::uint32_t kWhite = 0xFFFFFFFF;

DeviceVertex corner(float y, float z) {
  DeviceVertex vertex{};
  vertex.position = {0, y, z};
  vertex.weights = 255;
  vertex.normal = 32767;  // +x
  vertex.base = kWhite;
  return vertex;
}

/// A board 0.8 m wide and 1.6 m high that faces +x, of two triangles.
PackedMesh board() {
  PackedMesh mesh;
  mesh.vertices = {corner(-0.4F, 0), corner(0.4F, 0), corner(0.4F, 1.6F), corner(-0.4F, 1.6F)};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

skinning::Palette at_rest() {
  skinning::Palette palette;
  for (skinning::BoneMatrix& bone : palette) {
    bone.setIdentity();
  }
  return palette;
}

/// Looks along -x from 80 m away; a meter is 3.5 pixels there.
camera::Camera far_camera() { return camera_at({80, 0, 1}, 180, 0); }

class Painting : public testing::Test {
 protected:
  bool paint(double x, double y, std::uint32_t id, float yaw_rad = 0) {
    PersonInstance instance;
    instance.position = {static_cast<float>(x), static_cast<float>(y), 0};
    instance.yaw_rad = yaw_rad;
    return painter_.paint({mesh_, palette_, instance.appearance, Stance(instance), {}, id}, shape_);
  }
  /// Pixels of the current image with this id.
  std::uint64_t painted(std::uint32_t id) const {
    std::uint64_t count = 0;
    for (const Eigen::Vector2i& tile : painter_.tiles()) {
      for (int y = tile.y(); y < std::min(tile.y() + 16, painter_.height()); ++y) {
        for (int x = tile.x(); x < std::min(tile.x() + 16, painter_.width()); ++x) {
          const PaintedPixel& pixel =
              painter_.pixels()[static_cast<std::size_t>(y * painter_.width() + x)];
          if (pixel.depth > 0 && pixel.id == id) ++count;
        }
      }
    }
    return count;
  }

  DistantMesh mesh_ = distant_mesh(board());
  skinning::Palette palette_ = at_rest();
  DistantPainter painter_;
  PaintedShape shape_;
};

TEST_F(Painting, CoversThePixelsWhoseCentersAreInside) {
  painter_.begin(far_camera(), Eigen::Vector3f::UnitX());
  ASSERT_TRUE(paint(0, 0, 7));
  const double focal_px = far_camera().intrinsics.fx_px;
  const double width_px = 0.8 * focal_px / 80;
  const double height_px = 1.6 * focal_px / 80;
  const Eigen::Vector2i size(static_cast<int>(std::lround(width_px)),
                             static_cast<int>(std::lround(height_px)));
  const std::uint64_t area = shape_.area(nullptr);
  EXPECT_NEAR(static_cast<double>(area), width_px * height_px, size.x() + size.y());
  EXPECT_EQ(painted(7), area) << "the seam between the triangles is painted once, without gaps";
  const PixelMask mask = shape_.mask();
  EXPECT_EQ(static_cast<std::uint64_t>(std::count(mask.set.begin(), mask.set.end(), 1)), area);
}

TEST_F(Painting, ShowsOnlyTheFront) {
  painter_.begin(far_camera(), Eigen::Vector3f::UnitX());
  ASSERT_TRUE(paint(0, 0, 7, 3.14159F));
  EXPECT_EQ(shape_.area(nullptr), 0U);
  EXPECT_EQ(painted(7), 0U);
}

TEST_F(Painting, NearerPeopleHideFartherOnesInAnyOrder) {
  for (const bool nearer_first : {false, true}) {
    painter_.begin(far_camera(), Eigen::Vector3f::UnitX());
    if (nearer_first) paint(2, 0, 8);
    ASSERT_TRUE(paint(0, 0.4, 7));
    const std::uint64_t whole = shape_.area(nullptr);
    if (!nearer_first) paint(2, 0, 8);
    EXPECT_GT(whole, painted(7));
    EXPECT_GT(painted(7), 0U);
    EXPECT_GT(painted(8), painted(7));
  }
}

TEST_F(Painting, LeavesOutWhoeverReachesOutOfTheImageOrIsLarge) {
  painter_.begin(far_camera(), Eigen::Vector3f::UnitX());
  EXPECT_FALSE(paint(0, 46, 7));
  EXPECT_FALSE(paint(100, 0, 7)) << "behind the camera";
  EXPECT_FALSE(paint(77, 0, 7));
  EXPECT_TRUE(painter_.tiles().empty());
}

TEST_F(Painting, BeginsWithoutTheLastImage) {
  painter_.begin(far_camera(), Eigen::Vector3f::UnitX());
  ASSERT_TRUE(paint(0, 0, 7));
  painter_.begin(far_camera(), Eigen::Vector3f::UnitX());
  ASSERT_TRUE(paint(0, 0.6, 8));
  EXPECT_EQ(painted(7), 0U);
}

TEST(DistantMeshes, AreOpaqueBodiesOfOneBoneAVertex) {
  EXPECT_EQ(distant_mesh(board()).triangles.size(), 2U);
  PackedMesh transparent = board();
  transparent.has_transparent_parts = true;
  EXPECT_TRUE(distant_mesh(transparent).triangles.empty());
  PackedMesh blended = board();
  blended.vertices[1].weights = 128 | (127U << 8U);
  EXPECT_TRUE(distant_mesh(blended).triangles.empty());
  PackedMesh umbrella = board();
  umbrella.vertices[1].part = 1U << 31U;
  EXPECT_TRUE(distant_mesh(umbrella).triangles.empty());
}

/// A crowd of the baked population, of whom most are 8 to 16 pixels tall.
class DistantCrowd : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path folder = skinning::population_folder();
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no people in " << folder;
    people_ = skinning::load_population(folder);
    for (std::uint32_t i = 0; i < 900; ++i) {
      PersonInstance person =
          standing(people_, i, 0.9 * (i % 30) - 13.5, 0.9 * (i / 30) - 13.5, 0.7 * i);
      person.appearance = skinning::sample_appearance(people_, 1, i);
      person.pose = skinning::pose_at(people_, 0.01 * i, 1.4, 0);
      scene_.people.push_back(person);
    }
  }
  /// Surfaces are drawn by the device, so that with them people are, too.
  Frame draw(bool painted, bool whole_masks = false) {
    Renderer renderer(scenario_, people_, {}, {"software"},
                      {.normals = !painted, .whole_masks = whole_masks});
    return renderer.draw(scene_, camera_at({-60, 0, 35}, 0, -30, 640, 480));
  }

  skinning::Population people_;
  world::Scenario scenario_ = open_ground();
  Scene scene_;
};

TEST_F(DistantCrowd, LooksAsTheDeviceDrawsIt) {
  const Frame painted = draw(true);
  const Frame drawn = draw(false);
  std::size_t ids = 0;
  std::size_t other_ids = 0;
  double light = 0;
  double other_light = 0;
  for (std::size_t i = 0; i < drawn.id.size(); ++i) {
    if (!is_agent(drawn.id[i])) continue;
    ++ids;
    if (painted.id[i] != drawn.id[i]) {
      ++other_ids;
      continue;
    }
    EXPECT_NEAR(painted.depth_m[i], drawn.depth_m[i], 0.6);
    for (std::size_t c = 0; c < 3; ++c) {
      light += drawn.rgb[3 * i + c];
      other_light += painted.rgb[3 * i + c];
    }
  }
  EXPECT_GT(ids, 10000U);
  EXPECT_LT(other_ids, ids / 200);
  EXPECT_NEAR(other_light / light, 1, 0.06);
  ASSERT_EQ(painted.people.size(), drawn.people.size());
  std::size_t distant = 0;
  for (std::size_t i = 0; i < drawn.people.size(); ++i) {
    if (drawn.people[i].level == skinning::kDistantLevel) ++distant;
    EXPECT_NEAR(static_cast<double>(painted.people[i].amodal_area_px),
                static_cast<double>(drawn.people[i].amodal_area_px), 2);
  }
  EXPECT_GT(distant, 500U);
}

TEST_F(DistantCrowd, ContainsWhatIsVisibleInItsWholeMasks) {
  const Frame frame = draw(true, true);
  for (const PersonInView& person : frame.people) {
    ASSERT_NE(person.whole_mask, nullptr);
    const auto whole = std::count(person.whole_mask->set.begin(), person.whole_mask->set.end(), 1);
    EXPECT_EQ(static_cast<std::uint64_t>(whole), person.amodal_area_px);
    const Mask visible = instance_mask(frame, id_of_agent(person.agent));
    EXPECT_LE(visible.pixels, person.amodal_area_px);
  }
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const std::uint32_t id = frame.id[pixel_index(frame, x, y)];
      if (!is_agent(id)) continue;
      EXPECT_TRUE(find_person(frame, agent_of_id(id)).whole_mask->at(x, y));
    }
  }
}

TEST_F(DistantCrowd, DoesNotDependOnTheOrderOfPeople) {
  const Frame before = draw(true);
  std::reverse(scene_.people.begin(), scene_.people.end());
  const Frame after = draw(true);
  EXPECT_EQ(before.rgb, after.rgb);
  EXPECT_EQ(before.id, after.id);
}

}  // namespace
}  // namespace throng::render
