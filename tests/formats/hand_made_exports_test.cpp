// Exports of one picture with known boxes: the expected lines are computed by hand from the
// formats' definitions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "annotate/png.h"
#include "base/error.h"
#include "formats/card.h"
#include "tests/formats/hand_made.h"
#include "tests/formats/readers.h"

namespace throng::formats {
namespace {

using hand_made::Export;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// A: fully visible, B: half hidden and cut off by the left edge, C: fails the filters, and D, of
/// whom nothing is visible.
Image crossing() {
  Image image = hand_made::image();
  Person a = hand_made::person(3, {10, 20, 8, 30}, {10, 20, 8, 30}, 1);
  Person b = hand_made::person(12, {0, 40, 6, 20}, {-6, 38, 12, 24}, 0.417);
  b.truncation = 0.5;
  b.state = "lying";
  Person c = hand_made::person(25, {60, 10, 4, 6}, {60, 10, 4, 6}, 0.1);
  c.is_ignored = true;
  a.head = Eigen::Vector2d(14, 22);
  b.head = Eigen::Vector2d(-2, 40);
  image.people = {a, b, c};
  image.hidden = {{2'000'031, {70.5, 30.25, 5, 12}, false}, {2'000'032, {1, 2, 3, 4}, true}};
  return image;
}

TEST(HandMadeMot, HasWholeBodiesCountedFromOne) {
  Export out;
  out.run("mot", {crossing()});
  EXPECT_EQ(out.text("train/run002-d1/gt/gt.txt"),
            "5,3,11.000,21.000,8.000,30.000,1,1,1.00000\n"
            "5,12,-5.000,39.000,12.000,24.000,1,1,0.41700\n"
            "5,25,61.000,11.000,4.000,6.000,0,1,0.10000\n"
            "5,31,71.500,31.250,5.000,12.000,1,1,0\n"
            "5,32,2.000,3.000,3.000,4.000,0,1,0\n");
  EXPECT_EQ(out.text("train/run002-d1/det/det.txt"),
            "5,-1,11,21,8,30,1.00000,-1,-1,-1\n"
            "5,-1,1,41,6,20,0.41700,-1,-1,-1\n");
  EXPECT_EQ(out.text("train/run002-d1/seqinfo.ini"),
            "[Sequence]\nname=run002-d1\nimDir=img1\nframeRate=2\nseqLength=10\nimWidth=100\n"
            "imHeight=80\nimExt=.jpg\n");
  EXPECT_EQ(out.text("train/run002-d1/img1/000005.jpg"), "JPEG images/run002/d1/000004.jpg");
}

TEST(HandMadeMot, KeepsSequencesApart) {
  Image first = crossing();
  Image second = crossing();
  second.camera = "d2";
  second.file = "images/run002/d2/000004.jpg";
  second.people.resize(1);
  second.hidden.clear();
  Export out;
  out.run("mot", {first, second});
  EXPECT_EQ(out.text("train/run002-d2/gt/gt.txt"), "5,3,11.000,21.000,8.000,30.000,1,1,1.00000\n");
  EXPECT_THAT(out.text("train/run002-d2/seqinfo.ini"), HasSubstr("name=run002-d2\n"));
}

TEST(HandMadeMots, NumbersPeopleByClassAndHasOneIgnoreRegion) {
  Export out;
  Image image = crossing();
  image.people.push_back(hand_made::person(1234, {80, 60, 2, 2}, {80, 60, 2, 2}, 1));
  out.run("mots", {image});
  const auto lines = lines_of(out.root() / "out/train/run002-d1/gt/gt.txt");
  ASSERT_EQ(lines.size(), 4);
  EXPECT_EQ(lines[0], "5 2003 2 80 100 " + hand_made::filled(10, 20, 8, 30));
  EXPECT_EQ(lines[1], "5 2012 2 80 100 " + hand_made::filled(0, 40, 6, 20));
  EXPECT_EQ(lines[2].substr(0, lines[2].rfind(' ')), "5 2001234 2 80 100") << "more digits";
  EXPECT_EQ(lines[3], "5 10000 10 80 100 " + hand_made::filled(60, 10, 4, 6));
}

TEST(HandMadeYolo, HasCentersAndSizesAsShares) {
  Export out;
  out.run("yolo-detect", {crossing()});
  // A: center (14, 35) of 100 x 80, size 8 x 30.
  EXPECT_EQ(out.text("labels/train/run002-d1-000004.txt"),
            "0 0.140000 0.437500 0.080000 0.375000\n"
            "0 0.030000 0.625000 0.060000 0.250000\n");
  EXPECT_EQ(out.text("data.yaml"), "train: images/train\nnc: 1\nnames:\n  0: \"person\"\n");
  EXPECT_TRUE(out.has("images/train/run002-d1-000004.jpg"));
}

TEST(HandMadeYolo, CountsDronesAfterPeoplesClasses) {
  Export out;
  out.dataset().categories = {"woman", "man"};
  out.dataset().sees_drones = true;
  Image image = crossing();
  image.people[0].category = 1;
  image.drones = {hand_made::person(99'985, {50, 0, 10, 8}, {50, 0, 10, 8}, 1)};
  out.run("yolo-detect", {image});
  EXPECT_EQ(out.text("labels/train/run002-d1-000004.txt"),
            "1 0.140000 0.437500 0.080000 0.375000\n"
            "0 0.030000 0.625000 0.060000 0.250000\n"
            "2 0.550000 0.050000 0.100000 0.100000\n");
  EXPECT_THAT(out.text("data.yaml"),
              HasSubstr("nc: 3\nnames:\n  0: \"woman\"\n  1: \"man\"\n  2: \"drone\"\n"));
}

TEST(HandMadeYolo, PosesHaveKeypointsAndTheirMirror) {
  Export out;
  Image image = crossing();
  image.people.resize(1);
  for (int i = 0; i < 17; ++i) image.people[0].keypoints.push_back({10.0 + i, 20, 2});
  image.people[0].keypoints[16] = {0, 0, 0};
  out.run("yolo-pose", {image});
  const auto line = numbers_of(lines_of(out.root() / "out/labels/train/run002-d1-000004.txt")[0]);
  ASSERT_EQ(line.size(), 5 + 51);
  EXPECT_DOUBLE_EQ(line[5], 0.10);
  EXPECT_DOUBLE_EQ(line[6], 0.25);
  EXPECT_EQ(line[7], 2);
  EXPECT_EQ(line[55], 0);
  const std::string yaml = out.text("data.yaml");
  EXPECT_THAT(yaml, HasSubstr("kpt_shape: [17, 3]"));
  // COCO's order is nose, then left before right.
  EXPECT_THAT(yaml, HasSubstr("flip_idx: [0,2,1,4,3,6,5,8,7,10,9,12,11,14,13,16,15]"));
}

TEST(HandMadeYolo, SegmentsEncloseTheMask) {
  Export out;
  Image image = crossing();
  image.people.resize(1);
  out.run("yolo-segment", {image});
  const auto line = numbers_of(lines_of(out.root() / "out/labels/train/run002-d1-000004.txt")[0]);
  ASSERT_GE(line.size(), 1 + 8);
  double twice = 0;
  const std::size_t corners = (line.size() - 1) / 2;
  for (std::size_t i = 0; i < corners; ++i) {
    const double x = line[1 + 2 * i] * 100;
    const double y = line[2 + 2 * i] * 80;
    const std::size_t k = (i + 1) % corners;
    EXPECT_TRUE(x >= 10 && x <= 18 && y >= 20 && y <= 50) << x << " " << y;
    twice += x * line[2 + 2 * k] * 80 - line[1 + 2 * k] * 100 * y;
  }
  EXPECT_NEAR(std::abs(twice) / 2, 7 * 29, 1) << "between the middles of its outer pixels";
}

TEST(HandMadeVisDrone, HasClassesOfTruncationAndOcclusion) {
  Export out;
  out.run("visdrone-det", {crossing()});
  EXPECT_EQ(out.text("train/annotations/run002-d1-000004.txt"),
            "10,20,8,30,1,1,0,0\n"
            "0,40,6,20,1,2,1,2\n"  // lying: category people; more than half hidden
            "60,10,4,6,0,0,0,2\n");
  Export mot;
  mot.run("visdrone-mot", {crossing()});
  EXPECT_EQ(mot.text("train/annotations/run002-d1.txt"),
            "5,3,10,20,8,30,1,1,0,0\n"
            "5,12,0,40,6,20,1,2,1,2\n"
            "5,25,60,10,4,6,0,0,0,2\n");
  EXPECT_TRUE(mot.has("train/sequences/run002-d1/0000005.jpg"));
}

TEST(HandMadeVisDrone, DrawsTheLineOfOcclusionAtAHalf) {
  const auto occlusion = [](double visibility) {
    Export out;
    Image image = crossing();
    image.people.resize(1);
    image.people[0].visibility = visibility;
    out.run("visdrone-det", {image});
    return numbers_of(out.text("train/annotations/run002-d1-000004.txt")).back();
  };
  EXPECT_EQ(occlusion(0.996), 0);
  EXPECT_EQ(occlusion(0.99), 1);
  EXPECT_EQ(occlusion(0.5), 1);
  EXPECT_EQ(occlusion(0.49), 2);
}

TEST(HandMadeUavdt, HasNumbersOfItsOwn) {
  Export out;
  out.run("uavdt", {crossing()});
  EXPECT_EQ(out.text("train/GT/run002-d1_gt_whole.txt"),
            "5,3,10,20,8,30,1,1,4\n"
            "5,12,0,40,6,20,2,3,4\n");
  EXPECT_EQ(out.text("train/GT/run002-d1_gt_ignore.txt"), "5,25,60,10,4,6,1,2,4\n");
  EXPECT_TRUE(out.has("train/UAV-benchmark-M/run002-d1/img000005.jpg"));
}

TEST(HandMadeUavdt, ClassesOcclusionByThirds) {
  const auto line_of = [](double visibility, double truncation) {
    Export out;
    Image image = crossing();
    image.people.resize(1);
    image.people[0].visibility = visibility;
    image.people[0].truncation = truncation;
    out.run("uavdt", {image});
    const auto numbers = numbers_of(out.text("train/GT/run002-d1_gt_whole.txt"));
    return std::pair(numbers.at(6), numbers.at(7));
  };
  EXPECT_EQ(line_of(1, 0), std::pair(1.0, 1.0));
  EXPECT_EQ(line_of(0.71, 0.1), std::pair(3.0, 4.0));
  EXPECT_EQ(line_of(0.69, 0.29), std::pair(3.0, 3.0));
  EXPECT_EQ(line_of(0.31, 0.31), std::pair(2.0, 3.0));
  EXPECT_EQ(line_of(0.29, 0.9), std::pair(2.0, 2.0));
}

TEST(HandMadeKitti, PutsPeopleIntoTheCamerasFrame) {
  Export out;
  Image image = crossing();
  // 2 m right of the axis, 20 m ahead, on the ground: x 2, y 10 (down), z 20 in the camera.
  image.people[0].box_middle = {2, 20, 0.9};
  image.people[0].box_size = {0.4, 0.6, 1.8};
  image.people[0].heading_rad = 0.25;  // to the right and a little away
  image.people[1].box_middle = {0, 10, 0.2};
  image.people[1].box_size = {1.7, 0.5, 0.4};
  image.people[1].heading_rad = std::acos(-1) / 2;  // away from the camera
  out.run("kitti", {image});
  // alpha = rotation_y - atan2(x, z): -0.25 - atan2(2, 20) = -0.3497; heading away is -pi / 2.
  EXPECT_EQ(out.text("train/label_2/run002-d1-000004.txt"),
            "Pedestrian 0.00 0 -0.3497 10.00 20.00 18.00 50.00 1.800 0.600 0.400 2.000 10.000 "
            "20.000 -0.2500\n"
            "Pedestrian 0.50 2 -1.5708 0.00 40.00 6.00 60.00 0.400 0.500 1.700 0.000 10.000 10.000 "
            "-1.5708\n"
            "DontCare -1 -1 -10 60.00 10.00 64.00 16.00 -1 -1 -1 -1000 -1000 -1000 -10\n");
  const auto calib = lines_of(out.root() / "out/train/calib/run002-d1-000004.txt");
  ASSERT_EQ(calib.size(), 6);
  EXPECT_THAT(numbers_of(calib[2].substr(3)),
              ::testing::ElementsAre(50, 0, 49.5, 0, 0, 50, 39.5, 0, 0, 0, 1, 0));
  EXPECT_EQ(calib[4], "R0_rect: 1 0 0 0 1 0 0 0 1");
  EXPECT_THAT(numbers_of(calib[5].substr(calib[5].find(':') + 1)),
              ::testing::ElementsAre(1, 0, 0, 0, 0, 0, -1, 10, 0, 1, 0, 0));
}

TEST(HandMadeKitti, HasThreeClassesOfOcclusion) {
  const auto occlusion = [](double visibility) {
    Export out;
    Image image = crossing();
    image.people.resize(1);
    image.people[0].visibility = visibility;
    image.people[0].box_middle = {0, 10, 1};
    out.run("kitti", {image});
    return out.text("train/label_2/run002-d1-000004.txt").substr(16, 1);
  };
  EXPECT_EQ(occlusion(0.9), "0");
  EXPECT_EQ(occlusion(0.89), "1");
  EXPECT_EQ(occlusion(0.5), "1");
  EXPECT_EQ(occlusion(0.49), "2");
}

TEST(HandMadeVoc, HasCornersFromOneAndFlags) {
  Export out;
  out.run("voc", {crossing()});
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(out.text("Annotations/run002-d1-000004.xml").c_str()), tinyxml2::XML_SUCCESS);
  const auto* root = xml.RootElement();
  EXPECT_STREQ(root->FirstChildElement("source")->FirstChildElement("database")->GetText(),
               "hand <made>")
      << "escaped";
  EXPECT_EQ(root->FirstChildElement("size")->FirstChildElement("width")->IntText(), 100);
  EXPECT_EQ(root->FirstChildElement("size")->FirstChildElement("height")->IntText(), 80);
  std::vector<std::vector<int>> objects;
  for (const auto* object = root->FirstChildElement("object"); object != nullptr;
       object = object->NextSiblingElement("object")) {
    EXPECT_STREQ(object->FirstChildElement("name")->GetText(), "person");
    const auto* box = object->FirstChildElement("bndbox");
    auto& row = objects.emplace_back();
    for (const char* key : {"xmin", "ymin", "xmax", "ymax"}) {
      row.push_back(box->FirstChildElement(key)->IntText());
    }
    for (const char* key : {"truncated", "occluded", "difficult"}) {
      row.push_back(object->FirstChildElement(key)->IntText());
    }
  }
  EXPECT_EQ(objects,
            (std::vector<std::vector<int>>{
                {11, 21, 18, 50, 0, 0, 0}, {1, 41, 6, 60, 1, 1, 0}, {61, 11, 64, 16, 0, 1, 1}}));
  EXPECT_EQ(out.text("ImageSets/Main/train.txt"), "run002-d1-000004\n");
}

TEST(HandMadeCvat, HasBoxesWithAttributes) {
  Export out;
  out.run("cvat", {crossing()});
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(out.text("annotations.xml").c_str()), tinyxml2::XML_SUCCESS);
  const auto* image = xml.RootElement()->FirstChildElement("image");
  EXPECT_STREQ(image->Attribute("name"), "train/run002-d1-000004.jpg");
  EXPECT_STREQ(image->Attribute("subset"), "train");
  const auto* box = image->FirstChildElement("box");
  EXPECT_STREQ(box->Attribute("xtl"), "10.00");
  EXPECT_STREQ(box->Attribute("ytl"), "20.00");
  EXPECT_STREQ(box->Attribute("xbr"), "18.00");
  EXPECT_STREQ(box->Attribute("ybr"), "50.00");
  EXPECT_STREQ(box->Attribute("occluded"), "0");
  const auto* attribute = box->FirstChildElement("attribute");
  EXPECT_STREQ(attribute->GetText(), "2000003");
  box = box->NextSiblingElement("box");
  EXPECT_STREQ(box->Attribute("occluded"), "1");
  EXPECT_STREQ(box->LastChildElement("attribute")->GetText(), "lying");
  EXPECT_EQ(box->NextSiblingElement("box"), nullptr) << "who is ignored has no box";
}

TEST(HandMadeDroneCrowd, HasHeadsInsideOfThePicture) {
  Export out;
  Image image = crossing();
  image.people[0].box_middle = {0, 25, 1};  // 25 m ahead: 0.25 m are 0.5 px, drawn as 1 px
  Person near = hand_made::person(40, {30, 30, 9, 9}, {30, 30, 9, 9}, 0.4);
  near.head = Eigen::Vector2d(34, 31);
  near.box_middle = {0, 5, 9};  // 5 m ahead: 2.5 px
  image.people.push_back(near);
  out.run("dronecrowd", {image});
  EXPECT_EQ(out.text("train/annotations/run002-d1.txt"),
            "5,3,13.50,21.50,1.00,1.00,0,0,-1,-1\n"
            "5,40,32.75,29.75,2.50,2.50,0,1,-1,-1\n");
}

TEST(HandMadeTable, HasAValuePerColumnAndQuotes) {
  Export out;
  Image image = crossing();
  image.people.resize(1);
  Person& a = image.people[0];
  a.position = {1.5, 20, 0};
  a.velocity = {0.25, -1};
  a.heading_rad = 0.5;
  a.record["exit"] = "west \"gate\", 2";
  a.record["behaviour"] = "Walk";
  out.run("table", {image});
  const auto lines = lines_of(out.root() / "out/people.csv");
  ASSERT_EQ(lines.size(), 2);
  EXPECT_EQ(lines[1],
            "run002,d1,4,2,train,7,103,2000003,10,20,8,30,10,20,8,30,1,0,30,14,22,1.5,20,0.25,-1,"
            "0.5,0,walking,Walk,\"west \"\"gate\"\", 2\",4,female,31,,1.71,");
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','), 35);
}

TEST(HandMadeCoco, MarksWhoIsIgnoredAsCrowd) {
  Export out;
  Image image = crossing();
  image.people[0].record["keypoints"] = {1, 2, 2};
  out.run("coco", {image});
  const json file = json::parse(out.text("annotations/instances_train.json"));
  EXPECT_EQ(file.at("info").at("description"), "hand <made>");
  EXPECT_EQ(file.at("categories"),
            json::parse(R"([{"id":1,"name":"person","supercategory":"person"}])"));
  ASSERT_EQ(file.at("images").size(), 1);
  EXPECT_EQ(file.at("images")[0].at("file_name"), "run002-d1-000004.jpg");
  EXPECT_EQ(out.text("train/run002-d1-000004.jpg"), "JPEG images/run002/d1/000004.jpg");
  const json& people = file.at("annotations");
  ASSERT_EQ(people.size(), 3);
  EXPECT_EQ(people[0].at("iscrowd"), 0);
  EXPECT_FALSE(people[0].contains("keypoints"));
  EXPECT_EQ(people[2].at("iscrowd"), 1);
  // Columns of 80: 60 columns and 10 rows, then four times 6 of 80, then the rest.
  EXPECT_EQ(people[2].at("segmentation").at("counts"),
            json({60 * 80 + 10, 6, 74, 6, 74, 6, 74, 6, 36 * 80 + 64}));
  ASSERT_EQ(file.at("tracks").size(), 3);
  EXPECT_EQ(file.at("tracks")[1].at("id"), 2'000'012);
}

TEST(HandMadeCoco, WritesTracksOncePerRunAndClassesByProperty) {
  Export out;
  out.dataset().categories = {"woman", "man"};
  Image first = crossing();
  Image second = crossing();
  second.frame = 5;
  second.file = "images/run002/d1/000005.jpg";
  second.people[0].category = 1;
  out.run("coco-keypoints", {first, second});
  const json file = json::parse(out.text("annotations/person_keypoints_train.json"));
  EXPECT_EQ(file.at("tracks").size(), 3) << "three people in two pictures";
  EXPECT_EQ(file.at("annotations").size(), 6);
  EXPECT_EQ(file.at("annotations")[3].at("category_id"), 2);
  const json& category = file.at("categories")[0];
  EXPECT_EQ(category.at("name"), "woman");
  EXPECT_EQ(category.at("keypoints").size(), 17);
  EXPECT_EQ(category.at("keypoints")[0], "nose");
  for (const json& bone : category.at("skeleton")) {
    EXPECT_TRUE(bone[0] >= 1 && bone[0] <= 17 && bone[1] >= 1 && bone[1] <= 17) << bone;
  }
}

TEST(HandMadeImageFolder, HasListsPerPicture) {
  Export out;
  Image image = crossing();
  image.split = Split::val;
  out.dataset().options.splits.runs = {{"run002", Split::val}};
  out.run("imagefolder", {image});
  const json line = json::parse(out.text("validation/metadata.jsonl"));
  EXPECT_EQ(line.at("file_name"), "run002-d1-000004.jpg");
  EXPECT_EQ(line.at("objects").at("bbox"),
            json::parse("[[10.0,20.0,8.0,30.0],[0.0,40.0,6.0,20.0]]"));
  EXPECT_EQ(line.at("objects").at("area"), json::parse("[240.0,120.0]"));
  EXPECT_EQ(line.at("objects").at("track_id"), json({2'000'003, 2'000'012}));
  EXPECT_EQ(line.at("objects").at("categories"), json({0, 0}));
  EXPECT_EQ(line.at("time_s"), 2.0);
  EXPECT_TRUE(out.has("validation/run002-d1-000004.jpg"));
}

/// A picture of 100 x 80 samples of each channel in a row, 16 bits.
void write_raster(const std::filesystem::path& path, int channels,
                  const std::vector<std::uint16_t>& samples) {
  write_file_atomically(
      path, annotate::png_bytes({hand_made::kWidth, hand_made::kHeight, channels}, samples));
}

template <typename Value>
Value little_endian(const std::string& bytes, std::size_t at) {
  Value value;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

TEST(HandMadeFlow, IsMiddleburysWithUnknownPixels) {
  Export out;
  std::vector<std::uint16_t> samples(3 * 100 * 80, 0);
  // The first pixel moves by (1.5, -0.25); others are not known.
  samples[0] = 32768 + 96;
  samples[1] = 32768 - 16;
  samples[2] = 1;
  write_raster(out.root() / "flow/run002/d1/000004.png", 3, samples);
  out.run("flow-flo", {hand_made::image()});
  const std::string flo = out.text("run002-d1/run002-d1-000004.flo");
  ASSERT_EQ(flo.size(), 12 + 8 * 100 * 80);
  EXPECT_EQ(little_endian<float>(flo, 0), 202021.25F);
  EXPECT_EQ(little_endian<std::int32_t>(flo, 4), 100);
  EXPECT_EQ(little_endian<std::int32_t>(flo, 8), 80);
  EXPECT_EQ(little_endian<float>(flo, 12), 1.5F);
  EXPECT_EQ(little_endian<float>(flo, 16), -0.25F);
  EXPECT_GT(little_endian<float>(flo, 20), 1e9F) << "above 1e9: unknown";
}

/// Attributes of an OpenEXR header by name, and where the table of lines begins.
std::map<std::string, std::string> exr_header(const std::string& bytes, std::size_t& at) {
  std::map<std::string, std::string> attributes;
  at = 8;
  while (bytes.at(at) != '\0') {
    const std::string name = bytes.c_str() + at;
    at += name.size() + 1;
    const std::string type = bytes.c_str() + at;
    at += type.size() + 1;
    const auto size = little_endian<std::int32_t>(bytes, at);
    attributes[name] = type + ":" + bytes.substr(at + 4, static_cast<std::size_t>(size));
    at += 4 + static_cast<std::size_t>(size);
  }
  ++at;
  return attributes;
}

TEST(HandMadeDepth, IsOpenExrInMeters) {
  Export out;
  std::vector<std::uint16_t> samples(100 * 80, 1234);
  samples[0] = 0;
  samples[100 * 79 + 99] = 65535;
  write_raster(out.root() / "depth/run002/d1/000004.png", 1, samples);
  out.run("depth-exr", {hand_made::image()});
  const std::string exr = out.text("run002-d1/run002-d1-000004.exr");
  EXPECT_EQ(little_endian<std::uint32_t>(exr, 0), 20000630U);
  EXPECT_EQ(little_endian<std::uint32_t>(exr, 4), 2U) << "version 2, scan lines";
  std::size_t at = 0;
  const auto header = exr_header(exr, at);
  EXPECT_EQ(header.at("compression"), std::string("compression:\0", 13));
  const std::string window = header.at("dataWindow").substr(6);
  EXPECT_EQ(little_endian<std::int32_t>(window, 8), 99);
  EXPECT_EQ(little_endian<std::int32_t>(window, 12), 79);
  const std::string channels = header.at("channels").substr(7);
  EXPECT_STREQ(channels.c_str(), "Y");
  EXPECT_EQ(little_endian<std::int32_t>(channels, 2), 2) << "float";
  for (int row = 0; row < 80; ++row) {
    const auto line = little_endian<std::uint64_t>(exr, at + 8 * static_cast<std::size_t>(row));
    EXPECT_EQ(little_endian<std::int32_t>(exr, line), row);
    EXPECT_EQ(little_endian<std::int32_t>(exr, line + 4), 400);
    const float first = little_endian<float>(exr, line + 8);
    if (row == 0) {
      EXPECT_TRUE(std::isinf(first)) << "sky";
    } else {
      EXPECT_FLOAT_EQ(first, 12.34F);
    }
  }
  EXPECT_FLOAT_EQ(little_endian<float>(exr, exr.size() - 4), 655.35F);
}

TEST(HandMadeCard, CountsPicturesAndPeople) {
  Export out;
  const json manifest = {{"schema_version", 1},
                         {"job", {{"name", "j"}, {"outputs", {{"formats", {"mot"}}}}}},
                         {"runs",
                          {{{"run", "run000"}, {"seed", 5}},
                           {{"run", "run001"}, {"seed", 6}},
                           {{"run", "run002"}, {"seed", 7}}}}};
  DatasetCard card(out.dataset(), manifest, Output(out.root() / "out"));
  Image image = crossing();
  image.record["environment"] = {{"sun_elevation_deg", -3}, {"weather", "rain"}};
  card.add(image);
  Image empty = hand_made::image();
  empty.record["environment"] = {{"sun_elevation_deg", 30}};
  card.add(empty);
  card.finish();
  const json dataset = json::parse(out.text("dataset.json"));
  const json& counts = dataset.at("statistics");
  EXPECT_EQ(counts.at("images"), 2);
  EXPECT_EQ(counts.at("annotations"), 3);
  EXPECT_EQ(counts.at("most_people_in_an_image"), 3);
  EXPECT_EQ(counts.at("truncated"), 1);
  EXPECT_EQ(counts.at("fail_the_filters"), 1);
  // Whole heights of 30, 24 and 6 px; visibilities of 100, 41.7 and 10 %.
  EXPECT_EQ(counts.at("annotations_by_height_px"), json({{"00000-00008", 1}, {"00016-00032", 2}}));
  EXPECT_EQ(counts.at("annotations_by_visibility_percent"),
            json({{"00010-00025", 1}, {"00025-00050", 1}, {"00090-", 1}}));
  EXPECT_EQ(counts.at("annotations_by_state"), json({{"lying", 1}, {"walking", 2}}));
  EXPECT_EQ(counts.at("images_by_people"), json({{"00000-00001", 1}, {"00001-00010", 1}}));
  EXPECT_EQ(counts.at("images_by_light"), json({{"day", 1}, {"twilight", 1}}));
  EXPECT_EQ(counts.at("images_by_weather"), json({{"rain", 1}, {"unknown", 1}}));
  EXPECT_EQ(dataset.at("seeds"), json({{"run000", 5}, {"run001", 6}, {"run002", 7}}));
  EXPECT_EQ(dataset.at("formats").at("mot"), "formats/mot");
  const std::string readme = out.text("README.md");
  EXPECT_THAT(readme, HasSubstr("2 images with 3 annotations"));
  EXPECT_THAT(readme, HasSubstr("3 runs"));
  EXPECT_THAT(readme, HasSubstr("| format mot | formats/mot/ |"));
  EXPECT_THAT(readme, Not(HasSubstr("numpy.load"))) << "it has no density";
}

TEST(HandMadeCard, ClassesLightByTheSun) {
  const auto light = [](double elevation_deg) {
    Export out;
    DatasetCard card(
        out.dataset(),
        {{"schema_version", 1}, {"job", {{"outputs", json::object()}}}, {"runs", json::array()}},
        Output(out.root() / "out"));
    Image image = hand_made::image();
    image.record["environment"] = {{"sun_elevation_deg", elevation_deg}};
    card.add(image);
    card.finish();
    return json::parse(out.text("dataset.json"))
        .at("statistics")
        .at("images_by_light")
        .begin()
        .key();
  };
  EXPECT_EQ(light(-6.1), "night");
  EXPECT_EQ(light(-5.9), "twilight");
  EXPECT_EQ(light(0), "low sun");
  EXPECT_EQ(light(9.9), "low sun");
  EXPECT_EQ(light(10), "day");
}

TEST(AllFormats, HaveUniqueNamesAndAreFound) {
  std::set<std::string_view> names;
  for (const Format& format : all_formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_EQ(find_format(format.name), &format);
    EXPECT_FALSE(format.summary.empty());
    EXPECT_EQ(format.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"),
              std::string_view::npos);
  }
  EXPECT_EQ(find_format("no-such"), nullptr);
  EXPECT_EQ(find_format(""), nullptr);
}

TEST(Sequences, AreCalledByRunAndCamera) {
  const Image image = hand_made::image();
  EXPECT_EQ(image.sequence(), "run002-d1");
  EXPECT_EQ(image.stem(), "run002-d1-000004");
  EXPECT_EQ(hand_made::person(17, {0, 0, 1, 1}, {0, 0, 1, 1}, 1).number_in_run(), 17);
}

}  // namespace
}  // namespace throng::formats
