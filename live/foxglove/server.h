// A server of the WebSocket protocol foxglove.websocket.v1: channels that clients subscribe to,
// channels on which clients publish, parameters and services.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "live/foxglove/channels.h"
#include "live/foxglove/client_messages.h"

namespace throng::foxglove {

/// Address of the server, and those who may connect.
struct ServerOptions {
  std::string name = "throng";       ///< shown to users
  std::string host = "127.0.0.1";    ///< an address of this machine
  std::uint16_t port = 8765;         ///< 0: a free one
  std::vector<std::string> origins;  ///< web pages that may connect besides those of this machine
                                     ///< and of Foxglove; "*": all
};

/// Safe to use from many threads. No member waits for clients.
class Server {
 public:
  /// Listens, but answers nobody before start(). Throws InputError for a wrong host and
  /// EnvironmentError if the port is taken.
  Server(const ServerOptions& options, std::vector<Channel> channels, std::vector<Service> services,
         Hooks hooks);
  /// Ends all connections: clients get what they wait for unless that takes longer than a second.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Calls the hooks from now on. Once.
  void start();

  std::uint16_t port() const;
  /// Whether a client has subscribed to the channel with this index.
  bool is_subscribed(std::size_t channel) const;
  /// Sends a message, stamped with a time from the run's start, to those who have subscribed. It is
  /// dropped, unless it is latched, where the server's thread is too far behind.
  void publish(std::size_t channel, std::uint64_t time_ns, std::string bytes);
  /// Tells the time to all clients.
  void tell_time(std::uint64_t time_ns);
  /// Sends those parameters that have changed to those who have subscribed to them.
  void refresh_parameters();
  /// Sends a status to all clients.
  void tell(Level level, const std::string& text);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace throng::foxglove
