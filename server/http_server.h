// cpp-httplib, hardened. Debian's 0.11.4 needs care in its defaults (8 threads, 5 requests per
// connection) and in what it lets through (chunked bodies of any size, contradictory lengths).
// It still cannot bound headers or slow clients: the bare port is for loopback.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace httplib {
class Server;
struct Request;
struct Response;
}  // namespace httplib

namespace throng::server {

struct HttpOptions {
  std::string host = "127.0.0.1";
  int port = 0;  ///< 0: any that is free
  /// Bytes that a request's body may have; the rest is read, thrown away and answered with 413.
  std::size_t largest_body = 1 << 20;
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
  httplib::Server& routes() { return *server_; }
  int port() const { return port_; }

  /// Serves until stop(). Once only.
  void run();
  /// Makes run() return, from another thread and also when it is only about to begin; open
  /// connections end.
  void stop();

 private:
  std::unique_ptr<httplib::Server> server_;
  int port_ = 0;
  std::atomic<bool> stopping_ = false;
};

}  // namespace throng::server
