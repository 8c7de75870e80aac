// Characters (code points) of UTF-8 text. JSON Schema counts lengths in them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace throng {

/// Number of code points. Every byte that is no continuation byte counts as the first of one.
std::size_t character_count(std::string_view text);

/// The first `count` code points of `text`, all of it if it has fewer.
std::string first_characters(std::string_view text, std::size_t count);

}  // namespace throng
