// The folder of the tests' robots.
#pragma once

#include <filesystem>

#include "base/files/resources.h"

namespace throng::imports {

inline std::filesystem::path robots_folder() {
  return source_folder() / "tests/places/imports/data/robots";
}

}  // namespace throng::imports
