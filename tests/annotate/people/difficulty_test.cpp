// Contrast and occluders of images whose colors and pixels are known.
#include "annotate/people/difficulty.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "annotate/people/contrast.h"
#include "annotate/people/lookalikes.h"
#include "tests/annotate/synthetic_frame.h"

namespace throng::annotate {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr int kSize = 60;
constexpr Rgb kGray{120, 120, 120};

/// An image of one color, and a box of 20 x 30 pixels in it that is the object.
class TestImage {
 public:
  explicit TestImage(const Rgb& background)
      : mask_(Eigen::AlignedBox2i(Eigen::Vector2i(20, 15), Eigen::Vector2i(40, 45))) {
    for (int i = 0; i < kSize * kSize; ++i) {
      rgb_.insert(rgb_.end(), background.begin(), background.end());
    }
    mask_.set.assign(mask_.set.size(), 1);
  }

  void fill(int x0, int y0, int x1, int y1, const Rgb& color) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        std::copy(color.begin(), color.end(), rgb_.begin() + 3 * (y * kSize + x));
      }
    }
  }
  void fill_object(const Rgb& color) { fill(20, 15, 40, 45, color); }

  Contrast contrast() const { return measure_contrast({kSize, kSize, rgb_}, mask_); }

 private:
  std::vector<std::uint8_t> rgb_;
  render::PixelMask mask_;
};

TEST(Contrast, IsTheColorDifferenceOfCie1976) {
  TestImage image({0, 255, 0});
  image.fill_object({255, 0, 0});
  // sRGB red is (53.24, 80.09, 67.20) and green (87.73, -86.18, 83.18) in CIELAB, white D65.
  const double expected = std::hypot(87.73 - 53.24, -86.18 - 80.09, 83.18 - 67.20);
  EXPECT_NEAR(image.contrast().region, expected, 0.1);
  EXPECT_NEAR(image.contrast().edge, expected, 0.1);
}

TEST(Contrast, OfWhiteToBlackIs100) {
  TestImage image({0, 0, 0});
  image.fill_object({255, 255, 255});
  EXPECT_NEAR(image.contrast().region, 100, 0.1);
}

TEST(Contrast, IsZeroInFrontOfTheSameColor) {
  TestImage image(kGray);
  EXPECT_EQ(image.contrast().region, 0);
  EXPECT_EQ(image.contrast().edge, 0);
  image.fill_object({122, 122, 122});
  EXPECT_GT(image.contrast().region, 0.3);
  EXPECT_LT(image.contrast().region, 2.3) << "not noticeable";
}

TEST(Contrast, AlongTheOutlineIsSeenWhereTheMeansAgree) {
  // Black and white halves, whose mean lightness is that of the gray around them.
  TestImage image({119, 119, 119});
  image.fill(20, 15, 30, 45, {0, 0, 0});
  image.fill(30, 15, 40, 45, {255, 255, 255});
  EXPECT_LT(image.contrast().region, 1.5);
  EXPECT_GT(image.contrast().edge, 40);
}

TEST(Contrast, IsOfTheNearSurroundings) {
  // Pixels farther than 0.15 of the height, 4.5 px, do not count.
  TestImage image({255, 0, 0});
  image.fill(15, 10, 45, 50, kGray);
  image.fill_object(kGray);
  EXPECT_EQ(image.contrast().region, 0);
}

TEST(Contrast, OfAnObjectThatFillsTheImageIsZero) {
  const std::vector<std::uint8_t> rgb(12, 50);
  render::PixelMask mask(Eigen::AlignedBox2i(Eigen::Vector2i(0, 0), Eigen::Vector2i(2, 2)));
  mask.set.assign(4, 1);
  EXPECT_EQ(measure_contrast({2, 2, rgb}, mask).region, 0);
  EXPECT_EQ(measure_contrast({2, 2, rgb}, {}).edge, 0);
}

class Occluders : public testing::Test {
 protected:
  /// Agent 0 is 10 x 10 pixels, of which others cover some.
  void SetUp() override {
    frame_ = synthetic_frame({});
    std::fill(frame_.id.begin(), frame_.id.end(), render::kIdGround);
    frame_.people.resize(1);
    frame_.people[0].agent = 0;
    frame_.people[0].amodal_box = {Eigen::Vector2d(10, 10), Eigen::Vector2d(20, 20)};
    frame_.people[0].amodal_area_px = 100;
    render::PixelMask whole(Eigen::AlignedBox2i(Eigen::Vector2i(10, 10), Eigen::Vector2i(20, 20)));
    whole.set.assign(100, 1);
    frame_.people[0].whole_mask = std::make_shared<const render::PixelMask>(whole);
    fill(10, 20, render::id_of_agent(0));
  }

  void fill(int y0, int y1, std::uint32_t id) {
    for (int y = y0; y < y1; ++y) {
      for (int x = 10; x < 20; ++x) {
        frame_.id[static_cast<std::size_t>(y * frame_.width() + x)] = id;
      }
    }
  }

  std::vector<Occluder> occluders() {
    FrameLabels labels = label_people(frame_);
    add_occluders(frame_, labels);
    return labels.people.at(0).occluders.value();
  }

  render::Frame frame_;
};

TEST_F(Occluders, AreNoneForAWhollyVisiblePerson) { EXPECT_TRUE(occluders().empty()); }

TEST_F(Occluders, AreBySharesAndInstance) {
  fill(18, 19, render::kIdProp + 5);
  fill(10, 13, render::kIdBuilding + 2);
  fill(19, 20, render::kIdUmbrella + render::id_of_agent(7));
  const std::vector<Occluder> found = occluders();
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].instance, 0x800002U);
  EXPECT_DOUBLE_EQ(found[0].share, 0.3);
  EXPECT_EQ(found[1].instance, 0x400008U);
  EXPECT_EQ(found[2].instance, 0xC00005U);
  EXPECT_DOUBLE_EQ(found[2].share, 0.1);
}

using DeliveredImage = Occluders;

TEST_F(DeliveredImage, IsTheOneThatContrastsAreMeasuredIn) {
  std::vector<std::uint8_t> rgb(frame_.rgb.size(), 255);
  for (std::size_t i = 0; i < frame_.id.size(); ++i) {
    if (frame_.id[i] == render::id_of_agent(0)) std::fill_n(rgb.begin() + 3 * i, 3, 0);
  }
  frame_.depth_m.assign(frame_.id.size(), 10);
  FrameLabels labels = label_people(frame_);
  add_difficulty(frame_, {frame_.width(), frame_.height(), rgb}, labels);
  EXPECT_NEAR(labels.people.at(0).difficulty->contrast, 100, 0.1) << "black on white";
  EXPECT_NEAR(labels.people.at(0).difficulty->edge_contrast, 100, 0.1);
}

TEST(Lookalikes, AreNearAndOfNearlyTheSameColorsAboveAndBelow) {
  const Look blue_gray{{40, 10, -30}, {50, 0, 0}};
  const Look nearly{{42, 12, -27}, {47, 2, 1}};
  const Look same_above{{40, 10, -30}, {50, 20, 0}};
  const std::vector<PersonLook> people = {
      {{100, 100}, 50, blue_gray}, {{180, 100}, 50, nearly},    {{120, 100}, 50, same_above},
      {{240, 100}, 50, blue_gray}, {{251, 100}, 50, blue_gray}, {{100, 110}, 50, std::nullopt},
  };
  const auto found = group_lookalikes(people);
  EXPECT_EQ(found[0], (std::vector<std::size_t>{1, 3})) << "151 px are more than 3 heights";
  EXPECT_EQ(found[1], (std::vector<std::size_t>{3, 4, 0})) << "the nearest first";
  EXPECT_TRUE(found[2].empty());
  EXPECT_EQ(found[4], (std::vector<std::size_t>{3, 1}));
  EXPECT_TRUE(found[5].empty());
}

TEST(Look, IsTheMeanColorOfEachHalf) {
  std::vector<std::uint8_t> rgb;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 10; ++x) {
      const Rgb color = y < 12 ? Rgb{255, 0, 0} : Rgb{0, 255, 0};
      rgb.insert(rgb.end(), color.begin(), color.end());
    }
  }
  render::PixelMask mask(Eigen::AlignedBox2i(Eigen::Vector2i(2, 4), Eigen::Vector2i(8, 20)));
  mask.set.assign(mask.set.size(), 1);
  const auto look = describe_look({10, 20, rgb}, mask);
  ASSERT_TRUE(look.has_value());
  EXPECT_NEAR((look->upper - Eigen::Vector3d(53.24, 80.09, 67.20)).norm(), 0, 0.1);
  EXPECT_NEAR((look->lower - Eigen::Vector3d(87.73, -86.18, 83.18)).norm(), 0, 0.1);
  render::PixelMask small(Eigen::AlignedBox2i(Eigen::Vector2i(2, 4), Eigen::Vector2i(6, 10)));
  small.set.assign(small.set.size(), 1);
  EXPECT_FALSE(describe_look({10, 20, rgb}, small).has_value()) << "12 pixels in each half";
}

}  // namespace
}  // namespace throng::annotate
