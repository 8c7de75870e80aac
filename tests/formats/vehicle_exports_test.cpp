// Cars and trains in every format that has classes for them. The expected lines are computed by
// hand from the formats' definitions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "formats/card.h"
#include "tests/formats/hand_made.h"
#include "tests/formats/readers.h"

namespace throng::formats {
namespace {

using hand_made::Export;
using nlohmann::json;
using ::testing::HasSubstr;

/// Numbers of a run's first vehicles, and their classes after that of people.
constexpr std::int64_t kFirst = annotate::kFirstVehicleNumber + 1;
constexpr std::size_t kCar = 1;
constexpr std::size_t kTrain = 2;

/// Somebody, a car, a train that is half hidden, and a car that fails the filters.
Image street() {
  Image image = hand_made::image();
  image.people = {hand_made::person(3, {10, 20, 8, 30}, {10, 20, 8, 30}, 1)};
  Person car = hand_made::person(kFirst, {40, 50, 20, 10}, {40, 50, 20, 10}, 1);
  car.category = kCar;
  car.box_middle = {2, 20, 0.75};
  car.box_size = {4.4, 1.8, 1.5};
  car.heading_rad = 0.25;
  Person train = hand_made::person(kFirst + 1, {0, 10, 30, 8}, {0, 10, 60, 8}, 0.5);
  train.category = kTrain;
  train.box_middle = {0, 10, 2};
  train.box_size = {20, 2.9, 4};
  train.heading_rad = std::acos(-1) / 2;
  Person far = hand_made::person(kFirst + 2, {90, 10, 4, 2}, {90, 10, 4, 2}, 1);
  far.category = kCar;
  far.is_ignored = true;
  image.objects = {car, train, far};
  return image;
}

/// The street in one format.
class StreetExport : public Export {
 public:
  explicit StreetExport(const std::string& format) {
    dataset().object_categories = annotate::object_categories(false, true);
    run(format, {street()});
  }
};

TEST(VehicleExports, VisDroneHasCarsAndOthers) {
  EXPECT_EQ(StreetExport("visdrone-det").text("train/annotations/run002-d1-000004.txt"),
            "10,20,8,30,1,1,0,0\n"
            "40,50,20,10,1,4,0,0\n"
            "0,10,30,8,1,11,0,1\n"
            "90,10,4,2,0,0,0,0\n");
  const std::string tracks = StreetExport("visdrone-mot").text("train/annotations/run002-d1.txt");
  EXPECT_THAT(tracks, HasSubstr("5,95889,40,50,20,10,1,4,0,0\n"));
}

TEST(VehicleExports, UavdtHasCarsOnly) {
  const StreetExport out("uavdt");
  EXPECT_EQ(out.text("train/GT/run002-d1_gt_whole.txt"),
            "5,3,10,20,8,30,1,1,4\n"
            "5,95889,40,50,20,10,1,1,1\n");
  EXPECT_EQ(out.text("train/GT/run002-d1_gt_ignore.txt"), "5,95891,90,10,4,2,1,1,1\n");
}

TEST(VehicleExports, KittiHasCarsAndTrams) {
  const StreetExport out("kitti");
  const auto lines = read_lines(out.root() / "out/train/label_2/run002-d1-000004.txt");
  ASSERT_EQ(lines.size(), 4);
  // Height, width, length; the middle of the foot, 2 m right of the axis and 10 m below the camera.
  EXPECT_EQ(lines[1],
            "Car 0.00 0 -0.3497 40.00 50.00 60.00 60.00 1.500 1.800 4.400 2.000 10.000 20.000 "
            "-0.2500");
  EXPECT_EQ(lines[2].substr(0, 12), "Tram 0.00 1 ");
  EXPECT_EQ(lines[3].substr(0, 9), "DontCare ");
}

TEST(VehicleExports, YoloAndVocHaveClassesAfterPeoples) {
  const StreetExport yolo("yolo-detect");
  EXPECT_EQ(yolo.text("labels/train/run002-d1-000004.txt"),
            "0 0.140000 0.437500 0.080000 0.375000\n"
            "1 0.500000 0.687500 0.200000 0.125000\n"
            "2 0.150000 0.175000 0.300000 0.100000\n");
  EXPECT_THAT(yolo.text("data.yaml"),
              HasSubstr("nc: 7\nnames:\n  0: \"person\"\n  1: \"car\"\n  2: \"train\"\n"));
  const StreetExport voc("voc");
  const std::string xml = voc.text("Annotations/run002-d1-000004.xml");
  EXPECT_THAT(xml, HasSubstr("<name>car</name>"));
  EXPECT_THAT(xml, HasSubstr("<name>train</name>"));
}

TEST(VehicleExports, CocoHasCategoriesAfterPeoples) {
  const json coco = json::parse(StreetExport("coco").text("annotations/instances_train.json"));
  ASSERT_EQ(coco["categories"].size(), 7);
  EXPECT_EQ(coco["categories"][1]["name"], "car");
  EXPECT_EQ(coco["categories"][2]["name"], "train");
  ASSERT_EQ(coco["annotations"].size(), 4);
  EXPECT_EQ(coco["annotations"][1]["category_id"], 2);
  EXPECT_EQ(coco["annotations"][2]["category_id"], 3);
}

TEST(VehicleExports, CardCountsThem) {
  Export out;
  out.dataset().object_categories = annotate::object_categories(true, true);
  Image image = street();
  for (Person& object : image.objects) ++object.category;  // drones come first
  const json manifest = {
      {"schema_version", 1},
      {"job", {{"name", "j"}, {"outputs", {{"formats", {"mot"}}}}}},
      {"runs", {{{"run", "run000"}, {"seed", 5}}, {{"run", "run002"}, {"seed", 7}}}}};
  DatasetCard card(out.dataset(), manifest, Output(out.root() / "out"));
  card.add(image);
  card.finish();
  const json dataset = json::parse(out.text("dataset.json"));
  EXPECT_EQ(dataset["classes"], json({{"1", "person"},
                                      {"2", "drone"},
                                      {"3", "car"},
                                      {"4", "train"},
                                      {"5", "van"},
                                      {"6", "truck"},
                                      {"7", "bus"},
                                      {"8", "motorcycle"}}));
  EXPECT_EQ(
      dataset["statistics"]["annotations_of_vehicles"],
      json({{"car", 2}, {"train", 1}, {"van", 0}, {"truck", 0}, {"bus", 0}, {"motorcycle", 0}}));
}

}  // namespace
}  // namespace throng::formats
