#include "jobs/bucket/url_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

namespace throng::bucket {

namespace {

std::string encoded(std::string_view text, std::string_view kept) {
  std::string result;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 ||
        kept.find(c) != std::string_view::npos) {
      result += c;
    } else {
      result += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return result;
}

}  // namespace

std::string encoded_path(std::string_view key) { return encoded(key, "-._~/"); }

std::string query_text(Pairs query) {
  constexpr std::string_view kUnreserved = "-._~";
  std::sort(query.begin(), query.end());
  std::string text;
  for (const auto& [name, value] : query) {
    text += fmt::format("{}{}={}", text.empty() ? "?" : "&", encoded(name, kUnreserved),
                        encoded(value, kUnreserved));
  }
  return text;
}

}  // namespace throng::bucket
