#include "server/http_server.h"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.h"
#include "server/connection.h"
#include "server/http.h"

namespace throng::server {

namespace {

constexpr std::size_t kThreads = 256;  // one per open connection; half of them may be streams
constexpr int kBacklog = 1024;
constexpr std::size_t kRequestsPerConnection = 1'000'000;
constexpr std::chrono::milliseconds kIdle(2'000);  // between requests
constexpr int kIdleStepMs = 100;                   // bounds how long stop() takes
constexpr std::size_t kSmallBody = 1 << 20;        // not worth to be counted

bool is_number(const std::string& text) {
  constexpr std::size_t kMostDigits = 12;
  return !text.empty() && text.size() <= kMostDigits &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

struct Refusal {
  int status;
  std::string detail;
};

// Why a request is not read on: its body cannot be bounded or its length is unclear.
std::optional<Refusal> refusal_of(const httplib::Request& request) {
  constexpr const char* kWhy =
      "a request with a body needs one Content-Length and no Transfer-Encoding";
  if (request.has_header("Transfer-Encoding")) return Refusal{411, kWhy};
  const std::size_t lengths = request.get_header_value_count("Content-Length");
  if (lengths > 1) return Refusal{400, kWhy};
  if (lengths == 1 && !is_number(request.get_header_value("Content-Length"))) {
    return Refusal{400, kWhy};
  }
  return std::nullopt;
}

// A request that says nothing of a body has none (RFC 9112, 6.3): `curl -X POST`. The library would
// read on until the connection ends.
void say_that_there_is_no_body(const httplib::Request& request) {
  if (request.has_header("Content-Length")) return;
  // The library owns the request and made it non-const.
  const_cast<httplib::Request&>(request)  // NOLINT(cppcoreguidelines-pro-type-const-cast)
      .set_header("Content-Length", "0");
}

std::size_t length_of(const httplib::Request& request) {
  const std::string text = request.get_header_value("Content-Length");
  return text.empty() ? 0 : std::stoull(text);
}

// The library would keep the connection and read the unread body as the next request. It closes
// when a content provider fails, so the body is handed out by one that then does.
void close_after(httplib::Response& response) {
  const auto body = std::make_shared<std::string>(std::move(response.body));
  const std::string type = response.get_header_value("Content-Type");
  response.body.clear();
  response.headers.erase("Content-Type");
  response.set_header("Connection", "close");
  response.set_content_provider(body->size(), type,
                                [body](std::size_t, std::size_t, httplib::DataSink& sink) {
                                  sink.write(body->data(), body->size());
                                  return false;
                                });
}

}  // namespace

bool is_loopback(const std::string& host) {
  in_addr address{};  // the check keeps out names such as "127.example.com"
  return host == "localhost" || host == "::1" ||
         (host.starts_with("127.") && ::inet_pton(AF_INET, host.c_str(), &address) == 1);
}

/// The library's server with bounded connections, and a bound to what bodies take together.
class HttpServer::BoundedServer : public httplib::Server {
 public:
  explicit BoundedServer(std::int64_t most_body_bytes) : most_body_bytes_(most_body_bytes) {}

  /// Notes the memory that this thread's request will take; false when there is too little left.
  bool reserve(std::size_t bytes) {
    if (bytes <= kSmallBody) return true;
    const auto wanted = static_cast<std::int64_t>(bytes);
    if (body_bytes_.fetch_add(wanted) + wanted > most_body_bytes_) {
      body_bytes_ -= wanted;
      return false;
    }
    reserved_ += wanted;
    return true;
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    Connection connection(socket, limits_);
    bool served = false;
    for (std::size_t left = kRequestsPerConnection; left > 0 && is_next(connection); --left) {
      connection.begin_request();
      bool is_closed = false;
      served = process_request(connection, left == 1, is_closed, nullptr);
      body_bytes_ -= std::exchange(reserved_, 0);
      if (!served || is_closed) break;
    }
    close_gently(socket);
    return served;
  }

  /// Waits for another request of this connection.
  bool is_next(const Connection& connection) const {
    if (connection.has_pending()) return true;
    const auto end = std::chrono::steady_clock::now() + kIdle;
    while (svr_sock_ != INVALID_SOCKET && std::chrono::steady_clock::now() < end) {
      pollfd wait{connection.socket(), POLLIN, 0};
      if (::poll(&wait, 1, kIdleStepMs) > 0) return true;
    }
    return false;
  }

  const ConnectionLimits limits_;
  const std::int64_t most_body_bytes_;
  std::atomic<std::int64_t> body_bytes_ = 0;
  static thread_local std::int64_t reserved_;  ///< by the request that this thread works on
};

thread_local std::int64_t HttpServer::BoundedServer::reserved_ = 0;

HttpServer::HttpServer(const HttpOptions& options, const ErrorWriter& write_error)
    : server_(std::make_unique<BoundedServer>(options.most_body_bytes)) {
  server_->new_task_queue = [] {
    return std::make_unique<httplib::ThreadPool>(kThreads).release();
  };
  server_->set_payload_max_length(std::numeric_limits<std::size_t>::max());
  server_->set_tcp_nodelay(true);
  int listener = -1;
  // Without SO_REUSEPORT, which the library sets by default: two servers must not share a port.
  server_->set_socket_options([&listener](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    listener = socket;
  });
  server_->set_pre_routing_handler(
      [this, write_error, largest = options.largest_body](const httplib::Request& request,
                                                          httplib::Response& response) {
        std::optional<Refusal> refusal = refusal_of(request);
        if (!refusal && largest && length_of(request) > largest(request)) {
          refusal = {413, fmt::format("a body may have {} bytes here", largest(request))};
        }
        if (!refusal && !server_->reserve(length_of(request))) {
          response.set_header("Retry-After", "5");
          refusal = {503, "other uploads take all the memory there is for them"};
        }
        if (!refusal) {
          say_that_there_is_no_body(request);
          return httplib::Server::HandlerResponse::Unhandled;
        }
        response.status = refusal->status;
        write_error(request, response, refusal->status, refusal->detail);
        close_after(response);
        return httplib::Server::HandlerResponse::Handled;
      });
  server_->set_error_handler(
      [write_error](const httplib::Request& request, httplib::Response& response) {
        if (response.body.empty() && !response.content_provider_) {
          write_error(request, response, response.status, "");
        }
      });

  port_ = options.port == 0
              ? server_->bind_to_any_port(options.host)
              : (server_->bind_to_port(options.host, options.port) ? options.port : -1);
  if (port_ <= 0) {
    throw EnvironmentError(
        fmt::format("cannot listen on {} port {}: is the port taken?", options.host, options.port));
  }
  // The library's backlog is fixed at 5; a second listen() changes it.
  ::listen(listener, kBacklog);
}

HttpServer::~HttpServer() = default;

httplib::Server& HttpServer::routes() { return *server_; }

void HttpServer::run() {
  if (!stopping_) server_->listen_after_bind();
}

void HttpServer::stop() {
  if (stopping_.exchange(true)) return;
  // The library forgets a stop() that comes before it runs: give run() the moment it needs.
  constexpr auto kStep = std::chrono::milliseconds(1);
  for (int i = 0; i < 100 && !server_->is_running(); ++i) std::this_thread::sleep_for(kStep);
  server_->stop();
}

}  // namespace throng::server
