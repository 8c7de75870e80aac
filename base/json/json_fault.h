// Descriptions of syntax errors in JSON texts.
#pragma once

#include <string_view>

#include "base/error.h"

namespace throng {

/// Returns the first syntax error of a text that the JSON parser rejected, as a Problem without a
/// source: line and column, the error ("a comma too many before }") and the expected syntax. `what`
/// is "file" or "body", for messages about an empty text. `found` is empty if the syntax is valid
/// and, for example, a number is too large.
Problem json_fault(std::string_view text, std::string_view what);

/// Returns the position of a byte as "line 3, column 12"; columns count characters.
std::string text_position(std::string_view text, std::size_t byte);

}  // namespace throng
