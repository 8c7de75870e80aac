#include "server/http/request_head.h"
#include "base/text/words.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace throng::server {

namespace {

constexpr std::string_view kLineEnd = "\r\n";
constexpr std::string_view kAcceptEncoding = "Accept-Encoding";

// Thrown within this file only: reading stops at the first fault.
struct Fault {
  HeadError error;
};

[[noreturn]] void refuse(int status, std::string detail) {
  throw Fault{{status, std::move(detail)}};
}

bool is_digit_or_letter(unsigned char c) {
  return ('0' <= c && c <= '9') || ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
}

// RFC 9110, 5.6.2
bool is_token_char(unsigned char c) {
  constexpr std::string_view kMarks = "!#$%&'*+-.^_`|~";
  return is_digit_or_letter(c) || (c != 0 && kMarks.find(static_cast<char>(c)) != kMarks.npos);
}

bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_token_char);
}

bool is_control(unsigned char c) { return c < ' ' || c == 0x7f; }

char lower(char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool are_equal(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

/// The text without optional white space (RFC 9110, 5.6.3) at its ends.
std::string_view without_blanks(std::string_view text) { return trimmed(text, " \t"); }

/// The elements of a comma-separated list, without empty ones.
std::vector<std::string_view> split_list(std::string_view list) {
  std::vector<std::string_view> elements;
  while (!list.empty()) {
    const auto comma = std::min(list.find(','), list.size());
    if (const auto element = without_blanks(list.substr(0, comma)); !element.empty()) {
      elements.push_back(element);
    }
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return elements;
}

/// Whether a coding of Accept-Encoding has a quality of 0 (RFC 9110, 12.4.2): "0", "0.", "0.000".
bool is_refused(std::string_view parameters) {
  const auto mark = parameters.find("q=");
  if (mark == std::string_view::npos) return false;
  const std::string_view quality = without_blanks(parameters.substr(mark + 2));
  return quality.starts_with('0') && quality.find_first_not_of("0.") == std::string_view::npos;
}

bool names_gzip(std::string_view codings) {
  const auto elements = split_list(codings);
  return std::any_of(elements.begin(), elements.end(), [](std::string_view element) {
    const auto end = std::min(element.find(';'), element.size());
    const std::string_view coding = without_blanks(element.substr(0, end));
    return (are_equal(coding, "gzip") || are_equal(coding, "x-gzip")) &&
           !is_refused(element.substr(end));
  });
}

std::optional<int> hex_digit(char c) {
  if ('0' <= c && c <= '9') return c - '0';
  if ('a' <= lower(c) && lower(c) <= 'f') return lower(c) - 'a' + 10;
  return std::nullopt;
}

void check_method(std::string_view method) {
  constexpr std::array<std::string_view, 7> kMethods = {"GET", "HEAD",  "OPTIONS", "POST",
                                                        "PUT", "PATCH", "DELETE"};
  if (!is_token(method)) refuse(400, "the request does not begin with a method");
  if (std::find(kMethods.begin(), kMethods.end(), method) == kMethods.end()) {
    refuse(501, "this method is not known here (methods are case-sensitive)");
  }
}

/// The decoded path of a target in origin form. Malformed escapes are refused because the library
/// has rules of its own for them.
std::string path_in(std::string_view target) {
  constexpr const char* kForm = "the request target has to be an absolute path, percent-encoded";
  if (target.empty() || target.front() != '/') refuse(400, kForm);
  if (std::count(target.begin(), target.end(), '?') > 1) {
    refuse(400, "the request target has more than one '?'");
  }
  const auto path_end = std::min(target.find('?'), target.size());
  std::string path;
  for (std::size_t i = 0; i < target.size(); ++i) {
    char c = target[i];
    const auto byte = static_cast<unsigned char>(c);
    if (byte <= ' ' || byte >= 0x7f || c == '#') refuse(400, kForm);
    if (c == '%') {
      const bool is_whole = i + 2 < target.size();
      const auto high = is_whole ? hex_digit(target[i + 1]) : std::nullopt;
      const auto low = is_whole ? hex_digit(target[i + 2]) : std::nullopt;
      if (!high || !low) refuse(400, "a '%' in the target without two hex digits");
      c = static_cast<char>(*high * 16 + *low);
      if (c == '\0') refuse(400, "the request target holds %00");
      if (i < path_end) path += c;
      i += 2;
      continue;
    }
    if (i < path_end) path += c;
  }
  return path;
}

void read_request_line(std::string_view line, RequestHead& head) {
  if (line.size() >= kMaxLineBytes) refuse(414, fmt::format("at most {} bytes", kMaxLineBytes));
  const auto first = line.find(' ');
  const auto second = first == line.npos ? line.npos : line.find(' ', first + 1);
  if (second == line.npos || line.find(' ', second + 1) != line.npos) {
    refuse(400, "the request line has to be: METHOD SP TARGET SP HTTP/1.1");
  }
  const std::string_view version = line.substr(second + 1);
  constexpr std::size_t kVersionSize = 8;
  if (!version.starts_with("HTTP/") || version.size() != kVersionSize) {
    refuse(400, "the request line has to end with HTTP/1.1");
  }
  if (version != "HTTP/1.1" && version != "HTTP/1.0") refuse(505, "this is HTTP/1.1");
  head.is_http_1_0 = version == "HTTP/1.0";
  head.method = line.substr(0, first);
  check_method(head.method);
  head.target = line.substr(first + 1, second - first - 1);
  head.path = path_in(head.target);
}

HeaderField field_in(std::string_view line) {
  if (line.size() >= kMaxLineBytes) {
    refuse(431, fmt::format("a header field has at most {} bytes", kMaxLineBytes));
  }
  const auto colon = line.find(':');
  if (colon == line.npos || !is_token(line.substr(0, colon))) {
    // Also a blank before the colon, and a line that continues the one before it.
    refuse(400, "a header field has to be: NAME: VALUE, with a token as its name");
  }
  const std::string_view value = without_blanks(line.substr(colon + 1));
  const auto is_wrong = [](unsigned char c) { return is_control(c) && c != '\t'; };
  if (std::any_of(value.begin(), value.end(), is_wrong)) {
    refuse(400, "a header field holds a control character");
  }
  return {std::string(line.substr(0, colon)), std::string(value)};
}

std::vector<HeaderField> fields_in(std::string_view lines) {
  std::vector<HeaderField> fields;
  while (!lines.empty()) {
    const auto end = lines.find(kLineEnd);
    if (fields.size() == kMaxHeaderFields) {
      refuse(431, fmt::format("at most {} header fields", kMaxHeaderFields));
    }
    fields.push_back(field_in(lines.substr(0, end)));
    lines.remove_prefix(end + kLineEnd.size());
  }
  return fields;
}

std::vector<std::string_view> header_values(const std::vector<HeaderField>& fields,
                                            std::string_view name) {
  std::vector<std::string_view> values;
  for (const HeaderField& field : fields) {
    if (are_equal(field.name, name)) values.push_back(field.value);
  }
  return values;
}

// If there are two values, a proxy may follow the first and the library the second.
void check_single_fields(const std::vector<HeaderField>& fields) {
  constexpr std::array kSingle = {"Host",
                                  "Content-Length",
                                  "Transfer-Encoding",
                                  "Content-Type",
                                  "Expect",
                                  "Authorization",
                                  "Origin",
                                  "Range",
                                  "If-Range",
                                  "Idempotency-Key",
                                  "Last-Event-ID"};
  for (const char* name : kSingle) {
    if (header_values(fields, name).size() > 1) refuse(400, fmt::format("{} twice", name));
  }
}

void check_host(const RequestHead& head, const std::vector<HeaderField>& fields) {
  const auto hosts = header_values(fields, "Host");
  if (hosts.empty() && !head.is_http_1_0) refuse(400, "HTTP/1.1 needs a Host");
  constexpr std::string_view kMarks = "-._~%:[]!$&'()*+;=";  // no comma: it would be a list
  const auto is_allowed = [&](unsigned char c) {
    return is_digit_or_letter(c) || (c != 0 && kMarks.find(static_cast<char>(c)) != kMarks.npos);
  };
  if (!hosts.empty() && !std::all_of(hosts[0].begin(), hosts[0].end(), is_allowed)) {
    refuse(400, "the Host is not a host");
  }
}

std::size_t length_in(std::string_view text) {
  constexpr std::size_t kMaxDigits = 15;
  const auto is_digit = [](char c) { return '0' <= c && c <= '9'; };
  std::size_t length = 0;
  if (text.empty() || text.size() > kMaxDigits ||
      !std::all_of(text.begin(), text.end(), is_digit)) {
    refuse(400, fmt::format("a Content-Length is one number of 1 to {} digits", kMaxDigits));
  }
  std::from_chars(text.data(), text.data() + text.size(), length);
  return length;
}

void read_framing(const std::vector<HeaderField>& fields, RequestHead& head) {
  const auto lengths = header_values(fields, "Content-Length");
  if (const auto codings = header_values(fields, "Transfer-Encoding"); !codings.empty()) {
    if (!lengths.empty()) refuse(400, "both Transfer-Encoding and Content-Length");
    if (head.is_http_1_0) refuse(400, "HTTP/1.0 has no Transfer-Encoding");
    if (!head.takes_body()) refuse(400, fmt::format("a {} has no body", head.method));
    if (!are_equal(codings[0], "chunked")) refuse(501, "this transfer coding is not known here");
    head.is_chunked = true;
  }
  if (!lengths.empty()) head.content_length = length_in(lengths[0]);
  if (head.content_length > 0 && !head.takes_body()) {
    refuse(400, fmt::format("a {} has no body", head.method));
  }
  for (const std::string_view value : header_values(fields, "Content-Encoding")) {
    for (const std::string_view coding : split_list(value)) {
      if (!are_equal(coding, "identity")) refuse(415, "bodies are sent without a Content-Encoding");
    }
  }
}

void read_expectation(const std::vector<HeaderField>& fields, RequestHead& head) {
  const auto expectations = header_values(fields, "Expect");
  if (expectations.empty() || head.is_http_1_0) return;
  if (!are_equal(expectations[0], "100-continue")) refuse(417, "only 100-continue can be expected");
  head.expects_continue = head.content_length > 0 || head.is_chunked;
}

void read_persistence(const std::vector<HeaderField>& fields, RequestHead& head) {
  bool is_close = false;
  bool is_keep_alive = false;
  for (const std::string_view value : header_values(fields, "Connection")) {
    for (const std::string_view option : split_list(value)) {
      is_close = is_close || are_equal(option, "close");
      is_keep_alive = is_keep_alive || are_equal(option, "keep-alive");
    }
  }
  head.keeps_connection = !is_close && (is_keep_alive || !head.is_http_1_0);
}

// Hop-by-hop fields, and names that the library and library_text() reserve.
bool is_for_library(const HeaderField& field) {
  constexpr std::array kDropped = {
      "Connection",  "Keep-Alive",        "Proxy-Connection", "TE",
      "Trailer",     "Transfer-Encoding", "Upgrade",          "HTTP2-Settings",
      "Expect",      "Content-Length",    "Content-Encoding", "REMOTE_ADDR",
      "REMOTE_PORT", "LOCAL_ADDR",        "LOCAL_PORT",       kRangeField};
  return std::none_of(kDropped.begin(), kDropped.end(),
                      [&](const char* name) { return are_equal(field.name, name); });
}

void check_line_ends(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const bool is_wrong = (bytes[i] == '\n' && (i == 0 || bytes[i - 1] != '\r')) ||
                          (bytes[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] != '\n') ||
                          bytes[i] == '\0';
    if (is_wrong) refuse(400, "lines of a head end with CR LF and hold no CR, LF or NUL");
  }
}

RequestHead read_head(std::string_view bytes) {
  check_line_ends(bytes);
  RequestHead head;
  const auto line_end = bytes.find(kLineEnd);
  if (bytes.size() > kMaxHeadBytes) {
    refuse(431, fmt::format("a head has at most {} bytes", kMaxHeadBytes));
  }
  if (line_end == bytes.npos || !bytes.ends_with("\r\n\r\n")) refuse(400, "the head does not end");
  read_request_line(bytes.substr(0, line_end), head);
  const auto lines = bytes.substr(line_end + kLineEnd.size());
  std::vector<HeaderField> fields = fields_in(lines.substr(0, lines.size() - kLineEnd.size()));
  check_single_fields(fields);
  check_host(head, fields);
  read_framing(fields, head);
  read_expectation(fields, head);
  read_persistence(fields, head);
  std::copy_if(std::make_move_iterator(fields.begin()), std::make_move_iterator(fields.end()),
               std::back_inserter(head.fields), is_for_library);
  return head;
}

}  // namespace

bool RequestHead::takes_body() const {
  return method == "POST" || method == "PUT" || method == "PATCH" || method == "DELETE";
}

std::variant<RequestHead, HeadError> parse_request_head(std::string_view bytes) {
  try {
    return read_head(bytes);
  } catch (const Fault& fault) {
    return fault.error;
  }
}

HeadError check_header_field(std::string_view line) {
  try {
    static_cast<void>(field_in(line));
    return {0, ""};
  } catch (const Fault& fault) {
    return fault.error;
  }
}

HeadError check_head_start(std::string_view bytes) {
  try {
    if (!bytes.empty() && !is_token_char(static_cast<unsigned char>(bytes.front()))) {
      refuse(400, "the request does not begin with a method");
    }
    check_line_ends(bytes);
    const auto line_end = bytes.find(kLineEnd);
    RequestHead head;
    if (line_end != bytes.npos) {
      read_request_line(bytes.substr(0, line_end), head);
    } else if (bytes.size() > kMaxLineBytes) {
      refuse(414, fmt::format("a request line has at most {} bytes", kMaxLineBytes));
    }
    if (bytes.size() >= kMaxHeadBytes) {
      refuse(431, fmt::format("a head has at most {} bytes", kMaxHeadBytes));
    }
    return {0, ""};
  } catch (const Fault& fault) {
    return fault.error;
  }
}

bool RequestHead::accepts_gzip() const {
  return std::any_of(fields.begin(), fields.end(), [](const HeaderField& field) {
    return are_equal(field.name, kAcceptEncoding) && names_gzip(field.value);
  });
}

std::string library_text(const RequestHead& head) {
  std::string text = head.method + " " + head.target;
  text += head.is_http_1_0 ? " HTTP/1.0\r\n" : " HTTP/1.1\r\n";
  for (const HeaderField& field : head.fields) {
    if (are_equal(field.name, kAcceptEncoding)) continue;
    text += are_equal(field.name, "Range") ? kRangeField : field.name;
    text += ": ";
    // The library decodes percent escapes in values, which nobody else does.
    for (const char c : field.value) {
      if (c == '%') {
        text += "%25";
      } else {
        text += c;
      }
    }
    text += kLineEnd;
  }
  // The library prefers brotli at its slowest level (a second for 300 kB), and ignores qualities.
  if (head.accepts_gzip()) text += "Accept-Encoding: gzip\r\n";
  if (head.is_http_1_0 && head.keeps_connection) text += "Connection: Keep-Alive\r\n";
  // Without it the library reads a body until the connection ends.
  if (head.takes_body()) text += fmt::format("Content-Length: {}\r\n", head.content_length);
  text += kLineEnd;
  return text;
}

}  // namespace throng::server
