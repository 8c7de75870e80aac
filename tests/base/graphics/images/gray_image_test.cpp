#include "base/graphics/images/gray_image.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::images {
namespace {

using ::testing::HasSubstr;

// Smooth with noise, of odd sizes, so that a wrong orientation, stride or weight shows.
cv::Mat photograph(int type) {
  cv::Mat image(37, 61, type);
  cv::theRNG().state = 17;
  cv::randu(image, 0, CV_MAT_DEPTH(type) == CV_16U ? 65536 : 256);
  cv::GaussianBlur(image, image, {5, 5}, 1.5);
  return image;
}

std::string encoded(const char* suffix, const cv::Mat& image,
                    const std::vector<int>& options = {}) {
  std::vector<unsigned char> bytes;
  cv::imencode(suffix, image, bytes, options);
  return {bytes.begin(), bytes.end()};
}

// OpenCV's own reader, which calibrations elsewhere use.
void expect_as_opencv(const std::string& bytes, const std::string& name) {
  const cv::Mat expected =
      cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_GRAYSCALE);
  const GrayImage image = decode_gray_image(bytes, name);
  ASSERT_EQ(cv::Size(image.width, image.height), expected.size()) << name;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      ASSERT_EQ(image.pixels[static_cast<std::size_t>(y) * image.width + x],
                expected.at<std::uint8_t>(y, x))
          << name << " at " << x << ", " << y;
    }
  }
}

// An APP1 segment that says nothing but the orientation, after the JPEG's first marker.
std::string with_orientation(const std::string& jpeg, int orientation, bool big_endian) {
  std::string tiff = big_endian
                         ? std::string("MM\0\x2A\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 19)
                         : std::string("II\x2A\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 18);
  tiff += static_cast<char>(orientation);
  tiff += std::string(big_endian ? 6 : 7, '\0');
  const std::string data = std::string("Exif\0\0", 6) + tiff;
  const std::size_t size = data.size() + 2;
  return jpeg.substr(0, 2) + "\xFF\xE1" + static_cast<char>(size >> 8) + static_cast<char>(size) +
         data + jpeg.substr(2);
}

std::string refusal(const std::string& bytes) {
  try {
    decode_gray_image(bytes, "photo.jpg");
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

TEST(GrayImage, EqualsTheImageOfOpenCv) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    expect_as_opencv(encoded(".jpg", photograph(type)), "jpg");
    expect_as_opencv(encoded(".jpg", photograph(type), {cv::IMWRITE_JPEG_PROGRESSIVE, 1}),
                     "progressive");
  }
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3}) {
    expect_as_opencv(encoded(".png", photograph(type)), "png of type " + std::to_string(type));
  }
  expect_as_opencv(encoded(".png", photograph(CV_8UC1), {cv::IMWRITE_PNG_BILEVEL, 1}), "1 bit");
}

TEST(GrayImage, IsTurnedUpright) {
  const std::string jpeg = encoded(".jpg", photograph(CV_8UC1));
  for (int orientation = 0; orientation <= 9; ++orientation) {
    for (const bool big_endian : {false, true}) {
      expect_as_opencv(with_orientation(jpeg, orientation, big_endian),
                       "orientation " + std::to_string(orientation));
    }
  }
}

TEST(GrayImage, DamagedFilesAreRefused) {
  EXPECT_THAT(refusal(""), HasSubstr("photo.jpg: found 0 bytes of another kind"));
  EXPECT_THAT(refusal("GIF89a"), HasSubstr("expected a JPEG or PNG image"));
  const std::string png = encoded(".png", photograph(CV_8UC3));
  EXPECT_THAT(refusal(png.substr(0, 20)), HasSubstr("a damaged PNG: cut off"));
  EXPECT_THAT(refusal(png.substr(0, png.size() / 2)), HasSubstr("a damaged PNG"));
  std::string huge = png;
  huge.replace(16, 8, std::string("\0\x0F\x42\x40\0\x0F\x42\x40", 8));  // a million squared
  EXPECT_NE(refusal(huge), "taken");
  const std::string jpeg = encoded(".jpg", photograph(CV_8UC3));
  for (std::size_t size = 0; size < 100; size += 7) {
    EXPECT_NE(refusal(jpeg.substr(0, size)), "taken") << size;
  }
}

}  // namespace
}  // namespace throng::images
