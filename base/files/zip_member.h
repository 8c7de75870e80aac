// ZIP files with one member, such as NumPy's .npz files with one array.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace throng {

/// Returns a ZIP file with `bytes`, deflated, under `name`. Equal inputs give equal bytes.
std::string make_zip(std::string_view name, std::string_view bytes);

/// Returns the bytes of a member of a ZIP file. Throws InputError without a source if the file is
/// not a valid ZIP file, lacks the member, or the member has more than `max_bytes`.
std::string zip_member(std::string_view zip, std::string_view name, std::size_t max_bytes);

}  // namespace throng
