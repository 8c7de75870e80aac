// ZIP files of one member, as NumPy's .npz is one with one array.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace throng {

/// A ZIP file that holds `bytes` under `name`, deflated. Equal inputs give equal bytes.
std::string make_zip(std::string_view name, std::string_view bytes);

/// The bytes of a member of a ZIP file; nothing of more than `max_bytes` is unpacked. Throws
/// InputError without a source for a file that is no ZIP file, is damaged, lacks the member, or
/// whose member is larger.
std::string zip_member(std::string_view zip, std::string_view name, std::size_t max_bytes);

}  // namespace throng
