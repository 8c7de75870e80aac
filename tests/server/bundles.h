// Scenario bundles, and a scenario that is fit for use.
#pragma once

#include <string>
#include <vector>

#include "base/files/files.h"
#include "tests/base/packed.h"
#include "tests/places/scenarios/yard.h"

namespace throng::server {

/// The files of a yard with one door and sixteen people.
inline std::vector<testing::PackedEntry> yard_files(const testing::Yard& yard = {}) {
  const testing::TemporaryFolder folder;
  yard.write(folder);
  std::vector<testing::PackedEntry> files;
  for (const char* name : {"scene.xml", "behavior.xml", "yard.json"}) {
    files.push_back({name, read_file(folder.path() / name)});
  }
  return files;
}

inline std::string yard_bundle() { return packed(testing::Packing::zip, yard_files()); }

}  // namespace throng::server
