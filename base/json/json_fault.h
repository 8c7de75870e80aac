// The fault of a text that is no JSON, in words for the person who wrote it.
#pragma once

#include <string_view>

#include "base/error.h"

namespace throng {

/// The first fault of a text that the JSON parser has refused, as a Problem without a source: line
/// and column, what is there ("a comma too many before }") and what JSON has there. `what` is the
/// kind of text, "file" or "body", for the words of an empty one. `found` is empty if the text
/// keeps the grammar, as one whose numbers are too large.
Problem json_fault(std::string_view text, std::string_view what);

/// "line 3, column 12" of a byte of the text; columns count characters.
std::string text_position(std::string_view text, std::size_t byte);

}  // namespace throng
