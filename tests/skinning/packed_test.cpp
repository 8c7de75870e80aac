#include "skinning/packed.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/skinning/walkers.h"

namespace throng::skinning {
namespace {

TEST(Packed, KeepsThePositionOfEveryVertex) {
  const Walker walker = made_up_walker();
  for (const Clip& clip : standard_clips()) {
    const std::vector<Palette> palettes = bake_clip(walker, clip);
    const std::string bytes = pack(walker.joints, palettes);
    EXPECT_EQ(bytes.size(), palettes.size() * kPackedBytes);
    const std::vector<Palette> again = unpack(walker.joints, bytes);
    ASSERT_EQ(again.size(), palettes.size());
    for (std::size_t i = 0; i < palettes.size(); ++i) {
      for (const Vertex& vertex : walker.body) {
        EXPECT_LT((skin(vertex, palettes[i], palettes[i], 0) - skin(vertex, again[i], again[i], 0))
                      .norm(),
                  2e-4F)
            << clip.name;
      }
    }
  }
}

TEST(Packed, RefusesInvalidPoses) {
  const Joints joints = made_up_joints();
  EXPECT_THROW(unpack(joints, std::string(kPackedBytes, '\0')), std::out_of_range);
  EXPECT_TRUE(unpack(joints, "").empty());
}

}  // namespace
}  // namespace throng::skinning
