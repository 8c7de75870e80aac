#include "base/text/slug.h"

#include <cstddef>

#include "base/text/portable_name.h"

namespace throng {

std::string slug(std::string_view name) {
  constexpr std::size_t kMaxNameBytes = 60;
  std::string text;
  for (const char c : name) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool keep = upper || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (keep) {
      text += static_cast<char>(upper ? c - 'A' + 'a' : c);
    } else if (!text.empty() && text.back() != '-') {
      text += '-';
    }
    if (text.size() == kMaxNameBytes) break;
  }
  while (!text.empty() && text.back() == '-') text.pop_back();
  if (text.empty()) return "dataset";
  return is_device_name(text) ? text + "-dataset" : text;
}

}  // namespace throng
