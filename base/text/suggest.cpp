#include "base/text/suggest.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace throng {

namespace {

constexpr std::size_t kMaxWordLength = 40;  // letters; longer words are not taken for misspellings

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// The first candidate that has the word as its first part.
std::optional<std::string_view> longer_by_a_part(std::string_view word,
                                                 std::span<const std::string_view> candidates) {
  std::optional<std::string_view> best;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() <= word.size() || best) continue;
    const bool ends_there =
        std::string_view("-_/.").find(candidate[word.size()]) != std::string_view::npos;
    const bool is_start = std::equal(word.begin(), word.end(), candidate.begin(),
                                     [](char a, char b) { return lower(a) == lower(b); });
    if (ends_there && is_start) best = candidate;
  }
  return best;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the table of optimal string alignment.
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

std::optional<std::string_view> closest(std::string_view word,
                                        std::span<const std::string_view> candidates) {
  if (word.empty() || word.size() > kMaxWordLength) return std::nullopt;
  std::optional<std::string_view> best;
  std::size_t min_distance = 0;
  for (const std::string_view candidate : candidates) {
    if (candidate.empty() || candidate.size() > kMaxWordLength) continue;
    const std::size_t differ = edit_distance(word, candidate);
    if (3 * differ > std::max(word.size(), candidate.size())) continue;
    if (!best || differ < min_distance) {
      best = candidate;
      min_distance = differ;
    }
  }
  return best ? best : longer_by_a_part(word, candidates);
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
  const auto known = closest(word, candidates);
  return known ? fmt::format(" (did you mean {}?)", *known) : std::string();
}

Problem unknown_name(std::string source, std::string where, std::string_view kind,
                     std::string_view name, std::span<const std::string_view> known) {
  const auto nearest = closest(name, known);
  return {std::move(source), std::move(where), fmt::format("unknown {} \"{}\"", kind, name),
          nearest ? fmt::format("\"{}\"", *nearest)
                  : fmt::format("one of: {}", fmt::join(known, ", "))};
}

}  // namespace throng
