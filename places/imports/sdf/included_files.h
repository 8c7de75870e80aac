// Checks of a file of SDF and of all that it includes, before libsdformat reads them.
#pragma once

#include <filesystem>
#include <string>

#include "places/imports/sdf/local_files.h"

namespace throng::imports {

/// Follows the <include>s of an SDF file as far as `files` finds them. Throws InputError (file,
/// line) if a file includes itself, directly or through others, which libsdformat would follow
/// without end, and if one has numbers with decimal commas, which it would cut. Files that are no
/// XML are ignored: they are reported when they are loaded.
void check_included_files(const std::filesystem::path& file, const LocalFiles& files);

/// The name of the model, light or actor that an <include> with this URI in the file `from` brings;
/// "" if there is none.
std::string included_name(const std::string& uri, const std::filesystem::path& from,
                          const LocalFiles& files);

}  // namespace throng::imports
