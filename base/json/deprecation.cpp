#include "base/json/deprecation.h"

#include <fmt/core.h>

#include <cstdio>
#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace throng {

namespace {
// A server reads any number of documents; what is forgotten is warned of again.
constexpr std::size_t kMaxRemembered = 1000;
}  // namespace

void warn_deprecated(std::string_view source, std::string_view where, std::string_view name) {
  static std::mutex mutex;
  static std::set<std::pair<std::string, std::string>> warned;
  const std::string_view field = where.substr(where.rfind('/') + 1);
  const std::lock_guard lock(mutex);
  if (warned.size() >= kMaxRemembered) warned.clear();
  if (!warned.insert({std::string(source), std::string(field)}).second) return;
  fmt::print(stderr, "throng: warning: {}{}{} is deprecated, use \"{}\"\n", source,
             source.empty() ? "" : ": ", where, name);
}

}  // namespace throng
