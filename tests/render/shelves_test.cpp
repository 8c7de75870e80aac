// Rectangles packed into rows.
#include "render/people/shelves.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "base/compute/random.h"

namespace throng::render {
namespace {

TEST(Shelves, RectanglesStayInsideAndApart) {
  const Eigen::AlignedBox2i room(Eigen::Vector2i(0, 0), Eigen::Vector2i(200, 150));
  Shelves shelves(room.max());
  Random random(3, Stream::crowd_generator, 0);
  std::vector<Eigen::AlignedBox2i> placed;
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2i size(1 + static_cast<int>(random.uniform(0, 40)),
                               1 + static_cast<int>(random.uniform(0, 30)));
    const auto at = shelves.place(size);
    if (!at) {
      ++refused;
      continue;
    }
    const Eigen::AlignedBox2i box(*at, Eigen::Vector2i(*at + size));
    EXPECT_TRUE(room.contains(box));
    EXPECT_LE(box.max().y(), shelves.used_rows());
    for (const Eigen::AlignedBox2i& other : placed) {
      const Eigen::Vector2i overlap =
          box.max().cwiseMin(other.max()) - box.min().cwiseMax(other.min());
      EXPECT_LE(overlap.minCoeff(), 0);
    }
    placed.push_back(box);
  }
  EXPECT_GT(placed.size(), 30U);
  EXPECT_GT(refused, 100);
}

TEST(Shelves, OversizedItemsLeaveRoomForOthers) {
  Shelves shelves({100, 100});
  EXPECT_FALSE(shelves.place({101, 10}));
  EXPECT_FALSE(shelves.place({10, 101}));
  EXPECT_EQ(shelves.used_rows(), 0);
  EXPECT_TRUE(shelves.place({100, 100}));
  EXPECT_FALSE(shelves.place({1, 1}));
}

}  // namespace
}  // namespace throng::render
