#include "base/text/utf8.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace throng {

namespace {

/// Continuation bytes are 10xxxxxx (RFC 3629, section 3).
bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

}  // namespace

std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

bool is_utf8(std::string_view text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());  // refuses other bytes
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
  return true;
}

std::string first_characters(std::string_view text, std::size_t count) {
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end) {
    if (begins_character(text[end]) && ++characters > count) break;
  }
  return std::string(text.substr(0, end));
}

}  // namespace throng
