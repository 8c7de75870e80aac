// Topics that recordings of datasets and of live flights share.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "formats/recording/drone_topics.h"
#include "formats/recording/geodetic_fix.h"
#include "formats/recording/recording.h"
#include "formats/recording/ros_names.h"
#include "formats/recording/run_topics.h"
#include "tests/formats/files/mcap_reader.h"
#include "tests/world/temporary_folder.h"

namespace throng::formats::ros {
namespace {

using ::testing::HasSubstr;

TEST(Recording, ATopicIsOneChannel) {
  const throng::testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  Recording recording(path);
  EXPECT_EQ(recording.last_topic(), "");
  recording.add({"/a", Kind::text, 1, text("one")});
  recording.add({"/b", Kind::clock, 2, clock(2)});
  recording.add({"/a", Kind::text, 3, text("two")});
  EXPECT_EQ(recording.last_topic(), "/a");
  recording.close();
  EXPECT_EQ(recording.complete_until_s(), 3);
  std::vector<std::uint16_t> channels;
  for (const mcap::Message& message : mcap::read_messages(read_file(path))) {
    channels.push_back(message.channel);
  }
  EXPECT_THAT(channels, ::testing::ElementsAre(0, 1, 0));
}

TEST(RosNames, FollowTheRulesOfRos) {
  RosNames names("job.json");
  EXPECT_EQ(names.name_of("d-1"), "d_1");
  EXPECT_EQ(names.name_of("d-1"), "d_1");
  EXPECT_EQ(names.name_of("2nd"), "drone_2nd");
  try {
    names.name_of("d_1");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("job.json"));
    EXPECT_THAT(error.what(), HasSubstr("d_1 and d-1"));
  }
}

TEST(GeodeticFix, DegreesAreThoseOfTheEllipsoid) {
  // A degree of latitude and of longitude has 110574 and 111320 m at the equator, 111132 and 78847
  // m at 45 degrees (WGS 84).
  const Fix equator = geodetic_fix({111320, 110574, 7}, 0, {1, 2, 3});
  EXPECT_NEAR(equator.latitude_deg, 1, 1e-5);
  EXPECT_NEAR(equator.longitude_deg, 1, 1e-5);
  EXPECT_EQ(equator.altitude_m, 7);
  EXPECT_EQ(equator.sd_m, Eigen::Vector3d(1, 2, 3));
  const Fix north = geodetic_fix({78847, 111132, 0}, 45, {});
  EXPECT_NEAR(north.latitude_deg, 46, 1e-5);
  EXPECT_NEAR(north.longitude_deg, 1, 1e-5);
}

TEST(ClockTopic, NeverGoesBack) {
  std::vector<double> times_s;
  ClockTopic topic([&](const TopicMessage& message) { times_s.push_back(message.time_s); });
  for (const double time_s : {0.0, 1.0, 1.0, 0.5, 2.0}) topic.advance(time_s);
  EXPECT_THAT(times_s, ::testing::ElementsAre(0, 1, 2));
}

TEST(DroneTopics, AFixIsPublishedWhenItIsKnown) {
  std::map<std::string, std::vector<TopicMessage>> topics;
  DroneTopics drone("d1", [&](const TopicMessage& m) { topics[m.topic].push_back(m); });
  SensorRow row;
  for (int i = 0; i < 6; ++i) {
    row.time_s = 0.1 * i;
    row.gps_time_s = i < 3 ? 0 : 0.2;
    drone.publish_readings(row, {});
  }
  EXPECT_EQ(topics["/d1/imu"].size(), 6U);
  EXPECT_EQ(topics["/d1/pressure"].size(), 6U);
  ASSERT_EQ(topics["/d1/fix"].size(), 2U);
  EXPECT_DOUBLE_EQ(topics["/d1/fix"][1].time_s, 0.3) << "when it is known";
  EXPECT_EQ(topics["/d1/fix"][1].bytes,
            fix({"d1/base_link", 0.2}, geodetic_fix(Eigen::Vector3d::Zero(), 0, {0, 0, 0})));
  EXPECT_EQ(topics["/d1/fix_velocity"].size(), 2U);
}

TEST(DroneTopics, CamerasAreBelowTheirDrone) {
  std::vector<TopicMessage> messages;
  const DroneTopics drone("d1", [&](const TopicMessage& m) { messages.push_back(m); });
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5 * EIGEN_PI, Eigen::Vector3d::UnitZ()));
  drone.publish_transforms(1, {{1, 2, 3}, turn}, {{1, 3, 3}, turn});
  ASSERT_EQ(messages.size(), 1U);
  const Pose ahead{turn.inverse() * Eigen::Vector3d(0, 1, 0), turn.inverse() * turn};
  EXPECT_EQ(messages[0].bytes, transforms(1, {{"world", "d1/base_link", {{1, 2, 3}, turn}},
                                              {"d1/base_link", "d1/camera_optical_frame", ahead}}));
}

}  // namespace
}  // namespace throng::formats::ros
