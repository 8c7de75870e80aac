// HTTP server: cpp-httplib behind a strict filter (server/http/connection.h,
// server/http/request_head.h), because Debian's version 0.11.4 has a lenient parser and small
// limits (8 threads, 5 requests per connection). It has no TLS and no rate limits per client, so
// the port should be reachable from loopback only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "server/http/connection_limits.h"
#include "server/http/http_error.h"
#include "server/http/http_fwd.h"
#include "server/http/request_head.h"

namespace throng::server {

/// Decision about the body of a request.
struct BodyAdmission {
  std::size_t max_bytes = 0;
  std::shared_ptr<void> held = {};  ///< kept as long as the request is worked on
};

/// Address and limits of a server.
struct HttpOptions {
  std::string host = "127.0.0.1";
  int port = 0;  ///< 0: any free port
  /// Decides about a request's body; a larger one is refused with 413. Called after the head was
  /// read and before the body; the request has method, path, headers and address. May throw
  /// HttpError to refuse the request.
  std::function<BodyAdmission(const httplib::Request&)> admit_body = {};
  /// Whether a request is served while all threads are busy: there are a few in reserve. Others are
  /// refused with 503 then. Empty: none is.
  std::function<bool(const httplib::Request&)> is_urgent = {};
  /// Max total size of all bodies above 1 MiB that are being read or handled; a further one is
  /// refused with 503.
  std::int64_t max_all_body_bytes = 512 << 20;
  ConnectionLimits connection = {};  ///< of each connection
};

/// Whether an address can only be reached from this machine.
bool is_loopback(const std::string& host);

/// The server, with routes that the caller adds.
class HttpServer {
 public:
  /// Writes the response to a request that was refused before it reached a handler.
  using ErrorWriter =
      std::function<void(const httplib::Request&, httplib::Response&, const HttpError& error)>;

  /// Binds the port: clients can connect and wait until run() is called. Throws EnvironmentError.
  HttpServer(const HttpOptions& options, const ErrorWriter& write_error);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// The library's server, to add routes before run().
  httplib::Server& routes();
  int port() const { return port_; }

  /// Serves until stop(). Call it once only.
  void run();
  /// Makes run() return and closes open connections. Safe to call from another thread, also just
  /// before run().
  void stop();

 private:
  class BoundedServer;
  std::unique_ptr<BoundedServer> server_;
  int port_ = 0;
};

}  // namespace throng::server
