#include "server/http/http_server.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

#include "base/error.h"
#include "server/http/connection.h"
#include "server/http/http.h"
#include "server/http/reason_phrase.h"

namespace throng::server {

namespace {

constexpr int kThreads = 512;  // one per open connection; half of them may be streams
// For health checks and administrators while all others are busy.
constexpr int kReserveThreads = 16;
constexpr int kMaxQueued = 128;  // connections whose request waits for a thread
const ConnectionLimits kReserveLimits = {.head_time = std::chrono::milliseconds(250),
                                         .silence = std::chrono::milliseconds(250),
                                         .linger = std::chrono::milliseconds(50)};
constexpr int kSilentS = 5;  // until the system gives up a new connection without a byte
constexpr int kBacklog = 1024;
constexpr std::size_t kRequestsPerConnection = 1'000'000;
constexpr int kIdleStepMs = 100;  // bounds how long stop() takes
constexpr std::chrono::milliseconds kPauseWithoutFiles(100);
constexpr std::size_t kSmallBody = 1 << 20;  // not worth to be counted

httplib::Request to_library_request(const RequestHead& head) {
  httplib::Request request;
  request.method = head.method;
  request.target = head.target;
  request.path = head.path;
  for (const HeaderField& field : head.fields) request.headers.emplace(field.name, field.value);
  return request;
}

/// The last answer of a connection.
std::string text_of_answer(const httplib::Request& request, const httplib::Response& response) {
  std::string text =
      fmt::format("HTTP/1.1 {} {}\r\nContent-Length: {}\r\nConnection: close\r\n", response.status,
                  reason_phrase(response.status), response.body.size());
  for (const auto& [name, value] : response.headers) {
    text += fmt::format("{}: {}\r\n", name, value);
  }
  text += "\r\n";
  return request.method == "HEAD" ? text : text + response.body;
}

}  // namespace

bool is_loopback(const std::string& host) {
  in_addr address{};  // the check keeps out names such as "127.example.com"
  return host == "localhost" || host == "::1" ||
         (host.starts_with("127.") && ::inet_pton(AF_INET, host.c_str(), &address) == 1);
}

/// The library's server with filtered connections, and a limit to what bodies take together.
class HttpServer::BoundedServer : public httplib::Server {
 public:
  BoundedServer(HttpOptions options, ErrorWriter write_error)
      : options_(std::move(options)), write_error_(std::move(write_error)) {}
  ~BoundedServer() override {
    if (listener_ >= 0) ::close(listener_);
  }
  BoundedServer(const BoundedServer&) = delete;
  BoundedServer& operator=(const BoundedServer&) = delete;

  /// Takes over the socket that the library has bound.
  void own(int listener) { listener_ = listener; }

  /// Serves until end(). Instead of the library's loop, which stops for good once the machine lacks
  /// memory or files for a moment, and whose sockets are inherited by programs that are started.
  void accept_all() {
    httplib::ThreadPool threads(kThreads);
    httplib::ThreadPool reserve(kReserveThreads);
    while (svr_sock_ != INVALID_SOCKET) {
      pollfd wait{listener_, POLLIN, 0};
      if (::poll(&wait, 1, -1) <= 0) continue;  // end() shuts the socket down, which wakes this
      const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      if (socket >= 0) {
        begin(socket, threads, reserve);
      } else if (errno != EINTR && errno != ECONNABORTED && svr_sock_ != INVALID_SOCKET) {
        spdlog::warn("connections wait: {}", std::strerror(errno));
        std::this_thread::sleep_for(kPauseWithoutFiles);
      }
    }
    reserve.shutdown();  // it hands connections over to the others
    threads.shutdown();
  }

  /// Makes accept_all() return, now or when it is only about to begin; open connections end.
  void end() {
    if (svr_sock_.exchange(INVALID_SOCKET) != INVALID_SOCKET) ::shutdown(listener_, SHUT_RDWR);
  }

 private:
  using SharedConnection = std::shared_ptr<Connection>;

  /// While all threads are busy, the reserve looks at what the client wants.
  void begin(int socket, httplib::ThreadPool& threads, httplib::ThreadPool& reserve) {
    if (open_ < kThreads) {
      return queue(std::make_shared<Connection>(socket, options_.connection), {}, threads);
    }
    const auto connection = std::make_shared<Connection>(socket, kReserveLimits);
    reserve.enqueue(
        [this, connection, &threads] { attend([&] { serve_in_reserve(connection, threads); }); });
  }

  /// Has a thread serve a connection, from `first` on if its head was read already. The connection
  /// closes when nobody holds it.
  void queue(const SharedConnection& connection, const std::optional<RequestHead>& first,
             httplib::ThreadPool& threads) {
    ++open_;
    threads.enqueue([this, connection = SharedConnection(connection), first]() mutable {
      attend([&] { serve_all(*connection, first); });
      connection.reset();
      --open_;
    });
  }

  template <typename Serve>
  void attend(const Serve& serve) {
    try {
      serve();
    } catch (const std::exception& error) {  // nothing above this catches
      spdlog::error("a connection: {}", error.what());
    }
    body_bytes_ -= std::exchange(reserved_, 0);
  }

  /// Serves an urgent request; others wait for a thread, if not too many do.
  void serve_in_reserve(const SharedConnection& connection, httplib::ThreadPool& threads) {
    auto head = connection->read_head();
    if (std::holds_alternative<Connection::Ended>(head)) return;
    if (const auto* error = std::get_if<HeadError>(&head)) {
      return refuse(*connection, {}, {error->status, error->detail});
    }
    const RequestHead& request = std::get<RequestHead>(head);
    httplib::Request asked = to_library_request(request);
    connection->get_remote_ip_and_port(asked.remote_addr, asked.remote_port);
    if (options_.is_urgent && options_.is_urgent(asked)) {
      serve(*connection, request, true);
    } else if (open_ < kThreads + kMaxQueued) {
      connection->use_limits(options_.connection);
      queue(connection, request, threads);
    } else {
      refuse(*connection, asked, {503, "all connections are in use; try again"});
    }
  }

  void serve_all(Connection& connection, std::optional<RequestHead> first) {
    bool was_served = false;
    for (std::size_t left = kRequestsPerConnection;
         left > 0 && (first || is_next(connection, was_served)); --left) {
      auto head = first ? std::variant<RequestHead, HeadError, Connection::Ended>(*first)
                        : connection.read_head();
      first.reset();
      if (std::holds_alternative<Connection::Ended>(head)) break;
      if (const auto* error = std::get_if<HeadError>(&head)) {
        refuse(connection, {}, {error->status, error->detail});
        break;
      }
      const RequestHead& request = std::get<RequestHead>(head);
      const bool is_last = left == 1 || !request.keeps_connection;
      was_served = serve(connection, request, is_last);
      if (!was_served || is_last || !connection.is_consumed()) break;
    }
  }

  /// False when the connection has to end.
  bool serve(Connection& connection, RequestHead head, bool is_last) {
    BodyAdmission admission;
    if (head.content_length > 0 || head.is_chunked) {
      httplib::Request request = to_library_request(head);
      connection.get_remote_ip_and_port(request.remote_addr, request.remote_port);
      try {
        admission = admit_body(request, head.content_length);
        if (head.is_chunked) receive_chunks(connection, head, admission.max_bytes);
      } catch (const HttpError& error) {
        refuse(connection, request, error);
        return false;
      } catch (const std::exception& error) {  // e.g. the keys cannot be read
        spdlog::error("{} {}: {}", request.method, request.path, error.what());
        refuse(connection, request, {503, "the request cannot be checked now; try again"});
        return false;
      }
    }
    connection.begin_request(head);
    bool is_closed = false;
    const bool served = process_request(connection, is_last, is_closed, nullptr);
    body_bytes_ -= std::exchange(reserved_, 0);
    return served && !is_closed;
  }

  void refuse(Connection& connection, const httplib::Request& request, const HttpError& error) {
    httplib::Response response;
    write_error_(request, response, error);
    connection.write_all(text_of_answer(request, response));
  }

  /// Throws HttpError for a body that is not to be read. The result is held during the request.
  BodyAdmission admit_body(const httplib::Request& request, std::size_t bytes) {
    BodyAdmission admission{std::numeric_limits<std::size_t>::max()};
    if (options_.admit_body) {
      admission = options_.admit_body(request);
      if (bytes > admission.max_bytes) {
        throw HttpError{413, fmt::format("a body may have {} bytes here", admission.max_bytes)};
      }
    }
    if (!reserve(bytes))
      throw HttpError{503, "other uploads take all the memory there is for them"};
    return admission;
  }

  /// Receives a body whose length nobody knows beforehand; throws HttpError.
  void receive_chunks(Connection& connection, RequestHead& head, std::size_t max_bytes) {
    const auto may_hold = [this](std::size_t bytes) {
      constexpr std::size_t kStep = 2 * kSmallBody;  // reserve() counts what is above one
      const auto held = static_cast<std::size_t>(reserved_);
      return bytes <= std::max(kSmallBody, held) || reserve(std::max(kStep, bytes - held));
    };
    const HeadError error = connection.receive_chunks(head, max_bytes, may_hold);
    if (error.status != 0) throw HttpError{error.status, error.detail};
  }

  /// Notes the memory that this thread's request will take; false when there is too little left.
  bool reserve(std::size_t bytes) {
    if (bytes <= kSmallBody) return true;
    const auto wanted = static_cast<std::int64_t>(bytes);
    if (body_bytes_.fetch_add(wanted) + wanted > options_.max_all_body_bytes) {
      body_bytes_ -= wanted;
      return false;
    }
    reserved_ += wanted;
    return true;
  }

  /// Waits for another request of this connection.
  bool is_next(Connection& connection, bool was_served) const {
    if (connection.has_pending()) return true;
    const auto end = std::chrono::steady_clock::now() + options_.connection.idle;
    // Others wait for a thread: a connection that only might be used ends.
    constexpr auto kFirstRequest = std::chrono::milliseconds(200);
    const auto end_if_needed = std::chrono::steady_clock::now() +
                               (was_served ? std::chrono::milliseconds(0) : kFirstRequest);
    while (svr_sock_ != INVALID_SOCKET && std::chrono::steady_clock::now() < end) {
      if (open_ >= kThreads && std::chrono::steady_clock::now() >= end_if_needed) {
        connection.drop();
        return false;
      }
      pollfd wait{connection.socket(), POLLIN, 0};
      if (::poll(&wait, 1, kIdleStepMs) > 0) return true;
    }
    return false;
  }

  int listener_ = -1;
  const HttpOptions options_;
  const ErrorWriter write_error_;
  std::atomic<std::int64_t> body_bytes_ = 0;
  std::atomic<int> open_ = 0;                  ///< connections that have a thread or wait for one
  static thread_local std::int64_t reserved_;  ///< by the request that this thread works on
};

thread_local std::int64_t HttpServer::BoundedServer::reserved_ = 0;

namespace {

/// `error` is an errno; 0: the library has none, as for names without an address.
[[noreturn]] void throw_listen_error(const HttpOptions& options, int error) {
  const char* advice = "";
  if (error == 0) advice = ": no address of this machine has this name";
  if (error == EADDRINUSE) advice = ": another program listens there; --port chooses another";
  if (error == EACCES) {
    advice =
        ": ports below 1024 are for root and holders of CAP_NET_BIND_SERVICE; "
        "--port chooses another";
  }
  throw EnvironmentError(fmt::format("cannot listen on {} port {}{}{}", options.host, options.port,
                                     error == 0 ? "" : fmt::format(": {}", std::strerror(error)),
                                     advice));
}

}  // namespace

HttpServer::HttpServer(const HttpOptions& options, const ErrorWriter& write_error)
    : server_(std::make_unique<BoundedServer>(options, write_error)) {
  server_->set_default_headers({{"X-Content-Type-Options", "nosniff"},
                                {"Referrer-Policy", "no-referrer"},
                                {"Cross-Origin-Resource-Policy", "same-origin"}});
  server_->set_payload_max_length(std::numeric_limits<std::size_t>::max());
  server_->set_tcp_nodelay(true);
  // Answers tell clients for how long an idle connection stays, so that they do not use it as it
  // ends.
  server_->set_keep_alive_timeout(
      std::chrono::duration_cast<std::chrono::seconds>(options.connection.idle).count());
  int listener = -1;
  // Without SO_REUSEPORT, which the library sets by default: two servers must not share a port.
  server_->set_socket_options([&listener](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    ::fcntl(socket, F_SETFD, FD_CLOEXEC);
    listener = socket;
  });
  server_->set_error_handler(
      [write_error](const httplib::Request& request, httplib::Response& response) {
        if (response.body.empty() && !response.content_provider_) {
          write_error(request, response, {response.status, ""});
        }
      });

  errno = 0;
  port_ = options.port == 0
              ? server_->bind_to_any_port(options.host)
              : (server_->bind_to_port(options.host, options.port) ? options.port : -1);
  if (port_ <= 0) throw_listen_error(options, errno);
  server_->own(listener);
  // A connection takes a thread when its first bytes are there.
  ::setsockopt(listener, IPPROTO_TCP, TCP_DEFER_ACCEPT, &kSilentS, sizeof(kSilentS));
  // The library's backlog is fixed at 5; a second listen() changes it.
  ::listen(listener, kBacklog);
}

HttpServer::~HttpServer() = default;

httplib::Server& HttpServer::routes() { return *server_; }

void HttpServer::run() { server_->accept_all(); }

void HttpServer::stop() { server_->end(); }

}  // namespace throng::server
