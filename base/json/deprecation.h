// Deprecated names of fields in files, which are accepted for one version with a warning.
#pragma once

#include <string_view>

namespace throng {

/// Warns on stderr that a document uses the deprecated field at the JSON pointer `where`, once per
/// process, document and field:
/// `throng: warning: yard.json: /exits/0/shuts_s is deprecated, use "closes_at_s"`.
/// `source` names the document, or is "" if there is no file. Thread-safe.
void warn_deprecated(std::string_view source, std::string_view where, std::string_view name);

}  // namespace throng
