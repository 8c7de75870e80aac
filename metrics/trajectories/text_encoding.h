// The text of a file, whatever its encoding.
#pragma once

#include <string>
#include <string_view>

namespace throng::metrics {

/// Whether bytes are UTF-16, by their byte order mark or by the zeros of its Latin letters.
bool is_utf16(std::string_view bytes);

/// Returns the text of a file in UTF-8 without byte order mark; UTF-16 is converted. `name` names
/// the file in messages. Throws InputError for bytes that are no text, naming their kind.
std::string decode_text(std::string_view bytes, const std::string& name);

/// Returns a part of a file for a message: shortened, with unprintable characters replaced.
std::string shown(std::string_view text);

}  // namespace throng::metrics
