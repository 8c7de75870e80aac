// "Did you mean ...?": the known word that a misspelt one is nearest to.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace throng::crowd {

/// The candidate that differs from `word` in the fewest letters (inserted, left out, replaced or
/// swapped; case does not count), the first of equals. Nothing when more than a third of the
/// letters differ, since then it is no misspelling.
std::optional<std::string_view> closest(std::string_view word,
                                        std::span<const std::string_view> candidates);

/// " (did you mean x?)", or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

/// The names in angle brackets of a text such as "<Goal> or <GoalSet>".
std::vector<std::string_view> names_in_brackets(std::string_view text);

}  // namespace throng::crowd
