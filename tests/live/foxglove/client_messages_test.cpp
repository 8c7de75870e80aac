// Frames of clients, sound ones and others.
#include "live/foxglove/client_messages.h"

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

namespace throng::foxglove {
namespace {

/// The text of the error for a frame; "" for a sound one.
template <typename Read>
std::string problem(Read read, std::string_view bytes) {
  try {
    read(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ClientMessages, TextIsRead) {
  const auto subscribe = std::get<Subscribe>(read_text_message(
      R"({"op": "subscribe", "subscriptions": [{"id": 0, "channelId": 3}, {"id": 7.0, "channelId": 5}]})"));
  ASSERT_EQ(subscribe.subscriptions.size(), 2U);
  EXPECT_EQ(subscribe.subscriptions[1].id, 7U);
  EXPECT_EQ(subscribe.subscriptions[1].channel, 5U);
  const auto advertise = std::get<Advertise>(read_text_message(
      R"({"op": "advertise", "channels": [{"id": 1, "topic": "/d1/cmd_vel", "encoding": "json"}]})"));
  EXPECT_EQ(advertise.channels.at(0).topic, "/d1/cmd_vel");
  EXPECT_EQ(advertise.channels.at(0).schema_name, "");
  const auto set = std::get<SetParameters>(read_text_message(
      R"({"op": "setParameters", "id": "a", "parameters": [{"name": "factor", "value": 2}, {"name": "x"}]})"));
  EXPECT_EQ(set.id, "a");
  EXPECT_EQ(set.parameters[0].value, 2);
  EXPECT_TRUE(set.parameters[1].value.is_null());
  EXPECT_EQ(std::get<Unsubscribe>(
                read_text_message(R"({"op": "unsubscribe", "subscriptionIds": [4294967295]})"))
                .ids.at(0),
            4294967295U);
}

TEST(ClientMessages, WrongTextIsNamed) {
  const auto found = [](const char* text) { return problem(read_text_message, text); };
  EXPECT_NE(found("{"), "");
  EXPECT_NE(found("\xff"), "");
  EXPECT_EQ(found("[1]"), "message: found [1], expected an object");
  EXPECT_EQ(found("{}"), "message: /op: found nothing, expected a text");
  EXPECT_EQ(found(R"({"op": "subscribed"})"),
            R"(message: /op: unknown operation "subscribed"; did you mean "subscribe"?)");
  EXPECT_EQ(found(R"({"op": "subscribe", "subscriptions": [{"id": -1, "channelId": 3}]})"),
            "message: /subscriptions/0/id: found -1, expected an integer from 0 to 4294967295");
  EXPECT_EQ(found(R"({"op": "subscribe", "subscriptions": [{"id": 1e300, "channelId": 3}]})"),
            "message: /subscriptions/0/id: found 1e+300, expected an integer from 0 to 4294967295");
  EXPECT_EQ(found(R"({"op": "unadvertise", "channelIds": 3})"),
            "message: /channelIds: found 3, expected a list");
  EXPECT_EQ(found(R"({"op": "getParameters", "parameterNames": [3]})"),
            "message: /parameterNames/0: found 3, expected a text");
  EXPECT_EQ(found(R"({"op": "advertise", "channels": ["/d1"]})"),
            R"(message: /channels/0: found "/d1", expected an object)");
}

TEST(ClientMessages, BinaryFramesAreSplit) {
  const std::string data("\1\2\0\0\0{}", 7);
  const auto message = std::get<ClientData>(read_binary_message(data));
  EXPECT_EQ(message.channel, 2U);
  EXPECT_EQ(message.bytes, "{}");
  const std::string call("\2\1\0\0\0\7\0\0\0\4\0\0\0json{\"steps\":2}", 28);
  const auto service = std::get<ServiceCall>(read_binary_message(call));
  EXPECT_EQ(service.service, 1U);
  EXPECT_EQ(service.call, 7U);
  EXPECT_EQ(service.encoding, "json");
  EXPECT_EQ(service.bytes, "{\"steps\":2}");
  // Cut anywhere, also within the name of the encoding.
  constexpr std::size_t kHead = 17;
  for (std::size_t length = 0; length < kHead; ++length) {
    EXPECT_NE(problem(read_binary_message, std::string_view(call).substr(0, length)), "") << length;
  }
  EXPECT_EQ(problem(read_binary_message, std::string_view(call).substr(0, kHead)), "");
  EXPECT_EQ(problem(read_binary_message, "\x09"),
            "message: found the binary operation 9, expected 1 (data of a channel) or 2 (call of a "
            "service)");
  EXPECT_NE(
      problem(read_binary_message, std::string_view("\2\0\0\0\0\0\0\0\0\xff\xff\xff\xff", 13)), "");
}

}  // namespace
}  // namespace throng::foxglove
