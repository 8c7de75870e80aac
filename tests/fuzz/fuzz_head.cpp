// Any request head: what is taken has one meaning, and the library is given exactly that.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

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
  require(same.content_length == head.content_length && same.fields.size() == head.fields.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const auto read = throng::server::parse_request_head(bytes);
  const bool is_taken = std::holds_alternative<RequestHead>(read);
  for (std::size_t i = 0; i <= size; i += 1 + size / 50) {
    const auto error = throng::server::check_head_start(bytes.substr(0, i));
    require(error.status == 0 || !is_taken);
  }
  if (is_taken) check_taken(std::get<RequestHead>(read));
  return 0;
}
