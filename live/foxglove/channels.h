// Channels and services of a server, and the program behind it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "live/foxglove/client_messages.h"

namespace throng::foxglove {

/// A channel of the server. Messages are CDR, schemas are in the text of ros2msg.
struct Channel {
  std::string topic;
  std::string schema_name;
  std::string schema;
  bool is_image = false;    ///< the first to be dropped for slow clients
  bool is_latched = false;  ///< those who subscribe get the last message
};

/// A service. Requests and responses are JSON, described by JSON Schemas.
struct Service {
  std::string name;
  std::string type;
  std::string request_schema;
  std::string response_schema;
};

/// Severity of a status message.
enum class Level : std::uint8_t { info, warning, error };

/// Answers a call of a service, once: a problem, or else the response. From any thread, while the
/// server exists.
using ServiceAnswer = std::function<void(const std::string& problem, const nlohmann::json&)>;

/// The program behind the server. All are called on the server's thread; an InputError is reported
/// to the client.
struct Hooks {
  /// Checks a channel on which a client wants to publish.
  std::function<void(const ClientChannel&)> check_channel;
  std::function<void(const ClientChannel&, std::string_view bytes)> take_message;
  std::function<std::vector<Parameter>()> parameters;  ///< all of them
  std::function<void(const std::vector<Parameter>&)> set_parameters;
  /// `service` is an index.
  std::function<void(std::size_t service, const nlohmann::json& request, ServiceAnswer)> call;
};

/// Whether a page of this origin may connect: none (programs), this machine's, Foxglove's, and the
/// given ones. Any page that a user opens could otherwise steer.
bool is_allowed_origin(std::string_view origin, const std::vector<std::string>& more);

}  // namespace throng::foxglove
