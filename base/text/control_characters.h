// Control characters in texts of one line, such as names.
#pragma once

#include <algorithm>
#include <string_view>

namespace throng {

/// Rule of a JSON Schema, true where a text has no control characters: a "pattern" would do, but
/// regular expressions of the C++ library end the process at long texts.
inline constexpr const char* kOneLine = "x-one-line";

/// Whether a UTF-8 text has a control character: U+0000 to U+001F or U+007F to U+009F. Terminals
/// act on them, and lists and logs show one line as several.
inline bool has_control_characters(std::string_view text) {
  constexpr unsigned char kDelete = 0x7f;
  constexpr unsigned char kLead = 0xc2;    // of U+0080 to U+00BF
  constexpr unsigned char kLastC1 = 0x9f;  // second byte of U+009F
  unsigned char before = 0;
  return std::any_of(text.begin(), text.end(), [&](unsigned char c) {
    const bool is_c1 = before == kLead && c <= kLastC1;
    before = c;
    return c < ' ' || c == kDelete || is_c1;
  });
}

}  // namespace throng
