// `throng crowd --list`: the vocabulary of the crowd engine's files, for people, programs and the
// documentation.
#pragma once

#include <string>
#include <string_view>

namespace throng::cli {

/// `format` is text, json or markdown.
std::string crowd_vocabulary(std::string_view format);

}  // namespace throng::cli
