// Formats of heads with known boxes: the expected lines follow from the formats' definitions.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/graphics/images/jpeg_writer.h"
#include "tests/formats/hand_made.h"

namespace throng::formats {
namespace {

using hand_made::Export;
using nlohmann::json;

/// A: head 8 px wide, visible and sharp. B: most of the head hidden, blurred. Outside: a head left
/// of the image. Ignored: fails the filters.
Image heads() {
  Image image = hand_made::image();
  const auto head = [](std::int64_t number, Eigen::Vector2d at, const Box& box, double visibility,
                       double blur_px) {
    Person made = hand_made::person(number, box, box, 1);
    made.head = at;
    made.head_box = box;
    made.head_visibility = visibility;
    made.record["difficulty"] = {{"blur_px", blur_px}};
    return made;
  };
  Person ignored = head(9, {30, 30}, {28, 28, 4, 4}, 1, 0);
  ignored.is_ignored = true;
  image.people = {head(3, {14.75, 22.5}, {10.5, 17.25, 8, 10.5}, 1, 1.9),
                  head(12, {60.2, 40}, {58.2, 38, 4, 4.5}, 0.25, 1),
                  head(13, {-1, 40}, {-3, 38, 4, 4}, 1, 0), ignored};
  image.record["environment"] = {{"weather", "rain"}};
  image.record["flight"] = {{"true", {{"height_m", 12.345}}}};
  return image;
}

/// The same of another run, with nobody in it.
Image nobody() {
  Image image = hand_made::image();
  image.run = "run000";
  image.file = "images/run000/d1/000004.jpg";
  image.split = Split::val;
  return image;
}

/// Exports with images of one gray.
class HeadExports : public ::testing::Test {
 protected:
  void run(const std::string& format, const std::vector<Image>& images, std::uint8_t gray = 100) {
    constexpr int kSize = 16;
    const std::vector<std::uint8_t> pixels(3UL * kSize * kSize, gray);
    for (const Image& image : images) {
      write_file_atomically(out_.root() / image.file, images::jpeg_bytes(pixels, kSize, kSize, 95));
    }
    out_.run(format, images);
  }
  Export out_;
};

TEST_F(HeadExports, OfNwpuHavePointsBoxesAndLists) {
  run("nwpu", {nobody(), heads()});
  EXPECT_EQ(out_.text("val.txt"), "0001 1 0\n") << "luminance 100 / 255, nobody";
  EXPECT_EQ(out_.text("train.txt"), "0002 1 1\n");
  EXPECT_FALSE(out_.has("test.txt"));
  EXPECT_TRUE(out_.has("images/0002.jpg"));
  const json record = json::parse(out_.text("jsons/0002.json"));
  EXPECT_EQ(record.at("img_id"), "0002.jpg");
  EXPECT_EQ(record.at("human_num"), 2);
  EXPECT_EQ(record.at("points"), json::parse("[[14.75, 22.5], [60.2, 40.0]]"));
  EXPECT_EQ(record.at("boxes"),
            json::parse("[[10.5, 17.25, 18.5, 27.75], [58.2, 38.0, 62.2, 42.5]]"));
  EXPECT_EQ(json::parse(out_.text("jsons/0001.json")).at("boxes"), json::array());
}

TEST_F(HeadExports, OfNwpuHaveLevelsOfLuminance) {
  for (const auto& [gray, level] : {std::pair(60, 0), {70, 1}, {150, 2}, {220, 3}}) {
    std::filesystem::remove_all(out_.root() / "out");
    run("nwpu", {nobody()}, static_cast<std::uint8_t>(gray));
    EXPECT_EQ(out_.text("val.txt"), "0001 " + std::to_string(level) + " 0\n") << gray;
  }
}

TEST_F(HeadExports, OfJhuCrowdHaveOcclusionBlurAndWeather) {
  out_.dataset().scenario = "square, busy";
  run("jhu-crowd", {nobody(), heads()});
  // 1.9 px are less than a quarter of 8 px; 1 px is a quarter of 4 px.
  EXPECT_EQ(out_.text("train/gt/0002.txt"), "14 22 8 11 1 0\n60 40 4 5 2 1\n");
  EXPECT_EQ(out_.text("train/image_labels.txt"), "0002,2,square  busy,2,0\n");
  EXPECT_EQ(out_.text("val/gt/0001.txt"), "");
  EXPECT_EQ(out_.text("val/image_labels.txt"), "0001,0,square  busy,0,1\n");
  EXPECT_TRUE(out_.has("train/images/0002.jpg"));
}

TEST_F(HeadExports, OfUpCountHaveTheHeightInTheName) {
  run("up-count", {nobody(), heads()});
  EXPECT_EQ(out_.text("labels/run002-d1/run002-d1__000005__12.35.txt"), "14 22\n60 40\n");
  EXPECT_TRUE(out_.has("images/run002-d1/run002-d1__000005__12.35.jpg"));
  EXPECT_EQ(out_.text("train.txt"), "run002-d1\n");
  EXPECT_EQ(out_.text("val.txt"), "run000-d1\n");
  EXPECT_EQ(out_.text("labels/run000-d1/run000-d1__000005__10.00.txt"), "")
      << "the camera's height where no flight is known";
}

TEST_F(HeadExports, OfMovingDroneCrowdHaveTracksOfBoxes) {
  run("movingdronecrowd", {nobody(), heads()});
  EXPECT_EQ(out_.text("annotations/run002/d1.csv"),
            "4,3,10.50,17.25,8.00,10.50\n4,12,58.20,38.00,4.00,4.50\n");
  EXPECT_TRUE(out_.has("frames/run002/d1/000005.jpg"));
  EXPECT_EQ(out_.text("train.txt"), "run002/d1\n");
  EXPECT_EQ(out_.text("annotations/run000/d1.csv"), "");
}

TEST_F(HeadExports, NeedABoxOfEachHead) {
  Image image = heads();
  image.people[0].head_box.reset();
  EXPECT_THROW(run("nwpu", {image}), InputError);
  EXPECT_THROW(choose_formats({"jhu-crowd"}, {"coco", "heads"}, "/outputs/formats"), InputError);
  EXPECT_THROW(choose_formats({"jhu-crowd"}, {"coco", "difficulty"}, "/outputs/formats"),
               InputError);
  EXPECT_NO_THROW(choose_formats({"jhu-crowd"}, {"coco", "heads", "difficulty"}, ""));
}

}  // namespace
}  // namespace throng::formats
