#include "crowd/elements/suggest.h"

namespace throng::crowd {

std::vector<std::string_view> names_in_brackets(std::string_view text) {
  std::vector<std::string_view> names;
  while (true) {
    const std::size_t open = text.find('<');
    if (open == std::string_view::npos) return names;
    text.remove_prefix(open + 1);
    const std::size_t close = text.find('>');
    if (close == std::string_view::npos) return names;
    names.push_back(text.substr(0, close));
    text.remove_prefix(close + 1);
  }
}

}  // namespace throng::crowd
