// Gives siblings of one name different ones, so that libsdformat does not drop all but the first.
#pragma once

#include <filesystem>

#include "places/imports/sdf/local_files.h"
#include "places/imports/sdf/sdf_text.h"

namespace throng::imports {

/// Renames models, lights, actors, links, visuals and collisions of `text` that have the name of an
/// earlier sibling: "box" becomes "box_0", as in Gazebo. Included models have the names of their
/// files, unless the <include> states one; `file` is the file of the text.
void make_names_unique(SdfText& text, const std::filesystem::path& file, const LocalFiles& files);

}  // namespace throng::imports
