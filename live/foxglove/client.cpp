#include "live/foxglove/client.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/text/suggest.h"
#include "live/foxglove/server_messages.h"

namespace throng::foxglove {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using nlohmann::json;

namespace {

constexpr const char* kSubprotocol = "foxglove.websocket.v1";
constexpr std::size_t kMaxFrameBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxClientChannels = 200;
constexpr std::uint32_t kMaxHeaderBytes = 8192;
constexpr std::chrono::seconds kMaxHandshake(10);

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// Whether a list of words separated by commas has this one.
bool has_word(beast::string_view list, const char* word) {
  const http::token_list words(list);
  return std::any_of(words.begin(), words.end(),
                     [&](beast::string_view each) { return each == word; });
}

}  // namespace

Client::Client(asio::ip::tcp::socket socket, Shared& shared)
    : stream_(std::move(socket)), shared_(shared) {
  ++shared_.connections;
}

Client::~Client() {
  --shared_.connections;
  if (is_accepted_) --shared_.accepted;
}

void Client::start() {
  beast::get_lowest_layer(stream_).expires_after(kMaxHandshake);
  parser_.emplace();
  parser_->header_limit(kMaxHeaderBytes);
  http::async_read(stream_.next_layer(), buffer_, *parser_,
                   [self = shared_from_this()](beast::error_code error, std::size_t) {
                     self->take_request(error);
                   });
}

void Client::take_request(beast::error_code error) {
  if (error) return;
  const Request& request = parser_->get();
  if (!websocket::is_upgrade(request)) {
    return refuse(
        http::status::upgrade_required,
        "This is a live flight of throng for clients of Foxglove's WebSocket protocol.\n");
  }
  if (!is_allowed_origin(view(request[http::field::origin]), shared_.origins)) {
    return refuse(http::status::forbidden,
                  fmt::format("found the origin {}, expected one that --allow-origin names\n",
                              view(request[http::field::origin])));
  }
  if (!has_word(request[http::field::sec_websocket_protocol], kSubprotocol)) {
    return refuse(http::status::bad_request,
                  fmt::format("found the subprotocols \"{}\", expected {}\n",
                              view(request[http::field::sec_websocket_protocol]), kSubprotocol));
  }
  if (shared_.accepted >= kMaxClients) {
    return refuse(http::status::service_unavailable,
                  fmt::format("found {} clients, expected fewer\n", kMaxClients));
  }
  ++shared_.accepted;
  is_accepted_ = true;
  beast::get_lowest_layer(stream_).expires_never();  // the stream has timeouts of its own
  stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  stream_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
    response.set(http::field::sec_websocket_protocol, kSubprotocol);
  }));
  stream_.read_message_max(kMaxFrameBytes);
  stream_.async_accept(
      request, [self = shared_from_this()](beast::error_code failed) { self->begin(failed); });
}

void Client::refuse(http::status status, std::string text) {
  constexpr unsigned kHttp11 = 11;
  response_ = std::make_unique<Response>(status, kHttp11, std::move(text));
  response_->set(http::field::content_type, "text/plain; charset=utf-8");
  response_->keep_alive(false);
  response_->prepare_payload();
  http::async_write(stream_.next_layer(), *response_,
                    [self = shared_from_this()](beast::error_code, std::size_t) {
                      beast::error_code ignored;
                      self->stream_.next_layer().socket().shutdown(
                          asio::ip::tcp::socket::shutdown_send, ignored);
                    });
}

void Client::begin(beast::error_code error) {
  if (error) return;
  parser_.reset();
  is_open_ = true;
  shared_.clients.insert(shared_from_this());
  send_text(shared_.greeting_info);
  send_text(shared_.greeting_channels);
  send_text(shared_.greeting_services);
  read();
}

void Client::read() {
  buffer_.clear();
  stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    self->take_frame(error);
  });
}

void Client::take_frame(beast::error_code error) {
  if (error) return leave();
  const std::string_view bytes(static_cast<const char*>(buffer_.data().data()), buffer_.size());
  try {
    const ClientMessage message =
        stream_.got_text() ? read_text_message(bytes) : read_binary_message(bytes);
    std::visit([this](const auto& each) { take(each); }, message);
  } catch (const InputError& problem) {
    send_status(Level::error, problem.what());
  }
  if (is_open_) read();
}

void Client::send(Outgoing message) {
  if (!is_open_) return;
  queue_.push(std::move(message));
  if (queue_.is_overrun()) return leave();
  send_next();
}

void Client::send_text(std::string text) { send({Rank::control, false, std::move(text)}); }

void Client::send_status(Level level, std::string_view text) { send_text(status(level, text)); }

void Client::send_next() {
  if (is_sending_ || !is_open_) return;
  std::optional<Outgoing> next = queue_.pop();
  if (!next) {
    if (is_ending_) {
      is_sending_ = true;
      stream_.async_close(websocket::close_code::going_away,
                          [self = shared_from_this()](beast::error_code) { self->leave(); });
    }
    return;
  }
  is_sending_ = true;
  sent_ = std::move(*next);
  stream_.binary(sent_.is_binary);
  const asio::const_buffer body =
      sent_.body ? asio::buffer(*sent_.body) : asio::const_buffer(nullptr, 0);
  stream_.async_write(std::array{asio::const_buffer(asio::buffer(sent_.head)), body},
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (error) return self->leave();
                        self->is_sending_ = false;
                        self->send_next();
                      });
}

void Client::close_when_sent() {
  is_ending_ = true;
  send_next();
}

void Client::leave() {
  if (!std::exchange(is_open_, false)) return;
  for (const auto& [channel, id] : subscribed_) shared_.on_subscription(channel, -1);
  subscribed_.clear();
  subscriptions_.clear();
  beast::get_lowest_layer(stream_).close();
  shared_.clients.erase(shared_from_this());
  shared_.on_leave();
}

void Client::publish(std::size_t channel, const Published& message) {
  const auto found = subscribed_.find(channel);
  if (found == subscribed_.end()) return;
  const Rank rank = shared_.channels[channel].is_image ? Rank::image : Rank::data;
  send({rank, true, data_head(found->second, message.time_ns), message.body});
}

void Client::send_changed(const std::vector<Parameter>& changed) {
  std::vector<Parameter> seen;
  std::copy_if(changed.begin(), changed.end(), std::back_inserter(seen),
               [&](const Parameter& each) { return watched_.count(each.name) > 0; });
  if (!seen.empty()) send_text(parameter_values(seen, {}));
}

void Client::take(const Subscribe& message) {
  for (const Subscription& asked : message.subscriptions) subscribe(asked);
}

void Client::subscribe(const Subscription& asked) {
  const auto refuse_it = [&](const std::string& found, const std::string& expected) {
    send_status(Level::error,
                Problem{"subscribe", fmt::format("id {}", asked.id), found, expected}.text());
  };
  const std::size_t channel = asked.channel;
  if (channel >= shared_.channels.size()) {
    return refuse_it(fmt::format("channel {}", channel),
                     fmt::format("one from 0 to {}", shared_.channels.size() - 1));
  }
  if (subscriptions_.count(asked.id) > 0) return refuse_it("an id in use", "another one");
  if (subscribed_.count(channel) > 0) {
    return refuse_it(shared_.channels[channel].topic + " again", "one subscription of a channel");
  }
  subscriptions_[asked.id] = channel;
  subscribed_[channel] = asked.id;
  shared_.on_subscription(channel, 1);
  if (const Published& last = shared_.latched[channel]; last.body) publish(channel, last);
}

void Client::take(const Unsubscribe& message) {
  for (const std::uint32_t id : message.ids) {
    const auto found = subscriptions_.find(id);
    if (found == subscriptions_.end()) {
      send_status(
          Level::warning,
          Problem{"unsubscribe", "", fmt::format("id {}", id), "the id of a subscription"}.text());
      continue;
    }
    shared_.on_subscription(found->second, -1);
    subscribed_.erase(found->second);
    subscriptions_.erase(found);
  }
}

void Client::take(const Advertise& message) {
  for (const ClientChannel& channel : message.channels) {
    try {
      if (channels_.size() >= kMaxClientChannels) {
        throw InputError({channel.topic, "", fmt::format("channel {}", channels_.size() + 1),
                          fmt::format("at most {}", kMaxClientChannels)});
      }
      shared_.hooks.check_channel(channel);
      if (!channels_.emplace(channel.id, channel).second) {
        throw InputError({channel.topic, "", fmt::format("the id {}, which is in use", channel.id),
                          "another id"});
      }
    } catch (const InputError& problem) {
      send_status(Level::error, problem.what());
    }
  }
}

void Client::take(const Unadvertise& message) {
  for (const std::uint32_t id : message.ids) channels_.erase(id);
}

std::vector<Parameter> Client::named_parameters(const std::vector<std::string>& names) const {
  std::vector<Parameter> all = shared_.hooks.parameters();
  if (names.empty()) return all;
  std::vector<std::string_view> known;
  known.reserve(all.size());
  for (const Parameter& parameter : all) known.push_back(parameter.name);
  std::vector<Parameter> chosen;
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      throw InputError(unknown_name("parameters", "", "parameter", name, known));
    }
    chosen.push_back(all[static_cast<std::size_t>(found - known.begin())]);
  }
  return chosen;
}

void Client::take(const GetParameters& message) {
  send_text(parameter_values(named_parameters(message.names), message.id));
}

void Client::take(const SetParameters& message) {
  shared_.hooks.set_parameters(message.parameters);
  if (!message.id) return;
  std::vector<std::string> names;
  for (const Parameter& parameter : message.parameters) names.push_back(parameter.name);
  send_text(parameter_values(named_parameters(names), message.id));
}

void Client::take(const SubscribeParameters& message) {
  for (const Parameter& parameter : named_parameters(message.names)) {
    watched_.insert(parameter.name);
  }
}

void Client::take(const UnsubscribeParameters& message) {
  if (message.names.empty()) watched_.clear();
  for (const std::string& name : message.names) watched_.erase(name);
}

void Client::take(const ClientData& message) {
  const auto channel = channels_.find(message.channel);
  if (channel == channels_.end()) {
    throw InputError({"message", "", fmt::format("data of the channel {}", message.channel),
                      "a channel that was advertised and accepted"});
  }
  shared_.hooks.take_message(channel->second, message.bytes);
}

void Client::take(const ServiceCall& message) {
  const auto fail = [&](const std::string& problem) {
    send_text(service_failure(message.service, message.call, problem));
  };
  if (message.service >= shared_.services.size()) {
    return fail(Problem{"service", "", fmt::format("id {}", message.service),
                        fmt::format("one from 0 to {}", shared_.services.size() - 1)}
                    .text());
  }
  const std::string& name = shared_.services[message.service].name;
  try {
    if (message.encoding != "json") {
      throw InputError({name, "encoding", "\"" + message.encoding + "\"", "\"json\""});
    }
    const json request = message.bytes.empty()
                             ? json::object()
                             : parse_json(message.bytes, name, kRequestJsonLimits);
    const auto answer = [weak = weak_from_this(), service = message.service, call = message.call](
                            const std::string& problem, const json& response) {
      const std::shared_ptr<Client> self = weak.lock();
      if (!self) return;
      asio::post(self->stream_.get_executor(), [self, service, call, problem, response] {
        if (!problem.empty()) return self->send_text(service_failure(service, call, problem));
        self->send({Rank::control, true, service_response(service, call, response.dump())});
      });
    };
    shared_.hooks.call(message.service, request, answer);
  } catch (const InputError& problem) {
    fail(problem.what());
  }
}

}  // namespace throng::foxglove
