#include "server/bounded_post.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <netdb.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <condition_variable>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>

#include "server/public_address.h"

namespace throng::server {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxAnswerHead = 16U << 10U;
// How late a wish to stop may be noticed.
constexpr auto kSlice = std::chrono::milliseconds(50);

/// Why there is no answer.
struct PostFailure {
  std::string why;
};

struct PostUrl {
  bool is_secure = false;
  std::string host;       ///< without the brackets of an IPv6 address
  std::string authority;  ///< for the header Host
  std::string port;
  std::string path;  ///< with the query; at least "/"
};

std::optional<std::string> checked_port(std::string_view text) {
  int port = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), port);
  constexpr int kMaxPort = 65535;
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() || port < 1 ||
      port > kMaxPort) {
    return std::nullopt;
  }
  return std::to_string(port);
}

std::optional<PostUrl> parse_url(std::string_view text) {
  PostUrl url;
  constexpr std::string_view kPlain = "http://";
  constexpr std::string_view kSecure = "https://";
  url.is_secure = text.starts_with(kSecure);
  if (!url.is_secure && !text.starts_with(kPlain)) return std::nullopt;
  text.remove_prefix(url.is_secure ? kSecure.size() : kPlain.size());
  const std::size_t end = std::min(text.find_first_of("/?"), text.size());
  std::string_view authority = text.substr(0, end);
  url.authority = authority;
  url.path = text.substr(end);
  if (url.path.empty() || url.path.front() != '/') url.path.insert(0, "/");
  std::string_view port = url.is_secure ? "443" : "80";
  if (authority.starts_with('[')) {
    const std::size_t close = authority.find(']');
    if (close == std::string_view::npos) return std::nullopt;
    url.host = authority.substr(1, close - 1);
    authority.remove_prefix(close + 1);
    if (!authority.empty() && authority.front() != ':') return std::nullopt;
  } else {
    url.host = authority.substr(0, authority.find(':'));
    authority.remove_prefix(url.host.size());
  }
  if (!authority.empty()) port = authority.substr(1);
  const auto number = checked_port(port);
  if (!number || url.host.empty()) return std::nullopt;
  url.port = *number;
  return url;
}

/// Waits for a descriptor, until the time is up or somebody wants an end.
class Patience {
 public:
  Patience(std::chrono::milliseconds timeout, const std::stop_token& stop)
      : end_(Clock::now() + timeout), stop_(stop) {}

  void wait_for(int descriptor, short events) const {
    while (true) {
      check();
      pollfd entry{descriptor, events, 0};
      if (::poll(&entry, 1, static_cast<int>(kSlice.count())) > 0) return;
    }
  }

  /// Throws PostFailure when it is over.
  void check() const {
    if (stop_.stop_requested()) throw PostFailure{"the service ends"};
    if (Clock::now() >= end_) throw PostFailure{"no answer in time"};
  }

 private:
  Clock::time_point end_;
  const std::stop_token& stop_;
};

struct SocketAddress {
  sockaddr_storage bytes{};
  socklen_t length = 0;
  int family = AF_UNSPEC;

  const sockaddr& generic() const { return reinterpret_cast<const sockaddr&>(bytes); }
};

struct Resolution {
  std::mutex mutex;
  std::condition_variable changed;
  bool is_done = false;
  int error = 0;
  std::vector<SocketAddress> addresses;
};

int look_up(const std::string& host, const std::string& port, int flags,
            std::vector<SocketAddress>& addresses) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = flags | AI_NUMERICSERV;
  addrinfo* first = nullptr;
  const int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &first);
  if (error != 0) return error;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> all(first, &::freeaddrinfo);
  for (const addrinfo* entry = first; entry != nullptr; entry = entry->ai_next) {
    SocketAddress& address = addresses.emplace_back();
    address.length = std::min<socklen_t>(entry->ai_addrlen, sizeof(address.bytes));
    address.family = entry->ai_family;
    std::memcpy(&address.bytes, entry->ai_addr, address.length);
  }
  return 0;
}

/// The system's resolver cannot be interrupted: a name is looked up in a thread of its own, which
/// is left behind when it takes too long and ends by itself.
std::vector<SocketAddress> resolved(const PostUrl& url, const Patience& patience) {
  std::vector<SocketAddress> numeric;
  if (look_up(url.host, url.port, AI_NUMERICHOST, numeric) == 0) return numeric;
  const auto resolution = std::make_shared<Resolution>();
  std::thread([resolution, host = url.host, port = url.port] {
    std::vector<SocketAddress> found;
    const int error = look_up(host, port, 0, found);
    const std::lock_guard lock(resolution->mutex);
    resolution->addresses = std::move(found);
    resolution->error = error;
    resolution->is_done = true;
    resolution->changed.notify_all();
  }).detach();
  std::unique_lock lock(resolution->mutex);
  while (!resolution->changed.wait_for(lock, kSlice, [&] { return resolution->is_done; })) {
    patience.check();
  }
  if (resolution->error != 0) throw PostFailure{::gai_strerror(resolution->error)};
  return std::move(resolution->addresses);
}

/// A socket that never blocks.
class OutgoingSocket {
 public:
  OutgoingSocket(const SocketAddress& address, const Patience& patience)
      : socket_(::socket(address.family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)),
        patience_(patience) {
    if (socket_ < 0) throw PostFailure{std::strerror(errno)};
    try {
      connect_to(address);
    } catch (...) {
      ::close(socket_);
      throw;
    }
  }
  ~OutgoingSocket() { ::close(socket_); }
  OutgoingSocket(const OutgoingSocket&) = delete;
  OutgoingSocket& operator=(const OutgoingSocket&) = delete;

  int descriptor() const { return socket_; }
  const Patience& patience() const { return patience_; }

 private:
  void connect_to(const SocketAddress& address) const {
    if (::connect(socket_, &address.generic(), address.length) == 0) return;
    if (errno != EINPROGRESS) throw PostFailure{std::strerror(errno)};
    patience_.wait_for(socket_, POLLOUT);
    int error = 0;
    socklen_t length = sizeof(error);
    ::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &length);
    if (error != 0) throw PostFailure{std::strerror(error)};
  }

  int socket_;
  const Patience& patience_;
};

/// Bytes to and from the other side.
class Channel {
 public:
  Channel() = default;
  virtual ~Channel() = default;
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  virtual void write(std::string_view bytes) = 0;
  /// At least one byte; none when the other side has closed.
  virtual std::size_t read(char* to, std::size_t size) = 0;
};

class PlainChannel final : public Channel {
 public:
  explicit PlainChannel(const OutgoingSocket& connection) : connection_(connection) {}

  void write(std::string_view bytes) override {
    while (!bytes.empty()) {
      connection_.patience().wait_for(connection_.descriptor(), POLLOUT);
      const ssize_t count =
          ::send(connection_.descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count < 0 && errno != EAGAIN && errno != EINTR) throw PostFailure{std::strerror(errno)};
      if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  std::size_t read(char* to, std::size_t size) override {
    while (true) {
      connection_.patience().wait_for(connection_.descriptor(), POLLIN);
      const ssize_t count = ::recv(connection_.descriptor(), to, size, 0);
      if (count >= 0) return static_cast<std::size_t>(count);
      if (errno != EAGAIN && errno != EINTR) throw PostFailure{std::strerror(errno)};
    }
  }

 private:
  const OutgoingSocket& connection_;
};

std::string tls_error(const char* otherwise) {
  const unsigned long code = ::ERR_peek_last_error();
  ::ERR_clear_error();
  const char* reason = code == 0 ? nullptr : ::ERR_reason_error_string(code);
  return reason == nullptr ? otherwise : reason;
}

/// TLS with a certificate for the host, issued by somebody whom the system trusts.
class TlsChannel final : public Channel {
 public:
  TlsChannel(const OutgoingSocket& connection, const std::string& host)
      : connection_(connection), context_(::SSL_CTX_new(::TLS_client_method()), &::SSL_CTX_free) {
    if (!context_ || ::SSL_CTX_set_default_verify_paths(context_.get()) != 1) {
      throw PostFailure{tls_error("TLS cannot be set up")};
    }
    ::SSL_CTX_set_min_proto_version(context_.get(), TLS1_2_VERSION);
    ::SSL_CTX_set_verify(context_.get(), SSL_VERIFY_PEER, nullptr);
    ssl_.reset(::SSL_new(context_.get()));
    if (!ssl_ || ::SSL_set_fd(ssl_.get(), connection.descriptor()) != 1) {
      throw PostFailure{tls_error("TLS cannot be set up")};
    }
    expect(host);
    attempt([&] { return ::SSL_connect(ssl_.get()); });
  }

  void write(std::string_view bytes) override {
    attempt([&] { return ::SSL_write(ssl_.get(), bytes.data(), static_cast<int>(bytes.size())); });
  }

  std::size_t read(char* to, std::size_t size) override {
    return static_cast<std::size_t>(
        std::max(0, attempt([&] { return ::SSL_read(ssl_.get(), to, static_cast<int>(size)); })));
  }

 private:
  void expect(const std::string& host) {
    std::vector<SocketAddress> numeric;
    if (look_up(host, "443", AI_NUMERICHOST, numeric) == 0) {
      ::X509_VERIFY_PARAM_set1_ip_asc(::SSL_get0_param(ssl_.get()), host.c_str());
      return;
    }
    // The macro of the library casts away const.
    ::SSL_ctrl(ssl_.get(), SSL_CTRL_SET_TLSEXT_HOSTNAME, TLSEXT_NAMETYPE_host_name,
               const_cast<char*>(host.c_str()));
    ::SSL_set1_host(ssl_.get(), host.c_str());
  }

  /// Repeats an action until the socket has let it through. 0 when the other side has closed.
  template <typename Action>
  int attempt(const Action& action) {
    while (true) {
      connection_.patience().check();
      ::ERR_clear_error();
      const int result = action();
      if (result > 0) return result;
      switch (::SSL_get_error(ssl_.get(), result)) {
        case SSL_ERROR_WANT_READ:
          connection_.patience().wait_for(connection_.descriptor(), POLLIN);
          break;
        case SSL_ERROR_WANT_WRITE:
          connection_.patience().wait_for(connection_.descriptor(), POLLOUT);
          break;
        case SSL_ERROR_ZERO_RETURN:
          return 0;
        default:
          if (const long why = ::SSL_get_verify_result(ssl_.get()); why != X509_V_OK) {
            throw PostFailure{::X509_verify_cert_error_string(why)};
          }
          throw PostFailure{tls_error("TLS failed")};
      }
    }
  }

  const OutgoingSocket& connection_;
  std::unique_ptr<SSL_CTX, decltype(&::SSL_CTX_free)> context_;
  std::unique_ptr<SSL, decltype(&::SSL_free)> ssl_{nullptr, &::SSL_free};
};

/// The status of a line "HTTP/1.1 204 No Content".
int status_of(std::string_view line) {
  constexpr std::string_view kBeginning = "HTTP/1.";
  constexpr std::size_t kStatusAt = 9;
  constexpr std::size_t kDigits = 3;
  int status = 0;
  if (line.starts_with(kBeginning) && line.size() >= kStatusAt + kDigits &&
      line[kStatusAt - 1] == ' ') {
    const char* first = line.data() + kStatusAt;
    const auto result = std::from_chars(first, first + kDigits, status);
    if (result.ec == std::errc() && result.ptr == first + kDigits) return status;
  }
  throw PostFailure{"the answer is not HTTP"};
}

/// The status of the final answer; informational ones (1xx) before it are skipped.
int read_status(Channel& channel) {
  std::string head;
  std::size_t total = 0;
  constexpr int kFirstFinal = 200;
  while (true) {
    if (const std::size_t line_end = head.find('\n'); line_end != std::string::npos) {
      const int status = status_of(head);
      if (status >= kFirstFinal) return status;
      if (const std::size_t end = head.find("\r\n\r\n"); end != std::string::npos) {
        head.erase(0, end + 4);
        continue;
      }
    }
    std::array<char, 1024> block{};
    const std::size_t count = channel.read(block.data(), block.size());
    if (count == 0) throw PostFailure{"the connection was closed without an answer"};
    total += count;
    if (total > kMaxAnswerHead) throw PostFailure{"the answer begins with too long a head"};
    head.append(block.data(), count);
  }
}

std::string request_text(const PostUrl& url, const PostHeaders& headers, const std::string& body) {
  std::string text =
      fmt::format("POST {} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n", url.path, url.authority);
  for (const auto& [name, value] : headers) text += fmt::format("{}: {}\r\n", name, value);
  return text + fmt::format("Content-Length: {}\r\n\r\n", body.size()) + body;
}

int post_to(const SocketAddress& address, const PostUrl& url, const std::string& text,
            const Patience& patience) {
  const OutgoingSocket connection(address, patience);
  std::unique_ptr<Channel> channel;
  if (url.is_secure) {
    channel = std::make_unique<TlsChannel>(connection, url.host);
  } else {
    channel = std::make_unique<PlainChannel>(connection);
  }
  channel->write(text);
  return read_status(*channel);
}

/// The addresses that may be called. Throws PostFailure when there is none.
std::vector<SocketAddress> permitted(std::vector<SocketAddress> addresses, bool allow_private) {
  if (!allow_private) {
    const auto gone =
        std::remove_if(addresses.begin(), addresses.end(),
                       [](const SocketAddress& address) { return !is_public(address.generic()); });
    addresses.erase(gone, addresses.end());
  }
  if (addresses.empty()) {
    throw PostFailure{"the address is private; throng serve --webhook-private allows such"};
  }
  return addresses;
}

}  // namespace

bool is_callable_url(const std::string& url) { return parse_url(url).has_value(); }

bool names_private_address(const std::string& url) {
  const auto parsed = parse_url(url);
  std::vector<SocketAddress> numeric;
  if (!parsed || look_up(parsed->host, parsed->port, AI_NUMERICHOST, numeric) != 0) return false;
  return std::none_of(numeric.begin(), numeric.end(),
                      [](const SocketAddress& address) { return is_public(address.generic()); });
}

PostResult bounded_post(const std::string& url, const PostHeaders& headers, const std::string& body,
                        const PostOptions& options, const std::stop_token& stop) {
  const Patience patience(options.timeout, stop);
  PostResult result;
  try {
    const auto parsed = parse_url(url);
    if (!parsed) throw PostFailure{"the URL cannot be called"};
    const std::string text = request_text(*parsed, headers, body);
    constexpr std::size_t kMaxAddresses = 4;
    std::vector<SocketAddress> addresses =
        permitted(resolved(*parsed, patience), options.allow_private);
    if (addresses.size() > kMaxAddresses) addresses.resize(kMaxAddresses);
    for (const SocketAddress& address : addresses) {
      try {
        result.status = post_to(address, *parsed, text, patience);
        result.error.clear();
        return result;
      } catch (const PostFailure& failure) {
        result.error = failure.why;
        patience.check();
      }
    }
  } catch (const PostFailure& failure) {
    result.error = failure.why;
  }
  return result;
}

}  // namespace throng::server
