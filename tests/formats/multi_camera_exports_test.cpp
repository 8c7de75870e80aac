// Exports for re-identification and for several cameras at once (Market-1501, WILDTRACK) of people
// that two cameras see, made by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <array>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "base/graphics/images/jpeg_file.h"
#include "base/graphics/images/jpeg_writer.h"
#include "tests/formats/hand_made.h"
#include "tests/formats/readers.h"

namespace throng::formats {
namespace {

namespace fs = std::filesystem;
using hand_made::Export;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kMarketWidth = 200;
constexpr int kMarketHeight = 120;

/// Parts of a crop's name.
struct CropName {
  std::string folder;
  int number = 0;
  int camera = 0;
  int sequence = 0;
  int frame = 0;
};

std::vector<CropName> crops_below(const fs::path& root) {
  static const std::regex kName(R"((-1|\d{4})_c(\d+)s(\d+)_(\d{6})_(\d{2})\.jpg)");
  std::vector<CropName> crops;
  for (const char* folder : {"bounding_box_train", "bounding_box_test", "query"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::directory_iterator(root / folder)) {
      std::smatch parts;
      const std::string name = entry.path().filename().string();
      EXPECT_TRUE(std::regex_match(name, parts, kName)) << name;
      crops.push_back({folder, std::stoi(parts[1]), std::stoi(parts[2]), std::stoi(parts[3]),
                       std::stoi(parts[4])});
    }
  }
  return crops;
}

Person dressed(std::int64_t number, const std::string& character, const std::string& color,
               const Box& box, double visibility = 1) {
  Person person = hand_made::person(number, box, box, visibility);
  person.mask.clear();  // of images of another size, and not looked at
  person.track = std::make_shared<const json>(
      json{{"id", person.track_id},
           {"attributes",
            {{"character", character},
             {"sex", "male"},
             {"age_years", 40},
             {"age_band", "adult"},
             {"stature_m", 1.8},
             {"carries", "nothing"},
             {"top_colour", color},
             {"clothes",
              {{{"slot", "upper"}, {"type", "shirt"}, {"colour", color}, {"colour_name", "red"}},
               {{"slot", "lower"}, {"type", "jeans"}}}}}}});
  return person;
}

/// Frame `frame` of a camera of run002 (or another): 20 people of ten characters, each in their own
/// color, 5 pixels wide; number 20 is half hidden, 21 nearly, and 22 is small.
Image crowd(const std::string& camera, std::int64_t frame, const std::string& run = "run002") {
  Image image = hand_made::image();
  image.width = kMarketWidth;
  image.height = kMarketHeight;
  image.camera = camera;
  image.frame = frame;
  image.run = run;
  image.file = "images/" + run + "/" + camera + "/00000" + std::to_string(frame) + ".jpg";
  for (int i = 0; i < 20; ++i) {
    image.people.push_back(dressed(i, "person_" + std::to_string(i / 2),
                                   "#0000" + std::to_string(10 + i),
                                   {8.0 * i, 10 + static_cast<double>(frame), 6, 40}));
  }
  image.people.push_back(dressed(20, "person_0", "#000010", {165, 10, 6, 40}, 0.4));
  image.people.push_back(dressed(21, "person_0", "#000010", {175, 10, 6, 40}, 0.1));
  image.people.push_back(dressed(22, "person_0", "#000010", {185, 10, 4, 20}));
  return image;
}

/// Each person's box has a gray of its own.
void write_jpeg(const Export& out, const Image& image) {
  std::vector<std::uint8_t> rgb(3UL * kMarketWidth * kMarketHeight, 128);
  for (const Person& person : image.people) {
    const Box& box = person.box;
    for (int y = static_cast<int>(box.y); y < box.y + box.height; ++y) {
      for (int x = static_cast<int>(box.x); x < box.x + box.width; ++x) {
        std::fill_n(&rgb[3UL * static_cast<std::size_t>(y * kMarketWidth + x)], 3,
                    static_cast<std::uint8_t>(10 * person.number_in_run()));
      }
    }
  }
  write_file_atomically(out.root() / image.file,
                        images::jpeg_bytes(rgb, kMarketWidth, kMarketHeight, 100));
}

std::vector<Image> two_cameras(const Export& out, const std::string& run = "run002") {
  std::vector<Image> images;
  for (const std::int64_t frame : {0, 1, 2}) {
    for (const char* camera : {"d1", "d2"}) {
      images.push_back(crowd(camera, frame, run));
      write_jpeg(out, images.back());
    }
  }
  return images;
}

TEST(HandMadeMarket, CharactersAreForTrainingOrForTheTest) {
  Export out;
  EXPECT_THAT(out.run("market1501", two_cameras(out)), IsEmpty());
  std::map<int, std::set<std::string>> folders;
  for (const CropName& crop : crops_below(out.root() / "out")) {
    if (crop.number > 0) folders[crop.number].insert(crop.folder);
    EXPECT_EQ(crop.sequence, 3);
  }
  ASSERT_EQ(folders.size(), 20U);
  std::size_t trained = 0;
  for (const auto& [number, in] : folders) {
    const bool is_train = in.contains("bounding_box_train");
    EXPECT_EQ(is_train, in.size() == 1) << "the test has queries and a gallery";
    trained += is_train ? 1 : 0;
  }
  EXPECT_EQ(trained, 10U) << "of each pair of characters one is for training";
  // Two of one character are on one side.
  const auto lines = read_lines(out.root() / "out/attributes.csv");
  ASSERT_EQ(lines.size(), 21U);
  EXPECT_EQ(lines[0].substr(0, 52), "id,set,sex,age_years,age_band,stature_m,upper_type,u");
  for (std::size_t i = 1; i < lines.size(); i += 2) {
    const bool is_train = lines[i].find(",train,") != std::string::npos;
    EXPECT_EQ(lines[i + 1].find(",train,") != std::string::npos, is_train);
    EXPECT_THAT(lines[i], HasSubstr(",male,40,adult,1.8,shirt,red,#0000"));
  }
}

TEST(HandMadeMarket, EachQueryIsInTheGalleryByAnotherCamera) {
  Export out;
  out.run("market1501", two_cameras(out));
  std::map<int, std::set<int>> queried;
  std::map<int, std::set<int>> gallery;
  std::size_t junk = 0;
  for (const CropName& crop : crops_below(out.root() / "out")) {
    if (crop.folder == "query") {
      EXPECT_TRUE(queried[crop.number].insert(crop.camera).second) << "one of each camera";
    }
    if (crop.folder == "bounding_box_test") gallery[crop.number].insert(crop.camera);
    junk += crop.number == -1 ? 1 : 0;
  }
  EXPECT_EQ(queried.size(), 10U);
  for (const auto& [number, cameras] : queried) {
    EXPECT_EQ(cameras, (std::set{1, 2}));
    EXPECT_EQ(gallery.at(number), (std::set{1, 2})) << "two of three frames are left";
  }
  EXPECT_EQ(junk, gallery.contains(-1) ? 6U : 0U) << "the half hidden one, if it is for the test";
}

TEST(HandMadeMarket, CropsHaveThePixelsOfTheImage) {
  Export out;
  out.run("market1501", two_cameras(out));
  const auto lines = read_lines(out.root() / "out/crops.csv");
  EXPECT_EQ(lines[0], "file,image,x,y,width,height,run,camera,track_id,visibility");
  ASSERT_GE(lines.size(), 121U);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::string file = lines[i].substr(0, lines[i].find(','));
    const std::string bytes = out.text(file);
    const images::JpegFile jpeg(bytes, file);
    ASSERT_EQ(jpeg.width(), 6);
    ASSERT_EQ(jpeg.height(), 40);
    const auto track = lines[i].find(",2000");
    ASSERT_NE(track, std::string::npos);
    const int number = std::stoi(lines[i].substr(track + 1)) - 2'000'000;
    const auto rgb = jpeg.decode(TJPF_RGB, true);
    EXPECT_NEAR(rgb[3 * (6 * 20 + 3)], 10 * number, 12) << lines[i];
  }
}

TEST(HandMadeMarket, EqualLooksInTwoRunsAreOneIdentity) {
  Export out;
  std::vector<Image> images = two_cameras(out, "run001");
  for (Image& image : two_cameras(out)) images.push_back(std::move(image));
  out.run("market1501", images);
  std::set<int> numbers;
  std::set<std::pair<int, int>> queries;
  for (const CropName& crop : crops_below(out.root() / "out")) {
    if (crop.number > 0) numbers.insert(crop.number);
    if (crop.folder == "query") {
      EXPECT_TRUE(queries.insert({crop.number, crop.camera}).second) << "one over all runs";
    }
  }
  EXPECT_EQ(numbers.size(), 20U);
}

TEST(HandMadeMarket, RunsForTheTestHaveNoTrainingAndThoseForTrainingNoTest) {
  Export out;
  out.dataset().options.splits.runs = {
      {"run000", Split::train}, {"run001", Split::train}, {"run002", Split::test}};
  std::vector<Image> images = two_cameras(out, "run001");
  for (Image& image : two_cameras(out)) {
    image.split = Split::test;
    images.push_back(std::move(image));
  }
  out.run("market1501", images);
  std::size_t distractors = 0;
  for (const CropName& crop : crops_below(out.root() / "out")) {
    EXPECT_EQ(crop.sequence == 2, crop.folder == "bounding_box_train");
    distractors += crop.number == 0 ? 1 : 0;
  }
  EXPECT_GT(distractors, 30U) << "characters of training are distractors in the test's runs";
}

TEST(HandMadeMarket, WarnsIfNobodyIsSeenByTwoCameras) {
  Export out;
  std::vector<Image> images = {crowd("d1", 0), crowd("d1", 1)};
  for (const Image& image : images) write_jpeg(out, image);
  const std::vector<Problem> warnings = out.run("market1501", images);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0].text(), HasSubstr("there is no query"));
}

/// Somebody 20 m ahead of the camera, seen or hidden.
Image ahead(const std::string& camera, std::int64_t frame, double x_m) {
  Image image = hand_made::image();
  image.camera = camera;
  image.frame = frame;
  image.file = "images/run002/" + camera + "/00000" + std::to_string(frame) + ".jpg";
  Person person = hand_made::person(5, {48, 50, 4, 20}, {47.5, 50.2, 5, 20}, 0.8);
  person.position = {x_m, 20, 0};
  image.people = {person};
  return image;
}

TEST(HandMadeWildtrack, HasPlacesBoxesOfAllViewsAndCalibrations) {
  Export out;
  Image hidden = ahead("d2", 0, 0);
  hidden.people.clear();
  hidden.hidden = {{2'000'005, {10.5, 20, 4, 9.5}, false}, {2'000'006, {1, 2, 3, 4}, false}};
  const auto warnings =
      out.run("wildtrack", {ahead("d1", 0, 0.5), hidden, ahead("d1", 1, 1.5), ahead("d2", 1, 1.5)});
  EXPECT_THAT(warnings, IsEmpty());
  const json first = json::parse(out.text("train/run002/annotations_positions/00000000.json"));
  ASSERT_EQ(first.size(), 1U) << "nobody has a place whom no camera sees";
  EXPECT_EQ(first[0].at("personID"), 5);
  EXPECT_EQ(first[0].at("views"),
            json::parse(R"([{"viewNum":0,"xmin":47,"ymin":50,"xmax":52,"ymax":70},
                            {"viewNum":1,"xmin":10,"ymin":20,"xmax":14,"ymax":29}])"));
  const json grid = json::parse(out.text("train/run002/grid.json"));
  EXPECT_EQ(grid.at("cameras"), (json{"d1", "d2"}));
  const auto place_of = [&](const json& person) {
    const auto cell = person.at("positionID").get<int>();
    const int columns = grid.at("columns");
    return std::pair(grid.at("origin_m")[0].get<double>() + 0.025 * (cell % columns),
                     grid.at("origin_m")[1].get<double>() + 0.025 * (cell / columns));
  };
  EXPECT_NEAR(place_of(first[0]).first, 0.5, 0.013);
  EXPECT_NEAR(place_of(first[0]).second, 20, 0.013);
  // The rotation that takes +y to ahead and -z to down is a quarter turn about x; centimeters.
  EXPECT_THAT(out.text("train/run002/calibrations/extrinsic/extr_C1.xml"),
              HasSubstr("<rvec>\n  1.57079632679"));
  EXPECT_THAT(out.text("train/run002/calibrations/extrinsic/extr_C1.xml"), HasSubstr("1000"));
  EXPECT_THAT(out.text("train/run002/calibrations/intrinsic_zero/intr_C2.xml"),
              HasSubstr("50 0 49.5 0 50 39.5 0 0 1"));
  EXPECT_TRUE(out.has("train/run002/Image_subsets/C2/00000001.jpg"));
}

TEST(HandMadeWildtrack, WarnsOfCamerasThatMoveAndOfOneCamera) {
  Export out;
  Image moved = ahead("d1", 1, 1.5);
  moved.t += Eigen::Vector3d(0.5, 0, 0);
  const auto warnings = out.run("wildtrack", {ahead("d1", 0, 0.5), moved});
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_THAT(warnings[0].text(), HasSubstr("cameras that move: d1"));
  EXPECT_THAT(warnings[1].text(), HasSubstr("runs with one camera"));
  EXPECT_TRUE(out.has("train/run002/calibrations/extrinsic/C1/00000001.xml"));
}

}  // namespace
}  // namespace throng::formats
