#include "server/http/byte_range.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

namespace throng::server {

namespace {

// Digits only; a number too large for us is as good as the largest. -1: no number.
std::int64_t number(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string_view::npos) return -1;
  std::int64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() ? value : std::numeric_limits<std::int64_t>::max();
}

}  // namespace

RangeAnswer range_answer(const std::string& range, const std::string& if_range,
                         const std::string& etag, std::int64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  using enum RangeAnswer::Kind;
  const std::string_view text = range;
  if (!text.starts_with(kUnit) || (!if_range.empty() && if_range != etag)) return {whole, {}};
  const std::string_view places = text.substr(kUnit.size());
  const auto dash = places.find('-');
  if (dash == std::string_view::npos || places.find(',') != std::string_view::npos) {
    return {whole, {}};
  }
  const std::string_view from = places.substr(0, dash);
  const std::string_view to = places.substr(dash + 1);
  const std::int64_t last = to.empty() ? size - 1 : number(to);
  if (from.empty()) {  // the last so many bytes
    if (to.empty() || last < 0) return {whole, {}};
    if (last == 0 || size == 0) return {unsatisfiable, {}};
    return {part, {std::max<std::int64_t>(0, size - last), size - 1}};
  }
  const std::int64_t first = number(from);
  if (first < 0 || last < 0 || (!to.empty() && last < first)) return {whole, {}};
  if (first >= size) return {unsatisfiable, {}};
  return {part, {first, std::min(last, size - 1)}};
}

}  // namespace throng::server
