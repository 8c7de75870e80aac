// Names of users as names of files and folders.
#pragma once

#include <string>
#include <string_view>

namespace throng {

/// Converts a name to one for files or folders: at most 60 lower-case letters, digits and '-';
/// "dataset" if nothing is left, and no device of Windows: "con" becomes "con-dataset".
std::string slug(std::string_view name);

}  // namespace throng
