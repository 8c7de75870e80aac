#include "crowd/elements/number_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/files/files.h"

namespace throng::crowd {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

NumberFile::NumberFile(const TextFile& file)
    : name_(file.path.filename().string()),
      text_(file.text != nullptr ? *file.text : read_file(file.path)) {}

void NumberFile::skip_space() {
  for (; position_ < text_.size() && is_space(text_[position_]); ++position_) {
    if (text_[position_] == '\n') ++line_;
  }
}

bool NumberFile::at_end() {
  skip_space();
  return position_ == text_.size();
}

std::string_view NumberFile::word(std::string_view what) {
  if (at_end()) fail("the end of the file", std::string(what));
  const std::size_t begin = position_;
  while (position_ < text_.size() && !is_space(text_[position_])) ++position_;
  return std::string_view(text_).substr(begin, position_ - begin);
}

std::string NumberFile::line(std::string_view what) {
  if (at_end()) fail("the end of the file", std::string(what));
  const std::size_t begin = position_;
  position_ = std::min(text_.find('\n', begin), text_.size());
  std::string found = text_.substr(begin, position_ - begin);
  while (is_space(found.back())) found.pop_back();
  return found;
}

double NumberFile::number(std::string_view what, double min, double max) {
  std::string_view found = word(what);
  const std::string_view digits = found.front() == '+' ? found.substr(1) : found;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  if (!is_number || !(value >= min && value <= max)) {
    fail(in_quotes(found), fmt::format("{}: a number from {} to {}", what, min, max));
  }
  return value;
}

int NumberFile::integer(std::string_view what, int min, int max) {
  const std::string_view found = word(what);
  int value = 0;
  const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
  const bool is_integer = error == std::errc() && end == found.data() + found.size();
  if (!is_integer || value < min || value > max) {
    fail(in_quotes(found), max < min
                               ? fmt::format("{} (there is none)", what)
                               : fmt::format("{}: a whole number from {} to {}", what, min, max));
  }
  return value;
}

int NumberFile::count(std::string_view what, int min, int numbers_each) {
  // A number takes two characters or more: itself and a space.
  const std::size_t max_count =
      (text_.size() - position_) / 2 / static_cast<std::size_t>(numbers_each);
  constexpr std::size_t kMaxNumbers = 100'000'000;
  const int value = integer(what, min, static_cast<int>(kMaxNumbers));
  if (static_cast<std::size_t>(value) > max_count + 1) {
    fail(fmt::format("{}", value), fmt::format("{}: no more than follow in the file", what));
  }
  return value;
}

void NumberFile::fail(std::string found, std::string expected) const {
  throw InputError(
      Problem{name_, fmt::format("line {}", line_), std::move(found), std::move(expected)});
}

}  // namespace throng::crowd
