#include "live/foxglove/server.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <thread>
#include <utility>

#include "base/error.h"
#include "live/foxglove/client.h"
#include "live/foxglove/server_messages.h"

namespace throng::foxglove {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr std::size_t kMaxConnections = 2 * kMaxClients;  // half of which may be beginning
/// Messages that wait for the server's thread; more are dropped.
constexpr std::int64_t kMaxWaitingBytes = 64 << 20;
constexpr std::int64_t kBytesOfMessage = 1024;  ///< besides its content
constexpr std::chrono::seconds kMaxFarewell(1);

tcp::endpoint endpoint(const ServerOptions& options) {
  boost::system::error_code error;
  const asio::ip::address address =
      asio::ip::make_address(options.host == "localhost" ? "127.0.0.1" : options.host, error);
  if (error) throw InputError({"--host", "", options.host, "an address such as 127.0.0.1"});
  return {address, options.port};
}

/// The part of an origin behind "http://" or "https://", without the port; "" for others.
std::string_view web_host(std::string_view origin) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!origin.starts_with(scheme)) continue;
    origin.remove_prefix(scheme.size());
    const std::size_t colon = origin.rfind(':');
    const bool has_port = colon != std::string_view::npos && origin.back() != ']';
    return has_port ? origin.substr(0, colon) : origin;
  }
  return {};
}

}  // namespace

bool is_allowed_origin(std::string_view origin, const std::vector<std::string>& more) {
  constexpr std::array<std::string_view, 3> kOwn = {"localhost", "127.0.0.1", "[::1]"};
  constexpr std::array<std::string_view, 2> kFoxglove = {"https://app.foxglove.dev", "file://"};
  if (origin.empty()) return true;
  if (std::find(kOwn.begin(), kOwn.end(), web_host(origin)) != kOwn.end()) return true;
  if (std::find(kFoxglove.begin(), kFoxglove.end(), origin) != kFoxglove.end()) return true;
  return std::any_of(more.begin(), more.end(),
                     [&](const std::string& each) { return each == "*" || each == origin; });
}

struct Server::State {
  Shared shared;
  std::vector<std::atomic<int>> subscribers;  ///< per channel
  std::vector<Parameter> known;               ///< parameters when they were last compared
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  asio::steady_timer farewell{context};
  asio::steady_timer pause{context};
  std::uint16_t port = 0;
  bool is_ending = false;
  std::atomic<std::int64_t> waiting_bytes{0};  ///< of messages, for the thread
  std::thread thread;

  explicit State(std::size_t channels) : subscribers(channels) {}

  void listen(const ServerOptions& options) {
    const tcp::endpoint place = endpoint(options);
    try {
      acceptor.open(place.protocol());
      acceptor.set_option(tcp::acceptor::reuse_address(true));
      acceptor.bind(place);
      acceptor.listen();
      port = acceptor.local_endpoint().port();
    } catch (const boost::system::system_error& error) {
      throw EnvironmentError(
          fmt::format("cannot listen on {}, port {}: {}; --port 0 takes a free port", options.host,
                      options.port, error.code().message()));
    }
  }

  void accept() {
    acceptor.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later();  // such as no more file descriptors
      // More are not served.
      if (shared.connections < kMaxConnections) {
        boost::system::error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        std::make_shared<Client>(std::move(socket), shared)->start();
      }
      accept();
    });
  }

  void accept_later() {
    constexpr std::chrono::milliseconds kPause(100);
    pause.expires_after(kPause);
    pause.async_wait([this](boost::system::error_code error) {
      if (!error && !is_ending) accept();
    });
  }

  template <typename Do>
  void for_clients(Do act) {
    // A client that fails leaves meanwhile.
    const std::vector<std::shared_ptr<Client>> all(shared.clients.begin(), shared.clients.end());
    for (const std::shared_ptr<Client>& client : all) act(*client);
  }

  void compare_parameters() {
    std::vector<Parameter> now = shared.hooks.parameters();
    std::vector<Parameter> changed;
    for (const Parameter& parameter : now) {
      const bool is_same = std::any_of(known.begin(), known.end(), [&](const Parameter& old) {
        return old.name == parameter.name && old.value == parameter.value;
      });
      if (!is_same) changed.push_back(parameter);
    }
    known = std::move(now);
    for_clients([&](Client& client) { client.send_changed(changed); });
  }

  void say_goodbye() {
    is_ending = true;
    acceptor.close();
    for_clients([](Client& client) { client.close_when_sent(); });
    farewell.expires_after(kMaxFarewell);
    farewell.async_wait([this](boost::system::error_code) {
      // Connections may not outlive the context.
      for_clients([](Client& client) { client.leave(); });
      context.stop();
    });
    stop_if_empty();
  }

  void stop_if_empty() {
    if (is_ending && shared.clients.empty()) context.stop();
  }
};

Server::Server(const ServerOptions& options, std::vector<Channel> channels,
               std::vector<Service> services, Hooks hooks)
    : state_(std::make_unique<State>(channels.size())) {
  State& state = *state_;
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  state.shared.greeting_info = server_info(options.name, std::to_string(now));
  state.shared.greeting_channels = advertise_channels(channels);
  state.shared.greeting_services = advertise_services(services);
  state.shared.latched.resize(channels.size());
  state.shared.channels = std::move(channels);
  state.shared.services = std::move(services);
  state.shared.hooks = std::move(hooks);
  state.shared.origins = options.origins;
  state.shared.on_subscription = [&state](std::size_t channel, int change) {
    state.subscribers[channel] += change;
  };
  state.shared.on_leave = [&state] { state.stop_if_empty(); };
  state.listen(options);
}

void Server::start() {
  state_->accept();
  state_->thread = std::thread([state = state_.get()] { state->context.run(); });
}

Server::~Server() {
  if (!state_->thread.joinable()) return;
  asio::post(state_->context, [state = state_.get()] { state->say_goodbye(); });
  state_->thread.join();
}

std::uint16_t Server::port() const { return state_->port; }

bool Server::is_subscribed(std::size_t channel) const {
  return state_->subscribers.at(channel) > 0;
}

void Server::publish(std::size_t channel, std::uint64_t time_ns, std::string bytes) {
  State* state = state_.get();
  const bool is_latched = state->shared.channels.at(channel).is_latched;
  if (!is_latched && !is_subscribed(channel)) return;
  const auto size = static_cast<std::int64_t>(bytes.size()) + kBytesOfMessage;
  if (!is_latched && state->waiting_bytes + size > kMaxWaitingBytes) return;
  state->waiting_bytes += size;
  Published message{time_ns, std::make_shared<const std::string>(std::move(bytes))};
  asio::post(state->context, [=, message = std::move(message)] {
    state->waiting_bytes -= size;
    if (is_latched) state->shared.latched[channel] = message;
    state->for_clients([&](Client& client) { client.publish(channel, message); });
  });
}

void Server::tell_time(std::uint64_t time_ns) {
  if (state_->waiting_bytes > kMaxWaitingBytes) return;
  state_->waiting_bytes += kBytesOfMessage;
  asio::post(state_->context, [state = state_.get(), time_ns] {
    state->waiting_bytes -= kBytesOfMessage;
    state->for_clients([&](Client& client) {
      client.send({Rank::data, true, time_message(time_ns)});
    });
  });
}

void Server::refresh_parameters() {
  asio::post(state_->context, [state = state_.get()] { state->compare_parameters(); });
}

void Server::tell(Level level, const std::string& text) {
  asio::post(state_->context, [state = state_.get(), level, text] {
    state->for_clients([&](Client& client) { client.send_status(level, text); });
  });
}

}  // namespace throng::foxglove
