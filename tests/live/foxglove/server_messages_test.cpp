// Frames of the server, byte by byte.
#include "live/foxglove/server_messages.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace throng::foxglove {
namespace {

using nlohmann::json;

TEST(ServerMessages, BinaryFramesAreLittleEndian) {
  EXPECT_EQ(data_head(0x01020304, 0x1112131415161718),
            std::string("\1\4\3\2\1\x18\x17\x16\x15\x14\x13\x12\x11", 13));
  EXPECT_EQ(time_message(5), std::string("\2\5\0\0\0\0\0\0\0", 9));
  EXPECT_EQ(service_response(1, 2, "{}"), std::string("\3\1\0\0\0\2\0\0\0\4\0\0\0json{}", 19));
}

TEST(ServerMessages, TextHasTheFieldsOfTheProtocol) {
  const json channels = json::parse(advertise_channels(
      {{"/clock", "rosgraph_msgs/msg/Clock", "text"}, {"/tf", "tf2_msgs/msg/TFMessage", "more"}}));
  EXPECT_EQ(channels.at("op"), "advertise");
  EXPECT_EQ(channels.at("channels").at(1), json({{"id", 1},
                                                 {"topic", "/tf"},
                                                 {"encoding", "cdr"},
                                                 {"schemaName", "tf2_msgs/msg/TFMessage"},
                                                 {"schema", "more"},
                                                 {"schemaEncoding", "ros2msg"}}));
  const json services =
      json::parse(advertise_services({{"/stop", "std_srvs/srv/Trigger", "{}", "{}"}}));
  EXPECT_EQ(services.at("services").at(0).at("request").at("encoding"), "json");
  const json values = json::parse(parameter_values({{"factor", 2.0}, {"paused", true}}, "id"));
  EXPECT_EQ(values.at("id"), "id");
  EXPECT_EQ(values.at("parameters").at(0).at("type"), "float64");
  EXPECT_FALSE(values.at("parameters").at(1).contains("type"));
  EXPECT_FALSE(json::parse(parameter_values({}, {})).contains("id"));
  EXPECT_EQ(json::parse(status(Level::error, "\xff")).at("level"), 2);
  EXPECT_EQ(json::parse(server_info("a", "b")).at("sessionId"), "b");
}

TEST(Origins, OnlyThoseOfThisMachineAndFoxgloveMayConnect) {
  for (const char* origin : {"", "http://localhost:8080", "https://127.0.0.1", "http://[::1]:80",
                             "https://app.foxglove.dev", "file://"}) {
    EXPECT_TRUE(is_allowed_origin(origin, {})) << origin;
  }
  for (const char* origin : {"null", "https://example.org", "http://localhost.example.org",
                             "https://app.foxglove.dev.example.org", "localhost", "http://"}) {
    EXPECT_FALSE(is_allowed_origin(origin, {})) << origin;
    EXPECT_TRUE(is_allowed_origin(origin, {"*"})) << origin;
  }
  EXPECT_TRUE(is_allowed_origin("https://example.org", {"https://example.org"}));
}

}  // namespace
}  // namespace throng::foxglove
