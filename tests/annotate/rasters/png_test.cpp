#include "annotate/rasters/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <limits>
#include <vector>

#include "base/compute/random.h"
#include "tests/annotate/synthetic_frame.h"

namespace throng::annotate {
namespace {

/// A file as libpng decodes it: its format's bits and samples.
struct Decoded {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bits = 0;
  int channels = 0;
  std::vector<std::uint16_t> samples;
};

struct Source {
  const std::string* bytes;
  std::size_t at;
};

void read_from(png_structp png, png_bytep to, png_size_t count) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  ASSERT_LE(source->at + count, source->bytes->size());
  std::memcpy(to, source->bytes->data() + source->at, count);
  source->at += count;
}

Decoded decode(const std::string& bytes) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  Source source{&bytes, 0};
  png_set_read_fn(png, &source, read_from);
  png_read_info(png, info);
  Decoded decoded{png_get_image_width(png, info),
                  png_get_image_height(png, info),
                  png_get_bit_depth(png, info),
                  png_get_channels(png, info),
                  {}};
  std::vector<png_byte> row(png_get_rowbytes(png, info));
  for (std::uint32_t y = 0; y < decoded.height; ++y) {
    png_read_row(png, row.data(), nullptr);
    for (std::size_t i = 0; i < row.size(); i += decoded.bits / 8) {
      decoded.samples.push_back(
          decoded.bits == 8 ? row[i] : static_cast<std::uint16_t>(row[i] << 8 | row[i + 1]));
    }
  }
  png_read_end(png, info);
  EXPECT_EQ(source.at, bytes.size()) << "nothing follows the image";
  png_destroy_read_struct(&png, &info, nullptr);
  return decoded;
}

TEST(Png, GivesBackNoiseOfAnySizeAndDepthExactly) {
  for (const int width : {1, 7, 640}) {
    for (const int channels : {1, 3}) {
      const Raster raster{width, 37, channels};
      const auto count = static_cast<std::size_t>(width) * 37 * channels;
      std::vector<std::uint8_t> bytes(count);
      std::vector<std::uint16_t> words(count);
      Random random(3, Stream::crowd_generator, static_cast<std::uint64_t>(width));
      for (std::size_t i = 0; i < count; ++i) {
        words[i] = static_cast<std::uint16_t>(random.uniform(0, 65535.9));
        bytes[i] = static_cast<std::uint8_t>(words[i]);
      }
      const Decoded eight = decode(png_bytes(raster, bytes));
      EXPECT_EQ(eight.bits, 8);
      EXPECT_EQ(eight.channels, channels);
      EXPECT_EQ(eight.width, width);
      EXPECT_TRUE(
          std::equal(bytes.begin(), bytes.end(), eight.samples.begin(), eight.samples.end()));
      const Decoded sixteen = decode(png_bytes(raster, words));
      EXPECT_EQ(sixteen.bits, 16);
      EXPECT_EQ(sixteen.samples, words);
    }
  }
}

TEST(Png, DepthIsInCentimetersAndTheSkyZero) {
  render::Frame frame = empty_frame(5, 1);
  frame.depth_m = {std::numeric_limits<float>::infinity(), 12.344F, 655.35F, 700.0F, 0.001F};
  // A surface that touches the lens is no sky.
  EXPECT_EQ(decode(depth_png(frame)).samples, (std::vector<std::uint16_t>{0, 1234, 65535, 0, 1}));
}

TEST(Png, InstancesTellPeopleAndThingsApart) {
  render::Frame frame = empty_frame(5, 1);
  frame.id = {render::kIdNothing, render::id_of_agent(70'000), render::kIdBuilding + 258,
              render::kIdGround, render::id_of_umbrella(70'000)};
  const Decoded decoded = decode(instance_png(frame));
  std::vector<std::uint32_t> ids;
  for (std::size_t i = 0; i < 15; i += 3) {
    ids.push_back(decoded.samples[i] + 256U * decoded.samples[i + 1] +
                  65536U * decoded.samples[i + 2]);
  }
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{0, 70'001, 0x800102, 0xFF0000, 0x400000 + 70'001}));
}

TEST(Png, SurfacesAreTheNumbersOfTheirClasses) {
  render::Frame frame = empty_frame(4, 1);
  frame.surface = {0, 4, 12, 33};
  EXPECT_EQ(decode(semantic_png(frame)).samples, (std::vector<std::uint16_t>{0, 4, 12, 33}));
}

TEST(Png, FlowIsKittis) {
  render::Frame frame = empty_frame(4, 1);
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  frame.flow = {1.5F, -2, unknown, 1, 3, unknown, 600, 0};
  EXPECT_EQ(decode(flow_png(frame)).samples,
            (std::vector<std::uint16_t>{32864, 32640, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(PngDeathTest, RefusesSamplesThatAreNotThere) {
  const std::vector<std::uint8_t> samples(5);
  EXPECT_DEATH(png_bytes({2, 3, 1}, samples), "samples");
}

}  // namespace
}  // namespace throng::annotate
