#include "server/access/expiry.h"

#include <fmt/chrono.h>

#include <array>
#include <ctime>
#include <regex>
#include <string_view>

#include "server/catalog/unix_time.h"

namespace throng::server {

namespace {

/// The duration "30d", "12h" or "2w"; at most five digits.
std::optional<std::int64_t> duration_ms(const std::string& text) {
  constexpr std::size_t kMaxLength = 6;
  const bool is_number = text.size() >= 2 && text.size() <= kMaxLength &&
                         text.find_first_not_of("0123456789") == text.size() - 1;
  const std::string_view units = "hdw";
  const std::size_t unit = is_number ? units.find(text.back()) : std::string_view::npos;
  if (unit == std::string_view::npos) return std::nullopt;
  constexpr std::int64_t kMsPerHour = 3'600'000;
  constexpr std::array<std::int64_t, 3> kHours = {1, 24, 7 * 24};
  return std::stoll(text) * kHours.at(unit) * kMsPerHour;
}

/// The Unix time of a date (its begin in UTC) or of a time by RFC 3339.
std::optional<std::int64_t> time_ms(const std::string& text) {
  static const std::regex kForm(
      R"((\d{4}-\d\d-\d\d)(?:T(\d\d:\d\d:\d\d)(?:\.\d+)?(Z|[+-](?:0\d|1[0-4]):[0-5]\d))?)");
  std::smatch parts;
  if (!std::regex_match(text, parts, kForm)) return std::nullopt;
  const std::string time = parts[1].str() + (parts[2].matched ? "T" + parts[2].str() : "T00:00:00");
  std::tm fields{};
  if (::strptime(time.c_str(), "%Y-%m-%dT%H:%M:%S", &fields) == nullptr) return std::nullopt;
  const std::int64_t seconds = ::timegm(&fields);
  // The library takes February 30 for March 2.
  if (fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(seconds)) != time) return std::nullopt;
  std::tm zone{};
  ::strptime(parts[3].str().c_str(), "%z", &zone);
  constexpr std::int64_t kMsPerS = 1000;
  return (seconds - zone.tm_gmtoff) * kMsPerS;
}

}  // namespace

std::optional<std::int64_t> parse_expiry(const std::string& text) {
  const std::int64_t now_ms = unix_ms_now();
  if (const auto duration = duration_ms(text)) {
    return *duration > 0 ? std::optional(now_ms + *duration) : std::nullopt;
  }
  const std::optional<std::int64_t> expires_ms = time_ms(text);
  return expires_ms && *expires_ms > now_ms ? expires_ms : std::nullopt;
}

}  // namespace throng::server
