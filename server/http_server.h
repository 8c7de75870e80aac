// cpp-httplib, hardened. Debian's 0.11.4 needs care in its defaults (8 threads, 5 requests per
// connection) and in what it lets through: chunked bodies of any size, contradictory lengths,
// endless and slow headers and bodies (server/connection.h). It speaks no TLS and counts no
// requests per client: the bare port is for loopback.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "server/http_fwd.h"

namespace throng::server {

struct HttpOptions {
  std::string host = "127.0.0.1";
  int port = 0;  ///< 0: any that is free
  /// Bytes that a request's body may have, asked when its headers have been read; a longer one is
  /// refused unread, with 413.
  std::function<std::size_t(const httplib::Request&)> largest_body = {};
  /// Bytes that all bodies above a megabyte may have together while they are read and worked on;
  /// one more is refused with 503.
  std::int64_t most_body_bytes = 512 << 20;
};

/// Whether an address can only be reached from this machine.
bool is_loopback(const std::string& host);

class HttpServer {
 public:
  /// Writes an error answer for a status that the library, and not a handler, has chosen.
  using ErrorWriter = std::function<void(const httplib::Request&, httplib::Response&, int status,
                                         const std::string& detail)>;

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
  std::atomic<bool> stopping_ = false;
};

}  // namespace throng::server
