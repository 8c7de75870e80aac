// Any request head: what is taken has one meaning, and the library is given exactly that. And any
// chunked body: it is the same in whatever pieces it arrives.
#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "server/http/chunked_body.h"
#include "server/http/request_head.h"

namespace {

using throng::server::RequestHead;

void require(bool holds) {
  if (!holds) std::abort();
}

bool is_one_line(const std::string& text) {
  return text.find_first_of(std::string("\r\n\0", 3)) == std::string::npos;
}

void check_taken(const RequestHead& head) {
  require(is_one_line(head.method) && is_one_line(head.target));
  require(head.target.starts_with('/') && head.target.find(' ') == std::string::npos);
  require(head.path.find('\0') == std::string::npos && head.path.starts_with('/'));
  require(head.content_length == 0 || head.takes_body());
  for (const auto& field : head.fields) {
    require(!field.name.empty() && is_one_line(field.name) && is_one_line(field.value));
    require(field.name.find_first_of(" \t:") == std::string::npos);
  }
  const std::string text = throng::server::library_text(head);
  require(text.find("\r\n\r\n") == text.size() - 4);
  const auto again = throng::server::parse_request_head(text);
  if (const auto* error = std::get_if<throng::server::HeadError>(&again)) {
    require(error->status == 431);  // a '%' takes three bytes for the library
    return;
  }
  const auto& same = std::get<RequestHead>(again);
  require(same.method == head.method && same.target == head.target && same.path == head.path);
  // The name that Range has for the library is not taken from clients.
  const std::size_t ranges =
      text.find(fmt::format("\r\n{}:", throng::server::kRangeField)) != std::string::npos ? 1 : 0;
  require(same.content_length == head.content_length &&
          same.fields.size() + ranges == head.fields.size());
}

void check_chunks(const std::string& bytes) {
  constexpr std::size_t kMaxBytes = 300;
  throng::server::ChunkedBody whole(kMaxBytes);
  throng::server::ChunkedBody pieces(kMaxBytes);
  const std::size_t taken = whole.take(bytes);
  std::size_t taken_in_pieces = 0;
  while (taken_in_pieces < bytes.size() && !pieces.is_whole() && pieces.error().status == 0) {
    taken_in_pieces += pieces.take(std::string_view(bytes).substr(taken_in_pieces, 3));
  }
  require(taken == taken_in_pieces && taken <= bytes.size() && whole.bytes() <= kMaxBytes);
  require(whole.is_whole() == pieces.is_whole() && whole.error().status == pieces.error().status);
  std::string one(kMaxBytes, '\0');
  std::string other(kMaxBytes, '\0');
  require(whole.read(one.data(), kMaxBytes) == whole.bytes());
  require(pieces.read(other.data(), kMaxBytes) == pieces.bytes() && one == other);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  check_chunks(bytes);
  const auto read = throng::server::parse_request_head(bytes);
  const bool is_taken = std::holds_alternative<RequestHead>(read);
  for (std::size_t i = 0; i <= size; i += 1 + size / 50) {
    const auto error = throng::server::check_head_start(bytes.substr(0, i));
    require(error.status == 0 || !is_taken);
  }
  if (is_taken) check_taken(std::get<RequestHead>(read));
  return 0;
}
