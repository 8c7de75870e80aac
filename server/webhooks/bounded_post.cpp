#include "server/webhooks/bounded_post.h"

#include <arpa/inet.h>
#include <curl/curl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include "server/webhooks/public_address.h"

namespace throng::server {

namespace {

constexpr std::size_t kMaxAnswerHead = 16U << 10U;
constexpr long kFirstFinalStatus = 200;

template <auto Free>
struct FreedBy {
  template <typename T>
  void operator()(T* value) const {
    Free(value);
  }
};

using Handle = std::unique_ptr<CURL, FreedBy<&curl_easy_cleanup>>;
using Multi = std::unique_ptr<CURLM, FreedBy<&curl_multi_cleanup>>;
using Headers = std::unique_ptr<curl_slist, FreedBy<&curl_slist_free_all>>;
using Url = std::unique_ptr<CURLU, FreedBy<&curl_url_cleanup>>;

/// The library reads "http:///x" as the host x.
bool has_host(std::string_view url) {
  const std::size_t end = url.find("://");
  return end != std::string_view::npos && url.substr(end, 4) != ":///";
}

std::string url_part(CURLU* url, CURLUPart part) {
  char* text = nullptr;
  ::curl_url_get(url, part, &text, 0);
  const std::unique_ptr<char, FreedBy<&curl_free>> owner(text);
  return text == nullptr ? "" : text;
}

/// Nothing when the library cannot call it, or not by HTTP.
Url parse_url(const std::string& text) {
  Url url(::curl_url());
  if (!has_host(text) ||
      ::curl_url_set(url.get(), CURLUPART_URL, text.c_str(), CURLU_DISALLOW_USER) != CURLUE_OK ||
      url_part(url.get(), CURLUPART_PORT) == "0") {
    return nullptr;
  }
  const std::string scheme = url_part(url.get(), CURLUPART_SCHEME);
  return scheme == "http" || scheme == "https" ? std::move(url) : nullptr;
}

/// The address as which a host is written; the library has made IPv4 ones plain.
std::optional<sockaddr_storage> numeric_address(std::string host) {
  sockaddr_storage storage{};
  auto& v4 = reinterpret_cast<sockaddr_in&>(storage);
  auto& v6 = reinterpret_cast<sockaddr_in6&>(storage);
  if (::inet_pton(AF_INET, host.c_str(), &v4.sin_addr) == 1) {
    v4.sin_family = AF_INET;
    return storage;
  }
  if (host.size() > 2 && host.front() == '[') host = host.substr(1, host.size() - 2);
  if (::inet_pton(AF_INET6, host.c_str(), &v6.sin6_addr) != 1) return std::nullopt;
  v6.sin6_family = AF_INET6;
  return storage;
}

/// Notes of the callbacks of one request.
struct Exchange {
  bool allow_private = false;
  bool has_refused = false;   ///< an address that is not public
  bool is_head_long = false;  ///< longer than is read
  std::size_t head_bytes = 0;
  long status = 0;
  CURL* handle = nullptr;
};

/// Called with the very address that would be connected to, so that a name cannot lead elsewhere.
curl_socket_t open_socket(void* data, curlsocktype, curl_sockaddr* address) {
  auto& exchange = *static_cast<Exchange*>(data);
  if (!exchange.allow_private && !is_public(address->addr)) {
    exchange.has_refused = true;
    return CURL_SOCKET_BAD;
  }
  return ::socket(address->family, address->socktype | SOCK_CLOEXEC, address->protocol);
}

/// The status of the final answer is all that is wanted: returning 0 ends the request.
std::size_t note_head(char*, std::size_t size, std::size_t count, void* data) {
  auto& exchange = *static_cast<Exchange*>(data);
  exchange.head_bytes += size * count;
  long status = 0;
  ::curl_easy_getinfo(exchange.handle, CURLINFO_RESPONSE_CODE, &status);
  if (status >= kFirstFinalStatus) {
    exchange.status = status;
    return 0;
  }
  exchange.is_head_long = exchange.head_bytes > kMaxAnswerHead;
  return exchange.is_head_long ? 0 : size * count;
}

std::size_t refuse_body(char*, std::size_t, std::size_t, void*) { return 0; }

Headers curl_headers(const PostHeaders& headers) {
  curl_slist* list = nullptr;
  for (const auto& [name, value] : headers) {
    list = ::curl_slist_append(list, (name + ": " + value).c_str());
  }
  for (const char* line : {"Connection: close", "Expect:"}) list = ::curl_slist_append(list, line);
  return Headers(list);
}

void prepare(CURL* handle, Exchange& exchange, const std::string& body,
             const PostOptions& options) {
  // The library reads no settings of the environment but these; and no proxy, which would call any
  // address.
  ::curl_easy_setopt(handle, CURLOPT_PROXY, "");
  if (const char* trusted = std::getenv("SSL_CERT_FILE"); trusted != nullptr) {
    ::curl_easy_setopt(handle, CURLOPT_CAINFO, trusted);
  }
  ::curl_easy_setopt(handle, CURLOPT_SSLVERSION, CURL_SSLVERSION_TLSv1_2);
  ::curl_easy_setopt(handle, CURLOPT_HTTP_VERSION, CURL_HTTP_VERSION_1_1);
  ::curl_easy_setopt(handle, CURLOPT_POST, 1L);
  ::curl_easy_setopt(handle, CURLOPT_POSTFIELDS, body.c_str());
  ::curl_easy_setopt(handle, CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
  ::curl_easy_setopt(handle, CURLOPT_TIMEOUT_MS, static_cast<long>(options.timeout.count()));
  ::curl_easy_setopt(handle, CURLOPT_FORBID_REUSE, 1L);
  ::curl_easy_setopt(handle, CURLOPT_NOSIGNAL, 1L);
  // A look-up that hangs is left behind, and ends by itself.
  ::curl_easy_setopt(handle, CURLOPT_QUICK_EXIT, 1L);
  ::curl_easy_setopt(handle, CURLOPT_OPENSOCKETFUNCTION, &open_socket);
  ::curl_easy_setopt(handle, CURLOPT_OPENSOCKETDATA, &exchange);
  ::curl_easy_setopt(handle, CURLOPT_HEADERFUNCTION, &note_head);
  ::curl_easy_setopt(handle, CURLOPT_HEADERDATA, &exchange);
  ::curl_easy_setopt(handle, CURLOPT_WRITEFUNCTION, &refuse_body);
}

/// Runs a transfer to its end; nothing when a stop was requested before.
std::optional<CURLcode> perform(CURL* handle, const std::stop_token& stop) {
  const Multi multi(::curl_multi_init());
  const std::stop_callback wake(stop, [&multi] { ::curl_multi_wakeup(multi.get()); });
  ::curl_multi_add_handle(multi.get(), handle);
  std::optional<CURLcode> result;
  constexpr int kPollMs = 1000;
  for (int running = 1; !result && !stop.stop_requested();) {
    if (::curl_multi_perform(multi.get(), &running) != CURLM_OK) result = CURLE_FAILED_INIT;
    int left = 0;
    if (const CURLMsg* message = ::curl_multi_info_read(multi.get(), &left); message != nullptr) {
      result = message->data.result;
    } else if (!result) {
      ::curl_multi_poll(multi.get(), nullptr, 0, kPollMs, nullptr);
    }
  }
  ::curl_multi_remove_handle(multi.get(), handle);
  return result;
}

std::string describe_error(const Exchange& exchange, std::optional<CURLcode> result,
                           const char* detail) {
  if (!result) return "the service ends";
  if (exchange.is_head_long) return "the answer begins with too long a head";
  if (exchange.has_refused && *result == CURLE_COULDNT_CONNECT) {
    return "the address is private; throng serve --webhook-private allows such";
  }
  if (*result == CURLE_OPERATION_TIMEDOUT) return "no answer in time";
  if (*result == CURLE_OK) return "the connection was closed without an answer";
  return *detail != '\0' ? detail : ::curl_easy_strerror(*result);
}

}  // namespace

bool is_callable_url(const std::string& url) { return parse_url(url) != nullptr; }

bool names_private_address(const std::string& url) {
  const Url parsed = parse_url(url);
  const auto address =
      parsed ? numeric_address(url_part(parsed.get(), CURLUPART_HOST)) : std::nullopt;
  return address && !is_public(reinterpret_cast<const sockaddr&>(*address));
}

PostResult bounded_post(const std::string& url, const PostHeaders& headers, const std::string& body,
                        const PostOptions& options, const std::stop_token& stop) {
  static const CURLcode kReady = ::curl_global_init(CURL_GLOBAL_DEFAULT);
  const Url parsed = parse_url(url);
  if (!parsed || kReady != CURLE_OK) return {0, "the URL cannot be called"};
  const Headers list = curl_headers(headers);
  std::array<char, CURL_ERROR_SIZE> detail{};
  const Handle handle(::curl_easy_init());
  Exchange exchange{.allow_private = options.allow_private, .handle = handle.get()};
  prepare(handle.get(), exchange, body, options);
  ::curl_easy_setopt(handle.get(), CURLOPT_CURLU, parsed.get());
  ::curl_easy_setopt(handle.get(), CURLOPT_HTTPHEADER, list.get());
  ::curl_easy_setopt(handle.get(), CURLOPT_ERRORBUFFER, detail.data());
  const std::optional<CURLcode> result = perform(handle.get(), stop);
  if (exchange.status != 0) return {static_cast<int>(exchange.status), ""};
  return {0, describe_error(exchange, result, detail.data())};
}

}  // namespace throng::server
