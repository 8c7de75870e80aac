// UTF-8 text (RFC 3629) and its code points, in which JSON Schema counts lengths.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace throng {

/// Returns the number of code points: bytes that are not continuation bytes.
std::size_t character_count(std::string_view text);

/// Returns the position of the first byte that is not well-formed UTF-8, or npos.
std::size_t find_invalid_utf8(std::string_view text);

/// Whether the bytes are well-formed UTF-8: no overlong forms, surrogates, or code points above
/// U+10FFFF.
bool is_utf8(std::string_view text);

/// Returns the text without a byte order mark, with which spreadsheets and editors begin files.
std::string_view without_byte_order_mark(std::string_view text);

/// Returns the text with the replacement character U+FFFD for each byte that is not well-formed.
std::string with_valid_utf8(std::string_view text);

/// Returns the first `count` code points of `text`, or all if it has fewer.
std::string first_characters(std::string_view text, std::size_t count);

}  // namespace throng
