// Messages of clients in the WebSocket protocol foxglove.websocket.v1
// (github.com/foxglove/ws-protocol, docs/spec.md).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace throng::foxglove {

/// A client wants the messages of a channel, under a number that it chooses.
struct Subscription {
  std::uint32_t id = 0;
  std::uint32_t channel = 0;
};
struct Subscribe {
  std::vector<Subscription> subscriptions;
};
struct Unsubscribe {
  std::vector<std::uint32_t> ids;  ///< of subscriptions
};

/// A channel on which a client publishes, under a number that it chooses.
struct ClientChannel {
  std::uint32_t id = 0;
  std::string topic;
  std::string encoding;
  std::string schema_name;
};
struct Advertise {
  std::vector<ClientChannel> channels;
};
struct Unadvertise {
  std::vector<std::uint32_t> ids;  ///< of client channels
};

/// A parameter's name and value.
struct Parameter {
  std::string name;
  nlohmann::json value;
};
struct GetParameters {
  std::vector<std::string> names;  ///< none: all
  std::optional<std::string> id;
};
struct SetParameters {
  std::vector<Parameter> parameters;
  std::optional<std::string> id;
};
struct SubscribeParameters {
  std::vector<std::string> names;  ///< none: all
};
struct UnsubscribeParameters {
  std::vector<std::string> names;  ///< none: all
};

/// A message on a client's channel. The bytes are those of the frame.
struct ClientData {
  std::uint32_t channel = 0;
  std::string_view bytes;
};
struct ServiceCall {
  std::uint32_t service = 0;
  std::uint32_t call = 0;
  std::string encoding;
  std::string_view bytes;
};

using ClientMessage =
    std::variant<Subscribe, Unsubscribe, Advertise, Unadvertise, GetParameters, SetParameters,
                 SubscribeParameters, UnsubscribeParameters, ClientData, ServiceCall>;

/// Reads a text frame. Throws InputError for malformed JSON, unknown operations and wrong fields.
ClientMessage read_text_message(std::string_view text);

/// Reads a binary frame, to which the result refers. Throws InputError for unknown operations and
/// frames that are too short.
ClientMessage read_binary_message(std::string_view bytes);

}  // namespace throng::foxglove
