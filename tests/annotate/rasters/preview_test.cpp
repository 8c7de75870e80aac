#include "annotate/rasters/preview.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <array>
#include <cmath>

#include "base/graphics/images/jpeg_writer.h"
#include "tests/annotate/synthetic_frame.h"

namespace throng::annotate {
namespace {

SyntheticScene small_crowd() {
  SyntheticScene scene;
  scene.width = 320;
  scene.height = 240;
  return scene;
}

TEST(Preview, DrawsEachBoxInItsOwnColorAndNothingElseBelowTheCaption) {
  render::Frame frame = empty_frame(320, 240);
  for (std::uint32_t agent : {4, 9}) {
    frame.people.emplace_back().agent = agent;
    const int x0 = agent == 4 ? 50 : 200;
    for (int y = 100; y < 140; ++y) {
      for (int x = x0; x < x0 + 20; ++x) frame.id[y * 320 + x] = render::id_of_agent(agent);
    }
  }
  const std::vector<std::uint8_t> rgb = draw_preview(frame, label_people(frame));
  ASSERT_EQ(rgb.size(), frame.rgb.size());
  const auto pixel = [&](int x, int y) {
    const std::size_t at = std::size_t{3} * (y * 320 + x);
    return std::array{rgb[at], rgb[at + 1], rgb[at + 2]};
  };
  EXPECT_EQ(pixel(50, 100), pixel(69, 139));
  EXPECT_EQ(pixel(200, 100), pixel(219, 120));
  EXPECT_NE(pixel(50, 100), pixel(200, 100));
  int changed = 0;
  for (int y = 60; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const std::size_t at = std::size_t{3} * (y * 320 + x);
      if (!std::equal(&rgb[at], &rgb[at] + 3, &frame.rgb[at])) ++changed;
    }
  }
  EXPECT_EQ(changed, 2 * (2 * 20 + 2 * 40 - 4)) << "the outlines are one pixel thin";
}

TEST(Preview, IsTheSameEveryTime) {
  const render::Frame frame = synthetic_frame(small_crowd());
  const FrameLabels labels = label_people(frame);
  EXPECT_EQ(draw_preview(frame, labels), draw_preview(frame, labels));
}

TEST(Preview, FitsIntoTinyImages) {
  const render::Frame frame = empty_frame(5, 3);
  EXPECT_EQ(draw_preview(frame, label_people(frame)).size(), 45U);
}

TEST(JpegBytes, DecodeToTheImage) {
  const render::Frame frame = empty_frame(321, 123);
  const std::string jpeg = images::jpeg_bytes(frame.rgb, 321, 123, 95);
  EXPECT_EQ(jpeg, images::jpeg_bytes(frame.rgb, 321, 123, 95));
  EXPECT_LT(images::jpeg_bytes(frame.rgb, 321, 123, 10).size(), jpeg.size());

  tjhandle decoder = tjInitDecompress();
  const auto* bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
  int width = 0, height = 0, subsampling = 0, colors = 0;
  ASSERT_EQ(
      tjDecompressHeader3(decoder, bytes, jpeg.size(), &width, &height, &subsampling, &colors), 0);
  EXPECT_EQ(width, 321);
  EXPECT_EQ(height, 123);
  EXPECT_EQ(subsampling, TJSAMP_420);
  std::vector<unsigned char> rgb(frame.rgb.size());
  ASSERT_EQ(tjDecompress2(decoder, bytes, jpeg.size(), rgb.data(), width, 0, height, TJPF_RGB, 0),
            0);
  tjDestroy(decoder);
  double error = 0;
  for (std::size_t i = 0; i < rgb.size(); ++i) error += std::abs(rgb[i] - frame.rgb[i]);
  EXPECT_LT(error / rgb.size(), 2);
}

}  // namespace
}  // namespace throng::annotate
