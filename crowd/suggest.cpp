#include "crowd/suggest.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace throng::crowd {

namespace {

constexpr std::size_t kLongestWord = 40;  // letters; longer words are no misspelt ones

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Damerau and Levenshtein's distance (optimal string alignment), by three rows of its table.
std::size_t distance(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, kLongestWord + 1>;
  Row before{};
  Row last{};
  Row row{};
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = last;
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::optional<std::string_view> closest(std::string_view word,
                                        std::span<const std::string_view> candidates) {
  if (word.empty() || word.size() > kLongestWord) return std::nullopt;
  std::optional<std::string_view> best;
  std::size_t fewest = 0;
  for (const std::string_view candidate : candidates) {
    if (candidate.empty() || candidate.size() > kLongestWord) continue;
    const std::size_t differ = distance(word, candidate);
    if (3 * differ > std::max(word.size(), candidate.size())) continue;
    if (!best || differ < fewest) {
      best = candidate;
      fewest = differ;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
  const auto known = closest(word, candidates);
  return known ? fmt::format(" (did you mean {}?)", *known) : std::string();
}

std::vector<std::string_view> names_in_brackets(std::string_view text) {
  std::vector<std::string_view> names;
  while (true) {
    const std::size_t open = text.find('<');
    if (open == std::string_view::npos) return names;
    text.remove_prefix(open + 1);
    const std::size_t close = text.find('>');
    if (close == std::string_view::npos) return names;
    names.push_back(text.substr(0, close));
    text.remove_prefix(close + 1);
  }
}

}  // namespace throng::crowd
