#include "server/http_server.h"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <memory>
#include <thread>

#include "base/error.h"
#include "server/http.h"

namespace throng::server {

namespace {

constexpr std::size_t kThreads = 256;  // one per open connection; half of them may be streams
constexpr int kBacklog = 1024;
constexpr std::size_t kRequestsPerConnection = 1'000'000;
constexpr time_t kIdleS = 2;  // also bounds how long stop() takes
constexpr time_t kReadS = 10;
constexpr time_t kWriteS = 30;

bool is_number(const std::string& text) {
  constexpr std::size_t kMostDigits = 12;
  return !text.empty() && text.size() <= kMostDigits &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

// What to say of a request whose body cannot be bounded or whose length is unclear; 0: it is fine.
int refusal_of(const httplib::Request& request) {
  if (request.has_header("Transfer-Encoding")) return 411;
  const std::size_t lengths = request.get_header_value_count("Content-Length");
  if (lengths > 1) return 400;
  if (lengths == 1 && !is_number(request.get_header_value("Content-Length"))) return 400;
  const bool has_body =
      request.method == "POST" || request.method == "PUT" || request.method == "PATCH";
  return has_body && lengths == 0 ? 411 : 0;
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

HttpServer::HttpServer(const HttpOptions& options, const ErrorWriter& write_error)
    : server_(std::make_unique<httplib::Server>()) {
  server_->new_task_queue = [] {
    return std::make_unique<httplib::ThreadPool>(kThreads).release();
  };
  server_->set_keep_alive_max_count(kRequestsPerConnection);
  server_->set_keep_alive_timeout(kIdleS);
  server_->set_read_timeout(kReadS);
  server_->set_write_timeout(kWriteS);
  server_->set_payload_max_length(options.largest_body);
  server_->set_tcp_nodelay(true);
  int listener = -1;
  // Without SO_REUSEPORT, which the library sets by default: two servers must not share a port.
  server_->set_socket_options([&listener](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    listener = socket;
  });
  server_->set_pre_routing_handler(
      [write_error](const httplib::Request& request, httplib::Response& response) {
        const int status = refusal_of(request);
        if (status == 0) return httplib::Server::HandlerResponse::Unhandled;
        response.status = status;
        write_error(request, response, status,
                    "a request with a body needs one Content-Length and no Transfer-Encoding");
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
