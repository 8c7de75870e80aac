#include "annotate/people/keypoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "annotate/people/coco_records.h"
#include "base/compute/random.h"
#include "tests/render/stage.h"

namespace throng::annotate {
namespace {

enum Point : std::uint8_t { nose, left_shoulder = 5, right_shoulder = 6, left_knee = 13 };

FrameLabels label_frame(const render::Frame& frame) {
  FrameLabels labels = label_people(frame);
  add_keypoints(frame, labels);
  return labels;
}

const PersonLabel& find_label(const FrameLabels& labels, std::uint32_t agent) {
  return *std::find_if(labels.people.begin(), labels.people.end(),
                       [&](const PersonLabel& label) { return label.agent == agent; });
}

std::vector<render::PersonInstance> scattered(const render::Stage& stage, std::uint32_t count) {
  std::vector<render::PersonInstance> people;
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(3, Stream::crowd_generator, i);
    const double x = random.uniform(-4, 4);
    const double y = random.uniform(-4, 4);
    people.push_back(stage.standing(i, x, y, random.uniform(-3, 3)));
  }
  return people;
}

TEST(Keypoints, LieInTheBoxesOfImageAndWorldFromAnySide) {
  render::Stage stage(render::open_ground());
  const auto crowd = scattered(stage, 40);
  for (const double pitch_deg : {-89.0, -50.0, -20.0}) {
    const render::Frame frame = stage.draw(render::camera_at({-1, 0, 11}, 0, pitch_deg), crowd);
    for (const PersonLabel& label : label_frame(frame).people) {
      const render::PersonInView& person = label.person;
      Eigen::AlignedBox2d box = person.amodal_box;
      box.extend(Eigen::Vector2d(box.min().array() - 0.5));
      box.extend(Eigen::Vector2d(box.max().array() + 0.5));
      const Eigen::Matrix3f to_box =
          Eigen::AngleAxisf(static_cast<float>(-person.yaw_rad), Eigen::Vector3f::UnitZ())
              .toRotationMatrix();
      for (std::size_t i = 0; i < person.keypoints.size(); ++i) {
        const Eigen::Vector3f& point = person.keypoints[i];
        const auto seen = frame.camera.project(point.cast<double>());
        EXPECT_TRUE(box.contains(Eigen::Vector2d(seen.pixel.array() + 0.5)));
        const Eigen::Vector3f inside = to_box * (point - person.box_middle);
        // Toes and heels are points of the finest mesh, the box is that of a coarser one.
        const float slack_m = i < skinning::kKeypointCount ? 1e-4F : 0.015F;
        EXPECT_TRUE((inside.array().abs() <= person.box_size.array() / 2 + slack_m).all())
            << skinning::joint_names()[i] << " " << inside.transpose() << " of "
            << person.box_size.transpose();
      }
    }
  }
}

TEST(Keypoints, LeftIsThePersonsOwn) {
  render::Stage stage(render::open_ground());
  const render::Frame front =
      stage.draw(render::camera_at({5, 0, 1.5}, 180, 0), {stage.standing(0, 0, 0)});
  const render::Frame back =
      stage.draw(render::camera_at({-5, 0, 1.5}, 0, 0), {stage.standing(0, 0, 0)});
  const auto facing = label_frame(front).people.at(0).keypoints;
  EXPECT_GT(facing[left_shoulder].x, facing[right_shoulder].x + 20);
  const auto turned = label_frame(back).people.at(0).keypoints;
  EXPECT_LT(turned[left_shoulder].x, turned[right_shoulder].x - 20);
}

TEST(Keypoints, AreVisibleWhereTheImageShowsThem) {
  render::Stage stage(render::open_ground({render::block(1, 1.4, -3, 3, 1.0)}));
  const render::Frame frame = stage.draw(
      render::camera_at({6, 0, 1.7}, 180, -5),
      {stage.standing(0, 0, 0), stage.standing(1, 0, 1, 3.14159), stage.standing(2, -1, 0.02)});
  const FrameLabels labels = label_frame(frame);
  const auto& facing = find_label(labels, 0).keypoints;
  EXPECT_EQ(facing[nose].visibility, 2);
  EXPECT_EQ(facing[left_shoulder].visibility, 2);
  EXPECT_EQ(facing[left_knee].visibility, 1) << "behind the wall";
  const auto& turned = find_label(labels, 1).keypoints;
  EXPECT_EQ(turned[nose].visibility, 1) << "on the head's other side";
  EXPECT_EQ(turned[left_shoulder].visibility, 2);
  for (const PersonLabel& label : labels.people) {
    if (label.agent != 2) continue;
    EXPECT_EQ(label.keypoints[nose].visibility, 1) << "behind another head";
  }
}

TEST(Keypoints, AgreeWithDepth) {
  render::Stage stage(render::open_ground());
  const render::Frame frame =
      stage.draw(render::camera_at({-9, 0, 6}, 0, -30, 640, 480), scattered(stage, 60));
  int visible = 0;
  int hidden = 0;
  for (const PersonLabel& label : label_frame(frame).people) {
    const skinning::Keypoints seen = render::keypoints_in(label.person, frame.camera);
    for (std::size_t k = 0; k < label.keypoints.size(); ++k) {
      const Keypoint& point = label.keypoints[k];
      if (point.visibility == 0) continue;
      // How far before the keypoint the person's surface is that fits best within a pixel.
      float in_front = 1000;
      for (int i = 0; i < 9; ++i) {
        const int x = std::clamp(static_cast<int>(point.x) + i % 3 - 1, 0, frame.width() - 1);
        const int y = std::clamp(static_cast<int>(point.y) + i / 3 - 1, 0, frame.height() - 1);
        const std::size_t pixel = render::pixel_index(frame, x, y);
        if (frame.id[pixel] != render::id_of_agent(label.agent)) continue;
        const float here = seen[k].z() - frame.depth_m[pixel];
        if (std::abs(here) < std::abs(in_front)) in_front = here;
      }
      if (point.visibility == 2) {
        ++visible;
        EXPECT_LE(std::abs(in_front), 0.2F);
      } else {
        ++hidden;
        EXPECT_GT(std::abs(in_front), 0.039F);
      }
    }
  }
  EXPECT_GT(visible, 150);
  EXPECT_GT(hidden, 150);
}

TEST(Joints, SayWhetherTheOwnBodyHidesThem) {
  using skinning::Joint;
  using State = JointLabel::State;
  render::Stage stage(render::open_ground());
  // 0 faces the camera, 1 looks away from it, 2 is behind 0.
  render::Frame frame = stage.draw(
      render::camera_at({6, 0, 1.2}, 180, 0, 640, 480),
      {stage.standing(0, 0, 0), stage.standing(1, 0, 1.2, 3.14159), stage.standing(2, -1, 0.02)});
  FrameLabels labels = label_people(frame);
  add_keypoints(frame, labels);
  add_joints(frame, labels);
  const auto state = [&](std::uint32_t agent, Joint joint) {
    return find_label(labels, agent).joints.at(skinning::index_from(joint)).state;
  };
  EXPECT_EQ(state(0, Joint::nose), State::visible);
  EXPECT_EQ(state(1, Joint::nose), State::self_hidden);
  EXPECT_EQ(state(2, Joint::nose), State::hidden);
  EXPECT_EQ(state(0, Joint::neck), State::visible);
  EXPECT_EQ(state(0, Joint::left_big_toe), State::visible);
  EXPECT_EQ(state(1, Joint::right_heel), State::visible);
  for (const PersonLabel& label : labels.people) {
    ASSERT_EQ(label.joints.size(), skinning::kJointCount);
    for (std::size_t i = 0; i < label.keypoints.size(); ++i) {
      const int expected = label.joints[i].state == State::outside   ? 0
                           : label.joints[i].state == State::visible ? 2
                                                                     : 1;
      EXPECT_EQ(label.keypoints[i].visibility, expected);
      EXPECT_EQ(label.keypoints[i].x, label.joints[i].x);
    }
  }
}

TEST(Joints, OfARecordFaceWhereTheBodyDoes) {
  render::Stage stage(render::open_ground(), {}, {.bone_turns = true});
  const double yaw_rad = 0.7;
  const render::Frame frame =
      stage.draw(render::camera_at({6, 0, 1.2}, 180, 0), {stage.standing(0, 0, 0, yaw_rad)});
  FrameLabels labels = label_people(frame);
  add_joints(frame, labels);
  CocoImage image;
  image.file_name = "a.jpg";
  image.run = "run000";
  image.camera_id = "d1";
  image.camera = frame.camera;
  std::string text;
  append_annotation_record(text, image, labels.people.at(0));
  const nlohmann::json record = nlohmann::json::parse(text);
  EXPECT_EQ(record.at("joints").size(), 3 * skinning::kJointCount);
  EXPECT_EQ(record.at("joints_3d").size(), skinning::kJointCount);
  ASSERT_EQ(record.at("bone_turns").size(), skinning::kBoneCount);
  const auto& hips = record["bone_turns"][0];
  EXPECT_NEAR(hips[0].get<double>(), std::cos(yaw_rad / 2), 0.02) << "a turn about z";
  EXPECT_NEAR(hips[3].get<double>(), std::sin(yaw_rad / 2), 0.02);
  const double x = record.at("gaze")[0];
  const double y = record["gaze"][1];
  const double z = record["gaze"][2];
  EXPECT_NEAR(x * x + y * y + z * z, 1, 1e-3);
  EXPECT_GT(x * std::cos(yaw_rad) + y * std::sin(yaw_rad), 0.8);
}

TEST(Keypoints, OutsideOfTheImageAreNotLabeled) {
  render::Stage stage(render::open_ground());
  const render::Frame frame =
      stage.draw(render::camera_at({2, 0, 2.2}, 180, -5), {stage.standing(0, 0, 0)});
  const FrameLabels labels = label_frame(frame);
  CocoImage image;
  image.file_name = "a.jpg";
  image.run = "run000";
  image.camera_id = "d1";
  image.camera = frame.camera;
  std::string text;
  append_annotation_record(text, image, labels.people.at(0));
  const nlohmann::json record = nlohmann::json::parse(text);
  int labeled = 0;
  for (std::size_t i = 0; i < skinning::kKeypointCount; ++i) {
    const nlohmann::json& all = record.at("keypoints");
    const bool is_labeled = all[3 * i + 2] > 0;
    labeled += is_labeled ? 1 : 0;
    EXPECT_TRUE(is_labeled || (all[3 * i] == 0 && all[3 * i + 1] == 0));
    EXPECT_NEAR(record.at("keypoints_3d")[i][2].get<double>(),
                static_cast<double>(labels.people[0].person.keypoints[i].z()), 0.0006);
  }
  EXPECT_EQ(record.at("num_keypoints"), labeled);
  EXPECT_GT(labeled, 0);
  EXPECT_LT(labeled, 17);
  EXPECT_GT(record.at("truncation"), 0.2);
}

TEST(PersonFacts, ActivityFollowsFromStateFlagsAndSpeed) {
  constexpr std::uint8_t kCalm = world::kPresent;
  constexpr std::uint8_t kFell = world::kPresent | world::kFallen;
  using skinning::Action;
  const skinning::Actions none;
  EXPECT_EQ(classify_activity("Walk", kFell, none, 0), Activity::lying);
  EXPECT_EQ(classify_activity("Flee", kFell | world::kPanicked, none, 1), Activity::lying);
  EXPECT_EQ(classify_activity("Walk", kFell, skinning::Actions(Action::fall), 1),
            Activity::falling);
  EXPECT_EQ(classify_activity("Walk", kFell, skinning::Actions(Action::lie), 0), Activity::lying);
  EXPECT_EQ(classify_activity("Walk", kFell, skinning::Actions(Action::get_up), 0),
            Activity::getting_up);
  EXPECT_EQ(classify_activity("Walk", kCalm | world::kPanicked, none, 3), Activity::panicking);
  EXPECT_EQ(classify_activity("FollowDrone", kCalm, none, 1), Activity::following);
  EXPECT_EQ(classify_activity("FollowDrone", kCalm, none, 0.1), Activity::waiting);
  EXPECT_EQ(classify_activity("Walk", kCalm, none, 1.3), Activity::walking);
  EXPECT_EQ(classify_activity("Walk", kCalm, none, 2.5), Activity::running);
  EXPECT_EQ(classify_activity("sitting", kCalm, skinning::Actions(Action::sit), 0),
            Activity::sitting);
  EXPECT_EQ(
      classify_activity("Walk", kCalm, skinning::Actions(Action::squat, Action::use_phone), 0),
      Activity::squatting);
  EXPECT_EQ(
      classify_activity("Flee", kCalm | world::kPanicked, skinning::Actions(Action::cower), 0),
      Activity::squatting);
  EXPECT_EQ(classify_activity("Walk", kFell, skinning::Actions(Action::lie), 0), Activity::lying);
  EXPECT_EQ(to_string(Activity::running), "running");
  EXPECT_EQ(to_string(Activity::getting_up), "getting_up");
  EXPECT_EQ(to_string(Activity::sitting), "sitting");
  EXPECT_EQ(to_string(Activity::squatting), "squatting");
}

}  // namespace
}  // namespace throng::annotate
