// `throng crowd --list`: elements and attributes of the crowd simulation's files, as text for
// people, JSON for programs and Markdown for the documentation.
#pragma once

#include <string>
#include <string_view>

namespace throng::cli {

/// The list; `format` is text, json or markdown.
std::string crowd_vocabulary(std::string_view format);

}  // namespace throng::cli
