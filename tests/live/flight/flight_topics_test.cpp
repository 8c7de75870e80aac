// Messages of a live flight, as a sink gets them.
#include "live/flight/flight_topics.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "live/flight/flight.h"
#include "spec/job/spec.h"
#include "tests/jobs/yard.h"

namespace throng::live {
namespace {

using nlohmann::json;

jobs::JobSpec job_with(const std::string& first, const std::string& second) {
  return jobs::parse_job(fmt::format(R"({{"scenario": "yard", "drones": [
    {{"id": "{}", "start": [0, 0, 12]}}, {{"id": "{}", "start": [5, 5, 12]}}]}})",
                                     first, second),
                         "");
}

/// A flight over the yard, whose messages are kept.
class FlightTopicsTest : public ::testing::Test {
 protected:
  void begin(const std::string& first = "d-1", const std::string& second = "2") {
    const jobs::JobSpec job = job_with(first, second);
    scenario_ = jobs::load_job_scenario(job, folder_.path());
    flight_ = std::make_unique<Flight>(job, scenario_, folder_.path());
    topics_ = std::make_unique<FlightTopics>(
        job, *flight_, std::vector<double>(flight_->header().agent_count(), 1.75),
        [this](const ros::TopicMessage& message) { messages_.push_back(message); });
    topics_->add(*flight_->moment(0), {}, {});
  }

  void step(const std::vector<sim::RemoteCommand>& commands, const std::vector<json>& events = {}) {
    topics_->add(*flight_->step(commands, 0), commands, events);
  }

  std::vector<ros::TopicMessage> of_topic(const std::string& topic) const {
    std::vector<ros::TopicMessage> found;
    for (const ros::TopicMessage& message : messages_) {
      if (message.topic == topic) found.push_back(message);
    }
    return found;
  }

  ros::Box3 person(std::int64_t id, double x_m, const Eigen::Vector3d& size_m,
                   double height_m) const {
    const float yaw_rad = flight_->moment(0)->now->yaw_rad.at(static_cast<std::size_t>(id - 1));
    return {id,
            "person",
            {{x_m, 0, height_m},
             Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()))},
            size_m};
  }

  jobs::TemporaryFolder folder_;
  world::Scenario scenario_;
  std::unique_ptr<Flight> flight_;
  std::vector<ros::TopicMessage> messages_;
  std::unique_ptr<FlightTopics> topics_;
};

TEST_F(FlightTopicsTest, AreAllNamedBefore) {
  jobs::write_yard(folder_.path());
  begin();
  for (int i = 0; i < 5; ++i) step(std::vector<sim::RemoteCommand>(2));
  topics_->add_image(*flight_->moment(0), 0, flight_->time_s(), "jpeg");
  std::map<std::string, ros::Kind> named;
  for (const FlightTopic& topic : flight_topics(ros_names(*flight_))) {
    named[topic.name] = topic.kind;
  }
  for (const ros::TopicMessage& message : messages_) {
    ASSERT_TRUE(named.count(message.topic)) << message.topic;
    EXPECT_EQ(named[message.topic], message.kind) << message.topic;
  }
}

TEST_F(FlightTopicsTest, ComeInTheOrderOfTime) {
  jobs::write_yard(folder_.path());
  begin();
  std::vector<sim::RemoteCommand> commands(2);
  commands[0].velocity_mps = {1, 0, 0};
  for (int i = 0; i < 5; ++i) step(commands);
  double clock_s = -1;
  double last_s = 0;
  std::map<std::string, std::set<ros::Kind>> kinds;
  for (const ros::TopicMessage& message : messages_) {
    kinds[message.topic].insert(message.kind);
    EXPECT_GE(message.time_s, last_s) << message.topic;
    last_s = message.time_s;
    if (message.topic != "/clock") continue;
    EXPECT_GT(message.time_s, clock_s);
    clock_s = message.time_s;
  }
  EXPECT_DOUBLE_EQ(clock_s, 0.5);
  for (const auto& [topic, kinds_of_topic] : kinds) EXPECT_EQ(kinds_of_topic.size(), 1U) << topic;
  EXPECT_EQ(of_topic("/d_1/odometry").size(), of_topic("/drone_2/odometry").size());
  EXPECT_EQ(of_topic("/tf").size(), 2 * of_topic("/d_1/odometry").size());
  EXPECT_EQ(of_topic("/d_1/imu").size(), of_topic("/d_1/odometry").size());
  EXPECT_EQ(of_topic("/d_1/command").size(), 5U);
  EXPECT_EQ(of_topic("/d_1/mode").size(), 1U) << "it has not changed";
  EXPECT_EQ(of_topic("/ground_truth/boxes").size(), 6U);
}

TEST_F(FlightTopicsTest, CommandsHoldFromTheBeginningOfTheirStep) {
  jobs::write_yard(folder_.path());
  begin();
  std::vector<sim::RemoteCommand> commands(2);
  commands[1] = {{1, 2, -1}, 90, true, false};
  step({{}, {}});
  step(commands, {{{"time_s", 0.15}, {"type", "landed"}, {"drone", "d-1"}}});
  const auto given = of_topic("/drone_2/command");
  ASSERT_EQ(given.size(), 2U);
  EXPECT_DOUBLE_EQ(given[1].time_s, 0.1);
  EXPECT_EQ(given[1].bytes, ros::velocity({"drone_2/base_link", given[1].time_s}, {1, 2, -1},
                                          {0, 0, 0.5 * EIGEN_PI}));
  const auto modes = of_topic("/drone_2/mode");
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_EQ(modes[1].bytes, ros::text(R"({"beacon":true,"return_home":false,"route":false})"));
  const auto events = of_topic("/events");
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].time_s, 0.15);
  EXPECT_EQ(events[0].bytes, ros::text(R"({"drone":"d-1","time_s":0.15,"type":"landed"})"));
}

TEST_F(FlightTopicsTest, PeopleStandOrLie) {
  jobs::write_yard(folder_.path());
  begin();
  const double width_m = 2 * static_cast<double>(flight_->header().radius_m.at(0));
  const Eigen::Vector3d upright(width_m, width_m, 1.75);
  const auto standing = of_topic("/ground_truth/boxes");
  ASSERT_EQ(standing.size(), 1U);
  EXPECT_EQ(standing[0].bytes, ros::markers({"world", 0}, {person(1, 0, upright, 0.875),
                                                           person(2, 2, upright, 0.875)}));
  Moment later = *flight_->moment(0);
  auto people = std::make_shared<world::CrowdStep>(*later.now);
  people->time_s = later.time_s = 0.1;
  people->flags.at(0) |= world::kFallen;
  people->yaw_rad.at(0) = 0;
  people->flags.at(1) = 0;  // has left
  later.now = people;
  topics_->add(later, {}, {});
  const auto boxes = of_topic("/ground_truth/boxes");
  ASSERT_EQ(boxes.size(), 2U);
  ros::Box3 lying = person(1, 0.875, {1.75, width_m, width_m}, 0.5 * width_m);
  lying.pose.rotation = Eigen::Quaterniond::Identity();
  EXPECT_EQ(boxes[1].bytes, ros::markers({"world", 0.1}, {lying}));
}

TEST_F(FlightTopicsTest, LargeCrowdsComeOnceASecond) {
  jobs::write_yard(folder_.path());
  std::string agents;
  for (int i = 0; i < 1001; ++i) {
    agents +=
        fmt::format(R"(<Agent p_x="{}" p_y="{}"/>)", -9 + 0.6 * (i % 31), -9 + 0.5 * (i / 31));
  }
  std::string scene = read_file(folder_.path() / "yard_scene.xml");
  const std::string two = R"(<Agent p_x="0" p_y="0"/><Agent p_x="2" p_y="0"/>)";
  scene.replace(scene.find(two), two.size(), agents);
  write_file_atomically(folder_.path() / "yard_scene.xml", scene);
  begin();
  for (int i = 0; i < 21; ++i) step({{}, {}});
  std::vector<double> times_s;
  for (const auto& message : of_topic("/ground_truth/boxes")) times_s.push_back(message.time_s);
  ASSERT_EQ(times_s.size(), 3U);
  EXPECT_NEAR(times_s[1], 1, 1e-9);
  EXPECT_NEAR(times_s[2], 2, 1e-9);
}

TEST_F(FlightTopicsTest, ImagesHaveTheirTransforms) {
  jobs::write_yard(folder_.path());
  begin();
  std::vector<sim::RemoteCommand> commands(2);
  commands[0].velocity_mps = {1, 0, 0};
  const auto moment = flight_->step(commands, 0);
  messages_.clear();
  topics_->add_image(*moment, 0, 0.04, "a picture");
  ASSERT_EQ(messages_.size(), 3U);
  EXPECT_EQ(messages_[0].topic, "/tf");
  EXPECT_EQ(messages_[1].topic, "/d_1/camera/camera_info");
  EXPECT_EQ(messages_[2].topic, "/d_1/camera/image_color/compressed");
  EXPECT_EQ(messages_[2].bytes,
            ros::compressed_image({"d_1/camera_optical_frame", 0.04}, "jpeg", "a picture"));
  for (const ros::TopicMessage& message : messages_) EXPECT_EQ(message.time_s, 0.04);
  // No stamp comes twice in /tf: neither that of the last image nor that of a sample.
  messages_.clear();
  topics_->add_image(*moment, 0, 0.04, "a picture");
  topics_->add_image(*moment, 0, 0.05, "a picture");
  EXPECT_EQ(of_topic("/tf").size(), 0U);
  EXPECT_EQ(messages_.size(), 4U);
}

TEST_F(FlightTopicsTest, DronesMustDifferInRos) {
  jobs::write_yard(folder_.path());
  EXPECT_THROW(begin("d-1", "d_1"), InputError);
}

}  // namespace
}  // namespace throng::live
