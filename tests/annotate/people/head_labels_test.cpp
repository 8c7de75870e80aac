// Visible shares of heads whose pixels are known.
#include "annotate/people/head_labels.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/annotate/synthetic_frame.h"

namespace throng::annotate {
namespace {

class Heads : public testing::Test {
 protected:
  /// Agent 0 is 10 x 10 pixels; the head is in the first four rows.
  void SetUp() override {
    frame_ = synthetic_frame({});
    std::fill(frame_.id.begin(), frame_.id.end(), render::kIdGround);
    frame_.people.resize(1);
    render::PersonInView& person = frame_.people[0];
    person.agent = 0;
    person.amodal_box = {Eigen::Vector2d(10, 10), Eigen::Vector2d(20, 20)};
    person.amodal_area_px = 100;
    person.head_box = {Eigen::Vector2d(12, 10), Eigen::Vector2d(17, 14)};
    render::PixelMask whole(Eigen::AlignedBox2i(Eigen::Vector2i(10, 10), Eigen::Vector2i(20, 20)));
    whole.set.assign(100, 1);
    person.whole_mask = std::make_shared<const render::PixelMask>(whole);
    fill(10, 10, 20, 20, render::id_of_agent(0));
  }

  void fill(int x0, int y0, int x1, int y1, std::uint32_t id) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        frame_.id[static_cast<std::size_t>(y * frame_.width() + x)] = id;
      }
    }
  }

  HeadLabel head() {
    FrameLabels labels = label_people(frame_);
    add_heads(frame_, labels);
    return labels.people.at(0).head.value();
  }

  render::Frame frame_;
};

TEST_F(Heads, AreWhollyVisibleWithNothingInFront) {
  EXPECT_EQ(head().visibility, 1);
  EXPECT_EQ(head().box.min(), Eigen::Vector2d(12, 10));
}

TEST_F(Heads, AreHiddenByObjectsInTheirBox) {
  fill(10, 12, 15, 20, render::kIdProp);  // 3 x 2 of the head's 5 x 4 pixels
  EXPECT_DOUBLE_EQ(head().visibility.value(), 0.7);
  fill(12, 10, 17, 14, render::kIdBuilding);
  EXPECT_EQ(head().visibility, 0);
}

TEST_F(Heads, HavePixelsWhoseMiddlesAreInTheBox) {
  frame_.people[0].head_box = {Eigen::Vector2d(12.4, 10.6), Eigen::Vector2d(14.5, 12.51)};
  fill(13, 11, 14, 12, render::kIdProp);  // of columns 12 and 13, rows 11 and 12
  EXPECT_DOUBLE_EQ(head().visibility.value(), 0.75);
}

TEST_F(Heads, WithoutAPixelHaveNoShare) {
  frame_.people[0].head_box = {Eigen::Vector2d(12.6, 10.6), Eigen::Vector2d(13.4, 11.4)};
  EXPECT_FALSE(head().visibility.has_value());
  frame_.people[0].head_box = Eigen::AlignedBox2d();
  EXPECT_FALSE(head().visibility.has_value());
  EXPECT_TRUE(head().box.isEmpty());
}

}  // namespace
}  // namespace throng::annotate
