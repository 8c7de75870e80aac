#include "jobs/queue/store/job_id.h"

#include <fmt/core.h>

#include <algorithm>

namespace throng::jobs {

namespace {

// Crockford's base 32: no letters that look like digits, and sorted as ASCII is.
constexpr std::string_view kDigits = "0123456789abcdefghjkmnpqrstvwxyz";
constexpr std::size_t kTimeDigits = 9;  // 45 bits of milliseconds: until the year 3084
constexpr std::size_t kRandomDigits = 6;
constexpr int kBitsPerDigit = 5;

std::string format_digits(std::uint64_t value, std::size_t count) {
  std::string text(count, '0');
  for (std::size_t i = count; i-- > 0; value >>= kBitsPerDigit) text[i] = kDigits[value % 32];
  return text;
}

std::int64_t time_from_id(std::string_view id) {
  std::int64_t value = 0;
  for (const char digit : id.substr(1, kTimeDigits)) {
    value = (value << kBitsPerDigit) + static_cast<std::int64_t>(kDigits.find(digit));
  }
  return value;
}

}  // namespace

std::string make_job_id(std::int64_t now_ms, std::string_view previous, std::uint32_t random) {
  if (is_job_id(previous)) now_ms = std::max(now_ms, time_from_id(previous) + 1);
  return fmt::format("j{}{}", format_digits(static_cast<std::uint64_t>(now_ms), kTimeDigits),
                     format_digits(random, kRandomDigits));
}

bool is_job_id(std::string_view text) {
  return text.size() == 1 + kTimeDigits + kRandomDigits && text[0] == 'j' &&
         text.find_first_not_of(kDigits, 1) == std::string_view::npos;
}

}  // namespace throng::jobs
