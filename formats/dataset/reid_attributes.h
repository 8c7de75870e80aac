// Table with the appearance of re-identification identities.
#pragma once

#include <string>

#include "formats/dataset/dataset.h"
#include "formats/dataset/reid_identities.h"

namespace throng::formats {

/// The header line, with its line break.
std::string reid_attribute_columns();

/// The line of an identity, from the `attributes` of tracks; unknown values are empty.
std::string reid_attribute_line(int number, ReidSide side, const Person& person);

}  // namespace throng::formats
