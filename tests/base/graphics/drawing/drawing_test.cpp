#include "base/graphics/drawing/drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "tests/world/temporary_folder.h"

namespace throng::drawing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr Color kRed{{255, 0, 0}};
constexpr Color kBlue{{0, 0, 255}};

Shape square(double min_px, double max_px, const Color& fill) {
  Shape shape;
  shape.points = {{min_px, min_px}, {max_px, min_px}, {max_px, max_px}, {min_px, max_px}};
  shape.fill = fill;
  return shape;
}

Drawing make_drawing(std::vector<Shape> shapes) { return {100, 60, "Test", std::move(shapes)}; }

/// The pixels as another library decodes them, BGR.
cv::Mat pixels(const Drawing& drawing) {
  const std::string png = to_png(drawing);
  return cv::imdecode(
      cv::Mat(1, static_cast<int>(png.size()), CV_8U, const_cast<char*>(png.data())),
      cv::IMREAD_COLOR);
}

cv::Vec3b at(const cv::Mat& image, int x, int y) { return image.at<cv::Vec3b>(y, x); }

TEST(Drawing, HasTheSizeAndAWhiteBackground) {
  const cv::Mat image = pixels(make_drawing({}));
  EXPECT_EQ(image.size(), cv::Size(100, 60));
  EXPECT_EQ(at(image, 50, 30), cv::Vec3b(255, 255, 255));
}

TEST(Drawing, FillsPolygonsInOrder) {
  const cv::Mat image = pixels(make_drawing({square(10, 40, kRed), square(20, 30, kBlue)}));
  EXPECT_EQ(at(image, 15, 15), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(at(image, 25, 25), cv::Vec3b(255, 0, 0));
  EXPECT_EQ(at(image, 9, 15), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(at(image, 40, 15), cv::Vec3b(255, 255, 255));
}

TEST(Drawing, BlendsByOpacity) {
  const cv::Mat image = pixels(make_drawing({square(10, 40, {{255, 0, 0}, 0.5})}));
  EXPECT_NEAR(at(image, 20, 20)[0], 128, 1);
  EXPECT_EQ(at(image, 20, 20)[2], 255);
}

TEST(Drawing, StrokesCirclesAtTheirRadius) {
  Shape circle;
  circle.kind = Shape::Kind::circle;
  circle.points = {{50, 30}};
  circle.radius_px = 20;
  circle.width_px = 2;
  circle.stroke = kBlue;
  const cv::Mat image = pixels(make_drawing({circle}));
  EXPECT_EQ(at(image, 50, 30), cv::Vec3b(255, 255, 255)) << "not filled";
  EXPECT_EQ(at(image, 69, 29), cv::Vec3b(255, 0, 0));
  EXPECT_EQ(at(image, 74, 29), cv::Vec3b(255, 255, 255));
}

TEST(Drawing, EndsArrowsWithAHead) {
  Shape line;
  line.kind = Shape::Kind::line;
  line.points = {{10, 30}, {80, 30}};
  line.stroke = kRed;
  line.width_px = 2;
  const cv::Vec3b white(255, 255, 255);
  EXPECT_EQ(at(pixels(make_drawing({line})), 71, 33), white);
  line.arrow = true;
  EXPECT_EQ(at(pixels(make_drawing({line})), 71, 33), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(at(pixels(make_drawing({line})), 60, 33), white);
}

TEST(Drawing, WritesTextOnItsBaseline) {
  Shape text;
  text.kind = Shape::Kind::text;
  text.points = {{10, 40}};
  text.text = "H";
  text.font_px = 20;
  text.fill = kRed;
  cv::Mat ink;
  cv::inRange(pixels(make_drawing({text})), cv::Scalar(0, 0, 0), cv::Scalar(254, 254, 255), ink);
  cv::Mat places;
  cv::findNonZero(ink, places);
  ASSERT_FALSE(places.empty());
  const cv::Rect box = cv::boundingRect(places);
  EXPECT_NEAR(box.y + box.height, 40, 1) << "a capital stands on the baseline";
  EXPECT_NEAR(box.height, 0.72 * 20, 2) << "cap height of usual sans-serif fonts";
  EXPECT_NEAR(box.x, 11, 3);
}

TEST(Drawing, SurvivesTextOfAnyBytes) {
  Shape text;
  text.kind = Shape::Kind::text;
  text.points = {{10, 40}};
  text.fill = kRed;
  for (const char* bytes :
       {"", "<&>\"'", "caf\xC3\xA9", "broken \xC3", "\xFF\xFE", "\xE6\x97\xA5"}) {
    text.text = bytes;
    EXPECT_THAT(to_svg(make_drawing({text})), HasSubstr("</svg>")) << bytes;
    EXPECT_THAT(to_pdf(make_drawing({text})), HasSubstr("%%EOF")) << bytes;
  }
}

TEST(Drawing, IgnoresShapesWithoutPoints) {
  Shape line;
  line.kind = Shape::Kind::line;
  line.stroke = kRed;
  line.arrow = true;
  Shape text;
  text.kind = Shape::Kind::text;
  Shape dot = line;
  dot.points = {{5, 5}};
  EXPECT_EQ(to_png(make_drawing({line, text, Shape{}, dot})).substr(0, 4), "\x89PNG");
}

TEST(Drawing, EqualDrawingsHaveEqualBytes) {
  const Drawing drawing = make_drawing({square(10, 40, kRed)});
  EXPECT_EQ(to_svg(drawing), to_svg(drawing));
  EXPECT_THAT(to_svg(drawing), HasSubstr("width=\"100px\" height=\"60px\""));
  EXPECT_EQ(to_png(drawing), to_png(drawing));
  EXPECT_EQ(to_pdf(drawing), to_pdf(drawing));
  EXPECT_THAT(to_pdf(drawing), HasSubstr("20000101")) << "not the time of the run";
}

// hsl() of the CSS Color Module, its own table of examples.
TEST(Drawing, HuesAreThoseOfCss) {
  using Rgb = std::array<std::uint8_t, 3>;
  EXPECT_EQ(from_hsl(0, 1, 0.5).rgb, (Rgb{255, 0, 0}));
  EXPECT_EQ(from_hsl(120, 1, 0.25).rgb, (Rgb{0, 128, 0}));
  EXPECT_EQ(from_hsl(240, 1, 0.5).rgb, (Rgb{0, 0, 255}));
  EXPECT_EQ(from_hsl(60, 1, 0.5).rgb, (Rgb{255, 255, 0}));
  EXPECT_EQ(from_hsl(77, 0, 0.4).rgb, (Rgb{102, 102, 102}));
}

TEST(Drawing, IsWrittenInTheFormatOfTheSuffix) {
  const throng::testing::TemporaryFolder folder;
  const Drawing drawing = make_drawing({square(10, 40, kRed)});
  for (const auto& [name, head] :
       {std::pair{"a.svg", "<?xml"}, std::pair{"a.png", "\x89PNG"}, std::pair{"a.pdf", "%PDF"}}) {
    write_drawing(drawing, folder.path() / name);
    EXPECT_THAT(read_file(folder.path() / name), StartsWith(head));
  }
  EXPECT_THROW(write_drawing(drawing, folder.path() / "a.bmp"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.bmp"));
}

}  // namespace
}  // namespace throng::drawing
