#include "jobs/bucket/url_text.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/text/url.h"

namespace throng::bucket {

std::string encoded_path(std::string_view key) { return percent_encoded(key, "-._~/"); }

std::string query_text(Pairs query) {
  std::sort(query.begin(), query.end());
  std::string text;
  for (const auto& [name, value] : query) {
    text += fmt::format("{}{}={}", text.empty() ? "?" : "&", percent_encoded(name),
                        percent_encoded(value));
  }
  return text;
}

}  // namespace throng::bucket
