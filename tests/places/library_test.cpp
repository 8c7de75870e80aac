#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/files.h"
#include "base/resources.h"
#include "places/blueprint.h"
#include "places/check.h"
#include "tests/world/temporary_folder.h"

namespace throng::places {
namespace {

namespace fs = std::filesystem;
using throng::testing::TemporaryFolder;

std::vector<fs::path> blueprints() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(source_folder() / "scenarios")) {
    if (entry.path().filename().string().ends_with(".place.json")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Library, HasEightPlacesEachWithAnEmergency) {
  std::size_t places = 0;
  for (const fs::path& blueprint : blueprints()) {
    if (blueprint.filename() != "everyday.place.json") continue;
    ++places;
    EXPECT_TRUE(fs::exists(blueprint.parent_path() / "emergency.place.json")) << blueprint;
  }
  EXPECT_EQ(places, 8U);
}

TEST(Library, IsMadeFromItsBlueprints) {
  // Generated files must not be changed by hand: scripts/make_scenarios.sh generates them again.
  for (const fs::path& blueprint : blueprints()) {
    const TemporaryFolder folder;
    const std::string id = blueprint.stem().stem().string();
    make_scenario(load_blueprint(blueprint), blueprint.string(), folder.path(), id);
    for (const char* suffix : {".json", "_scene.xml", "_behavior.xml"}) {
      EXPECT_TRUE(read_file(folder.path() / (id + suffix)) ==
                  read_file(blueprint.parent_path() / (id + suffix)))
          << blueprint << ": " << id << suffix << " differs; run scripts/make_scenarios.sh";
    }
  }
}

TEST(Library, HasNoFaults) {
  for (const fs::path& blueprint : blueprints()) {
    const std::string id = blueprint.stem().stem().string();
    for (const Finding& finding : check_files(blueprint.parent_path() / (id + ".json"))) {
      ADD_FAILURE() << finding.text();
    }
  }
}

}  // namespace
}  // namespace throng::places
