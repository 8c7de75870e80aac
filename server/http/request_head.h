// The head of an HTTP/1 request, read strictly (RFC 9112). Wherever two readers of the same bytes
// could disagree on what a request is or where it ends, the request is refused: such differences
// between a proxy, this server and cpp-httplib are what request smuggling is made of.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace throng::server {

inline constexpr std::size_t kMaxHeadBytes = 64 << 10;  ///< request line and header fields together
/// cpp-httplib gives up on longer lines.
inline constexpr std::size_t kMaxLineBytes = 8 << 10;
inline constexpr std::size_t kMaxHeaderFields = 100;

struct HeaderField {
  std::string name;
  std::string value;  ///< without the blanks around it
};

struct RequestHead {
  std::string method;  ///< GET, HEAD, OPTIONS, POST, PUT, PATCH or DELETE
  std::string target;  ///< "/path?query", percent-encoded as sent
  std::string path;    ///< decoded, without the query
  bool is_http_1_0 = false;
  /// End-to-end fields. Framing and connection fields are in the members below.
  std::vector<HeaderField> fields;
  std::size_t content_length = 0;
  bool keeps_connection = true;   ///< the client may send another request afterwards
  bool expects_continue = false;  ///< the client waits for "100 Continue" before it sends the body

  /// Whether the method allows a body.
  bool takes_body() const;
  /// Whether an answer may be compressed by gzip (Accept-Encoding).
  bool accepts_gzip() const;
};

/// Why a request is refused. The connection has to be closed: where the next request begins is
/// unknown.
struct HeadError {
  int status;
  std::string detail;
};

/// Reads a head that ends with its empty line. Never throws.
///
/// Statuses: 400 for whatever is malformed or ambiguous, and for a body where the method has none;
/// 411 for chunked bodies; 414 and 431 for what is too long; 415 for a content coding; 417 for an
/// unknown expectation; 501 for unknown methods and transfer codings; 505 for other versions.
std::variant<RequestHead, HeadError> parse_request_head(std::string_view bytes);

/// Error in the first bytes of a head whose end has not arrived; status 0 when there is none.
HeadError check_head_start(std::string_view bytes);

/// The head in the form in which cpp-httplib 0.11 reads exactly the members' values. Of
/// Accept-Encoding only "gzip" is left, if it is accepted.
std::string library_text(const RequestHead& head);

}  // namespace throng::server
