// Numbers in files of SDF of which libsdformat would read the beginning only: those with decimal
// commas become whole ones, and units are ignored.
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

/// A pose or a size with text that is no number, of which libsdformat would read the beginning.
struct OddNumber {
  int line = 0;
  std::string element;  ///< "<radius>"
  std::string value;    ///< "3m"
};

/// The first of them below `element`, outside of plugins; line 0: there is none.
OddNumber find_odd_number(const tinyxml2::XMLElement& element);

}  // namespace throng::imports
