// Strict parser for the head of an HTTP/1 request (RFC 9112). It refuses every request on whose
// meaning or end two parsers could disagree, because such differences between a proxy, this server
// and cpp-httplib enable request smuggling.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace throng::server {

inline constexpr std::size_t kMaxHeadBytes = 64 << 10;  ///< request line and header fields together
/// Max length of a line; cpp-httplib fails on longer ones.
inline constexpr std::size_t kMaxLineBytes = 8 << 10;
inline constexpr std::size_t kMaxHeaderFields = 100;

struct HeaderField {
  std::string name;
  std::string value;  ///< without surrounding blanks
};

/// A valid head.
struct RequestHead {
  std::string method;  ///< GET, HEAD, OPTIONS, POST, PUT, PATCH or DELETE
  std::string target;  ///< "/path?query", percent-encoded as sent
  std::string path;    ///< decoded, without the query
  bool is_http_1_0 = false;
  /// End-to-end header fields. The members below hold framing and connection fields.
  std::vector<HeaderField> fields;
  std::size_t content_length = 0;
  bool is_chunked = false;        ///< the body comes in chunks, without a content_length
  bool keeps_connection = true;   ///< the client may send another request afterwards
  bool expects_continue = false;  ///< the client waits for "100 Continue" before it sends the body

  /// Whether the method allows a body.
  bool takes_body() const;
  /// Whether a response may be compressed by gzip (Accept-Encoding).
  bool accepts_gzip() const;
};

/// A refusal. The connection has to be closed, because the beginning of the next request is
/// unknown.
struct HeadError {
  int status;
  std::string detail;
};

/// Parses a head, including its final empty line. Throws nothing.
///
/// Statuses: 400 for malformed or ambiguous heads and for a body with a method that takes none; 414
/// for a long target and 431 for long or many fields; 415 for a content coding; 417 for an unknown
/// expectation; 501 for unknown methods and transfer codings; 505 for other versions.
std::variant<RequestHead, HeadError> parse_request_head(std::string_view bytes);

/// Checks a header field, without its line's end; status 0 if it has no error.
HeadError check_header_field(std::string_view line);

/// Checks the first bytes of an incomplete head; status 0 if they have no error.
HeadError check_head_start(std::string_view bytes);

/// The field in which library_text() has the value of Range. The library would answer 416 to ranges
/// that RFC 9110 (14.2) has ignored, for example "bytes=5-2", and cut any body, even of an error.
inline constexpr const char* kRangeField = "Requested-Range";

/// The head as a canonical text from which cpp-httplib 0.11 parses exactly the members' values.
/// Accept-Encoding is reduced to "gzip" if that is accepted; Range becomes kRangeField.
std::string library_text(const RequestHead& head);

}  // namespace throng::server
