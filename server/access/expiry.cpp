#include "server/access/expiry.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>
#include <string_view>

#include "server/catalog/unix_time.h"

namespace throng::server {

namespace {

/// The offset of a time zone by RFC 3339: "Z", "+02:00".
std::optional<std::int64_t> zone_offset_s(std::string_view zone) {
  if (zone == "Z" || zone == "z") return 0;
  constexpr std::size_t kLength = 6;
  if (zone.size() != kLength || (zone[0] != '+' && zone[0] != '-') || zone[3] != ':') {
    return std::nullopt;
  }
  const auto two_digits = [&](std::size_t at) {
    const bool are_digits = std::isdigit(static_cast<unsigned char>(zone[at])) != 0 &&
                            std::isdigit(static_cast<unsigned char>(zone[at + 1])) != 0;
    return are_digits ? 10 * (zone[at] - '0') + zone[at + 1] - '0' : 60;
  };
  constexpr int kMinutes = 60;
  constexpr int kHours = 24;
  const int hours = two_digits(1);
  const int minutes = two_digits(4);
  if (hours >= kHours || minutes >= kMinutes) return std::nullopt;
  const std::int64_t offset_s = (hours * kMinutes + minutes) * kMinutes;
  return zone[0] == '-' ? -offset_s : offset_s;
}

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
  constexpr std::size_t kDateLength = 10;
  const bool is_date = text.size() == kDateLength;
  std::tm time{};
  const char* rest = ::strptime(text.c_str(), is_date ? "%Y-%m-%d" : "%Y-%m-%dT%H:%M:%S", &time);
  if (rest == nullptr) return std::nullopt;
  const std::time_t seconds = ::timegm(&time);
  // The library takes "2027-2-30" for March 2.
  const std::string read = fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(seconds));
  if (!text.starts_with(is_date ? read.substr(0, kDateLength) : read)) return std::nullopt;
  constexpr std::int64_t kMsPerS = 1000;
  if (is_date) return seconds * kMsPerS;
  std::string_view zone = rest;
  if (zone.starts_with('.')) {  // parts of a second
    const std::size_t end = std::min(zone.find_first_not_of("0123456789", 1), zone.size());
    if (end == 1) return std::nullopt;
    zone.remove_prefix(end);
  }
  const auto offset_s = zone_offset_s(zone);
  if (!offset_s) return std::nullopt;
  return (seconds - *offset_s) * kMsPerS;
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
