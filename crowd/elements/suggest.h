// Suggestions in messages about names of the crowd files.
#pragma once

#include <string_view>
#include <vector>

#include "base/text/suggest.h"  // closest(), did_you_mean()

namespace throng::crowd {

/// Returns the names in angle brackets of a text such as "<Goal> or <GoalSet>".
std::vector<std::string_view> names_in_brackets(std::string_view text);

}  // namespace throng::crowd
