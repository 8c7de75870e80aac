// Attribution and licenses of the assets that characters are built from.
#pragma once

#include <string>
#include <vector>

#include "skinning/wardrobe/person.h"
#include "skinning/wardrobe/wardrobe.h"

namespace throng::skinning {

/// SPDX expression of the terms of everything that is used, e.g. "CC0-1.0 AND CC-BY-3.0".
std::string license_expression(const std::vector<PersonSpec>& people);

/// Text of NOTICE.txt for a population.
std::string notice_text(const std::vector<PersonSpec>& people, const Wardrobe& wardrobe);

}  // namespace throng::skinning
