// Formats of skeletons with known joints: the expected values follow from the formats' definitions.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "formats/dataset/joints.h"
#include "tests/formats/hand_made.h"

namespace throng::formats {
namespace {

using hand_made::Export;
using nlohmann::json;
using skinning::Joint;

/// Joint i at (i, 2 i) in the image; the nose is hidden, the left eye outside of the image, the
/// left heel hidden by the body. In the world all are 20 m ahead, i cm to the right.
Image joints_image() {
  Image image = hand_made::image();
  Person person = hand_made::person(5, {10, 20, 8, 30}, {10, 20, 8, 30}, 1);
  json joints = json::array();
  json in_world = json::array();
  for (int i = 0; i < static_cast<int>(skinning::kJointCount); ++i) {
    const int state = i == 0 ? 1 : i == 1 ? 0 : i == 31 ? 3 : 2;
    joints.insert(joints.end(), {state == 0 ? 0 : i, state == 0 ? 0 : 2 * i, state});
    in_world.push_back({0.01 * i, 20, 10});
  }
  person.record["joints"] = joints;
  person.record["joints_3d"] = in_world;
  json keypoints = json::array();
  for (int i = 0; i < 51; ++i) keypoints.push_back(i);
  person.record["keypoints"] = keypoints;
  image.people = {person};
  return image;
}

std::vector<double> point(const json& values, int number) {
  const auto at = static_cast<std::size_t>(3 * number);
  return {values.at(at), values.at(at + 1), values.at(at + 2)};
}

TEST(HandMadeOpenPose, HasBody25) {
  Export out;
  out.run("openpose", {joints_image()});
  const json file = json::parse(out.text("train/json/run002-d1-000004_keypoints.json"));
  EXPECT_EQ(file.at("version"), 1.3);
  ASSERT_EQ(file.at("people").size(), 1U);
  const json& values = file["people"][0].at("pose_keypoints_2d");
  ASSERT_EQ(values.size(), 75U);
  using Point = std::vector<double>;
  EXPECT_EQ(point(values, 0), (Point{0, 0, 0.5})) << "the nose is hidden";
  EXPECT_EQ(point(values, 1), (Point{5.5, 11, 1})) << "the neck is between the shoulders, 5 and 6";
  EXPECT_EQ(point(values, 2), (Point{6, 12, 1})) << "right shoulder";
  EXPECT_EQ(point(values, 8), (Point{11.5, 23, 1})) << "between the hips, 11 and 12";
  EXPECT_EQ(point(values, 14), (Point{15, 30, 1})) << "left ankle";
  EXPECT_EQ(point(values, 16), (Point{0, 0, 0})) << "the left eye is outside";
  EXPECT_EQ(point(values, 19), (Point{27, 54, 1})) << "left big toe";
  EXPECT_EQ(point(values, 21), (Point{31, 62, 0.5})) << "left heel";
  EXPECT_EQ(point(values, 24), (Point{32, 64, 1})) << "right heel";
  EXPECT_EQ(file["people"][0].at("person_id"), json{2'000'005});
  EXPECT_TRUE(file["people"][0].at("hand_left_keypoints_2d").empty());
  EXPECT_TRUE(out.has("train/images/run002-d1-000004.jpg"));
}

TEST(HandMadeJta, HasTwentyTwoJointsInImageAndCamera) {
  Export out;
  Image next = joints_image();
  next.frame = 5;
  next.file = "images/run002/d1/000005.jpg";
  Image nobody = joints_image();
  nobody.people.clear();
  nobody.frame = 3;
  nobody.file = "images/run002/d1/000003.jpg";
  out.run("jta", {nobody, joints_image(), next});
  const json rows = json::parse(out.text("annotations/train/run002-d1.json"));
  ASSERT_EQ(rows.size(), 44U);
  for (int i = 0; i < 44; ++i) {
    EXPECT_EQ(rows[static_cast<std::size_t>(i)].at(0), i < 22 ? 5 : 6) << "frames count from 1";
    EXPECT_EQ(rows[static_cast<std::size_t>(i)].at(1), 5);
    EXPECT_EQ(rows[static_cast<std::size_t>(i)].at(2), i % 22);
  }
  // head_top is joint 17; right is +x, and 20 m ahead is z.
  EXPECT_EQ(rows[0], json::parse("[5,5,0,17.0,34.0,0.17,0.0,20.0,0,0]"));
  EXPECT_EQ(rows[4], json::parse("[5,5,4,6.0,12.0,0.06,0.0,20.0,0,0]")) << "right shoulder";
  EXPECT_EQ(rows[15], json::parse("[5,5,15,22.0,44.0,0.22,0.0,20.0,0,0]")) << "at the pelvis";
  // neck 19, chest 20, spine 21, pelvis 22: the first of five steps is 0.6 of the way to the chest.
  EXPECT_NEAR(rows[11][3].get<double>(), 19.6, 1e-9);
  EXPECT_EQ(rows[21], json::parse("[5,5,21,15.0,30.0,0.15,0.0,20.0,0,0]")) << "left ankle";
  EXPECT_TRUE(out.has("frames/train/run002-d1/6.jpg"));
}

TEST(HandMadeJta, SequencesWithoutPeopleAreEmptyTables) {
  Export out;
  Image nobody = joints_image();
  nobody.people.clear();
  out.run("jta", {nobody});
  EXPECT_EQ(json::parse(out.text("annotations/train/run002-d1.json")), json::array());
}

TEST(HandMadeWholeBody, HasSixPointsOfFeet) {
  Export out;
  out.run("coco-wholebody", {joints_image()});
  const json file = json::parse(out.text("annotations/coco_wholebody_train_v1.0.json"));
  const json& record = file.at("annotations").at(0);
  ASSERT_EQ(record.at("foot_kpts").size(), 18U);
  EXPECT_EQ(point(record["foot_kpts"], 0), (std::vector<double>{27, 54, 2})) << "left big toe";
  EXPECT_EQ(point(record["foot_kpts"], 1), (std::vector<double>{29, 58, 2})) << "left small toe";
  EXPECT_EQ(point(record["foot_kpts"], 2), (std::vector<double>{31, 62, 1})) << "left heel, hidden";
  EXPECT_EQ(point(record["foot_kpts"], 5), (std::vector<double>{32, 64, 2})) << "right heel";
  EXPECT_EQ(record.at("foot_valid"), true);
  EXPECT_EQ(record.at("lefthand_kpts").size(), 63U);
  EXPECT_EQ(record.at("face_valid"), false);
  EXPECT_EQ(record.at("keypoints").size(), 51U);
}

TEST(HandMadeSkeletons, NeedAllJoints) {
  Export out;
  Image image = joints_image();
  image.people[0].record["joints"].erase(0);
  EXPECT_THROW(out.run("openpose", {image}), InputError);
}

}  // namespace
}  // namespace throng::formats
