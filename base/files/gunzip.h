// Decompression of gzip files.
#pragma once

#include <string>
#include <string_view>

namespace throng {

/// Whether bytes begin as a gzip file does.
bool is_gzip(std::string_view bytes);

/// Returns the content of a gzip file of one or several members. `name` names the file in messages.
/// Throws InputError for a damaged file and for a content of more than 1 GiB.
std::string gunzipped(std::string_view bytes, const std::string& name);

}  // namespace throng
