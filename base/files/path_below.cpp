#include "base/files/path_below.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace throng {

bool is_path_part(std::string_view text) {
  constexpr char kDelete = 0x7F;
  return !text.empty() && text != "." && text != ".." &&
         std::none_of(text.begin(), text.end(), [](char c) {
           return c == '/' || c == '\\' || c == kDelete || (c >= 0 && c < ' ');
         });
}

bool is_path_below(std::string_view text) {
  for (std::size_t end = text.find('/'); end != std::string_view::npos; end = text.find('/')) {
    if (!is_path_part(text.substr(0, end))) return false;
    text.remove_prefix(end + 1);
  }
  return is_path_part(text);
}

void require_path_below(std::string_view text, const std::string& source,
                        const std::string& pointer) {
  if (is_path_below(text)) return;
  throw InputError(
      Problem{source, pointer,
              nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
              "the path of a file below this folder, without \"..\""});
}

}  // namespace throng
