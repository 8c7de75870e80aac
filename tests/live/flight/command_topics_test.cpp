// Commands as clients publish them.
#include "live/flight/outside/command_topics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "formats/recording/message_sink.h"
#include "spec/live/messages.h"

namespace throng::live {
namespace {

using nlohmann::json;

const CommandTopics& topics() {
  static const CommandTopics topics({{"d1"}, {"d-2", false}}, {"d1", "d_2"});
  return topics;
}

json read(const std::string& topic, const std::string& text) {
  return to_json(topics().read({topic, "json", "", text})).at("drones").at(0);
}

/// A message in CDR, which is kept while it is read.
json read_cdr(const std::string& topic, const std::string& schema, const std::string& bytes) {
  return to_json(topics().read({topic, "cdr", schema, bytes})).at("drones").at(0);
}

/// A message of numbers only.
std::string cdr(std::initializer_list<double> numbers) {
  std::string bytes("\0\1\0\0", 4);
  for (const double number : numbers) append_value(bytes, number);
  return bytes;
}

/// geometry_msgs/TwistStamped, as the program itself writes it.
std::string stamped_twist() {
  return formats::ros::velocity({"world", 1.5}, {1, 2, 3}, {0, 0, EIGEN_PI / 2});
}

template <typename Act>
std::string problem(Act act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string refused(const std::string& topic, const std::string& text) {
  return problem([&] { read(topic, text); });
}

TEST(CommandTopics, TextBecomesCommands) {
  EXPECT_EQ(read("/d_2/cmd_vel", R"({"linear": {"x": 2, "z": -1}})"),
            json::parse(R"({"id": "d-2", "velocity_mps": [2, 0, -1], "yaw_rate_deg_s": 0,
                            "waypoints_m": []})"));
  EXPECT_EQ(read("/d1/cmd_pose", R"({"position": {"x": 1, "y": 2, "z": 3}, "speed_mps": 2})"),
            json::parse(R"({"id": "d1", "position_m": [1, 2, 3], "speed_mps": 2})"));
  EXPECT_EQ(read("/d1/cmd_waypoints", R"({"waypoints": [[1, 2, 3]], "yaw_deg": 90})"),
            json::parse(R"({"id": "d1", "waypoints_m": [[1, 2, 3]], "yaw_deg": 90})"));
  EXPECT_EQ(read("/d1/beacon", R"({"data": false})"),
            json::parse(R"({"id": "d1", "beacon": false})"));
}

TEST(CommandTopics, StampedMessagesAreRead) {
  const json turned = read("/d1/cmd_pose", R"({"header": {}, "pose": {"position": {"z": 9},
      "orientation": {"z": 0.6, "w": 0.8}}})");
  EXPECT_EQ(turned.at("position_m"), json({0, 0, 9}));
  EXPECT_NEAR(turned.at("yaw_deg").get<double>(), 73.739795, 1e-5);
  EXPECT_EQ(
      read("/d1/cmd_vel", R"({"header": {}, "twist": {"linear": {"y": 1}}})").at("velocity_mps"),
      json({0, 1, 0}));
}

TEST(CommandTopics, CdrIsReadWithItsAlignment) {
  const json fields = read_cdr("/d1/cmd_vel", "geometry_msgs/msg/TwistStamped", stamped_twist());
  EXPECT_EQ(fields.at("velocity_mps"), json({1.0, 2.0, 3.0}));
  EXPECT_NEAR(fields.at("yaw_rate_deg_s").get<double>(), 90, 1e-9);
  const std::string pose = cdr({4, 5, 6, 0, 0, 0, 1});
  EXPECT_EQ(read_cdr("/d1/cmd_pose", "geometry_msgs/Pose", pose).at("yaw_deg"), 0.0);
  const std::string flag = cdr({}) + '\1';
  EXPECT_EQ(read_cdr("/d_2/beacon", "Bool", flag).at("beacon"), true);
}

TEST(CommandTopics, PathsAreReadWithTheHeadingOfTheirEnd) {
  // nav_msgs/Path: a header, then poses with headers of their own.
  std::string bytes("\0\1\0\0", 4);
  const auto append = [&](auto number) {
    while ((bytes.size() - 4) % sizeof(number) != 0) bytes += '\0';
    append_value(bytes, number);
  };
  const auto append_header = [&](const std::string& frame) {
    append(std::int32_t{1});
    append(std::uint32_t{2});
    append(static_cast<std::uint32_t>(frame.size() + 1));
    bytes += frame + '\0';
  };
  append_header("world");
  append(std::uint32_t{2});
  for (const double x : {1.0, 2.0}) {
    append_header("map");
    for (const double number : {x, 3.0, 12.0, 0.0, 0.0, x == 2 ? 0.6 : 0.0, x == 2 ? 0.8 : 0.0}) {
      append(number);
    }
  }
  const json fields = read_cdr("/d1/cmd_waypoints", "nav_msgs/msg/Path", bytes);
  EXPECT_EQ(fields.at("waypoints_m"), json::parse("[[1.0, 3.0, 12.0], [2.0, 3.0, 12.0]]"));
  EXPECT_NEAR(fields.at("yaw_deg").get<double>(), 73.739795, 1e-5);
  EXPECT_NE(problem([&] {
              read_cdr("/d1/cmd_waypoints", "nav_msgs/msg/Path", bytes.substr(0, bytes.size() - 1));
            }),
            "");
}

TEST(CommandTopics, AnOrientationThatNobodyHasSetLeavesTheHeading) {
  const json fields = read_cdr("/d1/cmd_pose", "geometry_msgs/Pose", cdr({4, 5, 6, 0, 0, 0, 0}));
  EXPECT_FALSE(fields.contains("yaw_deg"));
}

TEST(CommandTopics, GimbalsTakeAnglesOrAnOrientation) {
  EXPECT_EQ(read("/d1/gimbal", R"({"pitch_deg": -60, "yaw_deg": 10})").at("gimbal_deg"),
            json({-60, 10}));
  // 30 degrees down: positive about y, as REP 103 has it; and 90 to the left.
  const double s = std::sin(EIGEN_PI / 12);
  const double c = std::cos(EIGEN_PI / 12);
  const json down =
      read_cdr("/d1/gimbal", "geometry_msgs/msg/Quaternion", cdr({0, s, 0, c})).at("gimbal_deg");
  EXPECT_NEAR(down[0].get<double>(), -30, 1e-9);
  EXPECT_NEAR(down[1].get<double>(), 0, 1e-9);
  const json left = read("/d1/gimbal", R"({"orientation": {"z": 0.70710678, "w": 0.70710678}})");
  EXPECT_NEAR(left.at("gimbal_deg")[1].get<double>(), 90, 1e-6);
  EXPECT_NE(refused("/d1/gimbal", R"({"orientation": {"x": 0.6, "w": 0.8}})"), "") << "roll";
  EXPECT_EQ(refused("/d1/gimbal", "{}"),
            "/d1/gimbal: /pitch_deg: found nothing, expected degrees above the horizon, or an "
            "orientation");
  EXPECT_EQ(refused("/d_2/gimbal", R"({"pitch_deg": 0})"),
            "/d_2/gimbal: /pitch_deg and yaw_deg: found a direction for a rigid camera, expected "
            "none: the job's camera has gimbal.model rigid");
}

TEST(CommandTopics, CutOrStrangeCdrIsRefused) {
  const std::string whole = stamped_twist();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::string cut = whole.substr(0, length);
    const std::string text =
        problem([&] { read_cdr("/d1/cmd_vel", "geometry_msgs/TwistStamped", cut); });
    EXPECT_TRUE(text.starts_with("/d1/cmd_vel: found ")) << length << text;
  }
  std::string big_endian = whole;
  big_endian[1] = '\0';
  EXPECT_NE(problem([&] { read_cdr("/d1/cmd_vel", "x/TwistStamped", big_endian); }), "");
  const std::string nowhere = cdr({std::nan(""), 0, 0, 0, 0, 0, 1});
  EXPECT_NE(problem([&] { read_cdr("/d1/cmd_pose", "x/Pose", nowhere); }), "");
}

TEST(CommandTopics, MistakesNameTopicAndField) {
  EXPECT_EQ(refused("/d1/cmd_vel", R"({"linear": {"x": "fast"}})"),
            R"(/d1/cmd_vel: /linear: found ["fast",0,0], expected 3 numbers from -20 to 20)");
  EXPECT_EQ(refused("/d1/cmd_vel", R"({"linear": [1, 2, 3]})"),
            "/d1/cmd_vel: /linear: found [1,2,3], expected an object with x, y, z");
  EXPECT_EQ(
      refused("/d1/cmd_pose", R"({"position": {"x": 1e5}})"),
      "/d1/cmd_pose: /position: found [100000.0,0,0], expected 3 numbers from -10000 to 10000");
  EXPECT_EQ(refused("/d1/cmd_pose", R"({"position": {}, "orientation": 3})"),
            "/d1/cmd_pose: /orientation/x: found 3, expected a number from -1.1 to 1.1");
  EXPECT_TRUE(refused("/d1/cmd_pose", R"({"position": {}, "yaw_deg": "north"})")
                  .starts_with("/d1/cmd_pose: /yaw_deg: found \"north\""));
  EXPECT_TRUE(refused("/d1/cmd_waypoints", R"({"waypoints": 3})")
                  .starts_with("/d1/cmd_waypoints: /waypoints: found 3"));
  EXPECT_TRUE(refused("/d1/beacon", R"({"data": 1})").starts_with("/d1/beacon: /data: found 1"));
  EXPECT_TRUE(refused("/d1/beacon", "nul").starts_with("/d1/beacon: "));
  EXPECT_EQ(refused("/d1/becon", "{}"),
            R"(channel: unknown topic "/d1/becon"; did you mean "/d1/beacon"?)");
}

TEST(CommandTopics, ChannelsAreChecked) {
  EXPECT_NO_THROW(topics().check({"/d1/cmd_vel", "cdr", "geometry_msgs/msg/Twist", ""}));
  EXPECT_NO_THROW(topics().check({"/d_2/cmd_waypoints", "json", "", ""}));
  EXPECT_EQ(
      problem([] {
        topics().check({"/d1/cmd_waypoints", "cdr", "nav_msgs/Odometry", ""});
      }),
      "/d1/cmd_waypoints: schema: found cdr with \"nav_msgs/Odometry\", expected json, or cdr "
      "with Path or PoseArray");
  EXPECT_EQ(problem([] {
              topics().check({"/d1/beacon", "protobuf", "", ""});
            }),
            "/d1/beacon: encoding: found \"protobuf\", expected json or cdr");
}

}  // namespace
}  // namespace throng::live
