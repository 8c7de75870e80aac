// Numbers with decimal commas in files of SDF, which libsdformat would cut to whole numbers.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace throng::imports {

/// Adds a problem (file, line, element) for each element and attribute below `element` that has
/// numbers with commas. Plugins, and elements that hold names or paths, are not looked at.
void find_number_commas(const tinyxml2::XMLElement& element, const std::string& file,
                        std::vector<Problem>& problems);

}  // namespace throng::imports
