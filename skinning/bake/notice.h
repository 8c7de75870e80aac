// Attribution and licenses of the assets in a character library.
#pragma once

#include <string>
#include <vector>

#include "skinning/wardrobe/person.h"
#include "skinning/wardrobe/wardrobe.h"

namespace throng::skinning {

/// SPDX expression of the licenses of all assets used, such as "CC0-1.0 AND CC-BY-3.0".
std::string license_expression(const std::vector<PersonSpec>& people);

/// The text of NOTICE.txt for a library with these characters.
std::string notice_text(const std::vector<PersonSpec>& people, const Wardrobe& wardrobe);

}  // namespace throng::skinning
