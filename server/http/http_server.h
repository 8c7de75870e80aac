// cpp-httplib behind a filter. Debian's 0.11.4 needs care in its defaults (8 threads, 5 requests
// per connection) and reads requests loosely: server/http/connection.h and
// server/http/request_head.h close that in front of it. It speaks no TLS and counts no requests per
// client: the bare port is for loopback.
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

struct HttpOptions {
  std::string host = "127.0.0.1";
  int port = 0;  ///< 0: any that is free
  /// Bytes that a request's body may have; asked for each that has one, when its head has been read
  /// and before any of its body is. The request holds method, path and headers. A longer body is
  /// refused with 413. Throws HttpError to refuse the request.
  std::function<std::size_t(const httplib::Request&)> max_body_bytes = {};
  /// Bytes that all bodies above a megabyte may have together while they are read and worked on;
  /// one more is refused with 503.
  std::int64_t max_all_body_bytes = 512 << 20;
  ConnectionLimits connection = {};  ///< of each
};

/// Whether an address can only be reached from this machine.
bool is_loopback(const std::string& host);

class HttpServer {
 public:
  /// Writes the answer to a request that was refused before a handler saw it.
  using ErrorWriter =
      std::function<void(const httplib::Request&, httplib::Response&, const HttpError& error)>;

  /// Binds at once: clients may connect, and wait until run(). Throws EnvironmentError.
  HttpServer(const HttpOptions& options, const ErrorWriter& write_error);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// To add routes to, before run().
  httplib::Server& routes();
  int port() const { return port_; }

  /// Serves until stop(). Once only.
  void run();
  /// Makes run() return, from another thread and also when it is only about to begin; open
  /// connections end.
  void stop();

 private:
  class BoundedServer;
  std::unique_ptr<BoundedServer> server_;
  int port_ = 0;
};

}  // namespace throng::server
