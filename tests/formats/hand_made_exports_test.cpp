// Exports of one image with known boxes: the expected lines are computed by hand from the
// formats' definitions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/formats/hand_made.h"
#include "tests/formats/readers.h"

namespace throng::formats {
namespace {

using hand_made::crossing;
using hand_made::Export;
using nlohmann::json;
using ::testing::HasSubstr;

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
  const auto lines = read_lines(out.root() / "out/train/run002-d1/gt/gt.txt");
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
  // The same for readers that take paths relative to their own folder.
  EXPECT_THAT(out.text("data.yolov5.yaml"),
              ::testing::EndsWith("path: \"../datasets/hand-made\"\n" + out.text("data.yaml")));
}

TEST(HandMadeMot, ListsItsSequencesForTrackEval) {
  Export out;
  out.run("mot", {crossing()});
  EXPECT_EQ(out.text("seqmaps/train.txt"), "name\nrun002-d1\n");
}

TEST(HandMadeYolo, CountsDronesAfterPeoplesClasses) {
  Export out;
  out.dataset().categories = {"woman", "man"};
  out.dataset().object_categories = annotate::object_categories(true, false);
  Image image = crossing();
  image.people[0].category = 1;
  image.objects = {hand_made::person(99'985, {50, 0, 10, 8}, {50, 0, 10, 8}, 1)};
  image.objects[0].category = 2;
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
  const auto line =
      parse_numbers(read_lines(out.root() / "out/labels/train/run002-d1-000004.txt")[0]);
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
  const auto line =
      parse_numbers(read_lines(out.root() / "out/labels/train/run002-d1-000004.txt")[0]);
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

TEST(HandMadeVisDrone, CallsThoseWhoNeitherStandNorWalkPeople) {
  const auto category = [](const std::string& state) {
    Export out;
    Image image = crossing();
    image.people.resize(1);
    image.people[0].state = state;
    out.run("visdrone-det", {image});
    return parse_numbers(out.text("train/annotations/run002-d1-000004.txt")).at(5);
  };
  for (const char* state : {"waiting", "walking", "running", "following", "panicking"}) {
    EXPECT_EQ(category(state), 1) << state;
  }
  for (const char* state : {"lying", "falling", "getting_up", "sitting", "squatting"}) {
    EXPECT_EQ(category(state), 2) << state;
  }
}

TEST(HandMadeVisDrone, DrawsTheLineOfOcclusionAtAHalf) {
  const auto occlusion = [](double visibility) {
    Export out;
    Image image = crossing();
    image.people.resize(1);
    image.people[0].visibility = visibility;
    out.run("visdrone-det", {image});
    return parse_numbers(out.text("train/annotations/run002-d1-000004.txt")).back();
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
    const auto numbers = parse_numbers(out.text("train/GT/run002-d1_gt_whole.txt"));
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
  const auto calib = read_lines(out.root() / "out/train/calib/run002-d1-000004.txt");
  ASSERT_EQ(calib.size(), 8);
  EXPECT_THAT(parse_numbers(calib[2].substr(3)),
              ::testing::ElementsAre(50, 0, 49.5, 0, 0, 50, 39.5, 0, 0, 0, 1, 0));
  EXPECT_EQ(calib[4], "R0_rect: 1 0 0 0 1 0 0 0 1");
  EXPECT_THAT(parse_numbers(calib[7].substr(calib[7].find(':') + 1)),
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

}  // namespace
}  // namespace throng::formats
