// One connection of a client. All runs on the server's thread.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "live/foxglove/channels.h"
#include "live/foxglove/client_messages.h"
#include "live/foxglove/client_queue.h"

namespace throng::foxglove {

class Client;

inline constexpr std::size_t kMaxClients = 16;

/// A message of a channel, or none.
struct Published {
  std::uint64_t time_ns = 0;
  std::shared_ptr<const std::string> body = nullptr;
};

/// Everything that the connections of a server share.
struct Shared {
  std::vector<Channel> channels;
  std::vector<Service> services;
  Hooks hooks;
  std::vector<std::string> origins;
  std::string greeting_info;
  std::string greeting_channels;
  std::string greeting_services;
  std::vector<Published> latched;             ///< per channel
  std::set<std::shared_ptr<Client>> clients;  ///< connected
  std::size_t connections = 0;                ///< also of those that have not begun yet
  std::size_t accepted = 0;                   ///< those whose request was, at most kMaxClients
  std::function<void(std::size_t channel, int change)> on_subscription;
  std::function<void()> on_leave;  ///< a client has gone
};

class Client : public std::enable_shared_from_this<Client> {
 public:
  /// `shared` outlives the client.
  Client(boost::asio::ip::tcp::socket socket, Shared& shared);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Reads the request, and refuses it or begins.
  void start();
  void send(Outgoing message);
  void send_status(Level level, std::string_view text);
  /// Sends the message if the client has subscribed to the channel.
  void publish(std::size_t channel, const Published& message);
  /// Sends those of the changed parameters to which it has subscribed.
  void send_changed(const std::vector<Parameter>& changed);
  /// Ends the connection when everything is sent.
  void close_when_sent();
  /// Ends the connection now.
  void leave();

 private:
  using Request = boost::beast::http::request<boost::beast::http::empty_body>;
  using Response = boost::beast::http::response<boost::beast::http::string_body>;

  void take_request(boost::beast::error_code error);
  void refuse(boost::beast::http::status status, std::string text);
  void begin(boost::beast::error_code error);
  void read();
  void take_frame(boost::beast::error_code error);
  void send_next();
  void send_text(std::string text);

  // Each does what a message asks for.
  void take(const Subscribe& message);
  void take(const Unsubscribe& message);
  void take(const Advertise& message);
  void take(const Unadvertise& message);
  void take(const GetParameters& message);
  void take(const SetParameters& message);
  void take(const SubscribeParameters& message);
  void take(const UnsubscribeParameters& message);
  void take(const ClientData& message);
  void take(const ServiceCall& message);
  void subscribe(const Subscription& asked);
  std::vector<Parameter> named_parameters(const std::vector<std::string>& names) const;

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  Shared& shared_;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
  std::unique_ptr<Response> response_;
  ClientQueue queue_;
  Outgoing sent_;  ///< the message that is being sent
  bool is_accepted_ = false;
  bool is_open_ = false;
  bool is_sending_ = false;
  bool is_ending_ = false;
  std::map<std::uint32_t, std::size_t> subscriptions_;  ///< channels' indices by id
  std::map<std::size_t, std::uint32_t> subscribed_;     ///< the inverse
  std::map<std::uint32_t, ClientChannel> channels_;     ///< on which it publishes
  std::set<std::string> watched_;                       ///< names of parameters
};

}  // namespace throng::foxglove
