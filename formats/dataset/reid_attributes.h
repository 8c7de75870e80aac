// The table of what re-identification's identities look like.
#pragma once

#include <string>

#include "formats/dataset/dataset.h"
#include "formats/dataset/reid_identities.h"

namespace throng::formats {

/// Heads of the columns, with a line's end.
std::string reid_attribute_columns();

/// The line of an identity, as the tracks' `attributes` say; what is not known is empty.
std::string reid_attribute_line(int number, ReidSide side, const Person& person);

}  // namespace throng::formats
