// UTF-8 text (RFC 3629) and its characters (code points), in which JSON Schema counts lengths.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace throng {

/// Number of code points. Every byte that is no continuation byte counts as the first of one.
std::size_t character_count(std::string_view text);

/// Position of the first byte that is not well-formed UTF-8 (RFC 3629); npos if there is none.
std::size_t find_invalid_utf8(std::string_view text);

/// Whether the bytes are well-formed: no overlong forms, no surrogates, nothing above U+10FFFF.
bool is_utf8(std::string_view text);

/// The first `count` code points of `text`, all of it if it has fewer.
std::string first_characters(std::string_view text, std::size_t count);

}  // namespace throng
