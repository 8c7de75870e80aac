#include "annotate/rasters/density.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "base/compute/random.h"
#include "base/files/zip_member.h"

namespace throng::annotate {
namespace {

using Eigen::Vector2d;
using Heads = std::vector<Vector2d>;

TEST(DensityMap, OneHeadIsAGaussianAboutIt) {
  const double sigma = 3;
  const DensityMap map = density_map(Heads{{30.7, 20.2}}, 64, 48, sigma);
  ASSERT_EQ(map.value.size(), 64U * 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double dx = x + 0.5 - 30.7;
      const double dy = y + 0.5 - 20.2;
      const bool is_far = std::max(std::abs(dx), std::abs(dy)) > 4 * sigma + 1;
      const double gauss =
          std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma)) / (2 * M_PI * sigma * sigma);
      EXPECT_NEAR(map.value[y * 64 + x], is_far ? 0 : gauss, 1e-5);
    }
  }
}

// Inside, on borders and in corners, narrow and wide kernels, kernels wider than the image.
TEST(DensityMap, EveryHeadInsideSumsToOne) {
  for (const double sigma : {0.01, 0.5, 4.0, 15.0, 100.0}) {
    for (const Vector2d& head : Heads{{32, 24},
                                      {0, 0},
                                      {63.999, 47.999},
                                      {0, 47.5},
                                      {std::nextafter(64.0, 0.0), 0},
                                      {12.5, 12.5},
                                      {1e-300, 3}}) {
      const DensityMap map = density_map(Heads{head}, 64, 48, sigma);
      EXPECT_NEAR(map.sum(), 1, 1e-6) << head.transpose() << " sigma " << sigma;
      for (const float value : map.value) EXPECT_GE(value, 0);
    }
  }
}

TEST(DensityMap, HeadsOutsideDoNotCount) {
  const Heads outside = {{-0.001, 5}, {5, -0.001}, {64, 5}, {5, 48}, {1e9, 1e9}, {-1e300, 5}};
  EXPECT_EQ(density_map(outside, 64, 48, 4).sum(), 0);
}

TEST(DensityMap, TwoHeadsInOnePixelBothCount) {
  const Heads heads(7, Vector2d(10.5, 10.5));
  EXPECT_NEAR(density_map(heads, 64, 48, 4).sum(), 7, 1e-5);
}

TEST(DensityMap, ThousandsOfHeadsSumToTheirCount) {
  Random random(1, Stream::crowd_generator);
  Heads heads;
  for (int i = 0; i < 5000; ++i) heads.emplace_back(random.uniform(0, 320), random.uniform(0, 200));
  EXPECT_NEAR(density_map(heads, 320, 200, 4).sum(), 5000, 5e-3);
  EXPECT_NEAR(density_map(Heads(5000, {3, 3}), 320, 200, 15).sum(), 5000, 5e-3);
}

TEST(NpyBytes, HasTheHeaderThatNumpyReads) {
  DensityMap map{3, 2, {0, 1, 2, 3, 4, 5.5F}};
  const std::string bytes = npy_bytes(map);
  ASSERT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t length =
      static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ((10 + length) % 64, 0U);
  const std::string header = bytes.substr(10, length);
  EXPECT_EQ(header.find("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }"), 0U);
  EXPECT_EQ(header.back(), '\n');
  ASSERT_EQ(bytes.size(), 10 + length + 6 * sizeof(float));
  std::vector<float> values(6);
  std::memcpy(values.data(), bytes.data() + 10 + length, 6 * sizeof(float));
  EXPECT_EQ(values, map.value);
}

TEST(NpzBytes, HoldTheArrayWithoutLossInLittleRoom) {
  Random random(3, Stream::crowd_generator);
  Heads heads;
  for (int i = 0; i < 300; ++i) heads.emplace_back(random.uniform(0, 1280), random.uniform(0, 720));
  const DensityMap map = density_map(heads, 1280, 720, 4);
  const std::string zip = npz_bytes(map);
  EXPECT_EQ(zip_member(zip, "density.npy", 4'000'000), npy_bytes(map));
  EXPECT_LT(zip.size(), npy_bytes(map).size() / 3);
}

TEST(NpyBytes, AlignsForAnySize) {
  for (const int width : {1, 99, 1234, 99999, 1234567}) {
    const DensityMap map{width, 1, std::vector<float>(width)};
    EXPECT_EQ((npy_bytes(map).size() - width * sizeof(float)) % 64, 0U);
  }
}

}  // namespace
}  // namespace throng::annotate
