// Paths in files of others (manifests, lists, labels), which may not lead out of their folder.
#pragma once

#include <string>
#include <string_view>

namespace throng {

/// Whether a text is the path of a file or folder below another one: parts with '/' between them,
/// none of which is empty, "." or "..", without backslashes and control characters.
bool is_path_below(std::string_view text);

/// Whether a text is one part of such a path, as ids of runs and drones are.
bool is_path_part(std::string_view text);

/// Throws InputError with `source` and `pointer` unless is_path_below(text).
void require_path_below(std::string_view text, const std::string& source,
                        const std::string& pointer);

}  // namespace throng
