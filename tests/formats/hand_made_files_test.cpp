// Exports of one image as files of their own (XML, tables, rasters, cards) with known boxes: the
// expected values are computed by hand from the formats' definitions.
#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include "annotate/rasters/png.h"
#include "formats/card.h"
#include "tests/formats/hand_made.h"
#include "tests/formats/readers.h"

namespace throng::formats {
namespace {

using hand_made::crossing;
using hand_made::Export;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

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

// Readers stop at boxes whose ends are equal, which one pixel has.
TEST(HandMadeVoc, SinglePixelsAreTwoWide) {
  Export out;
  Image image = hand_made::image();
  image.people = {hand_made::person(3, {10, 20, 1, 1}, {10, 20, 1, 1}, 0.5),
                  hand_made::person(4, {99, 79, 1, 1}, {99, 79, 1, 1}, 0.5),
                  hand_made::person(5, {0, 30, 1, 9}, {0, 30, 1, 9}, 0.5)};
  out.run("voc", {image});
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(out.text("Annotations/run002-d1-000004.xml").c_str()), tinyxml2::XML_SUCCESS);
  std::vector<std::vector<int>> boxes;
  for (const auto* object = xml.RootElement()->FirstChildElement("object"); object != nullptr;
       object = object->NextSiblingElement("object")) {
    auto& row = boxes.emplace_back();
    for (const char* key : {"xmin", "ymin", "xmax", "ymax"}) {
      row.push_back(object->FirstChildElement("bndbox")->FirstChildElement(key)->IntText());
    }
  }
  EXPECT_EQ(boxes,
            (std::vector<std::vector<int>>{{11, 21, 12, 22}, {99, 79, 100, 80}, {1, 31, 2, 39}}));
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
  EXPECT_EQ(box->NextSiblingElement("box"), nullptr) << "ignored people have no box";
}

TEST(HandMadeDroneCrowd, HasHeadsInsideOfTheImage) {
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
  const auto lines = read_lines(out.root() / "out/people.csv");
  ASSERT_EQ(lines.size(), 2);
  EXPECT_EQ(lines[1],
            "run002,d1,4,2,train,7,103,2000003,10,20,8,30,10,20,8,30,1,0,30,14,22,1.5,20,0.25,-1,"
            "0.5,0,walking,Walk,\"west \"\"gate\"\", 2\",4,female,31,,1.71,");
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','), 35);
}

TEST(HandMadeCoco, MarksIgnoredPeopleAsCrowd) {
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
  EXPECT_EQ(file.at("tracks").size(), 3) << "three people in two images";
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

TEST(HandMadeImageFolder, HasListsPerImage) {
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

/// An image of 100 x 80 samples of each channel in a row, 16 bits.
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

TEST(HandMadeDepth, IsOpenExrInMeters) {
  Export out;
  std::vector<std::uint16_t> samples(100 * 80, 1234);
  samples[0] = 0;
  samples[100 * 79 + 99] = 65535;
  write_raster(out.root() / "depth/run002/d1/000004.png", 1, samples);
  out.run("depth-exr", {hand_made::image()});
  Imf::InputFile exr(out.path("run002-d1/run002-d1-000004.exr").c_str());
  EXPECT_EQ(exr.header().compression(), Imf::ZIP_COMPRESSION);
  EXPECT_EQ(exr.header().dataWindow(), Imath::Box2i({0, 0}, {99, 79}));
  ASSERT_NE(exr.header().channels().findChannel("Y"), nullptr);
  EXPECT_EQ(exr.header().channels().findChannel("Y")->type, Imf::FLOAT);
  std::vector<float> meters(100 * 80);
  Imf::FrameBuffer buffer;
  buffer.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(meters.data()), sizeof(float),
                                100 * sizeof(float)));
  exr.setFrameBuffer(buffer);
  exr.readPixels(0, 79);
  EXPECT_TRUE(std::isinf(meters.front())) << "sky";
  EXPECT_FLOAT_EQ(meters[1], 12.34F);
  EXPECT_FLOAT_EQ(meters.back(), 655.35F);
}

TEST(HandMadeCard, CountsImagesAndPeople) {
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
  EXPECT_EQ(counts.at("distinct_characters"), 1) << "three people look alike";
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

TEST(HandMadeCard, ANameIsTextAndNothingElse) {
  Export out;
  out.dataset().name = "a<script>alert(1)</script> [b](javascript:c) `d` *e* | f & \\<g";
  DatasetCard card(
      out.dataset(),
      {{"schema_version", 1}, {"job", {{"outputs", json::object()}}}, {"runs", json::array()}},
      Output(out.root() / "out"));
  card.add(hand_made::image());
  card.finish();
  EXPECT_THAT(out.text("README.md"),
              StartsWith("# a&lt;script&gt;alert(1)&lt;/script&gt; \\[b\\](javascript:c) \\`d\\` "
                         "\\*e\\* \\| f &amp; \\\\&lt;g\n"));
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
