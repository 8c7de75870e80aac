// Images with alpha and rasters: written and read back, damaged files, files that would unpack to
// more than memory holds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <zlib.h>

#include "base/error.h"
#include "base/files/files.h"
#include "base/graphics/images/raster.h"
#include "base/graphics/images/rgba_image.h"

namespace throng::images {
namespace {

using ::testing::HasSubstr;

RgbaImage gradient() {
  RgbaImage image(5, 3);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    image.rgba[i] = static_cast<std::uint8_t>(37 * i);
  }
  return image;
}

// The message of the error that a call throws; "accepted" if it throws none.
template <typename Call>
std::string refused(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  return bytes;
}

// The first bytes of a gray PNG of this size, valid so far.
std::string head_of_png(std::uint32_t width, std::uint32_t height) {
  const std::string chunk =
      "IHDR" + big_endian(width) + big_endian(height) + std::string("\x08\x00\x00\x00\x00", 5);
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size()));
  return "\x89PNG\r\n\x1a\n" + big_endian(13) + chunk +
         big_endian(static_cast<std::uint32_t>(sum)) + big_endian(0) + "IDAT" +
         big_endian(0x35AF061E);
}

TEST(RgbaImages, PngKeepsEveryPixel) {
  const RgbaImage image = gradient();
  const RgbaImage read = decode_image(encode_png(image), "test");
  EXPECT_EQ(read.width, 5);
  EXPECT_EQ(read.height, 3);
  EXPECT_EQ(read.rgba, image.rgba);
}

TEST(RgbaImages, OtherBytesAreAnError) {
  EXPECT_THROW(decode_png("", "empty.png"), InputError);
  EXPECT_THROW(decode_png("GIF89a", "wrong.png"), InputError);
  const std::string png = encode_png(gradient());
  EXPECT_THROW(decode_png(png.substr(0, png.size() / 2), "cut.png"), InputError);
  EXPECT_THAT(refused([] { decode_image("GIF89a", "wrong.gif"); }), HasSubstr("wrong.gif"));
  EXPECT_THAT(refused([] { decode_image("\xFF\xD8\xFF", "cut.jpg"); }), HasSubstr("cut.jpg"));
  EXPECT_THAT(refused([&] { decode_image(head_of_png(60'000, 60'000), "large.png"); }),
              HasSubstr("60000 x 60000"));
}

TEST(Rasters, DamagedAndHugeFilesAreErrors) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "raster.png";
  const auto message_of = [&](const std::string& bytes) {
    write_file_atomically(file, bytes);
    return refused([&] { read_raster(file); });
  };
  EXPECT_THAT(message_of("no image"), HasSubstr("raster.png"));
  EXPECT_THAT(message_of(encode_png(gradient())), HasSubstr("gray or RGB of 8 or 16 bits"));
  EXPECT_THAT(message_of(head_of_png(8, 8)), HasSubstr("damaged PNG"));
  EXPECT_THAT(message_of(head_of_png(60'000, 60'000)), HasSubstr("60000 x 60000"));
  std::filesystem::remove(file);
  EXPECT_THAT(refused([&] { read_raster(file); }), HasSubstr("no such file"));
}

}  // namespace
}  // namespace throng::images
