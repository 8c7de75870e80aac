#include "metrics/trajectories/table_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <string>

#include "base/error.h"
#include "base/text/words.h"
#include "metrics/trajectories/number_in.h"

namespace throng::metrics {

namespace {

bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view unquoted(std::string_view text) {
  std::string_view field = trimmed(text, " \r");
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = field.substr(1, field.size() - 2);
  }
  return field;
}

/// Whether each comma is between digits, and blanks separate the numbers.
bool has_decimal_commas_only(std::string_view line) {
  const std::string_view text = trimmed(line, " \t\r");
  if (text.find_first_of(" \t") == std::string_view::npos) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != ',') continue;
    const bool between = i > 0 && i + 1 < text.size() && is_decimal_digit(text[i - 1]) &&
                         is_decimal_digit(text[i + 1]);
    if (!between) return false;
  }
  return true;
}

/// Parses an integer at the beginning of a text and removes it with the character behind it.
std::optional<int> take_integer(std::string_view& text, char behind) {
  int value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto used = static_cast<std::size_t>(rest - text.data());
  if (error != std::errc() || used == text.size() || text[used] != behind) return std::nullopt;
  text.remove_prefix(used + 1);
  return value;
}

/// Parses "HH:MM:SS.SS", in s; also with days before.
std::optional<double> clock_time(std::string_view text) {
  constexpr int kMinute = 60;
  constexpr int kHour = 3600;
  constexpr double kDay = 86400;
  double days = 0;
  if (std::count(text.begin(), text.end(), ':') == 3) {
    const auto count = take_integer(text, ':');
    if (!count) return std::nullopt;
    days = *count;
  }
  const auto hours = take_integer(text, ':');
  if (!hours) return std::nullopt;
  const auto minutes = take_integer(text, ':');
  if (!minutes) return std::nullopt;
  std::string seconds(text.substr(0, text.find_first_of("Z+")));
  std::replace(seconds.begin(), seconds.end(), ',', '.');
  const auto number = number_in(seconds);
  if (!number) return std::nullopt;
  return days * kDay + *hours * kHour + *minutes * kMinute + *number;
}

}  // namespace

char detect_separator(std::string_view line) {
  constexpr std::array kSeparators = {',', ';', '\t'};
  const auto count = [&](char c) { return std::count(line.begin(), line.end(), c); };
  char most_frequent = *std::max_element(kSeparators.begin(), kSeparators.end(),
                                         [&](char a, char b) { return count(a) < count(b); });
  if (most_frequent == ',' && has_decimal_commas_only(line)) {
    most_frequent = count('\t') > 0 ? '\t' : ' ';
  } else if (most_frequent == ',' && count(';') > 2) {
    most_frequent = ';';
  }
  return line.find(most_frequent) == std::string_view::npos ? ' ' : most_frequent;
}

std::vector<std::string_view> split_fields(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  bool quoted = false;
  std::size_t start = 0;
  const auto separates = [&](char c) { return c == separator || (separator == ' ' && c == '\t'); };
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (!separates(line[i]) || quoted) continue;
    fields.push_back(unquoted(line.substr(start, i - start)));
    start = i + 1;
  }
  fields.push_back(unquoted(line.substr(start)));
  if (separator == ' ') std::erase_if(fields, [](std::string_view field) { return field.empty(); });
  return fields;
}

std::vector<std::string_view> split_names(std::string_view line, char separator) {
  std::vector<std::string_view> names;
  bool is_open = false;
  for (const std::string_view field : split_fields(line, separator)) {
    if (field.empty()) {
      names.push_back(field);
      continue;
    }
    const bool is_unit =
        separator == ' ' && (is_open || field.front() == '[' || field.front() == '(');
    if (is_unit && !names.empty()) {
      const char* start = names.back().data();
      names.back() = {start, static_cast<std::size_t>(field.data() + field.size() - start)};
    } else {
      names.push_back(field);
    }
    const std::string_view name = names.back();
    is_open =
        std::count(name.begin(), name.end(), '[') + std::count(name.begin(), name.end(), '(') >
        std::count(name.begin(), name.end(), ']') + std::count(name.begin(), name.end(), ')');
  }
  return names;
}

std::optional<FieldNumber> field_number(std::string_view field) {
  const std::size_t comma = field.find(',');
  if (comma == std::string_view::npos) {
    const auto value = number_in(field);
    if (!value) return std::nullopt;
    return FieldNumber{*value, field.find('.') == std::string_view::npos ? '\0' : '.'};
  }
  if (field.find('.') != std::string_view::npos) return std::nullopt;
  std::string with_point(field);
  with_point[comma] = '.';
  const auto value = number_in(with_point);
  if (!value) return std::nullopt;
  return FieldNumber{*value, ','};
}

std::optional<FieldNumber> field_time(std::string_view field) {
  if (const auto number = field_number(field)) return number;
  if (field.find(':') == std::string_view::npos) return std::nullopt;
  double days_s = 0;
  if (const std::size_t end = field.find_first_of("T "); end != std::string_view::npos) {
    std::string_view date = field.substr(0, end + 1);
    const auto year = take_integer(date, '-');
    if (!year) return std::nullopt;
    const auto month = take_integer(date, '-');
    if (!month || date.empty()) return std::nullopt;
    const auto day = take_integer(date, date.back());
    if (!day) return std::nullopt;
    const std::chrono::year_month_day ymd(std::chrono::year(*year),
                                          std::chrono::month(static_cast<unsigned>(*month)),
                                          std::chrono::day(static_cast<unsigned>(*day)));
    if (!ymd.ok()) return std::nullopt;
    constexpr double kDay = 86400;
    days_s = kDay * static_cast<double>(std::chrono::sys_days(ymd).time_since_epoch().count());
    field.remove_prefix(end + 1);
  }
  const auto time = clock_time(field);
  if (!time) return std::nullopt;
  return FieldNumber{days_s + *time, 0};
}

void TableLine::reject(const std::string& found, const std::string& expected) const {
  throw InputError({file, fmt::format("line {}", number), found, expected});
}

double TableNumbers::read(std::string_view field, const TableLine& line) {
  const auto value = field_number(field);
  if (!value) line.reject(shown(field), "a number");
  note_decimal(value->decimal, line);
  return value->value;
}

void TableNumbers::note_decimal(char decimal, const TableLine& line) {
  if (decimal == 0 || decimal == decimal_) return;
  if (decimal_ != 0) {
    line.reject(fmt::format("a number with '{}', after numbers with '{}'", decimal, decimal_),
                "the same decimal separator throughout, and none of thousands");
  }
  decimal_ = decimal;
}

}  // namespace throng::metrics
